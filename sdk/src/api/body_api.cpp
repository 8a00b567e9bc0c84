// lockstitch/body.h.
#include <lockstitch/body.h>

#include <algorithm>

#include "api/body_checks.h"
#include "collide/filter.h"
#include "collide/saturation.h"
#include "rigid/body_motion.h"
#include "rigid/contact_memory.h"
#include "rigid/contact_search.h"
#include "rigid/coupling.h"
#include "rigid/make_body.h"
#include "rigid/sleep.h"

using namespace lks;

namespace {

bool reserve_body(lks_world& world, std::uint32_t index) {
    if (index < world.rigid.body_room()) {
        return true;
    }
    return world.rigid.reserve(grown_room(world.rigid.bodies.size()), world.colliders.capacity());
}

void forget_joints(RigidScene& scene, std::uint32_t body) {
    wake_jointed(scene, body);
    for (std::uint32_t i = 0; i < scene.joints.size(); ++i) {
        const JointDescription& joint = scene.joints[i].description;
        if (scene.joint_slots[i].used && (joint.body_a == body || joint.body_b == body)) {
            scene.free_joint(i);
        }
    }
    scene.joints_changed();
}

// What it pushes, and is pushed by, is another now.
void change_kind(lks_world& world, std::uint32_t index, std::uint32_t kind) {
    RigidScene& scene = world.rigid;
    Body& body = scene.bodies[index];
    wake_neighbours(scene, index);
    wake_jointed(scene, index);
    forget_contacts(scene, index);
    scene.definitions[index].kind = kind;
    scene.descriptions[index].kind = kind;
    apply_description(body, scene.descriptions[index]);
    wake(body);
    body.target_position = body.position;
    body.target_orientation = body.orientation;
    body.rest_position = body.position;
    body.rest_orientation = body.orientation;
    if (kind == LKS_BODY_KINEMATIC) {
        body.velocity = {0, 0, 0};
        body.angular_velocity = {0, 0, 0};
    }
    clamp_vector(body.velocity, body_speed_limit(world.rate));
    clamp_vector(body.angular_velocity, body_spin_limit(world.rate));
    for (std::size_t i = 0; i < scene.joints.size(); ++i) {
        Joint& joint = scene.joints[i];
        const JointDescription& d = joint.description;
        if (scene.joint_slots[i].used && (d.body_a == index || d.body_b == index)) {
            joint.constants =
                make_joint_constants(d, scene.bodies[d.body_a], scene.bodies[d.body_b], world.rate);
            forget_pushes(joint);
        }
    }
    follow_masses(world);
}

lks_transform transform_of(const Body& body, const BodyDescription& description) {
    const fixed::Rotation q = narrow(body.orientation);
    lks_transform transform{};
    transform.position = from_vec3(frame_position(body, description));
    transform.rotation = {q.x, q.y, q.z, q.w};
    return transform;
}

} // namespace

