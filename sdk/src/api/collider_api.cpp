// lockstitch/collider.h.
#include <lockstitch/collider.h>

#include <cstdlib>

#include "api/checks.h"
#include "api/collider_checks.h"
#include "collide/saturation.h"
#include "rigid/contact_memory.h"
#include "rigid/sleep.h"

using namespace lks;

namespace {

ColliderState make_collider(const lks_collider_def& def) {
    ColliderState collider{};
    collider.shape.kind = def.shape;
    // What a shape does not have stays zero, so that equal colliders have equal states.
    if (def.shape == LKS_SHAPE_SPHERE || def.shape == LKS_SHAPE_CAPSULE) {
        collider.shape.radius = coordinate_from_world(def.radius);
    }
    if (def.shape == LKS_SHAPE_CAPSULE) {
        collider.shape.half_length = coordinate_from_world(def.half_length);
    }
    if (def.shape == LKS_SHAPE_BOX) {
        collider.shape.half_extents = {coordinate_from_world(def.half_extents.x),
                                       coordinate_from_world(def.half_extents.y),
                                       coordinate_from_world(def.half_extents.z)};
    }
    collider.static_friction = def.static_friction;
    collider.dynamic_friction = def.dynamic_friction;
    collider.restitution = def.restitution;
    collider.filter = def.filter;
    place_collider(collider, to_vec3(def.transform.position),
                   fixed::normalise(to_rotation(def.transform.rotation)));
    return collider;
}

// Whether any point of it is put further off than contacts are looked for: what touched it is where it was by
// chance, and not on the side that it came from. A plane has one side.
bool jumps(const ColliderState& collider, const fixed::Vec3& position, const fixed::Rotation& rotation) {
    if (collider.shape.kind == LKS_SHAPE_PLANE) {
        return false;
    }
    const fixed::Matrix3 from = fixed::to_matrix(collider.rotation);
    const fixed::Matrix3 to = fixed::to_matrix(rotation);
    std::int64_t turn = 0; // Direction, at least as much as a point at one metre moves by
    for (int i = 0; i < 9; ++i) {
        turn += std::abs(std::int64_t{to.m[i / 3][i % 3]} - from.m[i / 3][i % 3]);
    }
    const std::int64_t radius = world_from_coordinate(bounding_radius(collider.shape, 0));
    const std::int64_t way =
        fixed::saturating_add(sum_of_magnitudes(saturating_subtract(position, collider.position)),
                              fixed::multiply_shift(radius, turn, direction_fraction_bits));
    return way > near_distance;
}

bool reserve_collider(lks_world& world, std::uint32_t index) {
    if (index < world.colliders.capacity()) {
        return true;
    }
    return world.reserve_colliders(grown_room(world.colliders.size()));
}

lks_result check_transform(const lks_world& world, const lks_transform& transform) {
    if (!within(transform.position, world_position_limit)) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                          out_of_range("collider's position", transform.position, "m", world_position_limit));
    }
    return check_rotation(world, transform.rotation);
}

// The collider, once the id and the transform are good; null, with the failure reported, otherwise.
ColliderState* require_collider(lks_world* world, lks_collider_id id, const lks_transform& transform,
                                lks_result& result) {
    if (world == nullptr) {
        result = LKS_ERROR_NULL_ARGUMENT;
        return nullptr;
    }
    ColliderState* collider = world->find_collider(id);
    result = collider == nullptr ? world->stale_collider(id) : check_transform(*world, transform);
    return result == LKS_OK ? collider : nullptr;
}

} // namespace

