// A humanoid that hangs by one of its bones, and what leads it.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/bodies.h"

namespace support {

// So far on a circle of a metre that begins at `start`.
inline lks_transform on_circle(const lks_transform& start, double radians) {
    lks_transform to = start;
    to.position.x += fixed(std::sin(radians));
    to.position.z += fixed(1 - std::cos(radians));
    return to;
}

// A humanoid over the ground, one of its bones on a ball joint of a kinematic body.
class HangingFigure {
public:
    HangingFigure(World& world, int bone, const lks_rotation& turned) : world_(world) {
        add_ground(world);
        humanoid_.def.transform = {fixed(0, 1.5, 0), turned};
        REQUIRE(humanoid_.add(world, bodies_, joints_) == LKS_OK);
        const Vector place = state_of(world, bodies_[bone]).position;
        lks_joint_def def = lks_default_joint_def();
        def.kind = LKS_JOINT_BALL;
        anchor_ = add_anchor(world, fixed(place.x, place.y, place.z));
        hold_ = add_joint(world, def, anchor_, bodies_[bone]);
        REQUIRE(lks_body_transform(world, anchor_, &start_) == LKS_OK);
    }

    // On a circle of a metre, for so many ticks; then it stops dead.
    void lead(double speed, int ticks) {
        for (int tick = 0; tick < ticks; ++tick) {
            REQUIRE(lks_body_move_to(world_, anchor_, on_circle(start_, speed * tick / 60)) == LKS_OK);
            world_.step();
        }
        least_ = whole_energy(world_, bodies_, LKS_HUMANOID_BONES);
    }

    void step() {
        world_.step();
        for (const lks_joint_id joint : joints_) {
            apart_ = std::max(apart_, error_of(world_, joint));
        }
        apart_ = std::max(apart_, error_of(world_, hold_));
        const double energy = whole_energy(world_, bodies_, LKS_HUMANOID_BONES);
        rise_ = std::max(rise_, energy - least_);
        least_ = std::min(least_, energy);
    }

    double apart() const { return apart_; } // m
    double rise() const { return rise_; }   // J, above the least before

private:
    World& world_;
    Humanoid humanoid_;
    lks_body_id bodies_[LKS_HUMANOID_BONES]{};
    lks_joint_id joints_[LKS_HUMANOID_BONES - 1]{};
    lks_body_id anchor_{};
    lks_joint_id hold_{};
    lks_transform start_{};
    double apart_ = 0;
    double rise_ = 0;
    double least_ = 1e9;
};

} // namespace support
