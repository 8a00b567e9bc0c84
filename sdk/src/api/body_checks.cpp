#include "api/body_checks.h"

#include "api/collider_checks.h"
#include "collide/shape.h"
#include "rigid/body_motion.h"
#include "rigid/make_body.h"

namespace lks {
namespace {

// Of a shape: kg/m³.
constexpr lks_fixed least_density = LKS_FIXED_RATIO(1, 1000);
constexpr lks_fixed greatest_density = LKS_FIXED(100000);

lks_result check_shape(const lks_world& world, const lks_body_shape& shape) {
    lks_result result = LKS_OK;
    switch (shape.shape) {
    case LKS_SHAPE_SPHERE:
        result = check_numbers(
            world, {Number{"sphere's radius", " m", shape.radius, least_shape_size, greatest_shape_size}});
        break;
    case LKS_SHAPE_CAPSULE:
        result = check_numbers(
            world, {Number{"capsule's radius", " m", shape.radius, least_shape_size, greatest_shape_size},
                    Number{"capsule's half_length", " m", shape.half_length, 0, greatest_shape_size}});
        break;
    case LKS_SHAPE_BOX:
        result = check_numbers(
            world,
            {Number{"box's half extent x", " m", shape.half_extents.x, least_shape_size, greatest_shape_size},
             Number{"box's half extent y", " m", shape.half_extents.y, least_shape_size, greatest_shape_size},
             Number{"box's half extent z", " m", shape.half_extents.z, least_shape_size,
                    greatest_shape_size}});
        break;
    default:
        return world.fail(
            LKS_ERROR_INVALID_ARGUMENT,
            Sentence() << "Shape " << shape.shape
                       << " is none of a body's: they are 1 (sphere), 2 (capsule) and 3 (box).");
    }
    if (result != LKS_OK) {
        return result;
    }
    if (shape.reserved != 0) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "The shape's reserved field is "
                                                                 << shape.reserved << "; it must be 0.");
    }
    if (!within(shape.transform.position, greatest_shape_size)) {
        return world.fail(
            LKS_ERROR_INVALID_ARGUMENT,
            out_of_range("shape's position", shape.transform.position, "m", greatest_shape_size));
    }
    result = check_rotation(world, shape.transform.rotation);
    return result != LKS_OK ? result
                            : check_numbers(world, {Number{"shape's density", " kg/m³", shape.density,
                                                           least_density, greatest_density}});
}

lks_result check_shapes(const lks_world& world, const lks_body_def& def) {
    if (def.shape_count < 1 || def.shape_count > LKS_MAX_BODY_SHAPES) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "The body has " << def.shape_count
                                                                 << " shapes; it must have from 1 to "
                                                                 << LKS_MAX_BODY_SHAPES << ".");
    }
    if (def.shapes == nullptr) {
        return world.fail(LKS_ERROR_NULL_ARGUMENT, Sentence() << "The body's shapes are null.");
    }
    for (std::uint32_t i = 0; i < def.shape_count; ++i) {
        if (const lks_result result = check_shape(world, def.shapes[i]); result != LKS_OK) {
            return result;
        }
    }
    return LKS_OK;
}

} // namespace

lks_result check_body_frame(const lks_world& world, const lks_transform& transform) {
    if (!within(transform.position, world_position_limit)) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                          out_of_range("body's position", transform.position, "m", world_position_limit));
    }
    return check_rotation(world, transform.rotation);
}

lks_result check_body_place(const lks_world& world, const BodyDescription& description,
                            const lks_transform& transform) {
    if (const lks_result result = check_rotation(world, transform.rotation); result != LKS_OK) {
        return result;
    }
    Body there{};
    place_body(there, description, to_vec3(transform.position),
               fixed::normalise(to_rotation(transform.rotation)));
    const lks_vec3 centre = from_vec3(there.position);
    return within(centre, world_position_limit)
               ? LKS_OK
               : world.fail(LKS_ERROR_INVALID_ARGUMENT,
                            out_of_range("body's centre of mass", centre, "m", world_position_limit));
}

lks_result check_body_kind(const lks_world& world, std::uint32_t kind) {
    return kind <= LKS_BODY_KINEMATIC
               ? LKS_OK
               : world.fail(LKS_ERROR_INVALID_ARGUMENT,
                            Sentence() << "The body's kind is " << kind << "; it must be 0 or 1.");
}

lks_result check_body_def(const lks_world& world, const lks_body_def& def) {
    if (def.kind > LKS_BODY_KINEMATIC || def.never_sleeps > 1) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "The body's kind is " << def.kind
                                                                 << " and never_sleeps " << def.never_sleeps
                                                                 << "; both are 0 or 1.");
    }
    if (const lks_result result = check_shapes(world, def); result != LKS_OK) {
        return result;
    }
    if (const lks_result result = check_body_velocities(world, def.velocity, def.angular_velocity);
        result != LKS_OK) {
        return result;
    }
    // 40 fraction bits hold a milligram to a millionth, and less than that ever worse. Only what is given as
    // a number needs the bound: inertias are those of one kilogram, and densities may make lighter bodies.
    const lks_fixed least_mass = def.mass == 0 ? 0 : LKS_FIXED_RATIO(1, 1000000);
    return check_numbers(world,
                         {Number{"body's mass", " kg", def.mass, least_mass, LKS_FIXED(1000000)},
                          Number{"gravity factor", "", def.gravity_factor, -LKS_FIXED(100), LKS_FIXED(100)},
                          Number{"linear damping", " 1/s", def.linear_damping, 0, LKS_FIXED(1000)},
                          Number{"angular damping", " 1/s", def.angular_damping, 0, LKS_FIXED(1000)},
                          Number{"static friction", "", def.static_friction, 0, LKS_FIXED(100)},
                          Number{"dynamic friction", "", def.dynamic_friction, 0, def.static_friction},
                          Number{"restitution", "", def.restitution, 0, LKS_FIXED_ONE}});
}

lks_result check_body_velocities(const lks_world& world, const lks_vec3& velocity, const lks_vec3& spin) {
    if (const std::int64_t limit = body_speed_limit(world.rate); !within(velocity, limit)) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT, out_of_range("velocity", velocity, "m/s", limit));
    }
    if (const std::int64_t limit = body_spin_limit(world.rate); !within(spin, limit)) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT, out_of_range("angular velocity", spin, "rad/s", limit));
    }
    return LKS_OK;
}

lks_result check_body_motion(const lks_world& world, const Body& body, const fixed::Vec3& position,
                             const fixed::Rotation& rotation) {
    ColliderState like{};
    like.position = body.position;
    like.rotation = narrow(body.orientation);
    return check_motion(world, like, position, rotation);
}

lks_result require_body(const lks_world* world, lks_body_id id) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (world->has_body(id)) {
        return LKS_OK;
    }
    return world->fail(LKS_ERROR_STALE_ID, Sentence()
                                               << "There is no body with index " << id.index
                                               << " and generation " << id.generation << " in this world.");
}

} // namespace lks
