// What takes a support away, or comes from nowhere, wakes who sleeps there.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "support/attachments.h"
#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

lks_body_def kinematic() {
    lks_body_def def = lks_default_body_def();
    def.kind = LKS_BODY_KINEMATIC;
    return def;
}

bool is_awake(const World& world, lks_body_id body) {
    return lks_body_is_awake(world, body) == 1;
}

double height(const World& world, lks_body_id body) {
    return state_of(world, body).position.y;
}

// A box asleep on four ropes without any tension, that pins hold at each of their points, or one kinematic
// body.
struct OnRopes {
    explicit OnRopes(bool by_body) : world(world_def(60, 8)) {
        if (by_body) {
            holder = add_anchor(world, fixed(0, 0.5, 0));
        }
        const Asset rope(straight_rope(points - 1, 1));
        for (const double z : {-0.15, -0.05, 0.05, 0.15}) {
            ropes.push_back(world.add(rope, at(-0.5, 1, z)));
            for (std::uint32_t i = 0; i < points; ++i) {
                hold(ropes.back(), i, fixed(-0.5 + i / 20.0, 1, z));
            }
        }
        box = add_body(world, box_shape(0.2, 0.1, 0.2, 200), fixed(0, 1.12, 0));
        for (int tick = 0; tick < 300 && is_awake(world, box); ++tick) {
            world.step();
        }
        REQUIRE_FALSE(is_awake(world, box));
        REQUIRE(height(world, box) > 1.1);
    }

    void hold(lks_object_id rope, std::uint32_t vertex, const lks_vec3& place) {
        if (!holder) {
            world.pin(rope, vertex);
            return;
        }
        const lks_vec3 point{place.x, place.y - fixed(0.5), place.z};
        attachments.push_back(attach(world, to_body(rope, vertex, *holder, point)));
    }

    template <typename Use>
    void for_each_point(const Use& use) {
        for (const lks_object_id rope : ropes) {
            for (std::uint32_t i = 0; i < points; ++i) {
                use(rope, i);
            }
        }
    }

    void move_pins(double by) {
        for_each_point([&](lks_object_id rope, std::uint32_t i) {
            lks_vec3 place{};
            REQUIRE(lks_object_positions(world, rope, i, 1, &place) == LKS_OK);
            world.set_target(rope, i, {place.x, place.y + fixed(by), place.z});
        });
    }

    static constexpr std::uint32_t points = 21;
    World world;
    std::optional<lks_body_id> holder;
    std::vector<lks_object_id> ropes;
    std::vector<lks_attachment_id> attachments;
    lks_body_id box{};
};

struct Act {
    std::string name;
    bool by_body;
    std::function<void(OnRopes&)> begin;
    std::function<void(OnRopes&)> each_tick = {};
};

const Act takes_ropes_away[] = {
    {"ropes removed", false,
     [](OnRopes& s) {
         for (const lks_object_id rope : s.ropes) {
             REQUIRE(lks_world_remove_object(s.world, rope) == LKS_OK);
         }
     }},
    {"let go", false,
     [](OnRopes& s) {
         s.for_each_point([&](lks_object_id rope, std::uint32_t i) {
             REQUIRE(lks_object_unpin(s.world, rope, i) == LKS_OK);
         });
     }},
    {"pins jump", false, [](OnRopes& s) { s.move_pins(-0.5); }},
    {"pins lowered by 6 cm/s", false, [](OnRopes&) {}, [](OnRopes& s) { s.move_pins(-0.001); }},
    {"attachments removed", true,
     [](OnRopes& s) {
         for (const lks_attachment_id id : s.attachments) {
             REQUIRE(lks_world_remove_attachment(s.world, id) == LKS_OK);
         }
     }},
    {"holder removed", true,
     [](OnRopes& s) { REQUIRE(lks_world_remove_body(s.world, *s.holder) == LKS_OK); }},
    {"holder becomes dynamic", true,
     [](OnRopes& s) { REQUIRE(lks_body_set_kind(s.world, *s.holder, LKS_BODY_DYNAMIC) == LKS_OK); }},
    {"holder put elsewhere", true,
     [](OnRopes& s) { REQUIRE(lks_body_set_transform(s.world, *s.holder, at(0, -0.5, 0)) == LKS_OK); }},
    {"holder lowered by 6 cm/s", true, [](OnRopes&) {},
     [](OnRopes& s) {
         lks_transform place{};
         REQUIRE(lks_body_transform(s.world, *s.holder, &place) == LKS_OK);
         place.position.y -= fixed(0.001);
         REQUIRE(lks_body_move_to(s.world, *s.holder, place) == LKS_OK);
     }},
};

