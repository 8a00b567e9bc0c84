// How far soft joints give way, against compliance times load.
#include <doctest/doctest.h>

#include <cmath>

#include "support/bodies.h"

using namespace support;

namespace {

constexpr double g = 9.81;

// Of a body, 1/s.
struct Damping {
    double linear = 0;
    double angular = 0;
};

// What hangs or stands out from an anchor after twelve seconds, when its damping has brought it to rest.
struct Soft {
    Soft(const lks_joint_def& joint, const lks_body_shape& shape, const lks_vec3& place,
         const Damping& damping)
        : world(world_def(60, 20)) {
        const lks_body_id anchor = add_anchor(world, {});
        lks_body_def def = lks_default_body_def();
        def.linear_damping = fixed(damping.linear);
        def.angular_damping = fixed(damping.angular);
        def.never_sleeps = 1;
        body = add_body(world, shape, place, def);
        id = add_joint(world, joint, anchor, body);
        world.step(720);
        REQUIRE(state_of(world, body).velocity.length() < 1e-5);
    }
    double error() const { return error_of(world, id); }

    World world;
    lks_body_id body{};
    lks_joint_id id{};
};

void check_hanging(double joint_damping, const Damping& body_damping) {
    for (const lks_joint_kind kind : {LKS_JOINT_DISTANCE, LKS_JOINT_BALL, LKS_JOINT_HINGE, LKS_JOINT_FIXED}) {
        for (const double compliance : {0.001, 0.002, 0.01}) { // a third of a metre, two thirds, three metres
            lks_joint_def joint = lks_default_joint_def();
            joint.kind = kind;
            joint.distance_max = fixed(1);
            joint.compliance = fixed(compliance);
            joint.damping = fixed(joint_damping);
            const bool hangs = kind == LKS_JOINT_DISTANCE;
            const Soft soft(joint, ball_shape(0.2), hangs ? fixed(0, -1, 0) : lks_vec3{}, body_damping);
            // A body's damping takes its share of what gravity gave it in the substep.
            const double pull = g * (1 - body_damping.linear / 1200);
            const double expected = compliance * mass_of(soft.world, soft.body) * pull;
            const double found = soft.error();
            INFO("kind " << kind << ": " << found << " of " << expected << " m");
            CHECK(std::abs(found / expected - 1) < 1e-4);
        }
    }
}

} // namespace

TEST_CASE("soft distances, and the points of soft joints, give way by compliance times weight, however far") {
    check_hanging(100, {});
}

TEST_CASE("without damping of their own, too, where the body's damping brings it to rest") {
    check_hanging(0, {3, 0});
}

namespace {

// An arm of 20 kg, a metre long, level at first; a hinge's axis lies along it.
void check_bent(double joint_damping, const Damping& body_damping) {
    for (const lks_joint_kind kind : {LKS_JOINT_HINGE, LKS_JOINT_FIXED}) {
        for (const double compliance : {0.0005, 0.002, 0.01, 0.05}) {
            lks_joint_def joint = lks_default_joint_def();
            joint.kind = kind;
            joint.frame_a.rotation = joint.frame_b.rotation = about(0, 0, 1, 90);
            joint.frame_b.position = fixed(-0.5, 0, 0);
            joint.angular_compliance = fixed(compliance);
            joint.angular_damping = fixed(joint_damping);
            const Soft soft(joint, box_shape(0.5, 0.05, 0.1), fixed(0.5, 0, 0), body_damping);
            // θ = α·m·g·l·cos θ.
            const double torque = mass_of(soft.world, soft.body) * g * 0.5;
            double bent = 0;
            for (double step = 1; step > 1e-12; step /= 2) {
                bent += bent + step < compliance * torque * std::cos(bent + step) ? step : 0;
            }
            const Vector at = state_of(soft.world, soft.body).position;
            const double found = std::atan2(-at.y, at.x);
            INFO("kind " << kind << ": " << found << " of " << bent << " rad");
            CHECK(std::abs(found / bent - 1) < 1e-4);
        }
    }
}

} // namespace

TEST_CASE("a soft hinge and a soft fixed joint bend across by angular compliance times torque, however far") {
    check_bent(20, {});
}

TEST_CASE("without damping of their own, too, where the body's damping stops it turning") {
    check_bent(0, {0, 12});
}

