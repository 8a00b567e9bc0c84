// Ball joints that hardly swing, or not at all: bodies cross all of their cone in a substep.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/bodies.h"

using namespace support;

namespace {

// A rod on a ball joint, below a kinematic body or below another rod, and perhaps a third one that hangs on
// it freely.
class Rods {
public:
    Rods(double cone, bool held, double third_density) : world_(world_def(60, 8)), cone_(cone) {
        REQUIRE(lks_world_set_gravity(world_, {}) == LKS_OK);
        first_ = held ? add_anchor(world_, {}) : add_rod(0.25, 1000);
        second_ = add_rod(-0.25, 1000);
        lks_joint_def def = lks_default_joint_def();
        def.swing_limit = fixed(cone);
        def.frame_a.position.y = held ? 0 : fixed(-0.25);
        def.frame_b.position.y = fixed(0.25);
        joint_ = add_joint(world_, def, first_, second_);
        if (third_density > 0) {
            def.swing_limit = fixed(180);
            def.frame_a.position.y = fixed(-0.25);
            add_joint(world_, def, second_, add_rod(-0.75, third_density));
        }
    }

    // About the joint, rad/s.
    void turn_second(double spin) {
        REQUIRE(lks_body_set_velocity(world_, second_, fixed(0.25 * spin, 0, 0), fixed(0, 0, spin)) ==
                LKS_OK);
    }
    void step() {
        world_.step();
        lks_fixed swing = 0;
        REQUIRE(lks_joint_angles(world_, joint_, &swing, nullptr) == LKS_OK);
        beyond_ = std::max(beyond_, metres(swing) - cone_);
    }

    double energy() const { return energy_of(world_); }
    double beyond() const { return beyond_; } // degrees
    // Of the second against the first.
    double spin() const {
        return std::abs(state_of(world_, second_).spin.z - state_of(world_, first_).spin.z);
    }

private:
    lks_body_id add_rod(double height, double density) const {
        return add_body(world_, box_shape(0.05, 0.25, 0.05, density), fixed(0, height, 0));
    }

    World world_;
    double cone_;
    lks_body_id first_{}, second_{};
    lks_joint_id joint_{};
    double beyond_ = 0;
};

} // namespace

// What turns one rod back is not to turn it to the other side: it was carried on as a push towards the middle
// whatever side that was, and up to 1.3 MJ came of 8 kJ.
TEST_CASE("a rod that is turned back across its narrow cone stops there") {
    double most = 0;
    for (const double cone : {0.0, 0.5, 2.0}) {
        for (const double spin : {5.0, 40.0, 200.0}) {
            for (const double third : {0.0, 500.0, 4000.0}) {
                Rods rods(cone, true, third);
                rods.turn_second(spin);
                const double start = rods.energy();
                for (int tick = 0; tick < 60; ++tick) {
                    rods.step();
                }
                INFO("cone " << cone << " degrees, " << spin << " rad/s, third rod of " << third);
                most = std::max(most, rods.energy() / start);
                CHECK(rods.energy() < 1e-4 * start);
                CHECK(rods.beyond() < 0.05);
            }
        }
    }
    MESSAGE("held: " << most << " of the energy left");
}

// An inelastic impact: together they have the momentum and the angular momentum that one of them had.
TEST_CASE("two rods with a narrow cone between them go on as one") {
    constexpr double own = (0.25 * 0.25 + 0.05 * 0.05) / 3; // of a kilogram, about its centre
    constexpr double about_joint = own + 0.25 * 0.25;
    // Half the speed of one, and half its spin about the joint, which is the middle of both.
    constexpr double left = (0.25 * 0.25 + about_joint) / 4 / ((0.25 * 0.25 + own) / 2);
    double worst = 0;
    double spin_left = 0;
    for (const double cone : {0.0, 0.5, 2.0}) {
        for (const double spin : {5.0, 40.0}) {
            Rods rods(cone, false, 0);
            rods.turn_second(spin);
            const double start = rods.energy();
            rods.step();
            worst = std::max(worst, std::abs(rods.energy() / start / left - 1));
            double least = start;
            for (int tick = 0; tick < 60; ++tick) {
                rods.step();
                CHECK(rods.energy() < least + 1e-4 * start);
                least = std::min(least, rods.energy());
            }
            INFO("cone " << cone << " degrees, " << spin << " rad/s");
            CHECK(rods.spin() < 0.03 * spin);
            CHECK(rods.beyond() < 0.05);
            spin_left = std::max(spin_left, rods.spin() / spin);
        }
    }
    MESSAGE("free: energy after the impact within " << worst << ", spin against each other " << spin_left
                                                    << " of the first");
    CHECK(worst < 0.02);
}
