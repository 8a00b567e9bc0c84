// Springs so soft that they swing once in minutes: joints, limits and attachments give way by their
// compliance, and damp by their damping, however little a substep has of it.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "support/attachments.h"
#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

constexpr double g = 9.81;
const double turn = 2 * std::acos(-1.0);
const double periods[] = {10, 40, 160}; // s

// Of what swings once in a period.
double compliance_of(double period, double inertia) {
    return period * period / (turn * turn * inertia);
}

// Where what begins at rest is after `time` when it falls onto its spring.
double fallen(double period, double time) {
    const double rate = turn / period;
    return g / (rate * rate) * (1 - std::cos(rate * time));
}

lks_body_def awake() {
    lks_body_def def = lks_default_body_def();
    def.never_sleeps = 1;
    return def;
}

double angle_of(const BodyState& state) {
    const double x = state.rotation.x, y = state.rotation.y, z = state.rotation.z;
    return 2 * std::atan2(std::sqrt(x * x + y * y + z * z), std::abs(double(state.rotation.w)));
}

constexpr double radius = 0.3;

double inertia_of(const World& world, lks_body_id ball) {
    return 0.4 * mass_of(world, ball) * radius * radius;
}

constexpr int ticks = 300;
constexpr double time = ticks / 60.0;

} // namespace

TEST_CASE("what hangs on the points of a soft joint falls as its period has it") {
    for (const double period : periods) {
        for (const lks_joint_kind kind :
             {LKS_JOINT_DISTANCE, LKS_JOINT_BALL, LKS_JOINT_HINGE, LKS_JOINT_FIXED}) {
            World world(world_def(60, 20));
            const lks_body_id anchor = add_anchor(world, {});
            const bool hangs = kind == LKS_JOINT_DISTANCE;
            const lks_body_id ball =
                add_body(world, ball_shape(radius), hangs ? fixed(0, -1, 0) : lks_vec3{}, awake());
            lks_joint_def joint = lks_default_joint_def();
            joint.kind = kind;
            joint.distance_max = fixed(1);
            joint.compliance = fixed(compliance_of(period, mass_of(world, ball)));
            const lks_joint_id id = add_joint(world, joint, anchor, ball);
            world.step(ticks);
            const double found = error_of(world, id);
            INFO("kind " << kind << ", " << period << " s: " << found << " of " << fallen(period, time)
                         << " m");
            CHECK(std::abs(found / fallen(period, time) - 1) < 5e-4);
        }
    }
}

TEST_CASE("what hangs on a soft attachment falls as its period has it") {
    for (const double period : periods) {
        World world(world_def(60, 20));
        const Asset points = loose_points({{0, 0, 0}, {9, 0, 0}}, {0.1, 0.1});
        const lks_object_id object = world.add(points, at(0, 0, 0));
        world.pin(object, 0);
        const lks_body_id ball = add_body(world, ball_shape(radius), {}, awake());
        lks_attachment_def def = to_body(object, 0, ball);
        def.compliance = fixed(compliance_of(period, mass_of(world, ball)));
        attach(world, def);
        world.step(ticks);
        const double found = -state_of(world, ball).position.y;
        INFO(period << " s: " << found << " of " << fallen(period, time) << " m");
        CHECK(std::abs(found / fallen(period, time) - 1) < 5e-4);
    }
}