extern "C" {

lks_body_def lks_default_body_def(void) {
    lks_body_def def{};
    def.struct_size = sizeof(lks_body_def);
    def.kind = LKS_BODY_DYNAMIC;
    def.transform.rotation.w = LKS_ROTATION_ONE;
    def.gravity_factor = LKS_FIXED_ONE;
    def.static_friction = LKS_FIXED_RATIO(1, 2);
    def.dynamic_friction = LKS_FIXED_RATIO(4, 10);
    def.filter = default_filter;
    return def;
}

lks_body_shape lks_default_body_shape(void) {
    lks_body_shape shape{};
    shape.shape = LKS_SHAPE_SPHERE;
    shape.transform.rotation.w = LKS_ROTATION_ONE;
    shape.radius = LKS_FIXED_RATIO(1, 2);
    shape.half_length = LKS_FIXED_RATIO(1, 2);
    shape.half_extents = {LKS_FIXED_RATIO(1, 2), LKS_FIXED_RATIO(1, 2), LKS_FIXED_RATIO(1, 2)};
    shape.density = LKS_FIXED(1000);
    return shape;
}

lks_result lks_world_add_body(lks_world* world, const lks_body_def* def, lks_body_id* body) {
    if (const lks_result result = check_addition(world, "body", def, body); result != LKS_OK) {
        return result;
    }
    if (const lks_result result = check_body_def(*world, *def); result != LKS_OK) {
        return result;
    }
    const BodyDefinition definition = plain_definition(*def);
    const BodyDescription description = describe_body(definition);
    if (const lks_result result = check_body_place(*world, description, def->transform); result != LKS_OK) {
        return result;
    }
    RigidScene& scene = world->rigid;
    const std::uint32_t index = first_free(scene.body_slots);
    if (index >= LKS_MAX_BODIES) {
        return world->fail(LKS_ERROR_LIMIT, Sentence()
                                                << "A world holds at most " << LKS_MAX_BODIES << " bodies.");
    }
    if (!reserve_body(*world, index)) {
        return world->fail_out_of_memory("a body");
    }
    if (index == scene.body_slots.size()) {
        scene.body_slots.push_reserved(Slot{1, false});
        scene.bodies.push_reserved(Body{});
        scene.definitions.push_reserved(BodyDefinition{});
        scene.descriptions.push_reserved(BodyDescription{});
    }
    scene.definitions[index] = definition;
    scene.descriptions[index] = description;
    scene.bodies[index] = make_body(description, *def);
    scene.body_slots[index].used = true;
    wake_touched(*world, index);
    *body = {index, scene.body_slots[index].generation};
    return LKS_OK;
}

lks_result lks_world_remove_body(lks_world* world, lks_body_id body) {
    if (const lks_result result = require_body(world, body); result != LKS_OK) {
        return result;
    }
    RigidScene& scene = world->rigid;
    wake_neighbours(scene, body.index);
    drop_contacts(scene, body.index);
    forget_joints(scene, body.index);
    forget_attachments(scene, body.index, false);
    scene.bodies[body.index] = Body{};
    scene.definitions[body.index] = BodyDefinition{};
    scene.descriptions[body.index] = BodyDescription{};
    free_slot(scene.body_slots[body.index]);
    return LKS_OK;
}

uint32_t lks_world_has_body(const lks_world* world, lks_body_id body) {
    return world != nullptr && world->has_body(body) ? 1u : 0u;
}

uint32_t lks_world_body_count(const lks_world* world) {
    return world == nullptr ? 0 : count_used(world->rigid.body_slots);
}

lks_fixed lks_world_spin_limit(const lks_world* world) {
    return world == nullptr ? 0 : body_spin_limit(world->rate);
}

lks_result lks_body_transform(const lks_world* world, lks_body_id body, lks_transform* transform) {
    if (const lks_result result = require_body(world, body); result != LKS_OK) {
        return result;
    }
    if (transform == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_body_transform", "transform"));
    }
    *transform = transform_of(world->rigid.bodies[body.index], world->rigid.descriptions[body.index]);
    return LKS_OK;
}

lks_result lks_body_set_transform(lks_world* world, lks_body_id body, lks_transform transform) {
    if (const lks_result result = require_body(world, body); result != LKS_OK) {
        return result;
    }
    RigidScene& scene = world->rigid;
    if (const lks_result result = check_body_place(*world, scene.descriptions[body.index], transform);
        result != LKS_OK) {
        return result;
    }
    wake_neighbours(scene, body.index);
    wake_jointed(scene, body.index);
    wake(scene.bodies[body.index]);
    forget_contacts(scene, body.index);
    place_body(scene.bodies[body.index], scene.descriptions[body.index], to_vec3(transform.position),
               fixed::normalise(to_rotation(transform.rotation)));
    wake_touched(*world, body.index);
    return LKS_OK;
}

lks_result lks_body_velocity(const lks_world* world, lks_body_id body, lks_vec3* velocity,
                             lks_vec3* angular_velocity) {
    if (const lks_result result = require_body(world, body); result != LKS_OK) {
        return result;
    }
    const Body& found = world->rigid.bodies[body.index];
    if (velocity != nullptr) {
        *velocity = from_vec3(found.velocity);
    }
    if (angular_velocity != nullptr) {
        *angular_velocity = from_vec3(found.angular_velocity);
    }
    return LKS_OK;
}

lks_result lks_body_set_velocity(lks_world* world, lks_body_id body, lks_vec3 velocity,
                                 lks_vec3 angular_velocity) {
    if (const lks_result result = require_body(world, body); result != LKS_OK) {
        return result;
    }
    if (const lks_result result = check_body_velocities(*world, velocity, angular_velocity);
        result != LKS_OK) {
        return result;
    }
    Body& found = world->rigid.bodies[body.index];
    if (!found.is_dynamic()) {
        return world->fail(LKS_ERROR_UNSUPPORTED, Sentence()
                                                      << "The body with index " << body.index
                                                      << " is kinematic: it moves by lks_body_move_to only.");
    }
    wake(found);
    found.velocity = to_vec3(velocity);
    found.angular_velocity = to_vec3(angular_velocity);
    return LKS_OK;
}

lks_result lks_body_apply_impulse(lks_world* world, lks_body_id body, lks_vec3 impulse, lks_vec3 point) {
    if (const lks_result result = require_body(world, body); result != LKS_OK) {
        return result;
    }
    Body& found = world->rigid.bodies[body.index];
    const fixed::Vec3 lever = saturating_subtract(to_vec3(point), found.position);
    if (!within(lever, LKS_FIXED(64))) {
        return world->fail(LKS_ERROR_INVALID_ARGUMENT, out_of_range("impulse's distance from the body",
                                                                    from_vec3(lever), "m", LKS_FIXED(64)));
    }
    if (!within(impulse, LKS_FIXED(8388607))) {
        return world->fail(LKS_ERROR_INVALID_ARGUMENT,
                           out_of_range("impulse", impulse, "N·s", LKS_FIXED(8388607)));
    }
    wake(found);
    apply_impulse(found, to_vec3(impulse), lever);
    world->counters.speed_clamps += clamp_vector(found.velocity, body_speed_limit(world->rate)) ? 1u : 0u;
    world->counters.speed_clamps +=
        clamp_vector(found.angular_velocity, body_spin_limit(world->rate)) ? 1u : 0u;
    return LKS_OK;
}

lks_result lks_body_apply_angular_impulse(lks_world* world, lks_body_id body, lks_vec3 impulse) {
    if (const lks_result result = require_body(world, body); result != LKS_OK) {
        return result;
    }
    if (!within(impulse, LKS_FIXED(8388607))) {
        return world->fail(LKS_ERROR_INVALID_ARGUMENT,
                           out_of_range("angular impulse", impulse, "N·m·s", LKS_FIXED(8388607)));
    }
    Body& found = world->rigid.bodies[body.index];
    wake(found);
    apply_angular_impulse(found, to_vec3(impulse));
    world->counters.speed_clamps +=
        clamp_vector(found.angular_velocity, body_spin_limit(world->rate)) ? 1u : 0u;
    return LKS_OK;
}

lks_result lks_body_move_to(lks_world* world, lks_body_id body, lks_transform target) {
    if (const lks_result result = require_body(world, body); result != LKS_OK) {
        return result;
    }
    if (const lks_result result = check_body_place(*world, world->rigid.descriptions[body.index], target);
        result != LKS_OK) {
        return result;
    }
    Body& found = world->rigid.bodies[body.index];
    if (found.is_dynamic()) {
        return world->fail(LKS_ERROR_UNSUPPORTED, Sentence()
                                                      << "The body with index " << body.index
                                                      << " is dynamic: only kinematic bodies are moved.");
    }
    const BodyDescription& description = world->rigid.descriptions[body.index];
    Body there = found;
    place_body(there, description, to_vec3(target.position), fixed::normalise(to_rotation(target.rotation)));
    if (const lks_result result = check_body_motion(*world, found, there.position, narrow(there.orientation));
        result != LKS_OK) {
        return result;
    }
    found.target_position = there.position;
    found.target_orientation = there.orientation;
    return LKS_OK;
}

lks_result lks_body_set_kind(lks_world* world, lks_body_id body, uint32_t kind) {
    if (const lks_result result = require_body(world, body); result != LKS_OK) {
        return result;
    }
    if (const lks_result result = check_body_kind(*world, kind); result != LKS_OK) {
        return result;
    }
    if (world->rigid.descriptions[body.index].kind != kind) {
        change_kind(*world, body.index, kind);
    }
    return LKS_OK;
}

uint32_t lks_body_get_kind(const lks_world* world, lks_body_id body) {
    return world != nullptr && world->has_body(body) ? world->rigid.descriptions[body.index].kind
                                                     : static_cast<std::uint32_t>(LKS_BODY_DYNAMIC);
}

uint32_t lks_body_is_awake(const lks_world* world, lks_body_id body) {
    return world != nullptr && world->has_body(body) && world->rigid.bodies[body.index].is_awake() ? 1u : 0u;
}

lks_result lks_body_wake(lks_world* world, lks_body_id body) {
    const lks_result result = require_body(world, body);
    if (result == LKS_OK) {
        wake(world->rigid.bodies[body.index]);
    }
    return result;
}

uint32_t lks_world_awake_body_count(const lks_world* world) {
    std::uint32_t count = 0;
    if (world != nullptr) {
        for (const Body& body : world->rigid.bodies) {
            count += body.is_awake() ? 1u : 0u;
        }
    }
    return count;
}

uint32_t lks_world_contact_count(const lks_world* world) {
    return world == nullptr ? 0 : static_cast<std::uint32_t>(world->rigid.memories.size());
}

lks_result lks_body_mass(const lks_world* world, lks_body_id body, lks_fixed* mass) {
    if (const lks_result result = require_body(world, body); result != LKS_OK) {
        return result;
    }
    if (mass == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_body_mass", "mass"));
    }
    const BodyDescription& description = world->rigid.descriptions[body.index];
    *mass = description.kind == LKS_BODY_KINEMATIC
                ? 0
                : description.properties.mass.to_i64_fixed(world_fraction_bits);
    return LKS_OK;
}

lks_result lks_body_centre_of_mass(const lks_world* world, lks_body_id body, lks_vec3* centre) {
    if (const lks_result result = require_body(world, body); result != LKS_OK) {
        return result;
    }
    if (centre == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_body_centre_of_mass", "centre"));
    }
    *centre = from_vec3(world->rigid.descriptions[body.index].centre);
    return LKS_OK;
}

lks_result lks_world_kinetic_energy(const lks_world* world, lks_fixed* energy) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (energy == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_world_kinetic_energy", "energy"));
    }
    fixed::Scaled sum;
    const RigidScene& scene = world->rigid;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.body_slots[i].used && scene.bodies[i].is_dynamic()) {
            sum = sum + kinetic_energy(scene.bodies[i], scene.descriptions[i]);
        }
    }
    *energy = std::min(sum.to_i64_fixed(world_fraction_bits), LKS_FIXED(8388607));
    return LKS_OK;
}

} // extern "C"
