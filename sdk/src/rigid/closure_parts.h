// What the solver of rigid/closures.h keeps of joints that close loops, and of the trees that they close.
#pragma once

#include <cstddef>
#include <cstdint>

#include "collide/manifold.h"
#include "rigid/body.h"
#include "rigid/held_row.h"
#include "rigid/row_joint.h"

namespace lks {

// Of a figure: what closes loops in more is swept, and so are limits and contacts that there is no room for.
inline constexpr std::uint32_t most_closure_rows = 48;
inline constexpr std::uint32_t closure_rows_a_joint = 3;
inline constexpr std::uint32_t closure_rows_a_pin = 3;
// Where it stands on light feet: limits, and contacts' points.
inline constexpr std::uint32_t standing_rows_a_joint = 8;

struct ClosureSide {
    std::uint32_t body;
    std::uint32_t tree; // no_tree: it does not move
    fixed::Vec3 lever;  // as its factors have it: as ArticulatedJoint's
};

// A joint that closes a loop, an attachment to what does not move, a joint of a tree that has limits, or a
// contact of a foot.
struct Closure {
    enum class Kind : std::uint8_t { closing, pin, limits, foot };

    Kind kind;
    std::uint32_t index; // of the scene's joints, attachments, or contacts
    std::uint32_t first_row;
    std::uint32_t row_count;
    ClosureSide a;
    ClosureSide b;
    std::int64_t
        pair_share; // the greater inverse mass of its bodies in the figure's greatest, 32 fraction bits
};

// What it holds in one direction, as the factors have it.
struct ClosureRow {
    enum class Kind : std::uint8_t { distance, point, turn, limit, contact };

    Kind kind;
    HeldRow::Kind limit;    // of which kind
    std::uint8_t point;     // of the contact
    fixed::Direction along; // b's point from a's, or about it b against a; in the world
    std::int32_t scale;     // the power of two by which it is scaled, so that `own` is about one
    std::int64_t own;       // what its bodies by themselves give way by, 40 fraction bits
    fixed::Vec3 torque_a;   // of a unit push, 40 fraction bits
    fixed::Vec3 torque_b;
};

// Of one figure: which of the scene's closures, rows and entries of closure_matrix are its.
struct ClosureRange {
    std::uint32_t figure;
    InverseMass lightest; // of its bodies
    std::uint32_t first;
    std::uint32_t end;
    std::uint32_t first_row;
    std::uint32_t row_room;
    std::uint32_t row_count; // of its last factors
    std::uint32_t first_entry;
    bool stands; // on light feet
};
inline constexpr std::uint32_t no_closures = UINT32_MAX;

// Of all figures of a scene with so many joints: with as many contacts as there are rows for.
constexpr std::size_t closure_room(std::size_t joints) {
    return (1 + standing_rows_a_joint / greatest_point_count) * joints;
}

// Row by row up to the diagonal.
constexpr std::uint32_t entry_of(std::uint32_t row, std::uint32_t column) {
    return row * (row + 1) / 2 + column;
}
inline constexpr std::uint32_t most_closure_entries = entry_of(most_closure_rows, 0);
// Of all figures of a scene with so many joints, and attachments; and with so many rows.
constexpr std::size_t greatest_closure_rows(std::size_t joints, std::size_t attachments) {
    return standing_rows_a_joint * joints + closure_rows_a_pin * attachments;
}
constexpr std::size_t greatest_closure_entries(std::size_t rows) {
    return rows * (most_closure_rows + 1) / 2;
}

} // namespace lks
