// Calls on objects and colliders that are refused: values out of range, indices that don't exist, stale ids.
#include <doctest/doctest.h>

#include <vector>

#include "support/refusals.h"
#include "support/scene.h"

using namespace support;

namespace {

constexpr lks_result invalid = LKS_ERROR_INVALID_ARGUMENT;

struct Fixture {
    SceneAssets assets;
    Scene scene{assets, {}, world_def(60, 4)};
    World& world = scene.world;

    Fixture() { scene.tick(3); }

    template <typename Call>
    void refused(lks_result expected, const std::string& value, Call call) {
        check_call_refused(world, expected, value, call);
    }

    template <typename Change>
    void object_refused(lks_result expected, const std::string& value, Change change) {
        lks_object_def def = object_def(assets.rope, at(0, 3, 0));
        change(def);
        lks_object_id id{77, 88};
        refused(expected, value, [&] { return lks_world_add_object(world, &def, &id); });
        CHECK(id.index == 77);
        CHECK(id.generation == 88);
    }

    template <typename Change>
    void collider_refused(lks_result expected, const std::string& value, Change change) {
        lks_collider_def def = lks_default_collider_def();
        change(def);
        lks_collider_id id{77, 88};
        refused(expected, value, [&] { return lks_world_add_collider(world, &def, &id); });
        CHECK(id.index == 77);
        CHECK(id.generation == 88);
    }
};

constexpr lks_fixed half = LKS_FIXED_ONE / 2;

} // namespace

TEST_CASE_FIXTURE(Fixture, "object definitions out of range are refused and add nothing") {
    object_refused(LKS_ERROR_NULL_ARGUMENT, "asset", [](auto& def) { def.asset = nullptr; });
    object_refused(invalid, "2", [](auto& def) { def.record_forces = 2; });
    object_refused(invalid, "8388001", [](auto& def) { def.transform.position.x = LKS_FIXED(8388001); });
    object_refused(invalid, "-8388000.5",
                   [](auto& def) { def.transform.position.z = -LKS_FIXED(8388000) - half; });
    object_refused(invalid, "1000.5", [](auto& def) { def.velocity.y = LKS_FIXED(1000) + half; });
    object_refused(invalid, "100.5", [](auto& def) { def.gravity_factor = LKS_FIXED(100) + half; });
    object_refused(invalid, "-100.5", [](auto& def) { def.gravity_factor = -LKS_FIXED(100) - half; });
    object_refused(invalid, "-0.5", [](auto& def) { def.linear_damping = -half; });
    object_refused(invalid, "1000.5", [](auto& def) { def.linear_damping = LKS_FIXED(1000) + half; });
}

TEST_CASE_FIXTURE(Fixture, "rotations that are no rotations are refused and near ones are normalised") {
    const lks_rotation bad[] = {{0, 0, 0, 0},
                                {0, 0, 0, LKS_ROTATION_ONE / 2},
                                {LKS_ROTATION_ONE, 0, 0, LKS_ROTATION_ONE},
                                {INT32_MIN, INT32_MIN, INT32_MIN, INT32_MIN},
                                {0, 0, 0, LKS_ROTATION_ONE + LKS_ROTATION_ONE / 1000}};
    for (const lks_rotation& rotation : bad) {
        object_refused(invalid, "rotation", [&](auto& def) { def.transform.rotation = rotation; });
        collider_refused(invalid, "rotation", [&](auto& def) { def.transform.rotation = rotation; });
        lks_transform transform = at(0, 0, 0);
        transform.rotation = rotation;
        refused(invalid, "rotation",
                [&] { return lks_collider_set_transform(world, scene.ball, transform); });
        refused(invalid, "rotation", [&] { return lks_collider_move_to(world, scene.ball, transform); });
    }
    lks_object_def def = object_def(assets.rope, at(0, 3, 0));
    def.transform.rotation.w = LKS_ROTATION_ONE + LKS_ROTATION_ONE / 20000;
    const lks_object_id near = world.add(def);
    const std::vector<Vector> positions = world.positions_from(near, def.transform.position);
    CHECK(positions.back().x == doctest::Approx(1.5).epsilon(1e-8));
}

