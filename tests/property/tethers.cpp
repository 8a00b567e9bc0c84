// Tethers: nothing is further from a pinned anchor than the cloth would let it, and what is slack, unpinned
// or at rest moves as without them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/builders.h"

using namespace support;

namespace {

Net net_of(std::uint32_t side, const std::vector<std::uint32_t>& anchors) {
    Net net;
    net.side = side;
    net.particle_mass = 1.0 / (static_cast<double>(side) * side);
    net.anchors = anchors;
    return net;
}

bool same(const std::vector<lks_raw_position>& a, const std::vector<lks_raw_position>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const auto& l, const auto& r) { return l.x == r.x && l.y == r.y && l.z == r.z; });
}

// Distance over length of the tether that is exceeded most.
double greatest_reach(const Asset& asset, const std::vector<Vector>& positions) {
    double greatest = 0;
    for (std::uint32_t v = 0; v < asset.vertex_count(); ++v) {
        lks_tether tethers[LKS_MAX_TETHERS_PER_VERTEX];
        const std::uint32_t count = lks_asset_vertex_tethers(asset, v, tethers);
        for (std::uint32_t i = 0; i < count; ++i) {
            greatest = std::max(greatest, (positions[v] - positions[tethers[i].anchor]).length() /
                                              metres(tethers[i].length));
        }
    }
    return greatest;
}

} // namespace

TEST_CASE("a tethered cloth at rest is left alone to the bit") {
    for (const std::uint32_t side : {2u, 13u, 64u}) {
        for (const double width : {1e-3, 2.0, 60.0}) {
            CAPTURE(side);
            CAPTURE(width);
            Net net = net_of(side, {0, side - 1, side * side - 1});
            net.width = width;
            const std::vector<std::uint32_t> pins = net.anchors;
            std::vector<lks_raw_position> found[2];
            for (std::vector<lks_raw_position>& positions : found) {
                World world(weightless(10));
                const Asset asset = net.build();
                const lks_object_id object = world.add(asset, at(0, 0, 0));
                for (const std::uint32_t pin : pins) {
                    world.pin(object, pin);
                }
                world.step(5);
                positions = world.raw_positions(object);
                net.anchors.clear();
            }
            CHECK(same(found[0], found[1]));
        }
    }
}

TEST_CASE("a cloth that nothing pins, and one that is slack, move to the bit as without tethers") {
    Net with = net_of(21, {0, 20, 400});
    with.shear = with.bend = off;
    with.stretch = soft(1e-4); // its weight would stretch an edge by a millimetre
    Net without = with;
    without.anchors.clear();
    const Asset tethered = with.build();
    const Asset plain = without.build();
    const auto run = [&](const Asset& asset, bool pinned, double speed) {
        World world(weightless(10));
        const lks_object_id object = world.add(asset, at(0, 0, 0));
        // Every other vertex is raised, and all are nearer to each other: each thread zigzags.
        for (std::uint32_t v = 0; v < 441; ++v) {
            const std::uint32_t column = v % 21;
            const std::uint32_t row = v / 21;
            const double spacing = 0.1 * std::sqrt(0.75);
            world.pin(object, v);
            world.set_target(object, v,
                             fixed(spacing * column, -spacing * row, (column + row) % 2 == 0 ? 0 : 0.05));
        }
        world.step();
        Random random(1);
        for (std::uint32_t v = 0; v < 441; ++v) {
            if (v > 0 || !pinned) {
                REQUIRE(lks_object_unpin(world, object, v) == LKS_OK);
                const auto any = [&] {
                    return speed * 0.001 * static_cast<double>(random.between(-1000, 1000));
                };
                REQUIRE(lks_object_set_velocity(world, object, v, fixed(any(), any(), any())) == LKS_OK);
            }
        }
        world.step(20);
        return world.raw_positions(object);
    };
    CHECK(same(run(tethered, true, 0.1), run(plain, true, 0.1)));
    CHECK(same(run(tethered, false, 10), run(plain, false, 10)));
    CHECK_FALSE(same(run(tethered, true, 10), run(plain, true, 10)));
}