// A box asleep on the ground, and a kinematic one.
struct OnGround {
    OnGround() : world(world_def(60, 8)) {
        add_ground(world);
        box = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(0, 0.2, 0));
        other = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(0, 0.2, 3));
        wall = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(5, 0.2, 0), kinematic());
        world.step(200);
        REQUIRE(lks_world_awake_body_count(world) == 0);
    }

    double overlap(lks_body_id with) const {
        return 0.4 - std::abs(state_of(world, box).position.x - state_of(world, with).position.x);
    }

    World world;
    lks_body_id box{};
    lks_body_id other{};
    lks_body_id wall{};
};

} // namespace

TEST_CASE("who sleeps on ropes falls when they go, whatever takes them away") {
    for (const Act& act : takes_ropes_away) {
        INFO(act.name);
        OnRopes scene(act.by_body);
        act.begin(scene);
        for (int tick = 0; tick < 90; ++tick) {
            if (act.each_tick) {
                act.each_tick(scene);
            }
            scene.world.step();
        }
        CHECK(height(scene.world, scene.box) < 1.06);
    }
}

TEST_CASE("who sleeps on ropes sleeps on when one far away goes, or the wind moves it") {
    OnRopes scene(false);
    const Asset rope(straight_rope(20, 1));
    const lks_object_id far = scene.world.add(rope, at(-0.5, 1, 2));
    const lks_object_id near = scene.world.add(rope, at(-0.5, 1.6, 0)); // above it
    for (const lks_object_id object : {far, near}) {
        scene.world.pin(object, 0);
        scene.world.pin(object, 20);
    }
    for (int tick = 0; tick < 60; ++tick) {
        REQUIRE(lks_object_add_velocity(scene.world, near, fixed(0, 0, tick % 20 < 10 ? 0.2 : -0.2)) ==
                LKS_OK);
        scene.world.step();
        CHECK_FALSE(is_awake(scene.world, scene.box));
    }
    REQUIRE(lks_world_remove_object(scene.world, far) == LKS_OK);
    REQUIRE(lks_world_remove_object(scene.world, near) == LKS_OK);
    scene.world.step();
    CHECK_FALSE(is_awake(scene.world, scene.box));
}

TEST_CASE("who hangs asleep on a kinematic body follows where it is put") {
    for (const std::uint32_t kind : {LKS_JOINT_BALL, LKS_JOINT_HINGE, LKS_JOINT_FIXED, LKS_JOINT_DISTANCE}) {
        for (const bool by_pose : {false, true}) {
            World world(world_def(60, 8));
            const lks_body_id anchor = add_anchor(world, fixed(0, 3, 0));
            const lks_body_id bob = add_body(world, box_shape(0.1, 0.1, 0.1), fixed(0, 2, 0));
            lks_joint_def def = lks_default_joint_def();
            def.kind = kind;
            if (kind == LKS_JOINT_DISTANCE) {
                def.distance_max = fixed(1);
            } else {
                def.frame_b = at(0, 1, 0);
            }
            const lks_joint_id joint = add_joint(world, def, anchor, bob);
            world.step(200);
            REQUIRE_FALSE(is_awake(world, bob));
            const lks_transform place = at(0.3, 3.5, 0);
            REQUIRE((by_pose ? lks_ragdoll_set_pose(world, &anchor, 1, &place, nullptr)
                             : lks_body_set_transform(world, anchor, place)) == LKS_OK);
            CHECK(is_awake(world, bob));
            world.step(60);
            CHECK(error_of(world, joint) < 0.01);
        }
    }
}

TEST_CASE("a kinematic body that comes from nowhere wakes whom it touches, and pushes him out") {
    for (const double depth : {0.01, 0.2, 0.35}) {
        for (const int how : {0, 1, 2}) {
            OnGround scene;
            lks_transform place = at(-0.4 + depth, 0.2, 0);
            lks_body_id wall = scene.wall;
            if (how == 0) {
                wall = add_body(scene.world, box_shape(0.2, 0.2, 0.2), place.position, kinematic());
            } else if (how == 1) {
                REQUIRE(lks_body_set_transform(scene.world, wall, place) == LKS_OK);
            } else {
                REQUIRE(lks_ragdoll_set_pose(scene.world, &wall, 1, &place, nullptr) == LKS_OK);
            }
            CHECK(is_awake(scene.world, scene.box));
            CHECK_FALSE(is_awake(scene.world, scene.other));
            scene.world.step(300);
            CHECK(scene.overlap(wall) < 0.002);
            CHECK(lks_world_awake_body_count(scene.world) == 0);
        }
    }
}