TEST_CASE_FIXTURE(Fixture, "velocities and factors and damping out of range are refused") {
    refused(invalid, "1000.5", [&] {
        return lks_object_set_velocity(world, scene.rope, 0, {0, LKS_FIXED(1000) + half, 0});
    });
    refused(invalid, "-1000.5", [&] {
        return lks_object_add_velocity(world, scene.rope, {-LKS_FIXED(1000) - half, 0, 0});
    });
    refused(invalid, "100.5",
            [&] { return lks_object_set_gravity_factor(world, scene.rope, LKS_FIXED(100) + half); });
    refused(invalid, "-0.5", [&] { return lks_object_set_linear_damping(world, scene.rope, -half); });
    refused(invalid, "1000.5",
            [&] { return lks_object_set_linear_damping(world, scene.rope, LKS_FIXED(1000) + half); });
}

TEST_CASE_FIXTURE(Fixture, "vertices and constraints that don't exist are refused by their index") {
    const std::uint32_t count = assets.rope.vertex_count();
    REQUIRE(count == 25);
    lks_vec3 buffer[4] = {{1, 2, 3}, {}, {}, {}};
    lks_raw_position raw[4] = {{1, 2, 3}, {}, {}, {}};
    for (const std::uint32_t vertex : {25u, 4294967295u}) {
        const std::string value = std::to_string(vertex);
        refused(invalid, value, [&] { return lks_object_pin(world, scene.rope, vertex); });
        refused(invalid, value, [&] { return lks_object_unpin(world, scene.rope, vertex); });
        refused(invalid, value, [&] { return lks_object_set_pin_target(world, scene.rope, vertex, {}); });
        refused(invalid, value, [&] { return lks_object_set_velocity(world, scene.rope, vertex, {}); });
        refused(invalid, value, [&] { return lks_object_apply_impulse(world, scene.rope, vertex, {}); });
        refused(invalid, value, [&] { return lks_object_positions(world, scene.rope, vertex, 1, buffer); });
        refused(invalid, value, [&] { return lks_object_velocities(world, scene.rope, vertex, 1, buffer); });
        refused(invalid, value, [&] { return lks_object_raw_positions(world, scene.rope, vertex, 1, raw); });
        CHECK(lks_object_is_pinned(world, scene.rope, vertex) == 0);
    }
    refused(invalid, "24", [&] { return lks_object_positions(world, scene.rope, 24, 2, buffer); });
    refused(invalid, "4294967295",
            [&] { return lks_object_positions(world, scene.rope, 2, 4294967295u, buffer); });
    CHECK(buffer[0].x == 1);
    CHECK(raw[0].z == 3);
    lks_fixed force = 5;
    const std::uint32_t constraints = assets.rope.constraint_count();
    refused(invalid, std::to_string(constraints),
            [&] { return lks_object_constraint_force(world, scene.rope, constraints, &force); });
    CHECK(force == 5);
    lks_object_id listed{1, 2};
    refused(invalid, "3", [&] { return lks_world_object_at(world, 3, &listed); });
    CHECK(listed.generation == 2);
}

TEST_CASE_FIXTURE(Fixture, "targets of vertices that are not pinned are refused") {
    refused(invalid, "5", [&] { return lks_object_set_pin_target(world, scene.rope, 5, {}); });
    const std::uint64_t hash = world.hash();
    const lks_result result = lks_object_unpin(world, scene.rope, 5);
    CHECK((result == LKS_OK || result == invalid));
    CHECK(world.hash() == hash);
}

