#include "rigid/make_body.h"

#include <algorithm>

#include "collide/saturation.h"
#include "fixed/formats.h"
#include "fixed/world_times.h"
#include "rigid/body_motion.h"

namespace lks {
namespace {

using fixed::Scaled;
using fixed::Vec3;

Vec3 vector(const lks_vec3& v) {
    return {v.x, v.y, v.z};
}

fixed::Rotation rotation(const lks_rotation& q) {
    return fixed::normalise(fixed::Rotation{q.x, q.y, q.z, q.w});
}

lks_body_shape plain_shape(const lks_body_shape& from) {
    lks_body_shape shape{};
    shape.shape = from.shape;
    shape.transform.position = from.transform.position;
    const lks_rotation& given = from.transform.rotation;
    const fixed::Rotation q = fixed::settle({given.x, given.y, given.z, given.w});
    shape.transform.rotation = {q.x, q.y, q.z, q.w};
    if (from.shape != LKS_SHAPE_BOX) {
        shape.radius = from.radius;
    } else {
        shape.half_extents = from.half_extents;
    }
    if (from.shape == LKS_SHAPE_CAPSULE) {
        shape.half_length = from.half_length;
    }
    shape.density = from.density;
    return shape;
}

BodyShape make_shape(const lks_body_shape& from) {
    const lks_rotation& q = from.transform.rotation;
    BodyShape shape{};
    shape.kind = from.shape;
    shape.radius = from.radius;
    shape.half_length = from.half_length;
    shape.half_extents = vector(from.half_extents);
    shape.position = vector(from.transform.position);
    shape.rotation = {q.x, q.y, q.z, q.w};
    shape.density = from.density;
    return shape;
}

// a·b − c·d, World.
std::int64_t minor(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
    return fixed::saturate_to_int64(fixed::shift_right_rounded(
        fixed::multiply_signed(a, b) - fixed::multiply_signed(c, d), world_fraction_bits));
}

InverseMass made_inverse_mass(const BodyDescription& description) {
    return to_inverse_mass(Scaled::from_u64(1) / description.properties.mass);
}

} // namespace

BodySettings plain_settings(const lks_body_def& def) {
    return {def.mass,
            def.gravity_factor,
            def.linear_damping,
            def.angular_damping,
            def.static_friction,
            def.dynamic_friction,
            def.restitution,
            def.filter,
            def.never_sleeps};
}

BodyDefinition plain_definition(const lks_body_def& def) {
    BodyDefinition out{};
    out.kind = def.kind;
    out.shape_count = def.shape_count;
    out.settings = plain_settings(def);
    for (std::uint32_t i = 0; i < def.shape_count; ++i) {
        out.shapes[i] = plain_shape(def.shapes[i]);
    }
    return out;
}

lks_body_def define_body(const BodyDefinition& definition) {
    const BodySettings& settings = definition.settings;
    lks_body_def def{};
    def.struct_size = sizeof(lks_body_def);
    def.kind = definition.kind;
    def.transform.rotation.w = LKS_ROTATION_ONE;
    def.shapes = definition.shapes;
    def.shape_count = definition.shape_count;
    def.mass = settings.mass;
    def.gravity_factor = settings.gravity_factor;
    def.linear_damping = settings.linear_damping;
    def.angular_damping = settings.angular_damping;
    def.static_friction = settings.static_friction;
    def.dynamic_friction = settings.dynamic_friction;
    def.restitution = settings.restitution;
    def.filter = settings.filter;
    def.never_sleeps = settings.never_sleeps;
    return def;
}

BodyDescription describe_body(const BodyDefinition& definition) {
    const BodySettings& settings = definition.settings;
    BodyDescription out{};
    out.kind = definition.kind;
    out.shape_count = definition.shape_count;
    for (std::uint32_t i = 0; i < out.shape_count; ++i) {
        out.shapes[i] = make_shape(definition.shapes[i]);
    }
    out.properties = mass_properties(out.shapes, out.shape_count);
    if (settings.mass != 0) {
        out.properties.mass = world_value(settings.mass);
    }
    out.centre = out.properties.centre;
    for (std::uint32_t i = 0; i < out.shape_count; ++i) {
        BodyShape& shape = out.shapes[i];
        shape.position = shape.position - out.centre;
        const auto distance = static_cast<std::int64_t>(fixed::length(shape.position));
        out.radius = std::max(out.radius, distance + bounding_radius(shape));
        out.thickness = i == 0 ? thickness(shape) : std::min(out.thickness, thickness(shape));
    }
    take_settings(out, settings);
    return out;
}

void take_settings(BodyDescription& description, const BodySettings& settings) {
    description.surface = {settings.static_friction, settings.dynamic_friction, settings.restitution};
    description.filter = settings.filter;
    description.gravity_factor = settings.gravity_factor;
    description.linear_damping = settings.linear_damping;
    description.angular_damping = settings.angular_damping;
    description.never_sleeps = settings.never_sleeps;
}

void apply_description(Body& body, const BodyDescription& description) {
    body.inverse_mass =
        description.kind == LKS_BODY_KINEMATIC ? InverseMass{0, 0} : made_inverse_mass(description);
    body.scale = description.properties.scale;
    body.inverse_shift = description.properties.inverse_shift;
    body.inverse_inertia = description.properties.inverse_inertia;
}

void place_body(Body& body, const BodyDescription& description, const Vec3& position,
                const fixed::Rotation& rotation) {
    body.orientation = widen(rotation);
    body.follow_orientation();
    body.position = saturating_add(position, fixed::rotate(body.rotation, description.centre));
    body.target_position = body.position;
    body.target_orientation = body.orientation;
    body.rest_position = body.position;
    body.rest_orientation = body.orientation;
    body.previous_position = body.position;
    body.previous_rotation = narrow(body.orientation);
}

Vec3 frame_position(const Body& body, const BodyDescription& description) {
    return saturating_subtract(body.position,
                               fixed::rotate(fixed::to_matrix(narrow(body.orientation)), description.centre));
}

Body make_body(const BodyDescription& description, const lks_body_def& def) {
    Body body{};
    apply_description(body, description);
    place_body(body, description, vector(def.transform.position), rotation(def.transform.rotation));
    if (body.is_dynamic()) {
        body.velocity = vector(def.velocity);
        body.angular_velocity = vector(def.angular_velocity);
    }
    return body;
}

InverseMass to_inverse_mass(const Scaled& value) {
    if (value.is_zero()) {
        return {0, 0};
    }
    // The upper half of the mantissa.
    return {static_cast<std::uint32_t>(value.mantissa >> 32), value.exponent + 32};
}

Scaled to_scaled(const InverseMass& w) {
    return Scaled::from_u64(w.mantissa).times_power_of_two(w.exponent);
}

Scaled inverse_mass(const Body& body) {
    return to_scaled(body.inverse_mass);
}

Scaled dynamic_inverse_mass(const BodyDescription& description) {
    return to_scaled(made_inverse_mass(description));
}

Scaled greater_inverse_mass(const PairShares& shares, const Body& a, const Body& b) {
    return inverse_mass(shares.a == direction_one ? a : b);
}

void apply_impulse(Body& body, const Vec3& impulse, const Vec3& lever) {
    if (!body.is_dynamic()) {
        return;
    }
    const Scaled w = inverse_mass(body);
    body.velocity =
        saturating_add(body.velocity, {times(impulse.x, w), times(impulse.y, w), times(impulse.z, w)});
    apply_angular_impulse(body, {minor(lever.y, impulse.z, lever.z, impulse.y),
                                 minor(lever.z, impulse.x, lever.x, impulse.z),
                                 minor(lever.x, impulse.y, lever.y, impulse.x)});
}

void apply_angular_impulse(Body& body, const Vec3& momentum) {
    if (!body.is_dynamic()) {
        return;
    }
    const Scaled w = inverse_mass(body);
    constexpr std::int64_t limit = (std::int64_t{1} << 62) - 1;
    const Vec3 bounded{std::clamp(momentum.x, -limit, limit), std::clamp(momentum.y, -limit, limit),
                       std::clamp(momentum.z, -limit, limit)};
    const Vec3 turn = multiply(rotated(body.inverse_inertia, body.rotation), bounded);
    const Scaled factor = w.times_power_of_two(body.inverse_shift - 2 * body.scale);
    body.angular_velocity = saturating_add(
        body.angular_velocity, {times(turn.x, factor), times(turn.y, factor), times(turn.z, factor)});
}

Scaled kinetic_energy(const Body& body, const BodyDescription& description) {
    const Scaled speed = Scaled::from_u128(fixed::length_squared(body.velocity), 2 * world_fraction_bits);
    const Vec3 spin = fixed::rotate_transposed(body.rotation, body.angular_velocity);
    const Vec3 momentum = multiply(description.properties.inertia, spin);
    const fixed::Int128 product = fixed::multiply_signed(spin.x, momentum.x) +
                                  fixed::multiply_signed(spin.y, momentum.y) +
                                  fixed::multiply_signed(spin.z, momentum.z);
    const Scaled turning = product.hi < 0 ? Scaled{}
                                          : Scaled::from_u128(fixed::abs(product), 2 * world_fraction_bits)
                                                .times_power_of_two(2 * description.properties.scale);
    return (speed + turning) * description.properties.mass * Scaled::ratio(1, 2);
}

} // namespace lks
