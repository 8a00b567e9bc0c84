// A collider's motion through a tick, and what one object sees of it during one substep.
//
// Only differences of world positions enter, as exact integers, so the same scene moved by any number of
// World units gives the same bits. Poses at the ends of the substeps are on a line from the pose at the start
// of the tick to its target: positions by exact division, rotations by fixed::interpolate; the end of one
// substep is to the bit the start of the next.
#pragma once

#include <cstdint>

#include "collide/filter.h"
#include "collide/shape.h"
#include "fixed/rotation.h"
#include "fixed/vector.h"

namespace lks {

struct Bounds; // solver/object.h: low and high corner

struct ColliderState {
    Shape shape;
    lks_filter filter;
    std::int64_t static_friction;  // World
    std::int64_t dynamic_friction; // World
    std::int64_t restitution;      // World: for bodies alone
    // At the start of the tick, and at its end. Rotations are normalised.
    fixed::Vec3 position; // World
    fixed::Vec3 target_position;
    fixed::Rotation rotation;
    fixed::Rotation target_rotation;
    // At the start of the tick before, for views only.
    fixed::Vec3 previous_position;
    fixed::Rotation previous_rotation;

    bool rotates() const { return !(rotation == target_rotation); }
    bool moves() const { return rotates() || !(position == target_position); }
};

// a + (b - a) · numerator / denominator without overflow, rounded towards a in two parts; exactly a and b at
// the ends. |b - a| < 2^62, numerator <= denominator.
std::int64_t interpolate_position(std::int64_t a, std::int64_t b, std::uint32_t numerator,
                                  std::uint32_t denominator);

// One collider from one object, during one substep. The shape's frame goes evenly from its start to its end
// pose, and so does a particle from its position at the start of the substep to where it is now; contacts are
// looked for on the straight way between these two ends as the shape sees them.
struct ContactFrame {
    Shape shape;
    std::int64_t margin;           // the particles' radius
    fixed::Matrix3 start_rotation; // local to object space
    fixed::Matrix3 end_rotation;
    fixed::Vec3 start_centre; // Coordinate, relative to the object's origin
    fixed::Vec3 end_centre;
    std::uint32_t static_friction;
    std::uint32_t dynamic_friction;
    // How much of an overlap from before the substep is undone in it.
    std::int64_t greatest_recovery;
    bool moving;
    bool rotating;
    // False: no particle within the bounds can touch it in this substep.
    bool reachable;
    // False: it turns too far for the box below to tell anything.
    bool has_box;
    // A particle whose way through the substep has a bounding box that misses this one does not touch the
    // shape. Where the collider rotates, the particle's own motion makes the particle's box larger by half.
    fixed::Vec3 box_low;
    fixed::Vec3 box_high;
    // The most by which that makes any particle's box larger; INT64_MAX where it is not known.
    std::int64_t greatest_growth;
};

// A shape's way through one substep.
struct ShapeWay {
    Shape shape;
    fixed::Vec3 start; // World
    fixed::Vec3 end;
    fixed::Matrix3 start_rotation;
    fixed::Matrix3 end_rotation;
    bool rotating;
    std::int64_t static_friction; // World
    std::int64_t dynamic_friction;
};

// `bounds` contain the particles now and at the start of the substep, in the object's coordinates around
// `origin`. `friction_factor` is the asset's, World.
ContactFrame make_contact_frame(const ShapeWay& way, const fixed::Vec3& origin, const Bounds& bounds,
                                std::int64_t margin, std::int64_t friction_factor);
// The same of a collider. `substep` counts from 1 to `substeps`.
ContactFrame make_contact_frame(const ColliderState& collider, std::uint32_t substep, std::uint32_t substeps,
                                const fixed::Vec3& origin, const Bounds& bounds, std::int64_t margin,
                                std::int64_t friction_factor);

} // namespace lks