extern "C" {

lks_collider_def lks_default_collider_def(void) {
    lks_collider_def def{};
    def.struct_size = sizeof(lks_collider_def);
    def.shape = LKS_SHAPE_SPHERE;
    def.transform.rotation.w = LKS_ROTATION_ONE;
    def.radius = LKS_FIXED_RATIO(1, 2);
    def.half_length = LKS_FIXED_RATIO(1, 2);
    def.half_extents = {LKS_FIXED_RATIO(1, 2), LKS_FIXED_RATIO(1, 2), LKS_FIXED_RATIO(1, 2)};
    def.static_friction = LKS_FIXED_RATIO(1, 2);
    def.dynamic_friction = LKS_FIXED_RATIO(4, 10);
    def.filter = default_filter;
    return def;
}

lks_result lks_world_add_collider(lks_world* world, const lks_collider_def* def, lks_collider_id* collider) {
    if (const lks_result result = check_addition(world, "collider", def, collider); result != LKS_OK) {
        return result;
    }
    if (const lks_result result = check_collider_def(*world, *def); result != LKS_OK) {
        return result;
    }
    if (const lks_result result = check_transform(*world, def->transform); result != LKS_OK) {
        return result;
    }
    const std::uint32_t index = first_free(world->colliders);
    if (index >= LKS_MAX_COLLIDERS) {
        return world->fail(LKS_ERROR_LIMIT,
                           Sentence() << "A world holds at most " << LKS_MAX_COLLIDERS << " colliders.");
    }
    if (!reserve_collider(*world, index)) {
        return world->fail_out_of_memory("a collider");
    }
    if (index == world->colliders.size()) {
        world->colliders.push_reserved(ColliderSlot{{}, 1, false});
    }
    ColliderSlot& slot = world->colliders[index];
    slot.collider = make_collider(*def);
    slot.used = true;
    wake_who_meets(world->rigid, def->filter);
    *collider = {index, slot.generation};
    return LKS_OK;
}

lks_result lks_world_remove_collider(lks_world* world, lks_collider_id collider) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (world->find_collider(collider) == nullptr) {
        return world->stale_collider(collider);
    }
    ColliderSlot& slot = world->colliders[collider.index];
    slot.used = false;
    wake_who_meets(world->rigid, slot.collider.filter);
    drop_contacts(world->rigid, collider.index | other_is_collider);
    slot.collider = ColliderState{};
    slot.generation = next_generation(slot.generation);
    return LKS_OK;
}

uint32_t lks_world_has_collider(const lks_world* world, lks_collider_id collider) {
    return world != nullptr && world->find_collider(collider) != nullptr ? 1u : 0u;
}

lks_result lks_collider_move_to(lks_world* world, lks_collider_id collider, lks_transform target) {
    lks_result result = LKS_OK;
    ColliderState* found = require_collider(world, collider, target, result);
    if (found == nullptr) {
        return result;
    }
    const fixed::Vec3 position = to_vec3(target.position);
    const fixed::Rotation rotation = fixed::normalise(to_rotation(target.rotation));
    if (result = check_motion(*world, *found, position, rotation); result != LKS_OK) {
        return result;
    }
    found->target_position = position;
    found->target_rotation = rotation;
    return LKS_OK;
}

lks_result lks_collider_set_transform(lks_world* world, lks_collider_id collider, lks_transform transform) {
    lks_result result = LKS_OK;
    if (ColliderState* found = require_collider(world, collider, transform, result)) {
        const fixed::Vec3 position = to_vec3(transform.position);
        const fixed::Rotation rotation = fixed::normalise(to_rotation(transform.rotation));
        if (jumps(*found, position, rotation)) {
            forget_contacts(world->rigid, collider.index | other_is_collider);
        }
        place_collider(*found, position, rotation);
        wake_who_meets(world->rigid, found->filter);
    }
    return result;
}

lks_result lks_collider_transform(const lks_world* world, lks_collider_id collider,
                                  lks_transform* transform) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    const ColliderState* found = world->find_collider(collider);
    if (found == nullptr) {
        return world->stale_collider(collider);
    }
    if (transform == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_collider_transform", "transform"));
    }
    transform->position = from_vec3(found->position);
    transform->rotation = {found->rotation.x, found->rotation.y, found->rotation.z, found->rotation.w};
    return LKS_OK;
}

} // extern "C"
