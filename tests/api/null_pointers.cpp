// Every function of the API takes a null pointer calmly wherever one can be given.
#include <doctest/doctest.h>

#include "support/refusals.h"
#include "support/scene.h"

using namespace support;

namespace {

constexpr lks_result null = LKS_ERROR_NULL_ARGUMENT;

} // namespace

TEST_CASE("calls without a world are refused or answer with nothing") {
    lks_object_def object = lks_default_object_def();
    lks_collider_def collider = lks_default_collider_def();
    lks_object_id object_id{};
    lks_collider_id collider_id{};
    lks_vec3 vec{};
    lks_raw_position raw{};
    lks_transform transform = lks_transform_identity();
    lks_world_counters counters{};
    lks_fixed force = 0;
    lks_vertex_view view = lks_default_vertex_view();
    float matrix[16] = {};
    std::uint32_t ran = 0;
    std::size_t size = 0;
    std::uint64_t memory[64] = {};
    const Asset asset = Chain().build();

    CHECK(lks_world_step(nullptr) == null);
    CHECK(lks_world_advance(nullptr, 1, &ran) == null);
    CHECK(lks_world_set_gravity(nullptr, vec) == null);
    CHECK(lks_world_gravity(nullptr, &vec) == null);
    CHECK(lks_world_get_counters(nullptr, &counters) == null);
    CHECK(lks_world_add_object(nullptr, &object, &object_id) == null);
    CHECK(lks_world_remove_object(nullptr, object_id) == null);
    CHECK(lks_world_object_at(nullptr, 0, &object_id) == null);
    CHECK(lks_object_origin(nullptr, object_id, &vec) == null);
    CHECK(lks_object_set_gravity_factor(nullptr, object_id, 0) == null);
    CHECK(lks_object_set_linear_damping(nullptr, object_id, 0) == null);
    CHECK(lks_object_positions(nullptr, object_id, 0, 1, &vec) == null);
    CHECK(lks_object_raw_positions(nullptr, object_id, 0, 1, &raw) == null);
    CHECK(lks_object_velocities(nullptr, object_id, 0, 1, &vec) == null);
    CHECK(lks_object_set_velocity(nullptr, object_id, 0, vec) == null);
    CHECK(lks_object_apply_impulse(nullptr, object_id, 0, vec) == null);
    CHECK(lks_object_add_velocity(nullptr, object_id, vec) == null);
    CHECK(lks_object_pin(nullptr, object_id, 0) == null);
    CHECK(lks_object_unpin(nullptr, object_id, 0) == null);
    CHECK(lks_object_set_pin_target(nullptr, object_id, 0, vec) == null);
    CHECK(lks_object_teleport(nullptr, object_id, &transform, &transform) == null);
    CHECK(lks_object_set_positions(nullptr, object_id, 0, 1, &vec) == null);
    CHECK(lks_object_constraint_force(nullptr, object_id, 0, &force) == null);
    CHECK(lks_object_write_vertices(nullptr, object_id, &view) == null);
    CHECK(lks_world_add_collider(nullptr, &collider, &collider_id) == null);
    CHECK(lks_world_remove_collider(nullptr, collider_id) == null);
    CHECK(lks_collider_move_to(nullptr, collider_id, transform) == null);
    CHECK(lks_collider_set_transform(nullptr, collider_id, transform) == null);
    CHECK(lks_collider_transform(nullptr, collider_id, &transform) == null);
    CHECK(lks_collider_write_matrix(nullptr, collider_id, 0, vec, matrix) == null);
    CHECK(lks_world_save_size(nullptr, &size) == null);
    CHECK(lks_world_save(nullptr, memory, sizeof memory, &size) == null);
    CHECK(lks_world_load(nullptr, memory, sizeof memory) == null);
    CHECK(lks_world_register_asset(nullptr, asset) == null);

    CHECK(lks_world_last_error(nullptr) == nullptr);
    CHECK(lks_world_interpolation(nullptr) == 0);
    CHECK(lks_world_tick(nullptr) == 0);
    CHECK(lks_world_tick_rate(nullptr) == 0);
    CHECK(lks_world_substeps(nullptr) == 0);
    CHECK(lks_world_iterations(nullptr) == 0);
    CHECK(lks_world_speed_limit(nullptr) == 0);
    CHECK(lks_world_has_object(nullptr, object_id) == 0);
    CHECK(lks_world_object_count(nullptr) == 0);
    CHECK(lks_object_asset(nullptr, object_id) == nullptr);
    CHECK(lks_object_pin_count(nullptr, object_id) == 0);
    CHECK(lks_object_is_pinned(nullptr, object_id, 0) == 0);
    CHECK(lks_world_has_collider(nullptr, collider_id) == 0);
    CHECK(lks_world_hash(nullptr) == 0);
    CHECK(lks_world_local_hash(nullptr) == 0);
    CHECK(lks_object_hash(nullptr, object_id) == 0);
    lks_world_destroy(nullptr);
}

