#include "solver/chain.h"

#include <algorithm>
#include <bit>

#include "fixed/formats.h"
#include "fixed/int128.h"
#include "fixed/vector.h"
#include "kernels/bounded.h"
#include "kernels/measure_segment.h"
#include "solver/chain_across.h"
#include "solver/chain_passes.h"
#include "solver/wrapping.h"

namespace lks {
namespace {

using fixed::multiply_shift;
using fixed::multiply_unsigned;
using fixed::Vec3;

// In every row, so that none is singular between two pins: it yields by 1.5e-11 of a multiplier.
constexpr std::uint64_t least_softness = std::uint64_t{1} << (chain_share_bits - 36);
// From here on a rope bears to be pulled apart by its pins: it is elastic.
constexpr std::uint64_t elastic_softness = std::uint64_t{1} << (chain_share_bits - 20);
// Of factors on rest lengths.
constexpr int rest_bits = 40;
constexpr std::uint64_t rest_one = std::uint64_t{1} << rest_bits;
constexpr std::uint64_t greatest_rest = std::uint64_t{1} << 62;
// How much longer than the distance of its pins a piece of rope is taken to be at least.
constexpr std::uint64_t least_slack = rest_one >> 24;
constexpr int most_solves = 32;
// substep_motion_limit.
constexpr int movement_bits = 60;
static_assert(substep_motion_limit == std::int64_t{1} << movement_bits);

// Of right sides, which are summed up without a look at each within a block.
constexpr std::int64_t side_limit = std::int64_t{1} << 61;
// Of the scale that the elimination is carried with.
constexpr std::uint64_t scale_one = std::uint64_t{1} << 62;

// Rounded down. In two parts, of which the upper one is whole: cheaper than a product of 128 bits.
std::int64_t unit_share(std::uint32_t unit, std::int64_t value) {
    const std::int64_t upper = fixed::wrapping_multiply(value >> unit_fraction_bits, unit);
    const std::int64_t lower = value & (std::int64_t{unit_one} - 1);
    return wrapping_add(upper, (lower * unit) >> unit_fraction_bits);
}

class ChainSolve {
public:
    ChainSolve(const ChainCoefficients& chain, const FamilyCoefficients& family, const DistanceArrays& arrays,
               const Kernels& kernels, std::int64_t* memory, bool torn)
        : chain_(chain), family_(family), arrays_(arrays), kernels_(kernels), count_(chain.count()),
          work_(memory, count_), torn_(torn), eased_(arrays.multipliers != nullptr && chain.softness != 0),
          softness_(std::max(chain.softness, least_softness)) {
        work_.end(count_);
    }

    // `again`: after itself, in the same substep.
    bool run(bool again) {
        off_ = false;
        any_long_ = false;
        const bool simple = !torn_ && !eased_ && family_.damping_share == 0 && chain_.pinned_count < 2;
        if (!(simple ? eliminate<true>() : eliminate<false>())) {
            return false;
        }
        substitute();
        push_particles(0);
        if (any_long_ && moves_too_far()) {
            return false;
        }
        if (!stiffen(again)) {
            move_particles();
            return true;
        }
        const int units = units_to_carry();
        if (units != 0) {
            push_particles(units);
        }
        off_ = move_across(chain_, kernels_, work_, units);
        move_particles();
        return true;
    }

    // Tensions were implicit, and a segment was left off its length.
    bool is_off() const { return off_; }

private:
    bool is_soft() const { return chain_.softness != 0; }

    Vec3 position(std::uint32_t index) const {
        const std::uint32_t p = chain_.particles[index];
        return {arrays_.x[p], arrays_.y[p], arrays_.z[p]};
    }
    Vec3 start(std::uint32_t index) const {
        const std::uint32_t p = chain_.particles[index];
        return {arrays_.start_x[p], arrays_.start_y[p], arrays_.start_z[p]};
    }
    ChainWeights weights_from(std::uint32_t first) const {
        return {chain_.weights.data() + first, chain_.weight_shifts.data() + first};
    }

    // Of the rows behind, what the next one needs.
    struct Row {
        std::uint64_t scale;        // q
        std::uint64_t scale_behind; // of the row behind it
        std::uint64_t part;         // u, of this row before it was shifted up ...
        int up;                     // ... by so much
        std::int64_t share;         // x
        std::int64_t side;          // b
    };

