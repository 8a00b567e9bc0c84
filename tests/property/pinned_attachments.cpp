// What is attached to a vertex when that is pinned, or lets go, and what hangs on a pinned one.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/attachments.h"
#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

Vector force_of(const World& world, lks_attachment_id id) {
    lks_vec3 force{};
    REQUIRE(lks_attachment_force(world, id, &force) == LKS_OK);
    return metres(force);
}

// Joints and motion are damped a little, so that it rests after a while.
struct CalmHumanoid : Humanoid {
    CalmHumanoid() {
        for (lks_bone& bone : bones) {
            bone.body.linear_damping = bone.body.angular_damping = fixed(0.5);
            bone.friction = fixed(1);
        }
    }
};

} // namespace

TEST_CASE("who hangs at rest from a vertex stays so when that is pinned, and when it lets go again") {
    for (const std::uint32_t solver : {LKS_ROPE_SWEPT, LKS_ROPE_DIRECT}) {
        World world(world_def(60, 8));
        lks_rope_def rope = lks_default_rope_def();
        rope.segments = 10;
        rope.length = 1;
        rope.linear_density = 0.1;
        rope.solver = solver;
        const Asset asset(rope);
        lks_object_def object = object_def(asset, turned(at(0, 4, 0), 0, 0, 1, -90));
        object.linear_damping = fixed(1);
        const lks_object_id id = world.add(object);
        world.pin(id, 0);
        CalmHumanoid humanoid;
        humanoid.def.transform.position = fixed(0, 1.2, 0);
        lks_body_id bones[LKS_HUMANOID_BONES];
        REQUIRE(humanoid.add(world, bones) == LKS_OK);
        const lks_attachment_id held =
            attach(world, to_body(id, 10, bones[LKS_HUMANOID_HEAD], fixed(0, 0.1, 0)));
        world.step(2400);
        REQUIRE(energy_of(world) < 0.05);
        const Vector weight = force_of(world, held);
        INFO("solver " << solver);
        CHECK(std::abs(std::abs(weight.y) / (78.0 * 9.81) - 1) < 0.02);
        REQUIRE(lks_object_pin(world, id, 10) == LKS_OK);
        CHECK((force_of(world, held) - weight).length() < 1e-3 * weight.length());
        for (int tick = 0; tick < 60; ++tick) {
            world.step();
            CHECK(energy_of(world) < 0.5);
            CHECK((force_of(world, held) - weight).length() < 0.2 * weight.length());
        }
        const Vector pinned = force_of(world, held);
        REQUIRE(lks_object_unpin(world, id, 10) == LKS_OK);
        CHECK((force_of(world, held) - pinned).length() < 1e-3 * pinned.length());
        world.step(2);
        CHECK(energy_of(world) < 0.5);
    }
}

TEST_CASE("an attachment's force is that of the last tick, whatever is pinned since, and from an image") {
    const Asset rope(lks_default_rope_def());
    for (const int what : {0, 1, 2}) { // the vertex is pinned, let go; the body becomes dynamic
        World world(world_def(60, 20));
        const lks_object_id object = world.add(rope, at(0, 0, 0));
        world.pin(object, 0);
        if (what == 1) {
            world.pin(object, 50);
        }
        lks_body_def def = lks_default_body_def();
        def.kind = what == 2 ? LKS_BODY_KINEMATIC : LKS_BODY_DYNAMIC;
        def.mass = fixed(1);
        const lks_body_id body = add_body(world, ball_shape(0.5), fixed(5.5, 0, 0), def);
        lks_attachment_def hold = to_body(object, 50, body, fixed(-0.5, 0, 0));
        hold.compliance = fixed(0.001);
        const lks_attachment_id held = attach(world, hold);
        world.step(300);
        const Vector force = force_of(world, held);
        REQUIRE(force.length() > 0.5);
        const lks_result changed = what == 0   ? lks_object_pin(world, object, 50)
                                   : what == 1 ? lks_object_unpin(world, object, 50)
                                               : lks_body_set_kind(world, body, LKS_BODY_DYNAMIC);
        REQUIRE(changed == LKS_OK);
        INFO("change " << what);
        CHECK((force_of(world, held) - force).length() < 1e-5 * force.length());
        const Image image = world.save();
        World fresh(world_def(60, 20));
        REQUIRE(lks_world_register_asset(fresh, rope) == LKS_OK);
        REQUIRE(lks_world_load(fresh, image.data(), image.size()) == LKS_OK);
        CHECK(same(fixed(force_of(fresh, held).x, force_of(fresh, held).y, force_of(fresh, held).z),
                   fixed(force_of(world, held).x, force_of(world, held).y, force_of(world, held).z)));
        world.step(5);
        fresh.step(5);
        CHECK(world.hash() == fresh.hash());
    }
}

TEST_CASE("a figure that hangs rigidly on a pinned vertex comes to rest, and pulls with its weight") {
    for (const std::uint32_t substeps : {8u, 20u}) {
        for (const bool chain : {true, false}) {
            World world(world_def(60, substeps));
            const Asset points = loose_points({{0, 3, 0}, {0, 4, 0}}, {0.05, 0.05});
            const lks_object_id object = world.add(points, at(0, 0, 0));
            world.pin(object, 0);
            world.pin(object, 1);
            double mass = 0;
            std::vector<lks_body_id> bodies;
            if (chain) {
                for (int i = 0; i < 6; ++i) {
                    lks_body_def def = lks_default_body_def();
                    def.mass = fixed(i == 0 ? 3 : 10);
                    def.linear_damping = def.angular_damping = fixed(0.5);
                    bodies.push_back(
                        add_body(world, box_shape(0.05, 0.15, 0.05), fixed(0, 2.8 - 0.3 * i, 0), def));
                    mass += i == 0 ? 3 : 10;
                    if (i > 0) {
                        lks_joint_def joint = lks_default_joint_def();
                        joint.frame_a.position = fixed(0, -0.15, 0);
                        joint.frame_b.position = fixed(0, 0.15, 0);
                        joint.friction = fixed(1);
                        add_joint(world, joint, bodies[bodies.size() - 2], bodies.back());
                    }
                }
            } else {
                CalmHumanoid humanoid;
                humanoid.def.transform.position = fixed(0, 1.2, 0);
                bodies.resize(LKS_HUMANOID_BONES);
                REQUIRE(humanoid.add(world, bodies.data()) == LKS_OK);
                mass = 78;
            }
            const lks_attachment_id held =
                attach(world, to_body(object, 0, chain ? bodies[0] : bodies[LKS_HUMANOID_HEAD],
                                      fixed(0, chain ? 0.15 : 0.1, 0)));
            world.step(2200);
            INFO((chain ? "six boxes, " : "a humanoid, ") << substeps << " substeps");
            for (int tick = 0; tick < 120; ++tick) {
                world.step();
                CHECK(energy_of(world) < 1e-3);
                CHECK(std::abs(std::abs(force_of(world, held).y) / (mass * 9.81) - 1) < 0.01);
            }
        }
    }
}
