// A definition that was not made by its lks_default function is refused, whatever else stands in it.
#include <doctest/doctest.h>

#include <cstring>
#include <vector>

#include "support/refusals.h"
#include "support/scene.h"

using namespace support;

namespace {

// Sizes that a newer, an older or no version of the struct might have.
template <typename Def>
std::vector<std::uint32_t> wrong_sizes() {
    const auto right = static_cast<std::uint32_t>(sizeof(Def));
    return {0, 1, right - 8, right - 1, right + 1, right + 8, 4294967295u};
}

} // namespace

TEST_CASE("definitions of a world and of assets with a wrong size are refused") {
    for (const std::uint32_t size : wrong_sizes<lks_world_def>()) {
        lks_world_def def = lks_default_world_def();
        CHECK(def.struct_size == sizeof def);
        def.struct_size = size;
        lks_world* world = nullptr;
        CHECK(lks_world_create(&def, &world) == LKS_ERROR_STRUCT_SIZE);
        CHECK(world == nullptr);
    }
    for (const std::uint32_t size : wrong_sizes<lks_cloth_def>()) {
        lks_cloth_def def = lks_default_cloth_def();
        CHECK(def.struct_size == sizeof def);
        def.struct_size = size;
        lks_asset* asset = nullptr;
        CHECK(lks_asset_create_cloth(&def, &asset) == LKS_ERROR_STRUCT_SIZE);
        CHECK(asset == nullptr);
    }
    for (const std::uint32_t size : wrong_sizes<lks_rope_def>()) {
        lks_rope_def def = lks_default_rope_def();
        CHECK(def.struct_size == sizeof def);
        def.struct_size = size;
        lks_asset* asset = nullptr;
        CHECK(lks_asset_create_rope(&def, &asset) == LKS_ERROR_STRUCT_SIZE);
        CHECK(asset == nullptr);
    }
}

TEST_CASE("definitions with a wrong size given to a world are refused and named") {
    const SceneAssets assets;
    const Scene scene(assets);
    const World& world = scene.world;
    for (const std::uint32_t size : wrong_sizes<lks_object_def>()) {
        lks_object_def def = object_def(assets.rope, at(0, 0, 0));
        CHECK(def.struct_size == sizeof def);
        def.struct_size = size;
        lks_object_id id{};
        check_call_refused(world, LKS_ERROR_STRUCT_SIZE, std::to_string(size),
                           [&] { return lks_world_add_object(world, &def, &id); });
    }
    for (const std::uint32_t size : wrong_sizes<lks_collider_def>()) {
        lks_collider_def def = lks_default_collider_def();
        CHECK(def.struct_size == sizeof def);
        def.struct_size = size;
        lks_collider_id id{};
        check_call_refused(world, LKS_ERROR_STRUCT_SIZE, std::to_string(size),
                           [&] { return lks_world_add_collider(world, &def, &id); });
    }
    for (const std::uint32_t size : wrong_sizes<lks_vertex_view>()) {
        lks_vertex_view view = lks_default_vertex_view();
        CHECK(view.struct_size == sizeof view);
        std::vector<float> positions(3 * assets.rope.vertex_count(), 5.0f);
        view.positions = positions.data();
        view.position_stride = 12;
        view.vertex_capacity = assets.rope.vertex_count();
        view.struct_size = size;
        check_call_refused(world, LKS_ERROR_STRUCT_SIZE, std::to_string(size),
                           [&] { return lks_object_write_vertices(world, scene.rope, &view); });
        CHECK(positions[0] == 5.0f);
    }
}

TEST_CASE("a definition of zero bytes is refused") {
    lks_world_def world_settings;
    std::memset(&world_settings, 0, sizeof world_settings);
    lks_world* world = nullptr;
    CHECK(lks_world_create(&world_settings, &world) == LKS_ERROR_STRUCT_SIZE);
    lks_cloth_def cloth;
    std::memset(&cloth, 0, sizeof cloth);
    lks_asset* asset = nullptr;
    CHECK(lks_asset_create_cloth(&cloth, &asset) == LKS_ERROR_STRUCT_SIZE);
}
