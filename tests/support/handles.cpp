#include "support/handles.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <cstring>

namespace support {

Asset::Asset(const lks_cloth_def& def) {
    lks_error error{};
    lks_cloth_def reporting = def;
    reporting.error = &error;
    const lks_result result = lks_asset_create_cloth(&reporting, &asset_);
    INFO(error.message);
    REQUIRE(result == LKS_OK);
}

Asset::Asset(const lks_rope_def& def) {
    lks_error error{};
    lks_rope_def reporting = def;
    reporting.error = &error;
    const lks_result result = lks_asset_create_rope(&reporting, &asset_);
    INFO(error.message);
    REQUIRE(result == LKS_OK);
}

std::vector<lks_constraint_info> Asset::constraints() const {
    std::vector<lks_constraint_info> result(constraint_count());
    for (std::uint32_t i = 0; i < result.size(); ++i) {
        REQUIRE(lks_asset_constraint(asset_, i, &result[i]) == LKS_OK);
    }
    return result;
}

std::vector<std::uint32_t> Asset::triangles() const {
    std::vector<std::uint32_t> result(std::size_t{3} * lks_asset_triangle_count(asset_));
    REQUIRE(lks_asset_triangles(asset_, result.data(), result.size()) == LKS_OK);
    return result;
}

World::World() : World(lks_default_world_def()) {}

World::World(const lks_world_def& def) {
    lks_error error{};
    lks_world_def reporting = def;
    reporting.error = &error;
    const lks_result result = lks_world_create(&reporting, &world_);
    INFO(error.message);
    REQUIRE(result == LKS_OK);
}

lks_object_id World::add(const Asset& asset, const lks_transform& transform) {
    return add(object_def(asset, transform));
}

lks_object_id World::add(const lks_object_def& def) {
    lks_object_id object{};
    const lks_result result = lks_world_add_object(world_, &def, &object);
    INFO(message());
    REQUIRE(result == LKS_OK);
    return object;
}

lks_collider_id World::add(const lks_collider_def& def) {
    lks_collider_id collider{};
    const lks_result result = lks_world_add_collider(world_, &def, &collider);
    INFO(message());
    REQUIRE(result == LKS_OK);
    return collider;
}

void World::step(std::uint64_t ticks) {
    for (std::uint64_t i = 0; i < ticks; ++i) {
        REQUIRE(lks_world_step(world_) == LKS_OK);
    }
}

lks_world_counters World::counters() const {
    lks_world_counters result{};
    REQUIRE(lks_world_get_counters(world_, &result) == LKS_OK);
    return result;
}

void World::pin(lks_object_id object, std::uint32_t vertex) {
    REQUIRE(lks_object_pin(world_, object, vertex) == LKS_OK);
}

void World::set_target(lks_object_id object, std::uint32_t vertex, const lks_vec3& target) {
    REQUIRE(lks_object_set_pin_target(world_, object, vertex, target) == LKS_OK);
}

std::uint32_t World::vertex_count(lks_object_id object) const {
    return lks_asset_vertex_count(lks_object_asset(world_, object));
}

std::vector<lks_vec3> World::positions(lks_object_id object) const {
    std::vector<lks_vec3> result(vertex_count(object));
    REQUIRE(lks_object_positions(world_, object, 0, vertex_count(object), result.data()) == LKS_OK);
    return result;
}

std::vector<lks_vec3> World::velocities(lks_object_id object) const {
    std::vector<lks_vec3> result(vertex_count(object));
    REQUIRE(lks_object_velocities(world_, object, 0, vertex_count(object), result.data()) == LKS_OK);
    return result;
}

std::vector<lks_raw_position> World::raw_positions(lks_object_id object) const {
    std::vector<lks_raw_position> result(vertex_count(object));
    REQUIRE(lks_object_raw_positions(world_, object, 0, vertex_count(object), result.data()) == LKS_OK);
    return result;
}

lks_vec3 World::origin(lks_object_id object) const {
    lks_vec3 result{};
    REQUIRE(lks_object_origin(world_, object, &result) == LKS_OK);
    return result;
}

std::vector<Vector> World::positions_from(lks_object_id object, const lks_vec3& place) const {
    const Vector offset = metres(origin(object) - place);
    std::vector<Vector> result;
    for (const lks_raw_position& raw : raw_positions(object)) {
        result.push_back(Vector{raw_metres(raw.x), raw_metres(raw.y), raw_metres(raw.z)} + offset);
    }
    return result;
}

double World::force(lks_object_id object, std::uint32_t constraint) const {
    lks_fixed result = 0;
    REQUIRE(lks_object_constraint_force(world_, object, constraint, &result) == LKS_OK);
    return metres(result);
}

Image World::save() const {
    std::size_t size = 0;
    REQUIRE(lks_world_save_size(world_, &size) == LKS_OK);
    Image image(size);
    std::size_t written = 0;
    REQUIRE(lks_world_save(world_, image.data(), image.size(), &written) == LKS_OK);
    REQUIRE(written == size);
    return image;
}

lks_world_def world_def(std::uint32_t tick_rate_hz, std::uint32_t substeps, std::uint32_t iterations) {
    lks_world_def def = lks_default_world_def();
    def.tick_rate_hz = tick_rate_hz;
    def.substeps = substeps;
    def.iterations = iterations;
    return def;
}

lks_world_def weightless(std::uint32_t substeps, std::uint32_t iterations) {
    lks_world_def def = world_def(60, substeps, iterations);
    def.gravity = {};
    return def;
}

lks_object_def object_def(const Asset& asset, const lks_transform& transform) {
    lks_object_def def = lks_default_object_def();
    def.asset = asset;
    def.transform = transform;
    return def;
}

bool long_runs() {
    const char* value = std::getenv("LOCKSTITCH_LONG");
    return value != nullptr && std::strcmp(value, "1") == 0;
}

} // namespace support