// A rod of a metre, or a box half a metre away, that sticks out level from an anchor, held by the joint's
// friction of so many times the load.
struct Held {
    Held(lks_joint_def joint, bool rod, double friction, std::uint32_t substeps)
        : world(world_def(60, substeps)) {
        const lks_body_id anchor = add_anchor(world, {});
        lks_body_shape shape = rod ? capsule_shape(0.04, 0.46) : box_shape(0.1, 0.1, 0.1);
        shape.transform.rotation = about(0, 0, 1, 90);
        lks_body_def def = lks_default_body_def();
        def.never_sleeps = 1;
        def.filter.mask = 0;
        body = add_body(world, shape, fixed(0.5, 0, 0), def);
        joint.frame_b.position = fixed(-0.5, 0, 0);
        joint.friction = fixed(friction * mass_of(world, body) * g * 0.5);
        id = add_joint(world, joint, anchor, body);
    }
    double sag() const { return -state_of(world, body).position.y; }

    World world;
    lks_body_id body{};
    lks_joint_id id{};
};

void check_held(const lks_joint_def& joint, std::uint32_t substeps, double friction, double sunk) {
    for (const bool rod : {true, false}) {
        Held held(joint, rod, friction, substeps);
        held.world.step(120);
        const double early = held.sag();
        held.world.step(1200);
        // What the rigid joint takes to find its load, and by how much a soft one gives way by.
        const double most = (rod ? 0.1 : 1.0) / (substeps * substeps) + sunk;
        INFO(substeps << " substeps, rod " << rod << ": " << early << ", then " << held.sag() << " m");
        CHECK(std::abs(held.sag()) < most);
        CHECK(std::abs(held.sag() - early) < 1e-5);
    }
}

TEST_CASE("friction holds a load on a soft joint as long as on a rigid one") {
    for (const std::uint32_t substeps : {4u, 8u, 20u}) {
        for (const lks_joint_kind kind : {LKS_JOINT_BALL, LKS_JOINT_HINGE}) {
            for (const double friction : {1.2, 5.0}) {
                lks_joint_def joint = lks_default_joint_def();
                joint.kind = kind;
                joint.frame_a.rotation = joint.frame_b.rotation = about(1, 0, 0, 90);
                check_held(joint, substeps, friction, 0);
                joint.angular_compliance = fixed(1e-6);
                check_held(joint, substeps, friction, 0);
                joint.compliance = fixed(1e-6);
                check_held(joint, substeps, friction, 2e-4);
                joint.angular_compliance = 0;
                check_held(joint, substeps, friction, 2e-4);
            }
        }
    }
}

// Swept one by one they sank, or rose, by 4 to 236 mm.
TEST_CASE("friction holds up a row of boxes on soft joints") {
    for (const std::uint32_t substeps : {8u, 20u}) {
        for (int count = 2; count <= 4; ++count) {
            World world(world_def(60, substeps));
            lks_body_id last = add_anchor(world, {});
            for (int i = 0; i < count; ++i) {
                lks_body_def def = lks_default_body_def();
                def.never_sleeps = 1;
                const lks_body_id before = last;
                last = add_body(world, box_shape(0.1, 0.05, 0.05), fixed(0.1 + 0.2 * i, 0, 0), def);
                lks_joint_def joint = lks_default_joint_def();
                joint.frame_a.position = i == 0 ? lks_vec3{} : fixed(0.1, 0, 0);
                joint.frame_b.position = fixed(-0.1, 0, 0);
                joint.friction = fixed(60);
                joint.compliance = fixed(1e-5);
                joint.damping = fixed(50);
                add_joint(world, joint, before, last);
            }
            world.step(60);
            const double height = state_of(world, last).position.y;
            world.step(1200);
            INFO(count << " at " << substeps);
            CHECK(std::abs(state_of(world, last).position.y - height) < (substeps == 8 ? 0.003 : 0.0003));
        }
    }
}

TEST_CASE("friction of a soft hinge that leans bears the load about its axis only") {
    for (const std::uint32_t substeps : {4u, 8u, 20u}) {
        lks_joint_def joint = lks_default_joint_def();
        joint.kind = LKS_JOINT_HINGE;
        joint.frame_a.rotation = joint.frame_b.rotation = about(1, 0, 0, 30);
        joint.angular_compliance = fixed(1e-5);
        Held held(joint, true, 0.6, substeps); // half of the load is about the axis
        held.world.step(120);
        const double early = held.sag();
        held.world.step(1200);
        INFO(substeps << " substeps: " << early << ", then " << held.sag() << " m");
        CHECK(std::abs(held.sag()) < 5e-4);
        CHECK(std::abs(held.sag() - early) < 2e-5);
    }
}