TEST_CASE("nothing in a cloth that falls and swings gets far beyond its tethers") {
    Net net = net_of(40, {0, 39});
    const Asset tethered = net.build();
    net.anchors.clear();
    const Asset plain = net.build();
    double reach[2] = {};
    for (int i = 0; i < 2; ++i) {
        World world(world_def(60, 10));
        const lks_object_id object =
            world.add(i == 0 ? tethered : plain, turned(lks_transform_identity(), 1, 0, 0, 90));
        world.pin(object, 0);
        world.pin(object, 39);
        for (int tick = 0; tick < 90; ++tick) {
            world.step();
            reach[i] = std::max(reach[i], greatest_reach(tethered, world.positions_from(object, {})));
        }
    }
    CHECK(reach[0] < 1.06);
    CHECK(reach[1] > 1.2);
}

TEST_CASE("pins further apart than the cloth between them is long stretch it evenly") {
    Net net = net_of(13, {0, 12});
    net.stretch = soft(1e-3);
    net.shear = net.bend = off;
    const Asset asset = net.build();
    World world(weightless(10));
    lks_object_def def = object_def(asset, at(0, 0, 0));
    def.linear_damping = LKS_FIXED(20);
    const lks_object_id object = world.add(def);
    world.pin(object, 0);
    world.pin(object, 12);
    for (int tick = 1; tick <= 60; ++tick) {
        world.set_target(object, 0, fixed(-1 - 0.2 * tick / 60, 1, 0));
        world.set_target(object, 12, fixed(1 + 0.2 * tick / 60, 1, 0));
        world.step();
    }
    world.step(240);
    const std::vector<Vector> positions = world.positions_from(object, {});
    for (std::uint32_t i = 0; i < 12; ++i) {
        CAPTURE(i);
        const double ratio = (positions[i + 1] - positions[i]).length() / (2.0 / 12);
        CHECK(ratio > 1.1);
        CHECK(ratio < 1.32);
    }
}

TEST_CASE("a tether acts while its anchor is pinned, and a pinned vertex obeys its pin alone") {
    const Net net = net_of(21, {0, 20});
    const Asset asset = net.build();
    World world(world_def(60, 10));
    const lks_object_id object = world.add(asset, at(0, 0, 0));
    world.pin(object, 0);
    world.pin(object, 440); // no anchor
    for (int tick = 1; tick <= 30; ++tick) {
        world.set_target(object, 440, fixed(1 + 0.1 * tick, -1, 0));
        world.step();
    }
    CHECK(same(world.positions(object)[440], fixed(4, -1, 0)));
    CHECK(same(world.positions(object)[0], fixed(-1, 1, 0)));

    // Torn off, it falls freely: whatever else it does, its centre is pulled by nothing but gravity.
    world.set_target(object, 440, fixed(1, -1, 0));
    world.step(300);
    REQUIRE(lks_object_unpin(world, object, 440) == LKS_OK);
    REQUIRE(lks_object_unpin(world, object, 0) == LKS_OK);
    const auto mean_velocity = [&] {
        Vector sum;
        for (const lks_vec3& v : world.velocities(object)) {
            sum = sum + metres(v) * (1.0 / 441);
        }
        return sum;
    };
    const Vector before = mean_velocity();
    world.step(30);
    const Vector change = mean_velocity() - before;
    CHECK(std::abs(change.x) < 1e-6);
    CHECK(std::abs(change.y + 9.81 / 2) < 1e-4);
    CHECK(std::abs(change.z) < 1e-6);

    // And is caught again.
    world.pin(object, 20);
    world.step(60);
    CHECK(greatest_reach(asset, world.positions_from(object, {})) > 0);
    const std::vector<Vector> positions = world.positions_from(object, {});
    double reach = 0;
    for (std::uint32_t v = 0; v < positions.size(); ++v) {
        reach = std::max(reach, (positions[v] - positions[20]).length());
    }
    CHECK(reach < 2.85);
}
