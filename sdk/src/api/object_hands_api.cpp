// lockstitch/object.h: velocities, impulses, pins and factors, the inputs that a game gives while it runs.
#include <lockstitch/object.h>

#include "api/attachment_checks.h"
#include "api/object_checks.h"
#include "rigid/coupling.h"
#include "solver/local_frame.h"
#include "solver/prediction.h"
#include "solver/wrapping.h"

using namespace lks;

namespace {

// The object and the particle of a vertex; null, with the result reported, where either does not exist.
Object* require_particle(lks_world* world, lks_object_id id, std::uint32_t vertex, std::uint32_t& particle,
                         lks_result& result) {
    Object* object = require_object(world, id, result);
    if (object == nullptr) {
        return nullptr;
    }
    result = check_vertex(*world, *object, vertex);
    if (result != LKS_OK) {
        return nullptr;
    }
    particle = object->asset().vertex_to_particle[vertex];
    return object;
}

// Adds to, or replaces, the motion of one particle; clamped axes are counted.
template <typename Change>
void change_motion(lks_world& world, Object& object, std::uint32_t particle, const Change& change) {
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t x = object.axis(axis)[particle];
        std::int64_t& start = object.start_axis(axis)[particle];
        const std::int64_t motion = change(axis, wrapping_subtract(x, start));
        if (set_motion(x, start, motion, world.rate.motion_limit)) {
            ++world.counters.speed_clamps;
        }
    }
}

Pin* require_pin(lks_world* world, lks_object_id id, std::uint32_t vertex, Object*& object,
                 lks_result& result) {
    std::uint32_t particle = 0;
    object = require_particle(world, id, vertex, particle, result);
    if (object == nullptr) {
        return nullptr;
    }
    Pin* pin = object->find_pin(particle);
    if (pin == nullptr) {
        result = world->fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "Vertex " << vertex
                                                                    << " of the object with index "
                                                                    << id.index << " is not pinned.");
    }
    return pin;
}

} // namespace

