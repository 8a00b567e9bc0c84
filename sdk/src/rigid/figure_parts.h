// What belongs to a figure: bodies that joints hold together, and what pushes them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fixed/int128.h"
#include "rigid/body.h"
#include "rigid/closure_parts.h"

namespace lks {

// In the order of its work. Shared contacts are those of two figures, and parts of both.
enum class Part : std::uint32_t { body, joint, tree, contact, shared_contact, attachment };
inline constexpr std::size_t part_kinds = 6;

// Figure, kind and index, so that sorted names stand figure by figure and kind by kind.
constexpr std::uint64_t name_part(std::uint32_t figure, Part kind, std::size_t index) {
    return std::uint64_t{figure} << 35 | std::uint64_t{static_cast<std::uint32_t>(kind)} << 32 | index;
}
constexpr std::uint32_t figure_of(std::uint64_t part) {
    return static_cast<std::uint32_t>(part >> 35);
}
constexpr Part kind_of(std::uint64_t part) {
    return static_cast<Part>(part >> 32 & 7);
}
constexpr std::uint32_t index_of(std::uint64_t part) {
    return static_cast<std::uint32_t>(part);
}

struct Sum3 {
    fixed::Int128 x{0, 0}, y{0, 0}, z{0, 0};

    friend constexpr Sum3 operator+(const Sum3& a, const Sum3& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
};

// Of a figure that nothing outside has pushed since it began, but for a pivot (rigid/free_figure.h).
struct FreeMotion {
    bool free;
    bool has_pivot; // a joint holds it there that turns freely
    bool has_axis;  // about this axis only, in the world: a hinge
    fixed::Direction axis;
    fixed::Vec3 pivot;         // World
    std::uint32_t pivot_joint; // index
    bool passive;              // neither motors, springs nor a pivot do any work on it
    bool each_substep;         // and not each tick
    bool gravity_works;        // on its motion about its centre of mass
    Sum3 lost;                 // of its angular momentum
    fixed::Int128 energy;      // that it began with
};

// Where the parts of each kind begin among all parts, and where the last ones end.
struct FigureRange {
    std::uint32_t begins[part_kinds + 1];
    InverseMass heaviest;   // of its heaviest body
    bool is_held;           // by a joint to what does not move
    bool has_held_tree;     // of which what joints turn is solved with their points (rigid/held_tree.h)
    bool is_pinned;         // by an attachment to a particle that does not move
    bool is_loaded;         // its trees hang on ropes that bear them (rigid/rope_loads.h)
    bool relieved;          // in this substep: it had iterations more
    std::uint32_t closures; // of the scene's closure_ranges, or no_closures
    FreeMotion motion;

    std::uint32_t begin() const { return begins[0]; }
    std::uint32_t count(Part kind) const {
        const auto k = static_cast<std::size_t>(kind);
        return begins[k + 1] - begins[k];
    }
};

// Figures that follow each other, and where their trees stand lane by lane (rigid/wide_trees.h).
struct FigureBundle {
    std::uint32_t first;
    std::uint32_t end;
    std::uint32_t first_body; // of the scene's wide_bodies and wide_joints
    std::uint32_t first_joint;

    bool is_wide() const { return end - first > 1; }
};

} // namespace lks
