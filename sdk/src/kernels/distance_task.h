// A piece of work for a distance kernel: batches of one object that have their parameters in common. Plain
// data, and no functions: kernels are compiled for instruction sets that not every machine has, and what they
// share with others must not be code.
#pragma once

#include <cstddef>
#include <cstdint>

#include "asset/constraint_runs.h"
#include "fixed/formats.h"

namespace lks {

// Of the particles of one object. Kernels may read up to widest_group − 1 elements behind each.
struct DistanceArrays {
    std::int64_t* x;
    std::int64_t* y;
    std::int64_t* z;
    // At the start of the substep; read only where there is damping.
    const std::int64_t* start_x;
    const std::int64_t* start_y;
    const std::int64_t* start_z;
    // Λ by constraint in Coordinate format; null where nobody needs it.
    std::int64_t* multipliers;
};

// What is the same for all constraints of a batch.
struct DistanceParameters {
    bool operator==(const DistanceParameters&) const = default;

    std::int32_t difference_shift; // s
    std::int32_t rest_exponent;
    std::int32_t gain_shift;    // Unit × Direction product to gain, 31 .. 41
    std::int32_t product_shift; // gain × difference product to Coordinate
    std::uint32_t error_share;  // c and γ', together at most one
    std::uint32_t damping_share;
};

// Constraints of one batch, which may be taken in any order and by any thread.
struct ConstraintRange {
    std::uint32_t first;
    std::uint32_t last; // one behind, and not before the first
};

constexpr bool is_in(ConstraintRange range, std::uint32_t constraint) {
    return constraint - range.first < range.last - range.first;
}

// All of one batch, or a part.
struct BatchPart {
    ConstraintRange range;
    const Run* runs; // those that reach into the range, in order, and then perhaps others
    std::uint32_t run_count;
    std::uint32_t first_single; // constraint: from here on its ends are in the task's `constraints`
    // Outside of these, which need not be in `range`, both ends have the same share.
    ConstraintRange unequal_shares;
    bool few_unequal; // of the batch: what kernels do where both are the same may pay
    bool whole;       // nobody else is at work on the batch
};

// Where a particle stands in the arrays of an object, or of one that is side by side with it.
constexpr std::ptrdiff_t place_of(std::uint32_t particle) {
    return static_cast<std::ptrdiff_t>(particle);
}

// A part in both ends' movements where they move alike; Direction.
inline constexpr std::uint32_t half_part = std::uint32_t{direction_one} / 2;
// The share of what is stiff and moves alike is a half: 2^half_share_bits, Unit.
inline constexpr int half_share_bits = unit_fraction_bits - 1;

// Objects in one task: with fewer than three a group would wait for itself.
inline constexpr std::uint32_t least_side_by_side = 3;
inline constexpr std::uint32_t most_side_by_side = 16;

struct DistanceTask {
    const BatchPart* parts; // one after the other
    std::uint32_t part_count;
    bool short_runs; // of less than widest_group constraints on the average of each batch
    bool soft;
    bool damped;
    // Each of the arrays begins within rows of row_length (kernels/row_task.h), and runs are not asked for.
    // Not all kernels take them (kernels.h).
    bool in_rows;
    DistanceParameters parameters;
    const Constraint* constraints;
    // By constraint; kernels read up to widest_group - 1 of each behind the last one.
    const std::uint32_t* rest_mantissas;
    // Unit, scaled: of each end where both move alike, and then at most a half; elsewhere of both together.
    // Not read where what is not soft moves alike.
    const std::uint32_t* shares;
    const std::uint32_t* parts_b;     // Direction, 0 .. 1: how much of both ends' movements is b's
    const std::uint32_t* relaxations; // null where needless
    DistanceArrays arrays;
    // Of objects side by side, which have all of the above in common, `arrays` are the first one's: how far
    // from them each one's are, in elements. Null: it is the only one. Then there are no multipliers, and
    // runs only; not all kernels take them (kernels.h).
    const std::ptrdiff_t* objects;
    std::uint32_t object_count;
};

} // namespace lks
