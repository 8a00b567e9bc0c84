// How the two frames of a joint are turned against each other, and rows that turn them.
#pragma once

#include "rigid/joint.h"

namespace lks {

// A joint's two axes in the world.
struct JointAxes {
    fixed::Direction a, b;
};

JointAxes axes_of(const Joint& joint, const Body& a, const Body& b);
// From a's frame to b's; w is not negative.
fixed::Rotation relative_rotation(const Joint& joint, const Body& a, const Body& b);
// A vector in the frame of a, 30 fraction bits, in the world.
fixed::Direction from_frame_a(const Joint& joint, const Body& a, const fixed::Direction& v);
// u × v, 30 fraction bits.
fixed::Vec3 sines(const fixed::Direction& u, const fixed::Direction& v);
// Angles, from 30 fraction bits to World.
constexpr std::int64_t to_world_angle(std::int64_t angle) {
    return angle * (std::int64_t{1} << (world_fraction_bits - 30));
}
// By a turning push.
void turn_apart(const Joint& joint, Body& a, Body& b, const fixed::Vec3& p);

// One row about an axis: what is to be turned, and by how much.
class TurnRow {
public:
    TurnRow(const Joint& joint, Body& a, Body& b, const fixed::Direction& axis, std::int64_t softness = 0);

    // What it takes to turn b against a by this angle about the axis.
    std::int64_t push_for(std::int64_t angle) const { return possible_ ? divide(angle, inverse_) : 0; }
    void apply(std::int64_t p) const;
    // Both; the push that it took.
    std::int64_t turn_by(std::int64_t angle) const;

private:
    Body& a_;
    Body& b_;
    RowSide side_a_{};
    RowSide side_b_{};
    Inverse inverse_{};
    bool possible_ = false;
};

// b is turned back against a by an angle about an axis, softly where the softness is not zero; adds to
// `push`.
void turn_back(const Joint& joint, Body& a, Body& b, const fixed::Direction& axis, std::int64_t angle,
               std::int64_t softness, fixed::Vec3& push);

} // namespace lks
