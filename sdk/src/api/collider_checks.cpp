#include "api/collider_checks.h"

#include "collide/shape.h"
#include "solver/wrapping.h"

namespace lks {
namespace {

constexpr lks_fixed greatest_friction = LKS_FIXED(100);
constexpr std::int64_t greatest_move = LKS_FIXED(100);

struct Size {
    const char* name;
    lks_fixed value;
    lks_fixed least;
};

bool in_range(const Size& size) {
    return size.value >= size.least && size.value <= greatest_shape_size;
}

lks_result check_size(const lks_world& world, const Size& size) {
    return in_range(size)
               ? LKS_OK
               : world.fail(LKS_ERROR_INVALID_ARGUMENT,
                            out_of_range(size.name, size.value, " m", size.least, greatest_shape_size));
}

// The angle between two unit quaternions is at most 90° where |q·p| ≥ cos 45°; a little room for rounding.
bool within_quarter_turn(const fixed::Rotation& a, const fixed::Rotation& b) {
    constexpr std::int64_t cosine = 759250125 - 64; // cos 45° in Q2.30
    const auto product = [](std::int32_t p, std::int32_t q) { return std::int64_t{p} * q; };
    const std::int64_t dot =
        (product(a.x, b.x) + product(a.y, b.y) + product(a.z, b.z) + product(a.w, b.w)) >>
        direction_fraction_bits;
    return dot >= cosine || dot <= -cosine;
}

bool is_near(const fixed::Vec3& a, const fixed::Vec3& b) {
    return within(saturating_subtract(a.x, b.x), greatest_move) &&
           within(saturating_subtract(a.y, b.y), greatest_move) &&
           within(saturating_subtract(a.z, b.z), greatest_move);
}

bool surface_is_valid(const ColliderState& collider) {
    return collider.static_friction >= 0 && collider.static_friction <= greatest_friction &&
           collider.dynamic_friction >= 0 && collider.dynamic_friction <= collider.static_friction &&
           collider.restitution >= 0 && collider.restitution <= LKS_FIXED_ONE;
}

bool is_coordinate_size(std::int64_t value, lks_fixed least) {
    constexpr std::int64_t scale = std::int64_t{1} << coordinate_from_world_shift;
    return value >= least * scale && value <= greatest_shape_size * scale && value % scale == 0;
}

bool shape_is_valid(const Shape& shape) {
    const fixed::Vec3& e = shape.half_extents;
    const bool no_extents = e.x == 0 && e.y == 0 && e.z == 0;
    switch (shape.kind) {
    case LKS_SHAPE_PLANE:
        return shape.radius == 0 && shape.half_length == 0 && no_extents;
    case LKS_SHAPE_SPHERE:
        return is_coordinate_size(shape.radius, least_shape_size) && shape.half_length == 0 && no_extents;
    case LKS_SHAPE_CAPSULE:
        return is_coordinate_size(shape.radius, least_shape_size) &&
               is_coordinate_size(shape.half_length, 0) && no_extents;
    case LKS_SHAPE_BOX:
        return shape.radius == 0 && shape.half_length == 0 && is_coordinate_size(e.x, least_shape_size) &&
               is_coordinate_size(e.y, least_shape_size) && is_coordinate_size(e.z, least_shape_size);
    default:
        return false;
    }
}

} // namespace

lks_result check_collider_def(const lks_world& world, const lks_collider_def& def) {
    lks_result result = LKS_OK;
    switch (def.shape) {
    case LKS_SHAPE_PLANE:
        break;
    case LKS_SHAPE_CAPSULE:
        result = check_size(world, {"capsule's half_length", def.half_length, 0});
        if (result != LKS_OK) {
            return result;
        }
        result = check_size(world, {"capsule's radius", def.radius, least_shape_size});
        break;
    case LKS_SHAPE_SPHERE:
        result = check_size(world, {"sphere's radius", def.radius, least_shape_size});
        break;
    case LKS_SHAPE_BOX:
        for (const Size& size : {Size{"box's half extent x", def.half_extents.x, least_shape_size},
                                 Size{"box's half extent y", def.half_extents.y, least_shape_size},
                                 Size{"box's half extent z", def.half_extents.z, least_shape_size}}) {
            result = result == LKS_OK ? check_size(world, size) : result;
        }
        break;
    default:
        return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                          Sentence() << "Shape " << def.shape << " does not exist: the shapes are 0 to 3.");
    }
    if (result != LKS_OK) {
        return result;
    }
    return check_numbers(world, {Number{"static friction", "", def.static_friction, 0, greatest_friction},
                                 Number{"dynamic friction", "", def.dynamic_friction, 0, def.static_friction},
                                 Number{"restitution", "", def.restitution, 0, LKS_FIXED_ONE}});
}

lks_result check_motion(const lks_world& world, const ColliderState& collider, const fixed::Vec3& position,
                        const fixed::Rotation& rotation) {
    if (!is_near(collider.position, position)) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                          out_of_range("motion in one tick",
                                       {saturating_subtract(position.x, collider.position.x),
                                        saturating_subtract(position.y, collider.position.y),
                                        saturating_subtract(position.z, collider.position.z)},
                                       "m", greatest_move));
    }
    if (!within_quarter_turn(collider.rotation, rotation)) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                          Sentence() << "The rotation (" << rotation.x << ", " << rotation.y << ", "
                                     << rotation.z << ", " << rotation.w
                                     << ") / 2^30 turns it by more than 90 degrees in one tick.");
    }
    return LKS_OK;
}

bool collider_is_valid(const ColliderState& collider) {
    return shape_is_valid(collider.shape) && surface_is_valid(collider) &&
           within(collider.position, world_position_limit) &&
           within(collider.target_position, world_position_limit) &&
           is_near(collider.position, collider.target_position) && fixed::is_nearly_unit(collider.rotation) &&
           fixed::is_nearly_unit(collider.target_rotation) &&
           within_quarter_turn(collider.rotation, collider.target_rotation);
}

void place_collider(ColliderState& collider, const fixed::Vec3& position, const fixed::Rotation& rotation) {
    collider.position = position;
    collider.target_position = position;
    collider.previous_position = position;
    collider.rotation = rotation;
    collider.target_rotation = rotation;
    collider.previous_rotation = rotation;
}

} // namespace lks