TEST_CASE("a kinematic body wakes nobody beside it, nor whom its filter excludes") {
    OnGround scene;
    REQUIRE(lks_body_set_transform(scene.world, scene.wall, at(-0.41, 0.2, 0)) == LKS_OK);
    lks_body_def excluded = kinematic();
    excluded.filter.mask = LKS_CATEGORY_PARTICLES;
    add_body(scene.world, box_shape(0.2, 0.2, 0.2), fixed(0.2, 0.2, 0), excluded);
    scene.world.step();
    CHECK(lks_world_awake_body_count(scene.world) == 0);
}

TEST_CASE("who slept on a kinematic body, or leaned on it, wakes when it is put elsewhere") {
    OnGround scene;
    const lks_body_id above = add_body(scene.world, box_shape(0.1, 0.1, 0.1), fixed(5, 0.5, 0));
    scene.world.step(200);
    REQUIRE_FALSE(is_awake(scene.world, above));
    REQUIRE(lks_body_set_transform(scene.world, scene.wall, at(10, 0.2, 0)) == LKS_OK);
    scene.world.step(60);
    CHECK(height(scene.world, above) < 0.15);
    CHECK_FALSE(is_awake(scene.world, scene.box));
}

TEST_CASE(
    "who stood on a collider falls when it is put above him, and stays beside a door that is put there") {
    // Its underside is a centimetre above the box.
    World world(world_def(60, 8));
    lks_collider_def platform = lks_default_collider_def();
    platform.shape = LKS_SHAPE_BOX;
    platform.half_extents = fixed(2, 0.1, 2);
    const lks_collider_id id = world.add(platform);
    const lks_body_id box = add_body(world, box_shape(0.25, 0.25, 0.25), fixed(0, 0.35, 0));
    world.step(30);
    REQUIRE(height(world, box) == doctest::Approx(0.35).epsilon(0.01));
    REQUIRE(lks_collider_set_transform(world, id, at(0, 0.71, 0)) == LKS_OK);
    world.step(60);
    CHECK(height(world, box) < -4);
    // Moved by millimetres from tick to tick it carries on.
    const lks_body_id rider = add_body(world, box_shape(0.25, 0.25, 0.25), fixed(0, 1.06, 0));
    world.step(60);
    for (int tick = 1; tick <= 120; ++tick) {
        REQUIRE(lks_collider_set_transform(world, id, at(0, 0.71 + 0.002 * tick, 0)) == LKS_OK);
        world.step();
    }
    CHECK(height(world, rider) == doctest::Approx(0.71 + 0.24 + 0.35).epsilon(0.01));
}

TEST_CASE("who is woken with his island has its half second to rest again, whichever comes first") {
    for (const bool slider_first : {true, false}) {
        World world(world_def(60, 8));
        add_ground(world, 0.02);
        lks_body_def def = lks_default_body_def();
        def.static_friction = def.dynamic_friction = fixed(0.02);
        def.linear_damping = 0;
        const auto add_slider = [&] {
            return add_body(world, box_shape(0.3, 0.1, 0.3), fixed(0, 0.1, 0), def);
        };
        const auto add_rider = [&] {
            return add_body(world, box_shape(0.1, 0.1, 0.1), fixed(0, 0.3, 0), def);
        };
        const lks_body_id first = slider_first ? add_slider() : add_rider();
        const lks_body_id second = slider_first ? add_rider() : add_slider();
        const lks_body_id slider = slider_first ? first : second;
        const lks_body_id rider = slider_first ? second : first;
        // The rider is kept awake by pushes for two seconds more than the slider rests.
        for (int tick = 0; tick < 180; ++tick) {
            REQUIRE(lks_body_apply_impulse(world, rider, fixed(tick % 2 == 0 ? 0.06 : -0.06, 0, 0),
                                           fixed(0, 0.3, 0)) == LKS_OK);
            world.step();
        }
        world.step(120);
        REQUIRE(lks_world_awake_body_count(world) == 0);
        // The rider is taken away by a blow, and takes the slider along a little.
        REQUIRE(lks_body_apply_impulse(world, rider, fixed(60, 0, 0), fixed(0, 0.3, 0)) == LKS_OK);
        lks_vec3 velocity{};
        world.step(2);
        REQUIRE(lks_body_velocity(world, slider, &velocity, nullptr) == LKS_OK);
        INFO("slider first: " << slider_first);
        CHECK(is_awake(world, slider));
        for (int tick = 0; tick < 15; ++tick) {
            world.step();
            CHECK(is_awake(world, slider)); // not put to sleep in the middle of its slide
        }
    }
}