TEST_CASE_FIXTURE(Fixture, "stale and made-up object ids are refused by every call and change nothing") {
    const lks_object_id removed = scene.mesh;
    REQUIRE(lks_world_remove_object(world, removed) == LKS_OK);
    const lks_object_id again = world.add(assets.mesh, at(0, 3, 0));
    REQUIRE(again.index == removed.index);
    const lks_object_id ids[] = {
        removed,          {removed.index, 0}, {removed.index, again.generation + 1}, {17, 1}, {0, 0},
        {4294967295u, 1}, {0, 4294967295u}};
    for (const lks_object_id id : ids) {
        const std::string value = std::to_string(id.index);
        lks_vec3 vec{9, 9, 9};
        lks_raw_position raw{9, 9, 9};
        lks_fixed force = 9;
        float floats[3 * 100] = {};
        lks_vertex_view view = lks_default_vertex_view();
        view.positions = floats;
        view.position_stride = 12;
        view.vertex_capacity = 100;
        constexpr lks_result stale = LKS_ERROR_STALE_ID;
        refused(stale, value, [&] { return lks_world_remove_object(world, id); });
        refused(stale, value, [&] { return lks_object_origin(world, id, &vec); });
        refused(stale, value, [&] { return lks_object_set_gravity_factor(world, id, 0); });
        refused(stale, value, [&] { return lks_object_set_linear_damping(world, id, 0); });
        refused(stale, value, [&] { return lks_object_positions(world, id, 0, 1, &vec); });
        refused(stale, value, [&] { return lks_object_raw_positions(world, id, 0, 1, &raw); });
        refused(stale, value, [&] { return lks_object_velocities(world, id, 0, 1, &vec); });
        refused(stale, value, [&] { return lks_object_set_velocity(world, id, 0, {}); });
        refused(stale, value, [&] { return lks_object_apply_impulse(world, id, 0, {}); });
        refused(stale, value, [&] { return lks_object_add_velocity(world, id, {}); });
        refused(stale, value, [&] { return lks_object_pin(world, id, 0); });
        refused(stale, value, [&] { return lks_object_unpin(world, id, 0); });
        refused(stale, value, [&] { return lks_object_set_pin_target(world, id, 0, {}); });
        refused(stale, value, [&] { return lks_object_set_positions(world, id, 0, 1, &vec); });
        const lks_transform frame = at(0, 0, 0);
        refused(stale, value, [&] { return lks_object_teleport(world, id, &frame, &frame); });
        refused(stale, value, [&] { return lks_object_constraint_force(world, id, 0, &force); });
        refused(stale, value, [&] { return lks_object_write_vertices(world, id, &view); });
        CHECK(vec.x == 9);
        CHECK(raw.x == 9);
        CHECK(force == 9);
        CHECK(lks_world_has_object(world, id) == 0);
        CHECK(lks_object_asset(world, id) == nullptr);
        CHECK(lks_object_hash(world, id) == 0);
        CHECK(lks_object_pin_count(world, id) == 0);
        CHECK(lks_object_is_pinned(world, id, 0) == 0);
    }
    CHECK(lks_world_has_object(world, again) == 1);
}

TEST_CASE_FIXTURE(Fixture, "stale and made-up collider ids are refused by every call and change nothing") {
    const lks_collider_id removed = scene.bar;
    REQUIRE(lks_world_remove_collider(world, removed) == LKS_OK);
    const lks_collider_id again = world.add(lks_default_collider_def());
    REQUIRE(again.index == removed.index);
    for (const lks_collider_id id : {removed, lks_collider_id{removed.index, 0}, lks_collider_id{99, 1},
                                     lks_collider_id{4294967295u, 4294967295u}}) {
        const std::string value = std::to_string(id.index);
        lks_transform transform = at(1, 2, 3);
        float matrix[16] = {42};
        constexpr lks_result stale = LKS_ERROR_STALE_ID;
        refused(stale, value, [&] { return lks_world_remove_collider(world, id); });
        refused(stale, value, [&] { return lks_collider_move_to(world, id, at(0, 0, 0)); });
        refused(stale, value, [&] { return lks_collider_set_transform(world, id, at(0, 0, 0)); });
        refused(stale, value, [&] { return lks_collider_transform(world, id, &transform); });
        refused(stale, value,
                [&] { return lks_collider_write_matrix(world, id, LKS_VIEW_LAST_TICK, {}, matrix); });
        CHECK(same(transform.position, fixed(1, 2, 3)));
        CHECK(matrix[0] == 42);
        CHECK(lks_world_has_collider(world, id) == 0);
    }
    CHECK(lks_world_has_collider(world, again) == 1);
}

