// Limits that give way: by their compliance, damped by their damping, and only back.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/bodies.h"
#include "support/spun_limb.h"

using namespace support;

namespace {

constexpr double g = 9.81;
const double degree = std::acos(-1.0) / 180;

struct Rebound {
    double furthest = 0; // beyond the limit, rad
    double speed = 0;    // with which it comes back, rad/s
};

// I·θ'' = −θ/α − β·θ' for as long as that turns back.
Rebound expected_rebound(double inertia, double compliance, double damping, double speed) {
    Rebound r;
    double angle = 0;
    const double step = 1e-6;
    for (double torque = 0; angle >= 0 && torque <= 0;) {
        torque = -angle / compliance - damping * speed;
        speed += torque / inertia * step;
        angle += speed * step;
        r.furthest = std::max(r.furthest, angle);
    }
    r.speed = -speed;
    return r;
}

double turned(const World& world, lks_joint_id joint, bool twist) {
    lks_fixed angle = 0;
    REQUIRE(lks_joint_angles(world, joint, twist ? nullptr : &angle, twist ? &angle : nullptr) == LKS_OK);
    return metres(angle) * degree;
}

// How much energy a humanoid whose limits are soft gains at most above what it had before, in joules.
double gained_in_fall(double damping, double tilt) {
    World world(world_def(60, 8));
    add_ground(world);
    Humanoid humanoid;
    for (lks_bone& bone : humanoid.bones) {
        bone.limit_compliance = fixed(0.005);
        bone.limit_damping = fixed(damping);
    }
    humanoid.def.transform = support::turned(at(0, 1, 0), 1, 0.3, 0, tilt);
    lks_body_id ids[LKS_HUMANOID_BONES];
    REQUIRE(humanoid.add(world, ids) == LKS_OK);
    const auto energy = [&] {
        double sum = energy_of(world);
        for (const lks_body_id id : ids) {
            sum += mass_of(world, id) * g * state_of(world, id).position.y;
        }
        return sum;
    };
    double least = energy();
    double gained = 0;
    for (int tick = 0; tick < 600; ++tick) {
        world.step();
        gained = std::max(gained, energy() - least);
        least = std::min(least, energy());
    }
    INFO("damping " << damping << ", tilted by " << tilt << " degrees: left " << energy_of(world) << " J");
    CHECK(energy_of(world) < 0.1);
    return gained;
}

} // namespace

TEST_CASE("what turns against a soft limit swings as far beyond as a spring and a damper let it") {
    struct Case {
        Spin spin;
        double inertia;
    };
    for (const double damping : {0.0, 5.0, 40.0}) {
        for (const Case& c :
             {Case{{LKS_JOINT_HINGE, fixed(0, 4, 0)}, 0.8}, Case{{LKS_JOINT_BALL, fixed(0, -4, 0)}, 0.8},
              Case{{LKS_JOINT_BALL, fixed(0, 0, 4)}, 1.6}}) {
            lks_joint_def def = lks_default_joint_def();
            def.swing_limit = fixed(30);
            def.twist_min = fixed(-30);
            def.twist_max = fixed(30);
            def.limit_compliance = fixed(0.01);
            def.limit_damping = fixed(damping);
            SpunLimb spun(c.spin, def, 20);
            World& world = spun.world;
            double furthest = 0, fastest = 0, speed = 0;
            for (int tick = 0; tick < 40; ++tick) {
                world.step();
                furthest = std::max(furthest, std::abs(turned(world, spun.joint, c.spin.twists())));
                speed = state_of(world, spun.limb).spin.length();
                fastest = std::max(fastest, speed);
            }
            const Rebound expected = expected_rebound(c.inertia, 0.01, damping, 4);
            INFO("kind " << c.spin.kind << ", inertia " << c.inertia << ", damping " << damping
                         << ": furthest " << furthest - 30 * degree << " of " << expected.furthest
                         << " rad, back at " << speed << " of " << expected.speed << " rad/s");
            CHECK(std::abs(furthest - 30 * degree - expected.furthest) < 0.03 * expected.furthest);
            CHECK(std::abs(speed - expected.speed) < 0.1);
            CHECK(fastest < 4 + 1e-3);
        }
    }
}

TEST_CASE("an arm that lies on a soft limit is beyond it by compliance times torque") {
    for (const double compliance : {0.0005, 0.002, 0.01}) {
        World world(world_def(60, 20));
        const lks_body_id anchor = add_anchor(world, {});
        lks_body_def def = lks_default_body_def();
        def.mass = fixed(10);
        def.never_sleeps = 1;
        const lks_body_id arm = add_body(world, box_shape(0.5, 0.05, 0.05), fixed(0.5, 0, 0), def);
        lks_joint_def joint = lks_default_joint_def();
        joint.kind = LKS_JOINT_HINGE;
        joint.frame_a.rotation = joint.frame_b.rotation = about(1, 0, 0, 90); // its axis along z
        joint.frame_b.position = fixed(-0.5, 0, 0);
        joint.twist_min = joint.twist_max = 0;
        joint.limit_compliance = fixed(compliance);
        joint.limit_damping = fixed(20);
        const lks_joint_id id = add_joint(world, joint, anchor, arm);
        world.step(600);
        double bent = 0;
        for (int i = 0; i < 100; ++i) {
            bent = compliance * 10 * g * 0.5 * std::cos(bent);
        }
        lks_vec3 torque{};
        REQUIRE(lks_joint_load(world, id, nullptr, &torque) == LKS_OK);
        INFO("bent by " << std::abs(turned(world, id, true)) << " of " << bent << " rad by "
                        << metres(torque.z) << " N·m");
        CHECK(std::abs(std::abs(turned(world, id, true)) / bent - 1) < 0.01);
        CHECK(std::abs(std::abs(metres(torque.z)) * compliance / bent - 1) < 0.01);
    }
}

TEST_CASE("a humanoid with soft limits falls, gains no more energy than they give back, and comes to rest") {
    constexpr int falls = 8;
    for (const double damping : {0.0, 1.0}) {
        double sum = 0;
        double worst = 0;
        for (int i = 0; i < falls; ++i) {
            const double gained = gained_in_fall(damping, 10 + 5 * i);
            sum += gained;
            worst = std::max(worst, gained);
        }
        INFO("damping " << damping << ": gained " << sum / falls << " J on the average, " << worst
                        << " at the worst");
        // A torque of 70 N·m is 12 J in an undamped one, and there are 14 of them.
        CHECK(sum / falls < (damping == 0 ? 20 : 8)); // of 700
        CHECK(worst < (damping == 0 ? 60 : 30));
        CHECK(sum > 0);
    }
}
