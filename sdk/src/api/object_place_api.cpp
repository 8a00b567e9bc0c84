// lockstitch/object.h: putting an object that exists elsewhere.
#include <lockstitch/object.h>

#include "api/checks.h"
#include "collide/saturation.h"
#include "rigid/particle_touch.h"
#include "solver/laying.h"

using namespace lks;

namespace {

lks_result check_place(const lks_world& world, const char* name, const lks_vec3& position) {
    return within(position, world_position_limit)
               ? LKS_OK
               : world.fail(LKS_ERROR_INVALID_ARGUMENT,
                            out_of_range(name, position, "m", world_position_limit));
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