TEST_CASE("calls without an asset are refused or answer with nothing") {
    std::uint32_t indices[3] = {};
    lks_constraint_info info{};
    CHECK(lks_asset_fingerprint(nullptr) == 0);
    CHECK(lks_asset_vertex_count(nullptr) == 0);
    CHECK(lks_asset_constraint_count(nullptr) == 0);
    CHECK(lks_asset_colour_count(nullptr) == 0);
    CHECK(lks_asset_triangle_count(nullptr) == 0);
    CHECK(lks_asset_triangles(nullptr, indices, 3) == null);
    CHECK(lks_asset_constraint(nullptr, 0, &info) == null);
    lks_tether tethers[LKS_MAX_TETHERS_PER_VERTEX];
    CHECK(lks_asset_vertex_tethers(nullptr, 0, tethers) == 0);
    lks_asset_release(nullptr);
}

TEST_CASE("missing definitions and missing places for results are refused") {
    lks_world* world = nullptr;
    lks_asset* asset = nullptr;
    const lks_world_def world_settings = lks_default_world_def();
    const lks_cloth_def cloth = lks_default_cloth_def();
    const lks_rope_def rope = lks_default_rope_def();
    CHECK(lks_world_create(nullptr, &world) == null);
    CHECK(lks_world_create(&world_settings, nullptr) == null);
    CHECK(lks_asset_create_cloth(nullptr, &asset) == null);
    CHECK(lks_asset_create_cloth(&cloth, nullptr) == null);
    CHECK(lks_asset_create_rope(nullptr, &asset) == null);
    CHECK(lks_asset_create_rope(&rope, nullptr) == null);
    CHECK(world == nullptr);
    CHECK(asset == nullptr);

    lks_fixed number = 0;
    lks_vec3 vec{};
    CHECK(lks_fixed_from_double(1, nullptr) == null);
    CHECK(lks_vec3_from_doubles(1, 2, 3, nullptr) == null);
    CHECK(lks_rotation_from_axis_angle(0, 1, 0, 10, nullptr) == null);
    vec.y = LKS_FIXED_ONE;
    CHECK(lks_rotation_from_axis_angle_fixed(vec, LKS_FIXED(10), nullptr) == null);
    CHECK(lks_sin_cos(0, nullptr, &number) == null);
    CHECK(lks_sin_cos(0, &number, nullptr) == null);

    const Asset chain = Chain().build();
    CHECK(lks_asset_constraint(chain, 0, nullptr) == null);
    CHECK(lks_asset_vertex_tethers(chain, 0, nullptr) == 0);
    const Asset net = Net().build();
    CHECK(lks_asset_triangles(net, nullptr, 100000) == null);
}

TEST_CASE("missing buffers of a living world are refused and named") {
    const SceneAssets assets;
    Scene scene(assets);
    World& world = scene.world;
    const lks_object_def object = object_def(assets.net, at(0, 0, 0));
    const lks_collider_def collider = lks_default_collider_def();
    lks_object_id object_id{};
    lks_collider_id collider_id{};
    const auto refused = [&](const std::string& name, auto call) {
        check_call_refused(world, null, name, call);
    };
    refused("gravity", [&] { return lks_world_gravity(world, nullptr); });
    refused("counters", [&] { return lks_world_get_counters(world, nullptr); });
    refused("def", [&] { return lks_world_add_object(world, nullptr, &object_id); });
    refused("object", [&] { return lks_world_add_object(world, &object, nullptr); });
    refused("object", [&] { return lks_world_object_at(world, 0, nullptr); });
    refused("null", [&] { return lks_object_origin(world, scene.net, nullptr); });
    refused("null", [&] { return lks_object_positions(world, scene.net, 0, 1, nullptr); });
    refused("null", [&] { return lks_object_raw_positions(world, scene.net, 0, 1, nullptr); });
    refused("null", [&] { return lks_object_velocities(world, scene.net, 0, 1, nullptr); });
    refused("null", [&] { return lks_object_set_positions(world, scene.net, 0, 1, nullptr); });
    const lks_transform transform = at(0, 0, 0);
    refused("from", [&] { return lks_object_teleport(world, scene.net, nullptr, &transform); });
    refused("to,", [&] { return lks_object_teleport(world, scene.net, &transform, nullptr); });
    refused("null", [&] { return lks_object_constraint_force(world, scene.rope, 0, nullptr); });
    refused("view", [&] { return lks_object_write_vertices(world, scene.net, nullptr); });
    refused("def", [&] { return lks_world_add_collider(world, nullptr, &collider_id); });
    refused("collider", [&] { return lks_world_add_collider(world, &collider, nullptr); });
    refused("transform", [&] { return lks_collider_transform(world, scene.ball, nullptr); });
    refused("matrix", [&] { return lks_collider_write_matrix(world, scene.ball, 0, {}, nullptr); });
    refused("size", [&] { return lks_world_save_size(world, nullptr); });
    refused("memory", [&] { return lks_world_save(world, nullptr, 1 << 20, nullptr); });
    refused("memory", [&] { return lks_world_load(world, nullptr, 1 << 20); });
    refused("asset", [&] { return lks_world_register_asset(world, nullptr); });
    CHECK(lks_world_object_count(world) == 3);
}