    // The rows from the far end to the near one. False: a segment is torn. `simple`: neither that nor
    // multipliers, damping or two pins need be looked at.
    template <bool simple>
    bool eliminate() {
        constexpr Row beginning{scale_one, 0, scale_one, 0, 0, 0};
        Row row = beginning;
        bool whole = true;
        taut_ = rest_one;
        each_block_back(count_, [&](std::uint32_t first, std::uint32_t count) {
            for (std::uint32_t last = first + count; whole && last > first;) {
                const std::uint32_t begin = last_pin(first, last);
                if (chain_.weights[last] == 0) {
                    row = beginning;
                }
                whole = eliminate_block<simple>(begin, last - begin, row);
                last = begin;
            }
        });
        return whole;
    }

    // Of the particles between these, which nothing is carried across, not even a scale; or else the first.
    std::uint32_t last_pin(std::uint32_t first, std::uint32_t last) const {
        if (chain_.pinned_within != 0) {
            for (std::uint32_t i = last - 1; i > first; --i) {
                if (chain_.weights[i] == 0) {
                    return i;
                }
            }
        }
        return first;
    }

    template <bool simple>
    bool eliminate_block(std::uint32_t first, std::uint32_t count, Row& row) {
        ChainSegments segments;
        segments.count = count;
        take_points(segments, first);
        for (int axis = 0; axis < 3; ++axis) {
            segments.directions[axis][count] = work_.directions[axis][first + count];
        }
        kernels_.chain.measure(segments);
        segments.rest_lengths = chain_.rest_lengths.data() + first;
        segments.slacks = chain_.slacks.data() + first;
        // Kernels read on to the end of a group.
        std::fill_n(segments.lengths + count, std::min(chain_block - count, chain_padding),
                    rest_behind_the_end);
        const bool stretched = simple && kernels_.chain.stretch(segments);
        if (!stretched && ((simple && !is_soft()) || !take_changes(segments, first))) {
            return false;
        }
        for (int axis = 0; axis < 3; ++axis) {
            std::copy_n(segments.directions[axis], count, work_.directions[axis] + first);
        }
        if (is_soft()) {
            std::copy_n(segments.lengths, count, work_.lengths + first);
        }
        ChainRows rows;
        rows.count = count;
        rows.near = weights_from(first);
        rows.softness = softness_;
        rows.exponent = chain_.multiplier_exponent;
        rows.versines = segments.versines;
        rows.scales[count] = static_cast<std::int64_t>(row.scale);
        rows.shares[count] = row.share;
        kernels_.chain.turn(rows);
        scale_rows(rows, first, row);
        kernels_.chain.divide(rows);
        row.share = rows.shares[0];
        std::copy_n(rows.carried + 1, count, work_.carried + first + 1);
        add_sides(segments, rows, row);
        kernels_.chain.solve(rows);
        std::copy_n(rows.multipliers, count, work_.multipliers + first);
        return true;
    }

    void take_points(ChainSegments& segments, std::uint32_t first) const {
        const std::uint32_t* const particles = chain_.particles.data() + first;
        const std::int64_t* const x = arrays_.x;
        const std::int64_t* const y = arrays_.y;
        const std::int64_t* const z = arrays_.z;
        const std::uint32_t count = segments.count;
        for (std::uint32_t i = 0; i <= count; ++i) {
            const std::uint32_t p = particles[i];
            segments.points[0][i] = x[p];
            segments.points[1][i] = y[p];
            segments.points[2][i] = z[p];
        }
    }

    // q and p of each row; q's top bit but one is set.
    void scale_rows(ChainRows& rows, std::uint32_t first, Row& row) const {
        const std::uint64_t* const weights = chain_.weight_shares.data() + first;
        const std::uint64_t softness = softness_;
        std::uint64_t scale = row.scale;
        std::uint64_t behind = row.scale_behind;
        std::uint64_t part = row.part;
        int up = row.up;
        for (std::uint32_t i = rows.count; i-- > 0;) {
            part = (upper_half(static_cast<std::uint64_t>(rows.turns[i]), behind) + part) << up;
            part = upper_half(weights[i + 1], part);
            behind = scale;
            const std::uint64_t next = upper_half(weights[i] + softness, scale) + part;
            up = std::countl_zero(next) - 1;
            scale = next << up;
            rows.scales[i] = static_cast<std::int64_t>(scale);
            rows.shifts[i] = up;
        }
        row.scale = scale;
        row.scale_behind = behind;
        row.part = part;
        row.up = up;
    }