extern "C" {

lks_result lks_object_set_gravity_factor(lks_world* world, lks_object_id object, lks_fixed factor) {
    lks_result result = LKS_OK;
    Object* found = require_object(world, object, result);
    if (found == nullptr) {
        return result;
    }
    result = check_gravity_factor(*world, factor);
    if (result == LKS_OK) {
        found->gravity_factor = factor;
    }
    return result;
}

lks_result lks_object_set_linear_damping(lks_world* world, lks_object_id object, lks_fixed damping) {
    lks_result result = LKS_OK;
    Object* found = require_object(world, object, result);
    if (found == nullptr) {
        return result;
    }
    result = check_linear_damping(*world, damping);
    if (result == LKS_OK) {
        found->linear_damping = damping;
    }
    return result;
}

lks_result lks_object_set_velocity(lks_world* world, lks_object_id object, uint32_t vertex,
                                   lks_vec3 velocity) {
    std::uint32_t particle = 0;
    lks_result result = LKS_OK;
    Object* found = require_particle(world, object, vertex, particle, result);
    if (found == nullptr) {
        return result;
    }
    const lks_fixed limit = lks_world_speed_limit(world);
    if (!within(velocity, limit)) {
        return world->fail(LKS_ERROR_INVALID_ARGUMENT, out_of_range("velocity", velocity, "m/s", limit));
    }
    if (found->find_pin(particle) != nullptr) {
        return world->fail(LKS_ERROR_INVALID_ARGUMENT,
                           Sentence() << "Vertex " << vertex << " is pinned; its pin decides its velocity.");
    }
    change_motion(*world, *found, particle, [&](int axis, std::int64_t) {
        return motion_from_velocity(world->rate, fixed::component(velocity, axis));
    });
    return LKS_OK;
}

lks_result lks_object_apply_impulse(lks_world* world, lks_object_id object, uint32_t vertex,
                                    lks_vec3 impulse) {
    std::uint32_t particle = 0;
    lks_result result = LKS_OK;
    Object* found = require_particle(world, object, vertex, particle, result);
    if (found == nullptr || found->find_pin(particle) != nullptr) {
        return result;
    }
    const fixed::Scaled& inverse_mass = found->asset().inverse_masses[particle];
    change_motion(*world, *found, particle, [&](int axis, std::int64_t motion) {
        return saturating_add(
            motion, motion_from_impulse(world->rate, fixed::component(impulse, axis), inverse_mass));
    });
    return LKS_OK;
}

lks_result lks_object_add_velocity(lks_world* world, lks_object_id object, lks_vec3 velocity) {
    lks_result result = LKS_OK;
    Object* found = require_object(world, object, result);
    if (found == nullptr) {
        return result;
    }
    const lks_fixed limit = lks_world_speed_limit(world);
    if (!within(velocity, limit)) {
        return world->fail(LKS_ERROR_INVALID_ARGUMENT, out_of_range("velocity", velocity, "m/s", limit));
    }
    const std::int64_t added[3] = {motion_from_velocity(world->rate, velocity.x),
                                   motion_from_velocity(world->rate, velocity.y),
                                   motion_from_velocity(world->rate, velocity.z)};
    for (std::uint32_t particle = 0; particle < found->count(); ++particle) {
        if (found->find_pin(particle) == nullptr) {
            change_motion(*world, *found, particle,
                          [&](int axis, std::int64_t motion) { return saturating_add(motion, added[axis]); });
        }
    }
    return LKS_OK;
}

lks_result lks_object_pin(lks_world* world, lks_object_id object, uint32_t vertex) {
    std::uint32_t particle = 0;
    lks_result result = LKS_OK;
    Object* found = require_particle(world, object, vertex, particle, result);
    if (found == nullptr || found->find_pin(particle) != nullptr) {
        return result;
    }
    if (const lks_result held = check_held_nowhere(*world, object, vertex, "it can't be pinned, too.");
        held != LKS_OK) {
        return held;
    }
    if (!found->reserve_pins(found->pins().size() + 1)) {
        return world->fail_out_of_memory("a pin");
    }
    Coordinates target = found->position(particle);
    for (std::int64_t* axis : {&target.x, &target.y, &target.z}) {
        *axis = *axis > coordinate_limit    ? coordinate_limit
                : *axis < -coordinate_limit ? -coordinate_limit
                                            : *axis;
    }
    found->add_pin(world->rate, particle, target);
    follow_masses(*world);
    return LKS_OK;
}

lks_result lks_object_unpin(lks_world* world, lks_object_id object, uint32_t vertex) {
    Object* found = nullptr;
    lks_result result = LKS_OK;
    if (const Pin* pin = require_pin(world, object, vertex, found, result)) {
        found->remove_pin(world->rate, pin->particle);
        follow_masses(*world);
    }
    return result;
}

lks_result lks_object_set_pin_target(lks_world* world, lks_object_id object, uint32_t vertex,
                                     lks_vec3 target) {
    Object* found = nullptr;
    lks_result result = LKS_OK;
    Pin* pin = require_pin(world, object, vertex, found, result);
    if (pin == nullptr) {
        return result;
    }
    if (!within(target, world_position_limit)) {
        return world->fail(LKS_ERROR_INVALID_ARGUMENT,
                           out_of_range("pin's target", target, "m", world_position_limit));
    }
    bool clamped = false;
    pin->target = to_local(*found, to_vec3(target), clamped);
    world->counters.target_clamps += clamped ? 1u : 0u;
    return LKS_OK;
}

uint32_t lks_object_pin_count(const lks_world* world, lks_object_id object) {
    const Object* found = world == nullptr ? nullptr : world->find_object(object);
    return found == nullptr ? 0 : static_cast<uint32_t>(found->pins().size());
}

uint32_t lks_object_is_pinned(const lks_world* world, lks_object_id object, uint32_t vertex) {
    const Object* found = world == nullptr ? nullptr : world->find_object(object);
    if (found == nullptr || vertex >= found->count()) {
        return 0;
    }
    return found->find_pin(found->asset().vertex_to_particle[vertex]) != nullptr ? 1u : 0u;
}

} // extern "C"
