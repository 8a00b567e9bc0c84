// Attachments in one line each.
#pragma once

#include <doctest/doctest.h>

#include "support/handles.h"

namespace support {

inline lks_attachment_id attach(const World& world, const lks_attachment_def& def) {
    lks_attachment_id id{};
    const lks_result result = lks_world_add_attachment(world, &def, &id);
    INFO(world.message());
    REQUIRE(result == LKS_OK);
    return id;
}

inline lks_attachment_def to_body(lks_object_id object, std::uint32_t vertex, lks_body_id body,
                                  const lks_vec3& point = {}) {
    lks_attachment_def def = lks_default_attachment_def();
    def.object = object;
    def.vertex = vertex;
    def.body = body;
    def.point = point;
    return def;
}

inline lks_attachment_def to_vertex(lks_object_id object, std::uint32_t vertex, lks_object_id other,
                                    std::uint32_t other_vertex) {
    lks_attachment_def def = lks_default_attachment_def();
    def.kind = LKS_ATTACHMENT_TO_VERTEX;
    def.object = object;
    def.vertex = vertex;
    def.other_object = other;
    def.other_vertex = other_vertex;
    return def;
}

} // namespace support