    // b of each row.
    static void add_sides(const ChainSegments& segments, ChainRows& rows, Row& row) {
        std::int64_t side = row.side;
        for (std::uint32_t i = segments.count; i-- > 0;) {
            side = segments.changes[i] + carry(rows.carried[i + 1], side);
            rows.sides[i] = side;
        }
        row.side = bounded(side, side_limit);
    }

    // Where there is more to it than lengths. False: a segment is torn.
    bool take_changes(ChainSegments& segments, std::uint32_t first) {
        for (std::uint32_t i = segments.count; i-- > 0;) {
            const std::uint32_t index = first + i;
            if (chain_.pinned_count > 1 && chain_.weights[index + 1] == 0) {
                taut_ = tautness(index);
            }
            const std::int64_t rest = rest_length(index);
            const std::int64_t length = segments.lengths[i];
            // Neither is negative.
            if (!torn_ && length - rest > chain_.slacks[index]) {
                if (!is_soft()) {
                    return false;
                }
                any_long_ = true;
            }
            const fixed::Direction along{static_cast<std::int32_t>(segments.directions[0][i]),
                                         static_cast<std::int32_t>(segments.directions[1][i]),
                                         static_cast<std::int32_t>(segments.directions[2][i])};
            segments.changes[i] = wanted_change(index, rest, {along, length}) >> side_shift;
        }
        return true;
    }

    std::int64_t rest_length(std::uint32_t index) const {
        const std::int64_t rest = chain_.rest_lengths[index];
        return taut_ == rest_one ? rest : multiply_shift(rest, static_cast<std::int64_t>(taut_), rest_bits);
    }

    // Of the piece whose last segment this is, between two pins or one and the near end. Pins that are
    // further apart than it is long stretch all its segments alike; there is no solution, and a multiplier
    // without end, otherwise.
    std::uint64_t tautness(std::uint32_t last) const {
        // In units of which the sum of all segments fits.
        constexpr int down = 16;
        std::uint32_t first = last;
        auto length = static_cast<std::uint64_t>(chain_.rest_lengths[last] >> down);
        while (first > 0 && chain_.weights[first] != 0) {
            --first;
            length += static_cast<std::uint64_t>(chain_.rest_lengths[first] >> down);
        }
        fixed::NormalisedVector pins{};
        if (chain_.weights[first] != 0 || chain_.softness > elastic_softness ||
            !measure_segment(position(last + 1) - position(first), pins)) {
            return rest_one;
        }
        const auto apart = static_cast<std::uint64_t>(pins.length >> down);
        const fixed::UInt128 quotient =
            fixed::divide(fixed::UInt128{0, apart} << rest_bits, std::max<std::uint64_t>(length, 1)).quotient;
        const std::uint64_t ratio = std::min(fixed::saturate_to_uint64(quotient), greatest_rest);
        return std::max(rest_one, ratio + least_slack);
    }

    // It may double or close, no more, and by no more than the limit.
    static std::int64_t wanted_length_change(std::int64_t length, std::int64_t rest, std::int64_t limit) {
        const std::int64_t change = rest - length;
        if (change <= length && length <= limit) {
            return change; // it is not below −length
        }
        const std::int64_t most = std::min(length, limit);
        return std::clamp(change, -most, most);
    }

    // −c·C − σ·λ − γ'·n·(motion): how much longer the segment is to become, by no more than particles move in
    // a substep.
    std::int64_t wanted_change(std::uint32_t index, std::int64_t rest,
                               const fixed::NormalisedVector& n) const {
        const std::int64_t limit =
            torn_ ? std::min(chain_.slacks[index] / 2, substep_motion_limit) : substep_motion_limit;
        std::int64_t change = wanted_length_change(n.length, rest, limit);
        if (family_.damping_share != 0) {
            const Vec3 motion = (position(index + 1) - start(index + 1)) - (position(index) - start(index));
            const auto within_range = [](std::int64_t v) {
                return std::clamp(v, -coordinate_limit, coordinate_limit);
            };
            const std::int64_t most = std::min(n.length, limit);
            const std::int64_t along = fixed::dot(
                n.direction, Vec3{within_range(motion.x), within_range(motion.y), within_range(motion.z)});
            change = unit_share(family_.error_share, change) -
                     unit_share(family_.damping_share, std::clamp(along, -most, most));
        }
        if (eased_) {
            const int up = chain_.multiplier_exponent;
            const std::int64_t greatest = coordinate_limit >> up;
            const std::int64_t eased =
                multiply_shift(static_cast<std::int64_t>(chain_.softness),
                               arrays_.multipliers[chain_.constraints[index]], chain_share_bits);
            change -= std::clamp(eased, -greatest, greatest) * (std::int64_t{1} << up);
        }
        return change;
    }