TEST_CASE_FIXTURE(Fixture, "collider definitions out of range are refused and add nothing") {
    collider_refused(invalid, "4", [](auto& def) { def.shape = 4; });
    collider_refused(invalid, "0", [](auto& def) { def.radius = 0; });
    collider_refused(invalid, "-0.5", [](auto& def) { def.radius = -half; });
    collider_refused(invalid, "30.5", [](auto& def) { def.radius = LKS_FIXED(30) + half; });
    collider_refused(invalid, "-0.5", [](auto& def) {
        def.shape = LKS_SHAPE_CAPSULE;
        def.half_length = -half;
    });
    collider_refused(invalid, "30.5", [](auto& def) {
        def.shape = LKS_SHAPE_CAPSULE;
        def.half_length = LKS_FIXED(30) + half;
    });
    collider_refused(invalid, "30.5", [](auto& def) {
        def.shape = LKS_SHAPE_BOX;
        def.half_extents = {LKS_FIXED(1), LKS_FIXED(30) + half, LKS_FIXED(1)};
    });
    collider_refused(invalid, "0", [](auto& def) {
        def.shape = LKS_SHAPE_BOX;
        def.half_extents = {LKS_FIXED(1), LKS_FIXED(1), 0};
    });
    collider_refused(invalid, "-0.5", [](auto& def) { def.static_friction = -half; });
    collider_refused(invalid, "100.5", [](auto& def) { def.static_friction = LKS_FIXED(100) + half; });
    collider_refused(invalid, "-0.5", [](auto& def) { def.dynamic_friction = -half; });
    collider_refused(invalid, "0.75", [](auto& def) {
        def.static_friction = half;
        def.dynamic_friction = half + half / 2;
    });
    collider_refused(invalid, "restitution -0.5", [](auto& def) { def.restitution = -half; });
    collider_refused(invalid, "restitution 1.5", [](auto& def) { def.restitution = LKS_FIXED_ONE + half; });
    collider_refused(invalid, "restitution", [](auto& def) { def.restitution = LKS_FIXED_ONE + 1; });
    collider_refused(invalid, "8388001", [](auto& def) { def.transform.position.y = LKS_FIXED(8388001); });
}

TEST_CASE_FIXTURE(Fixture,
                  "every filter of a collider is a good one, and so is any restitution from 0 to 1") {
    for (const lks_filter& filter : {lks_filter{0, 0, 0}, lks_filter{4294967295u, 4294967295u, 2147483647},
                                     lks_filter{1, 0, -2147483647 - 1}}) {
        for (const lks_fixed restitution : {lks_fixed{0}, lks_fixed{1}, LKS_FIXED_ONE}) {
            lks_collider_def def = lks_default_collider_def();
            def.transform = at(50, 50, 50);
            def.filter = filter;
            def.restitution = restitution;
            const std::uint64_t hash = world.hash();
            world.add(def);
            CHECK(world.hash() != hash);
        }
    }
}

TEST_CASE_FIXTURE(Fixture, "moves of more than 100 m or 90 degrees a tick are refused") {
    lks_transform now{};
    REQUIRE(lks_collider_transform(world, scene.ball, &now) == LKS_OK);
    const auto moved = [&](double metres_along_x) { return at(now.position + fixed(metres_along_x, 0, 0)); };
    refused(invalid, "100", [&] { return lks_collider_move_to(world, scene.ball, moved(100.5)); });
    refused(invalid, "100", [&] { return lks_collider_move_to(world, scene.ball, moved(-5000)); });
    refused(invalid, "90",
            [&] { return lks_collider_move_to(world, scene.ball, turned(at(now.position), 1, 1, 0, 91)); });
    CHECK(lks_collider_move_to(world, scene.ball, moved(99)) == LKS_OK);
    CHECK(lks_collider_move_to(world, scene.ball, turned(at(now.position), 1, 1, 0, 89)) == LKS_OK);
    refused(invalid, "8388001", [&] {
        lks_transform far = at(0, 0, 0);
        far.position.x = LKS_FIXED(8388001);
        return lks_collider_set_transform(world, scene.ball, far);
    });
}

TEST_CASE("the limit of objects and of colliders is refused and not passed") {
    World world(world_def(60, 1));
    for (std::uint32_t i = 0; i < LKS_MAX_COLLIDERS; ++i) {
        world.add(lks_default_collider_def());
    }
    const lks_collider_def def = lks_default_collider_def();
    lks_collider_id id{};
    check_call_refused(world, LKS_ERROR_LIMIT, "4096",
                       [&] { return lks_world_add_collider(world, &def, &id); });
    REQUIRE(lks_world_remove_collider(world, {100, 1}) == LKS_OK);
    CHECK(world.add(def).index == 100);
}

TEST_CASE("the limit of objects is 65536") {
    World world(world_def(60, 1));
    const Asset asset = loose_points({{0, 0, 0}, {1, 0, 0}}, {1, 1});
    for (std::uint32_t i = 0; i < LKS_MAX_OBJECTS; ++i) {
        world.add(asset, at(0, 0, 0));
    }
    const lks_object_def def = object_def(asset, at(0, 0, 0));
    lks_object_id id{};
    check_call_refused(world, LKS_ERROR_LIMIT, "65536",
                       [&] { return lks_world_add_object(world, &def, &id); });
}