TEST_CASE("what turns against a soft joint, or beyond a soft limit, turns as its period has it") {
    constexpr double speed = 0.2; // rad/s
    struct Case {
        lks_joint_kind kind;
        bool limited;
        lks_vec3 spin;
    };
    const Case cases[] = {{LKS_JOINT_FIXED, false, fixed(speed * 0.6, 0, speed * 0.8)},
                          {LKS_JOINT_HINGE, false, fixed(speed, 0, 0)},
                          {LKS_JOINT_HINGE, true, fixed(0, speed, 0)},
                          {LKS_JOINT_BALL, true, fixed(0, -speed, 0)},
                          {LKS_JOINT_BALL, true, fixed(0, 0, speed)}};
    for (const double period : periods) {
        for (const Case& c : cases) {
            World world(weightless(20));
            const lks_body_id anchor = add_anchor(world, {});
            lks_body_def def = awake();
            def.angular_velocity = c.spin;
            const lks_body_id ball = add_body(world, ball_shape(radius), {}, def);
            const double compliance = compliance_of(period, inertia_of(world, ball));
            lks_joint_def joint = lks_default_joint_def();
            joint.kind = c.kind;
            if (c.limited) {
                joint.swing_limit = joint.twist_min = joint.twist_max = 0;
                joint.limit_compliance = fixed(compliance);
            } else {
                joint.angular_compliance = fixed(compliance);
            }
            add_joint(world, joint, anchor, ball);
            world.step(ticks);
            const double rate = turn / period;
            const double expected = std::abs(speed / rate * std::sin(rate * time));
            const double found = angle_of(state_of(world, ball));
            INFO("kind " << c.kind << std::string(c.limited ? ", limit, " : ", ") << period << " s: " << found
                         << " of " << expected << " rad");
            CHECK(std::abs(found - expected) < 1e-3 * speed * time);
        }
    }
}

TEST_CASE("a joint that hardly damps slows what turns down by so much") {
    for (const double lasting : {100.0, 1e4}) { // s, until a third of the speed is left
        World world(weightless(20));
        const lks_body_id anchor = add_anchor(world, {});
        lks_body_def def = awake();
        def.angular_velocity = fixed(0, 2, 0);
        const lks_body_id ball = add_body(world, ball_shape(radius), {}, def);
        lks_joint_def joint = lks_default_joint_def();
        joint.kind = LKS_JOINT_BALL;
        joint.angular_damping = fixed(inertia_of(world, ball) / lasting);
        add_joint(world, joint, anchor, ball);
        world.step(3600);
        const double lost = 1 - state_of(world, ball).spin.length() / 2;
        const double expected = 1 - std::exp(-60 / lasting);
        INFO("lost " << lost << " of " << expected);
        CHECK(std::abs(lost / expected - 1) < 0.02);
    }
}

// Softer than anything counts as: ω² = n² / 2^30.
TEST_CASE("the softest joints of the heaviest bodies, at the highest rates, overflow nowhere") {
    const double rate = 1e5 / std::exp2(15);
    for (const lks_joint_kind kind : {LKS_JOINT_DISTANCE, LKS_JOINT_BALL, LKS_JOINT_HINGE, LKS_JOINT_FIXED}) {
        for (const double apart : {0.0, 1e3, 8e6}) {
            World world(world_def(1000, 100));
            const lks_body_id anchor = add_anchor(world, {});
            lks_body_def def = awake();
            def.mass = fixed(1e5);
            def.angular_velocity = fixed(3, -2, 4);
            const lks_body_id ball = add_body(world, ball_shape(2), fixed(0, -apart, 0), def);
            lks_joint_def joint = lks_default_joint_def();
            joint.kind = kind;
            joint.distance_max = 0;
            joint.compliance = joint.angular_compliance = joint.limit_compliance = fixed(1000);
            joint.swing_limit = joint.twist_min = joint.twist_max = 0;
            joint.angular_damping = 1;
            add_joint(world, joint, anchor, ball);
            world.step(200);
            const BodyState state = state_of(world, ball);
            INFO("kind " << kind << ", " << apart << " m: " << state.velocity.y << " m/s, "
                         << state.spin.length() << " rad/s");
            CHECK(state.spin.length() < std::sqrt(29.0) + 1e-6);
            // Towards the anchor, where it is not there, and at most at the speed limit.
            if (apart == 0) {
                CHECK(std::abs(state.velocity.y + g / rate * std::sin(rate * 0.2)) < 1e-3);
            } else {
                CHECK(state.velocity.y > 900);
                CHECK(state.velocity.y < 1000 + 1e-3);
            }
        }
    }
}