    // Multipliers from the near end to the far one.
    void substitute() const {
        const std::uint32_t count = count_;
        const std::int64_t* const carried = work_.carried;
        std::int64_t* const multipliers = work_.multipliers;
        std::int64_t multiplier = multipliers[0];
        for (std::uint32_t j = 1; j < count; ++j) {
            const std::int64_t raised = multiplier * (std::int64_t{1} << (64 - carried_bits));
            multiplier =
                bounded(multipliers[j] + fixed::multiply_signed(carried[j], raised).hi, multiplier_limit);
            multipliers[j] = multiplier;
        }
    }

    // Whether any tension is more than a chain stands by itself. Adds the multipliers to those that are
    // carried. Tensions are those of this iteration: where bend is swept between two, it and the rope push
    // against each other in each, and their sum grows with no tension behind it.
    bool stiffen(bool again) const {
        if (arrays_.multipliers != nullptr) {
            for (std::uint32_t j = 0; j < count_; ++j) {
                std::int64_t& sum = arrays_.multipliers[chain_.constraints[j]];
                sum = bounded(fixed::saturating_add(sum, work_.multipliers[j]), multiplier_limit);
            }
        }
        const std::int64_t* tensions = work_.multipliers;
        if (again) {
            for (std::uint32_t j = 0; j < count_; ++j) {
                work_.tensions[j] = bounded(work_.tensions[j] + work_.multipliers[j], multiplier_limit);
            }
            tensions = work_.tensions;
        }
        ChainTensions task{count_,
                           std::int64_t{1} << (chain_.stiffness_bits - 2),
                           tensions,
                           chain_.stiffness.data(),
                           chain_.near_shares.data(),
                           chain_.far_shares.data(),
                           work_.near,
                           work_.far};
        bool any = kernels_.chain.stiffen(task);
        if (any && is_soft()) { // there is none where there would be none at lengths of rest
            task.tensions = tensions_at_length(tensions);
            any = kernels_.chain.stiffen(task);
        }
        if (any && tensions != work_.tensions) {
            std::copy_n(tensions, count_, work_.tensions);
        }
        return any;
    }

    // A tension turns with its segment the less the longer that is: κ is over the length, not that at rest.
    // Where the multipliers' factors were, which nothing reads any more.
    const std::int64_t* tensions_at_length(const std::int64_t* tensions) const {
        constexpr int ratio_bits = 31;
        std::int64_t* const scaled = work_.carried;
        std::fill_n(scaled + count_, chain_padding, 0); // kernels read on
        for (std::uint32_t j = 0; j < count_; ++j) {
            const auto length = static_cast<std::uint64_t>(work_.lengths[j]);
            const auto rest = static_cast<std::uint64_t>(chain_.rest_lengths[j]);
            scaled[j] = tensions[j];
            if (length > rest) {
                const int down = std::max(64 - std::countl_zero(length) - 32, 0);
                const std::uint64_t ratio = ((rest >> down) << ratio_bits) / (length >> down);
                scaled[j] = multiply_shift(tensions[j], static_cast<std::int64_t>(ratio), ratio_bits);
            }
        }
        return scaled;
    }

    // How the particles move by the multipliers, in units of 2^units coordinate units; by the limit at most.
    void push_particles(int units) const {
        ChainMoves task;
        task.exponent = chain_.multiplier_exponent - units;
        for (auto& pushes : task.pushes) {
            pushes[0] = 0;
        }
        each_block(count_ + 1, [&](std::uint32_t first, std::uint32_t count) {
            task.count = count;
            task.near = weights_from(first);
            task.multipliers = work_.multipliers + first;
            for (int axis = 0; axis < 3; ++axis) {
                task.directions[axis] = work_.directions[axis] + first;
                task.movements[axis] = work_.movements[axis] + first;
            }
            kernels_.chain.push(task);
            for (auto& pushes : task.pushes) {
                pushes[0] = pushes[count];
            }
        });
    }

