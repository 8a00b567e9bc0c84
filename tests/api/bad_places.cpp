// Objects that are put elsewhere: what is refused changes nothing.
#include <doctest/doctest.h>

#include <vector>

#include "support/bodies.h"
#include "support/refusals.h"
#include "support/scene.h"

using namespace support;

namespace {

constexpr lks_result invalid = LKS_ERROR_INVALID_ARGUMENT;
constexpr lks_fixed half = LKS_FIXED_ONE / 2;

struct Fixture {
    SceneAssets assets;
    Scene scene{assets, {}, world_def(60, 4)};
    World& world = scene.world;

    Fixture() { scene.tick(3); }

    void teleport_refused(const std::string& value, const lks_transform& from, const lks_transform& to) {
        check_call_refused(world, invalid, value,
                           [&] { return lks_object_teleport(world, scene.net, &from, &to); });
    }

    void laying_refused(const std::string& value, lks_object_id object, std::uint32_t first,
                        const std::vector<lks_vec3>& positions) {
        check_call_refused(world, invalid, value, [&] {
            return lks_object_set_positions(world, object, first,
                                            static_cast<std::uint32_t>(positions.size()), positions.data());
        });
    }
};

} // namespace

TEST_CASE_FIXTURE(Fixture, "teleports from or to what is no place or no rotation are refused") {
    const lks_transform here = at(0, 0, 0);
    teleport_refused("from (8388001", at(8388001, 0, 0), here);
    teleport_refused("to (0, -8388000.5", here, at(lks_vec3{0, -LKS_FIXED(8388000) - half, 0}));
    for (const lks_rotation& rotation :
         {lks_rotation{0, 0, 0, 0}, lks_rotation{0, 0, 0, LKS_ROTATION_ONE / 2},
          lks_rotation{INT32_MIN, INT32_MIN, INT32_MIN, INT32_MIN}}) {
        const lks_transform bad{{}, rotation};
        teleport_refused(std::to_string(rotation.w), bad, here);
        teleport_refused(std::to_string(rotation.w), here, bad);
    }
}

TEST_CASE_FIXTURE(Fixture, "teleports out of the world are refused") {
    // The net hangs at 1.4 m.
    teleport_refused("8388001", at(0, 0, 0), at(0, 8388000, 0));
    teleport_refused("8388002", at(0, -1, 0), at(0, 8388000, 0));
    teleport_refused("-16775999|-8388608", at(0, 8388000, 0), at(0, -8388000, 0));
    teleport_refused("8388608", at(0, -8388000, 0), at(0, 8388000, 0));
    teleport_refused("8388608", turned(at(8388000, 0, 0), 0, 1, 0, 180), at(8388000, 0, 0));
    teleport_refused("8388608", turned(at(-8388000, 0, 0), 0, 1, 0, 180), at(-8388000, 8388000, 0));
    teleport_refused("8388608", turned(at(8388000, 8388000, 8388000), 0, 1, 0, 30), at(-8388000, 0, 0));
    const lks_transform edge = at(0, 8387998, 0);
    const lks_transform here = at(0, 0, 0);
    CHECK(lks_object_teleport(world, scene.net, &here, &edge) == LKS_OK);
    world.step();
}

TEST_CASE_FIXTURE(Fixture, "what would reach too far where it is turned is refused") {
    const Asset points = loose_points({{-50, 0, -50}, {50, 0, 50}}, {1, 1});
    const lks_object_id wide = world.add(points, at(0, 100, 0));
    const lks_transform from = at(0, 0, 0);
    const lks_transform to = turned(from, 0, 1, 0, 45);
    check_call_refused(world, invalid, "70.71|64",
                       [&] { return lks_object_teleport(world, wide, &from, &to); });
    const lks_transform less = turned(from, 0, 1, 0, 15);
    CHECK(lks_object_teleport(world, wide, &from, &less) == LKS_OK);
    // Not where it is beside its origin.
    const Asset beside = loose_points({{50, 0, 50}, {59, 0, 59}}, {1, 1});
    const lks_object_id far = world.add(beside, at(0, 100, 0));
    CHECK(lks_object_teleport(world, far, &from, &to) == LKS_OK);
    world.step();
    CHECK(world.counters().position_clamps == 0);
}

TEST_CASE_FIXTURE(Fixture, "positions out of the world, or too far apart, are refused") {
    const lks_vec3 bad = lks_vec3{0, 0, LKS_FIXED(8388000) + 1};
    laying_refused("8388000", scene.rope, 0, {fixed(0, 0, 0), bad});
    laying_refused("-8388608", scene.rope, 24, {lks_vec3{INT64_MIN, 0, 0}});
    laying_refused("120", scene.rope, 3, {fixed(0, 200, 0)});
    laying_refused("120", scene.rope, 0, {fixed(-8388000, 0, 0), fixed(8388000, 0, 0)});
    const Asset points = loose_points({{0, 0, 0}, {1, 0, 0}}, {1, 1});
    const lks_object_id two = world.add(points, at(0, 100, 0));
    laying_refused("120.5", two, 0, {fixed(0, 0, 0), fixed(0, 120.5, 0)});
    const lks_vec3 good[] = {fixed(0, 0, 0), fixed(0, 120, 0)};
    CHECK(lks_object_set_positions(world, two, 0, 2, good) == LKS_OK);
}

TEST_CASE_FIXTURE(Fixture, "vertices that don't exist are not laid, and none at all change nothing") {
    const std::vector<lks_vec3> some(26);
    laying_refused("25", scene.rope, 25, {{}});
    laying_refused("26 vertices", scene.rope, 0, some);
    laying_refused("4294967295", scene.rope, 4294967295u, {{}});
    check_call_refused(world, invalid, "4294967295", [&] {
        return lks_object_set_positions(world, scene.rope, 2, 4294967295u, some.data());
    });
    const std::uint64_t hash = world.hash();
    CHECK(lks_object_set_positions(world, scene.rope, 25, 0, some.data()) == LKS_OK);
    CHECK(world.hash() == hash);
}
