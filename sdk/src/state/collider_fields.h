// What a collider is made of in an image, once for writing and reading. Its hash has another order and leaves
// some of it out (state/state_hash.cpp).
#pragma once

#include "collide/collider_motion.h"
#include "state/field_io.h"

namespace lks {

template <typename Io, typename Collider>
void collider_fields(Io& io, Collider& collider) {
    io.u32(collider.shape.kind);
    io.u32(collider.filter.category);
    io.u32(collider.filter.mask);
    io.i32(collider.filter.group);
    io.i64(collider.shape.radius);
    io.i64(collider.shape.half_length);
    vector_fields(io, collider.shape.half_extents);
    io.i64(collider.static_friction);
    io.i64(collider.dynamic_friction);
    io.i64(collider.restitution);
    vector_fields(io, collider.position);
    vector_fields(io, collider.target_position);
    rotation_fields(io, collider.rotation);
    rotation_fields(io, collider.target_rotation);
}

} // namespace lks
