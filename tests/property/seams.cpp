// A floor of boxes side by side is as one of a single box: what slides or rolls over it does not meet the
// sides of the next one.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/bodies.h"
#include "support/builders.h"
#include "support/sanitised.h"

using namespace support;

namespace {

// Its upper side at zero, from 3 m behind to 27 m before the origin, 8 m wide.
void add_floor(World& world, bool tiles, double friction) {
    lks_collider_def def = lks_default_collider_def();
    def.shape = LKS_SHAPE_BOX;
    def.static_friction = def.dynamic_friction = fixed(friction);
    const double width = tiles ? 0.5 : 30;
    const double breadth = tiles ? 2 : 8;
    def.half_extents = fixed(width / 2, 0.25, breadth / 2);
    for (double x = -3 + width / 2; x < 27; x += width) {
        for (double z = -4 + breadth / 2; z < 4; z += breadth) {
            def.transform.position = fixed(x, -0.25, z);
            world.add(def);
        }
    }
}

struct Slide {
    double way = 0;
    double speed = 0;
    double highest = 0, lowest = 0; // against where it began
    double spin = 0;
};

// For two seconds or 20 m, from where `start` has it within a tile.
Slide slide(bool tiles, const lks_body_shape& shape, double height, double speed, double friction,
            std::uint32_t substeps, int start) {
    World world(world_def(60, substeps));
    add_floor(world, tiles, friction);
    lks_body_def def = lks_default_body_def();
    def.static_friction = def.dynamic_friction = fixed(friction);
    def.velocity = fixed(speed, 0, 0);
    const double x = 0.013 * start;
    const lks_body_id body = add_body(world, shape, fixed(x, height, 0.01 * start), def);
    Slide done;
    for (int tick = 0; tick < std::min(120, static_cast<int>(20 / speed * 60)); ++tick) {
        world.step();
        const BodyState now = state_of(world, body);
        done.way = now.position.x - x;
        done.speed = now.velocity.x;
        done.highest = std::max(done.highest, now.position.y - height);
        done.lowest = std::min(done.lowest, now.position.y - height);
        done.spin = std::max(done.spin, now.spin.length());
    }
    return done;
}

void compare(const char* name, const lks_body_shape& shape, double height) {
    for (const double friction : {0., 0.5}) {
        for (const std::uint32_t substeps : {8u, 20u}) {
            for (const double speed : {0.5, 2., 6., 15.}) {
                const Slide level = slide(false, shape, height, speed, friction, substeps, 0);
                for (int start = 0; start < (sanitised ? 1 : 4); ++start) {
                    const Slide seams = slide(true, shape, height, speed, friction, substeps, start);
                    INFO(name << " at " << speed << " m/s, friction " << friction << ", " << substeps
                              << " substeps, from " << start << ": " << seams.way << " m, " << level.way
                              << " over one box; " << seams.speed << " m/s, " << level.speed << "; "
                              << seams.highest << " m up, " << seams.lowest << " down");
                    CHECK(std::abs(seams.way - level.way) < 0.01 * level.way);
                    CHECK(std::abs(seams.speed - level.speed) < 0.02 * speed);
                    CHECK(seams.highest < level.highest + 0.5e-3);
                    CHECK(seams.lowest > level.lowest - 0.6e-3);
                    CHECK(seams.spin < level.spin + 0.25);
                }
            }
        }
    }
}

// How far its middle goes in four seconds.
template <typename Figure>
double slide_figure(bool tiles, double speed, double friction, int start) {
    World world(world_def(60, 8));
    add_floor(world, tiles, friction);
    Figure figure;
    figure.def.transform = {fixed(0.013 * start, 0.8, 0.017 * start), about(start % 2, 0.3 * start, 1, 90)};
    figure.def.velocity = fixed(speed, 0, 0);
    lks_body_id bodies[LKS_SPIDER_BONES > LKS_HUMANOID_BONES ? LKS_SPIDER_BONES : LKS_HUMANOID_BONES];
    REQUIRE(figure.add(world, bodies) == LKS_OK);
    const double begin = state_of(world, bodies[0]).position.x;
    world.step(240);
    return state_of(world, bodies[0]).position.x - begin;
}

} // namespace

TEST_CASE("what slides over a floor of boxes goes on as over a single one") {
    lks_body_shape turned = box_shape(0.2, 0.1, 0.2);
    turned.transform.rotation = about(0, 1, 0, 20);
    lks_body_shape along = capsule_shape(0.1, 0.2);
    along.transform.rotation = about(0, 0, 1, 90);
    lks_body_shape across = along;
    across.transform.rotation = about(1, 0, 0, 90);
    compare("box", box_shape(0.2, 0.2, 0.2), 0.2);
    compare("turned box", turned, 0.1);
    compare("ball", ball_shape(0.2), 0.2);
    compare("capsule along", along, 0.1);
    compare("capsule across", across, 0.1);
}

TEST_CASE("ragdolls slide over a floor of boxes nearly as far as over a single one") {
    for (const double speed : {4., 8.}) {
        double level = 0;
        double seams = 0;
        for (int start = 0; start < 6; ++start) {
            level += slide_figure<Humanoid>(false, speed, 0.2, start);
            seams += slide_figure<Humanoid>(true, speed, 0.2, start);
        }
        INFO(speed << " m/s: " << seams / 6 << " m on the average, " << level / 6 << " over one box");
        CHECK(seams > 0.85 * level);
        CHECK(seams < 1.15 * level);
    }
}

TEST_CASE("a step of more than a millimetre is met") {
    for (const double step : {0.003, 0.02, 0.2}) {
        for (int start = 0; start < 8; ++start) {
            World world(world_def(60, 8));
            add_floor(world, false, 0);
            add_box(world, fixed(1, 0.5, 4), fixed(2, step - 0.5, 0));
            lks_body_def def = lks_default_body_def();
            def.static_friction = def.dynamic_friction = 0;
            def.velocity = fixed(6, 0, 0);
            const lks_body_id body =
                add_body(world, box_shape(0.2, 0.2, 0.2), fixed(0.013 * start, 0.2, 0), def);
            bool met = false;
            for (int tick = 0; tick < 20; ++tick) {
                world.step();
                met = met || state_of(world, body).velocity.x < 5.5;
            }
            INFO(step << " m, from " << start);
            CHECK(met);
        }
    }
}
