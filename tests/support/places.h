// Transforms one after the other, and how objects lie, for tests that put things elsewhere.
#pragma once

#include <cstdlib>
#include <vector>

#include "support/bodies.h"

namespace support {

// What is fixed to a frame, after that has jumped.
inline lks_transform carried(const lks_transform& what, const lks_transform& from, const lks_transform& to) {
    const lks_rotation& q = from.rotation;
    const lks_rotation turn = product(to.rotation, {-q.x, -q.y, -q.z, q.w});
    const Vector arm = rotate(turn, metres(what.position - from.position));
    return {to.position + fixed(arm.x, arm.y, arm.z), product(turn, what.rotation)};
}

inline void teleport(const World& world, lks_object_id object, const lks_transform& from,
                     const lks_transform& to) {
    const lks_result result = lks_object_teleport(world, object, &from, &to);
    INFO(world.message());
    REQUIRE(result == LKS_OK);
}

inline void lay(const World& world, lks_object_id object, std::uint32_t first,
                const std::vector<lks_vec3>& positions) {
    const lks_result result = lks_object_set_positions(
        world, object, first, static_cast<std::uint32_t>(positions.size()), positions.data());
    INFO(world.message());
    REQUIRE(result == LKS_OK);
}

inline bool same(const std::vector<lks_raw_position>& a, const std::vector<lks_raw_position>& b) {
    bool all = a.size() == b.size();
    for (std::size_t i = 0; all && i < a.size(); ++i) {
        all = a[i].x == b[i].x && a[i].y == b[i].y && a[i].z == b[i].z;
    }
    return all;
}

inline bool same(const std::vector<lks_vec3>& a, const std::vector<lks_vec3>& b) {
    bool all = a.size() == b.size();
    for (std::size_t i = 0; all && i < a.size(); ++i) {
        all = same(a[i], b[i]);
    }
    return all;
}

// As drawn, metres from the world's origin.
inline std::vector<float> drawn(const World& world, lks_object_id object, std::uint32_t interpolation) {
    const std::uint32_t count = lks_asset_vertex_count(lks_object_asset(world, object));
    std::vector<float> floats(std::size_t{3} * count);
    lks_vertex_view view = lks_default_vertex_view();
    view.positions = floats.data();
    view.position_stride = 12;
    view.vertex_capacity = count;
    view.interpolation = interpolation;
    REQUIRE(lks_object_write_vertices(world, object, &view) == LKS_OK);
    return floats;
}

} // namespace support