    // Whether the ends of a segment that is too long, soft as it is, would move against each other by so much
    // that it is torn. Otherwise it hangs from a load.
    bool moves_too_far() const {
        constexpr std::int64_t parts = 16; // of its length
        for (std::uint32_t i = 0; i < count_; ++i) {
            const std::int64_t length = work_.lengths[i];
            if (length - chain_.rest_lengths[i] <= chain_.slacks[i]) {
                continue;
            }
            for (const std::int64_t* const movements : work_.movements) {
                if (!within(movements[i + 1] - movements[i], length / parts)) {
                    return true;
                }
            }
        }
        return false;
    }

    // None, but where a movement was limited, on which the second pass must not build: the pushes of
    // neighbours would no longer cancel, and a light particle's loss be as great a push on the heavy one
    // behind it. Seldom, and never where all multipliers are short.
    int units_to_carry() const {
        const int units = units_within_limit();
        return units != 0 && is_limited() ? units : 0;
    }

    bool is_limited() const {
        for (const std::int64_t* const movements : work_.movements) {
            for (std::uint32_t i = 0; i <= count_; ++i) {
                if (!within(movements[i], substep_motion_limit - 1)) {
                    return true;
                }
            }
        }
        return false;
    }

    // In which no movement reaches the limit: with at most half of R, a particle moves by no more than the
    // longer one of two multipliers. They are no less than half a multiplier's.
    int units_within_limit() const {
        std::uint64_t bits = 0;
        for (std::uint32_t j = 0; j < count_; ++j) {
            bits |= static_cast<std::uint64_t>(work_.multipliers[j] ^ (work_.multipliers[j] >> 63));
        }
        const int multiplier_bits = 64 - std::countl_zero(bits);
        return std::clamp(multiplier_bits + chain_.multiplier_exponent - movement_bits, 0,
                          chain_.multiplier_exponent - 1);
    }

    void move_particles() const {
        const std::uint32_t* const particles = chain_.particles.data();
        const std::int64_t* const x = work_.movements[0];
        const std::int64_t* const y = work_.movements[1];
        const std::int64_t* const z = work_.movements[2];
        const std::uint32_t count = count_;
        const DistanceArrays to = arrays_;
        for (std::uint32_t i = 0; i <= count; ++i) {
            const std::uint32_t p = particles[i];
            to.x[p] = wrapping_add(to.x[p], x[i]);
            to.y[p] = wrapping_add(to.y[p], y[i]);
            to.z[p] = wrapping_add(to.z[p], z[i]);
        }
    }

    const ChainCoefficients& chain_;
    const FamilyCoefficients& family_;
    DistanceArrays arrays_;
    const Kernels& kernels_;
    std::uint32_t count_;
    ChainWork work_;
    bool torn_;
    bool eased_; // multipliers so far count
    bool off_ = false;
    bool any_long_ = false; // of a soft rope: it may be torn, or hang from a load
    std::uint64_t softness_;
    std::uint64_t taut_ = rest_one; // what rest lengths are multiplied by in the piece at hand
};

} // namespace

bool solve_chain(const ChainCoefficients& chain, const FamilyCoefficients& family,
                 const DistanceArrays& arrays, const Kernels& kernels, std::int64_t* memory) {
    ChainSolve solve(chain, family, arrays, kernels, memory, false);
    if (!solve.run(false)) {
        return false;
    }
    for (int solved = 1; solved < most_solves && solve.is_off(); ++solved) {
        if (!solve.run(true)) {
            return false;
        }
    }
    return true;
}

bool is_torn(const ChainCoefficients& chain, const DistanceArrays& arrays) {
    const auto position = [&](std::uint32_t index) {
        const std::uint32_t p = chain.particles[index];
        return Vec3{arrays.x[p], arrays.y[p], arrays.z[p]};
    };
    for (std::uint32_t i = 0; i < chain.count(); ++i) {
        fixed::NormalisedVector n{};
        if (measure_segment(position(i + 1) - position(i), n) &&
            n.length - chain.rest_lengths[i] > chain.slacks[i]) {
            return true;
        }
    }
    return false;
}

void mend_chain(const ChainCoefficients& chain, const FamilyCoefficients& family,
                const DistanceArrays& arrays, const Kernels& kernels, std::int64_t* memory) {
    static_cast<void>(ChainSolve(chain, family, arrays, kernels, memory, true).run(false));
}

} // namespace lks
