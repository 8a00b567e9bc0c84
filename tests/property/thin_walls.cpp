// Figures that are thrown at a thin wall, or struck by one: joints draw after the rest what a contact has
// stopped. What is in the wall for some substeps has to come out where it went in, and where the wall has
// seams or gaps nothing may be drawn so far.
#include <doctest/doctest.h>

#include <random>

#include "support/bodies.h"
#include "support/sanitised.h"

using namespace support;

namespace {

constexpr double half_thickness = 0.025;

enum class Wall { fixed, loose, moved, tiles, fence };

// Tiles of 25 cm beside each other; bars of 5 cm radius, between which a hand of 3.8 cm does not fit. There
// is room for so many pairs a body on the average: somebody else has to be there.
void add_seamed_wall(World& world, Wall kind) {
    for (int i = 0; i < 100; ++i) {
        add_body(world, ball_shape(0.1), fixed(-500, i, 0));
    }
    if (kind == Wall::tiles) {
        for (int row = -7; row < 7; ++row) {
            for (int column = -7; column < 7; ++column) {
                add_box(world, fixed(half_thickness, 0.125, 0.125),
                        fixed(3, 0.125 + 0.25 * row, 0.125 + 0.25 * column));
            }
        }
        return;
    }
    for (int i = -20; i <= 20; ++i) {
        lks_collider_def bar = lks_default_collider_def();
        bar.shape = LKS_SHAPE_CAPSULE;
        bar.radius = fixed(0.05);
        bar.half_length = fixed(5);
        bar.transform = {fixed(3, 0.15 * i, 0), about(1, 0, 0, 90)};
        lks_collider_id id{};
        REQUIRE(lks_world_add_collider(world, &bar, &id) == LKS_OK);
    }
}

// How many bones are beyond the wall, or in its further half, a second later.
int bones_behind(Wall kind, double speed, const lks_rotation& rotation) {
    World world(world_def(60, 8));
    REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
    lks_body_id wall{};
    if (kind == Wall::tiles || kind == Wall::fence) {
        add_seamed_wall(world, kind);
    } else if (kind == Wall::fixed) {
        add_box(world, fixed(half_thickness, 10, 10), fixed(3, 0, 0));
    } else {
        lks_body_def def = lks_default_body_def();
        def.kind = kind == Wall::moved ? LKS_BODY_KINEMATIC : LKS_BODY_DYNAMIC;
        wall = add_body(world, box_shape(half_thickness, 10, 10, 100000), fixed(3, 0, 0), def);
    }
    Humanoid human;
    human.def.transform.rotation = rotation;
    human.def.velocity = kind == Wall::moved ? lks_vec3{} : fixed(speed, 0, 0);
    lks_body_id bodies[LKS_HUMANOID_BONES];
    lks_joint_id joints[LKS_HUMANOID_BONES - 1];
    REQUIRE(human.add(world, bodies, joints) == LKS_OK);
    for (int tick = 1; tick <= 60; ++tick) {
        if (kind == Wall::moved) {
            const lks_transform target{fixed(3 - speed * tick / 60, 0, 0), {0, 0, 0, LKS_ROTATION_ONE}};
            REQUIRE(lks_body_move_to(world, wall, target) == LKS_OK);
        }
        world.step();
    }
    lks_world_counters counters{};
    REQUIRE(lks_world_get_counters(world, &counters) == LKS_OK);
    REQUIRE(counters.lost_contacts == 0);
    const bool is_body = kind == Wall::loose || kind == Wall::moved;
    const double middle = is_body ? state_of(world, wall).position.x : 3;
    int count = 0;
    for (const lks_body_id body : bodies) {
        count += state_of(world, body).position.x > middle ? 1 : 0;
    }
    return count;
}

// Of forty figures, thrown any way up.
int bones_of_forty_behind(Wall kind, double speed, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> part(-1, 1);
    int behind = 0;
    for (int i = 0; i < 40; ++i) {
        const double axis[3] = {part(random), part(random), part(random)};
        behind += bones_behind(kind, speed, about(axis[0], axis[1], axis[2], 180 * part(random)));
    }
    return behind;
}

} // namespace

TEST_CASE("no bone of a figure passes a wall of five centimetres, however fast they meet") {
    for (const Wall kind : {Wall::fixed, Wall::loose, Wall::moved}) {
        for (const double speed : {30.0, 60.0}) {
            if (support::sanitised && speed < 60) {
                continue;
            }
            const int behind = bones_of_forty_behind(kind, speed, 3);
            INFO("wall " << static_cast<int>(kind) << " at " << speed << " m/s");
            CHECK(behind == 0);
        }
    }
}

TEST_CASE("no bone passes the seams of a wall of tiles, or a fence in whose gaps it has no room" *
          doctest::skip(support::sanitised)) {
    for (const Wall kind : {Wall::tiles, Wall::fence}) {
        for (const double speed : {30.0, 60.0}) {
            const int behind = bones_of_forty_behind(kind, speed, 5);
            INFO("wall " << static_cast<int>(kind) << " at " << speed << " m/s");
            CHECK(behind <= 2); // two feet of one that dives in feet first
        }
    }
}
