// What falls a hundred times as fast as others is stopped by what it falls on, from its first tick on.
#include <doctest/doctest.h>

#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

// Square and level, of `side` by `side` points.
struct LevelCloth {
    LevelCloth(std::uint32_t side, double width, double area_density) {
        lks_cloth_def def = lks_default_cloth_def();
        def.columns = def.rows = side;
        def.width = def.height = width;
        def.area_density = area_density;
        REQUIRE(lks_asset_create_cloth(&def, &asset) == LKS_OK);
    }
    ~LevelCloth() { lks_asset_release(asset); }
    LevelCloth(const LevelCloth&) = delete;
    LevelCloth& operator=(const LevelCloth&) = delete;

    lks_object_id add(World& world, double height, double gravity_factor) const {
        lks_object_def def = lks_default_object_def();
        def.asset = asset;
        def.gravity_factor = fixed(gravity_factor);
        def.transform.position = fixed(0, height, 0);
        def.transform.rotation = about(1, 0, 0, -90);
        lks_object_id id{};
        REQUIRE(lks_world_add_object(world, &def, &id) == LKS_OK);
        return id;
    }

    lks_asset* asset = nullptr;
};

} // namespace

// It was at -1.2 m after three ticks.
TEST_CASE("a cloth of any gravity is stopped by a small ball below it") {
    const LevelCloth cloth(9, 0.2, 0.2);
    for (const double factor : {1., 30., 100.}) {
        World world(world_def(60, 20));
        lks_body_def ball = lks_default_body_def();
        ball.kind = LKS_BODY_KINEMATIC;
        add_body(world, ball_shape(0.025), {}, ball);
        const lks_object_id object = cloth.add(world, 0.085, factor);
        world.step(3);
        CAPTURE(factor);
        CHECK(metres(world.positions(object)[40].y) > 0.025);
    }
}

TEST_CASE("a ball of any gravity is stopped by a cloth below it") {
    const LevelCloth cloth(41, 0.8, 100);
    for (const double factor : {1., 50., 100.}) {
        World world(world_def(60, 20));
        cloth.add(world, 0, 0);
        lks_body_def def = lks_default_body_def();
        def.mass = fixed(0.01);
        def.gravity_factor = fixed(factor);
        const lks_body_id ball = add_body(world, ball_shape(0.02), fixed(0, 0.08, 0), def);
        world.step(3);
        CAPTURE(factor);
        CHECK(state_of(world, ball).position.y > -0.05);
    }
}
