// lockstitch/object.h: adding, removing and asking.
#include <lockstitch/object.h>

#include <algorithm>

#include "api/object_checks.h"
#include "fixed/rotation.h"
#include "rigid/particle_touch.h"
#include "solver/prediction.h"
#include "solver/wrapping.h"

using namespace lks;

namespace {

lks_result check_object_def(const lks_world& world, const lks_object_def& def) {
    if (def.asset == nullptr) {
        return world.fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_world_add_object", "def->asset"));
    }
    if (def.record_forces > 1) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                          Sentence() << "record_forces is " << def.record_forces << "; it must be 0 or 1.");
    }
    if (!within(def.transform.position, world_position_limit)) {
        return world.fail(
            LKS_ERROR_INVALID_ARGUMENT,
            out_of_range("object's position", def.transform.position, "m", world_position_limit));
    }
    if (const lks_result result = check_rotation(world, def.transform.rotation); result != LKS_OK) {
        return result;
    }
    const lks_fixed speed_limit = lks_world_speed_limit(&world);
    if (!within(def.velocity, speed_limit)) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                          out_of_range("object's velocity", def.velocity, "m/s", speed_limit));
    }
    if (const lks_result result = check_gravity_factor(world, def.gravity_factor); result != LKS_OK) {
        return result;
    }
    return check_linear_damping(world, def.linear_damping);
}

void place_particles(Object& object, const lks_object_def& def, const StepRate& rate) {
    const fixed::Rotation rotation = fixed::normalise(to_rotation(def.transform.rotation));
    const fixed::Matrix3 matrix = fixed::to_matrix(rotation);
    const lks_asset& asset = object.asset();
    const fixed::Vec3 motion{motion_from_velocity(rate, def.velocity.x),
                             motion_from_velocity(rate, def.velocity.y),
                             motion_from_velocity(rate, def.velocity.z)};
    for (std::uint32_t i = 0; i < object.count(); ++i) {
        const Coordinates& rest = asset.rest_positions[i];
        const fixed::Vec3 p = fixed::rotate(matrix, fixed::Vec3{rest.x, rest.y, rest.z});
        object.axis(0)[i] = p.x;
        object.axis(1)[i] = p.y;
        object.axis(2)[i] = p.z;
        (void)set_motion(p.x, object.start_axis(0)[i], motion.x, rate.motion_limit);
        (void)set_motion(p.y, object.start_axis(1)[i], motion.y, rate.motion_limit);
        (void)set_motion(p.z, object.start_axis(2)[i], motion.z, rate.motion_limit);
    }
    object.origin = to_vec3(def.transform.position);
    object.gravity_factor = def.gravity_factor;
    object.linear_damping = def.linear_damping;
    object.keep_previous();
}

// Room for an object at this index, which is at most one more than all. False: no memory.
bool reserve_object(lks_world& world, std::uint32_t index) {
    if (index < world.objects.size()) {
        return true;
    }
    if (world.objects.size() == world.objects.capacity()) {
        const std::size_t capacity = grown_room(world.objects.size());
        return world.load_staging.reserve(capacity) && world.rigid.reserve_objects(capacity) &&
               world.objects.reserve(capacity);
    }
    return true;
}

std::int64_t world_axis(std::int64_t origin, std::int64_t coordinate) {
    constexpr std::int64_t half = std::int64_t{1} << (coordinate_from_world_shift - 1);
    return wrapping_add(origin, wrapping_add(coordinate, half) >> coordinate_from_world_shift);
}

} // namespace

extern "C" {

lks_object_def lks_default_object_def(void) {
    lks_object_def def{};
    def.struct_size = sizeof(lks_object_def);
    def.transform.rotation.w = LKS_ROTATION_ONE;
    def.gravity_factor = LKS_FIXED_ONE;
    return def;
}

lks_result lks_world_add_object(lks_world* world, const lks_object_def* def, lks_object_id* object) {
    if (const lks_result result = check_addition(world, "object", def, object); result != LKS_OK) {
        return result;
    }
    if (const lks_result result = check_object_def(*world, *def); result != LKS_OK) {
        return result;
    }
    const std::uint32_t index =
        first_free(world->objects, [](const ObjectSlot& slot) { return slot.object == nullptr; });
    if (index >= LKS_MAX_OBJECTS) {
        return world->fail(LKS_ERROR_LIMIT,
                           Sentence() << "A world holds at most " << LKS_MAX_OBJECTS << " objects.");
    }
    const std::size_t known_before = world->assets.size();
    const KnownAsset* known = world->know_asset(*def->asset);
    Object* made = known == nullptr || !reserve_object(*world, index)
                       ? nullptr
                       : world->make_object(*known, def->record_forces != 0);
    if (made == nullptr) {
        world->forget_assets(known_before);
        return world->fail_out_of_memory("an object");
    }
    place_particles(*made, *def, world->rate);
    if (index == world->objects.size()) {
        world->objects.push_reserved(ObjectSlot{nullptr, 1});
    }
    world->objects[index].object = made;
    *object = {index, world->objects[index].generation};
    return LKS_OK;
}

lks_result lks_world_remove_object(lks_world* world, lks_object_id object) {
    lks_result result = LKS_OK;
    if (const Object* found = require_object(world, object, result)) {
        wake_who_touches(*world, *found);
        free_object_slot(*world, object.index);
    }
    return result;
}

uint32_t lks_world_has_object(const lks_world* world, lks_object_id object) {
    return world != nullptr && world->find_object(object) != nullptr ? 1u : 0u;
}

uint32_t lks_world_object_count(const lks_world* world) {
    uint32_t count = 0;
    if (world != nullptr) {
        for (const ObjectSlot& slot : world->objects) {
            count += slot.object != nullptr ? 1u : 0u;
        }
    }
    return count;
}

lks_result lks_world_object_at(const lks_world* world, uint32_t n, lks_object_id* object) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (object == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_world_object_at", "object"));
    }
    std::uint32_t count = 0;
    const std::uint32_t index =
        find_nth(world->objects, n, count, [](const auto& slot) { return slot.object != nullptr; });
    if (index < world->objects.size()) {
        *object = {index, world->objects[index].generation};
        return LKS_OK;
    }
    return world->fail(LKS_ERROR_INVALID_ARGUMENT,
                       Sentence() << "Object " << n << " does not exist: the world has " << count << ".");
}

