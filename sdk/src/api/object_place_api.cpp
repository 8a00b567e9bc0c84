// lockstitch/object.h: putting an object that exists elsewhere.
#include <lockstitch/object.h>

#include "api/checks.h"
#include "collide/saturation.h"
#include "rigid/particle_touch.h"
#include "solver/carrying.h"
#include "solver/laying.h"

using namespace lks;

namespace {

lks_result check_place(const lks_world& world, const char* name, const lks_vec3& position) {
    return within(position, world_position_limit)
               ? LKS_OK
               : world.fail(LKS_ERROR_INVALID_ARGUMENT,
                            out_of_range(name, position, "m", world_position_limit));
}

lks_result check_frame(const lks_world& world, const char* name, const lks_transform& frame) {
    const lks_result result = check_place(world, name, frame.position);
    return result != LKS_OK ? result : check_rotation(world, frame.rotation);
}

Frame frame_of(const lks_transform& transform) {
    return {to_vec3(transform.position), to_rotation(transform.rotation)};
}

lks_vec3 in_world_units(const Coordinates& c) {
    return {world_from_coordinate(c.x), world_from_coordinate(c.y), world_from_coordinate(c.z)};
}

lks_result check_carrying(const lks_world& world, const Object& object, const Carrying& carrying) {
    if (const lks_result result =
            check_place(world, "place of the object's origin afterwards", from_vec3(carrying.origin));
        result != LKS_OK) {
        return result;
    }
    const auto fits = [](std::int64_t c) { return within(c, coordinate_limit); };
    for (std::uint32_t i = 0; carrying.turn.turns && i < object.count(); ++i) {
        if (const Coordinates x = carried_position(carrying, object.position(i));
            !fits(x.x) || !fits(x.y) || !fits(x.z)) {
            return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                              out_of_range("way from the object's middle to one of its vertices afterwards",
                                           in_world_units(x), "m", LKS_FIXED(64)));
        }
    }
    return LKS_OK;
}

lks_result check_laid(const lks_world& world, const Laid& laid, const Bounds& bounds) {
    for (std::uint32_t i = 0; i < laid.count; ++i) {
        if (const lks_result result = check_place(world, "vertex's position", laid.positions[i]);
            result != LKS_OK) {
            return result;
        }
    }
    const lks_vec3 extent = from_vec3(saturating_subtract(bounds.high, bounds.low));
    return within(extent, greatest_extent)
               ? LKS_OK
               : world.fail(LKS_ERROR_INVALID_ARGUMENT,
                            out_of_range("object's extent afterwards", extent, "m", greatest_extent));
}

// Whom the object leaves, and whom it comes to, wakes.
template <typename Put>
void put_elsewhere(lks_world& world, Object& object, const Put& put) {
    wake_who_touches(world, object);
    world.counters.target_clamps += put();
    wake_who_touches(world, object);
}

} // namespace

extern "C" {

lks_result lks_object_teleport(lks_world* world, lks_object_id object, const lks_transform* from,
                               const lks_transform* to) {
    lks_result result = LKS_OK;
    Object* found = require_object(world, object, result);
    if (found == nullptr) {
        return result;
    }
    if (from == nullptr || to == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT,
                           null_argument("lks_object_teleport", from == nullptr ? "from" : "to"));
    }
    result = check_frame(*world, "position of from", *from);
    result = result != LKS_OK ? result : check_frame(*world, "position of to", *to);
    if (result != LKS_OK) {
        return result;
    }
    const Carrying carrying = plan_carrying(*world->kernels, *found, frame_of(*from), frame_of(*to));
    result = check_carrying(*world, *found, carrying);
    if (result == LKS_OK) {
        put_elsewhere(*world, *found, [&] { return carry(*found, carrying); });
    }
    return result;
}

lks_result lks_object_set_positions(lks_world* world, lks_object_id object, uint32_t first, uint32_t count,
                                    const lks_vec3* positions) {
    lks_result result = LKS_OK;
    Object* found =
        require_vertices(world, object, first, count, positions, "lks_object_set_positions", result);
    if (found == nullptr || count == 0) {
        return result;
    }
    const Laid laid{first, count, positions};
    const Bounds bounds = laid_bounds(*found, laid);
    result = check_laid(*world, laid, bounds);
    if (result == LKS_OK) {
        put_elsewhere(*world, *found, [&] { return lay(*found, laid, bounds); });
    }
    return result;
}

} // extern "C"