const lks_asset* lks_object_asset(const lks_world* world, lks_object_id object) {
    const Object* found = world == nullptr ? nullptr : world->find_object(object);
    return found == nullptr ? nullptr : &found->asset();
}

lks_result lks_object_origin(const lks_world* world, lks_object_id object, lks_vec3* origin) {
    lks_result result = LKS_OK;
    if (const Object* found = require_vertices(world, object, 0, 0, origin, "lks_object_origin", result)) {
        *origin = from_vec3(found->origin);
    }
    return result;
}

lks_result lks_object_positions(const lks_world* world, lks_object_id object, uint32_t first, uint32_t count,
                                lks_vec3* positions) {
    lks_result result = LKS_OK;
    const Object* found =
        require_vertices(world, object, first, count, positions, "lks_object_positions", result);
    for (std::uint32_t i = 0; found != nullptr && i < count; ++i) {
        const Coordinates p = found->position(found->asset().vertex_to_particle[first + i]);
        positions[i] = {world_axis(found->origin.x, p.x), world_axis(found->origin.y, p.y),
                        world_axis(found->origin.z, p.z)};
    }
    return result;
}

lks_result lks_object_raw_positions(const lks_world* world, lks_object_id object, uint32_t first,
                                    uint32_t count, lks_raw_position* positions) {
    lks_result result = LKS_OK;
    const Object* found =
        require_vertices(world, object, first, count, positions, "lks_object_raw_positions", result);
    for (std::uint32_t i = 0; found != nullptr && i < count; ++i) {
        const Coordinates p = found->position(found->asset().vertex_to_particle[first + i]);
        positions[i] = {p.x, p.y, p.z};
    }
    return result;
}

lks_result lks_object_velocities(const lks_world* world, lks_object_id object, uint32_t first, uint32_t count,
                                 lks_vec3* velocities) {
    lks_result result = LKS_OK;
    const Object* found =
        require_vertices(world, object, first, count, velocities, "lks_object_velocities", result);
    for (std::uint32_t i = 0; found != nullptr && i < count; ++i) {
        const std::uint32_t particle = found->asset().vertex_to_particle[first + i];
        const auto velocity = [&](int axis) {
            return velocity_from_motion(world->rate, wrapping_subtract(found->axis(axis)[particle],
                                                                       found->start_axis(axis)[particle]));
        };
        velocities[i] = {velocity(0), velocity(1), velocity(2)};
    }
    return result;
}

lks_result lks_object_constraint_force(const lks_world* world, lks_object_id object, uint32_t constraint,
                                       lks_fixed* force) {
    lks_result result = LKS_OK;
    const Object* found = require_vertices(world, object, 0, 0, force, "lks_object_constraint_force", result);
    if (found == nullptr) {
        return result;
    }
    if (!found->record_forces) {
        return world->fail(LKS_ERROR_UNSUPPORTED, Sentence() << "The object with index " << object.index
                                                             << " was added without record_forces.");
    }
    const lks_asset& asset = found->asset();
    if (constraint >= asset.constraint_count()) {
        return world->fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "Constraint " << constraint
                                                                  << " does not exist: the object has "
                                                                  << asset.constraint_count() << ".");
    }
    const std::int64_t multiplier = found->multipliers[constraint];
    const fixed::Scaled effective =
        multiplier_scale(found->coefficients(), asset, world->rate,
                         {found->recorded_pins.data(), found->recorded_pins.size()}, constraint);
    std::int64_t newtons = 0;
    if (!effective.is_zero()) {
        const fixed::Scaled inverse_h = world->rate.inverse_h();
        const fixed::Scaled value =
            fixed::Scaled::from_fixed(fixed::magnitude(multiplier), coordinate_fraction_bits) / effective *
            inverse_h * inverse_h;
        newtons = std::min(value.to_i64_fixed(world_fraction_bits), LKS_FIXED(8388607));
    }
    // Λ is positive where the constraint pushes.
    *force = multiplier < 0 ? newtons : -newtons;
    return LKS_OK;
}

} // extern "C"
