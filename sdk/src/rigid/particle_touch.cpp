#include "rigid/particle_touch.h"

#include <algorithm>

#include "collide/filter.h"
#include "collide/saturation.h"
#include "rigid/attachment.h"
#include "rigid/placed_shape.h"
#include "rigid/sleep.h"

namespace lks {
namespace {

using fixed::Vec3;

// Between the surfaces: half a centimetre.
constexpr std::int64_t touching_reach = world_one / 200;

std::int64_t distance_between(const Vec3& point, const Body& body, const BodyShape& shape) {
    const PlacedShape placed = place_shape(body, shape);
    return distance_only(placed.shape,
                         fixed::rotate_transposed(placed.axes, saturating_subtract(point, placed.centre)), 0);
}

// Whether a point is no further than this from the body.
bool is_near(const Vec3& point, std::int64_t distance, const Body& body, const BodyDescription& description) {
    const Vec3 between = saturating_subtract(point, body.position);
    const std::int64_t reach = description.radius + distance;
    const auto far = [reach](std::int64_t along) { return along > reach || along < -reach; };
    if (far(between.x) || far(between.y) || far(between.z)) {
        return false;
    }
    return std::any_of(
        description.shapes, description.shapes + description.shape_count,
        [&](const BodyShape& shape) { return distance_between(point, body, shape) <= distance; });
}

bool touches(const Object& object, const Body& body, const BodyDescription& description) {
    const std::int64_t distance = world_from_coordinate(object.asset().particle_radius) + touching_reach;
    for (std::uint32_t i = 0; i < object.count(); ++i) {
        if (is_near(particle_position(object, i), distance, body, description)) {
            return true;
        }
    }
    return false;
}

bool touch(const lks_world& world, std::uint64_t pair) {
    const auto body = static_cast<std::uint32_t>(pair);
    const auto object = static_cast<std::uint32_t>(pair >> 32);
    return touches(*world.objects[object].object, world.rigid.bodies[body], world.rigid.descriptions[body]);
}

} // namespace

void wake_who_touches(lks_world& world, const Object& object) {
    RigidScene& scene = world.rigid;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const BodyDescription& description = scene.descriptions[i];
        if (scene.bodies[i].asleep != 0 && meets_particles(description.filter) &&
            touches(object, scene.bodies[i], description)) {
            wake(scene.bodies[i]);
        }
    }
}

void note_particle_touches(lks_world& world) {
    RigidScene& scene = world.rigid;
    scene.object_touches.clear();
    for (const std::uint64_t pair : scene.object_pairs) {
        const bool asleep = scene.bodies[static_cast<std::uint32_t>(pair)].asleep != 0;
        scene.object_touches.push_reserved(asleep && touch(world, pair) ? 1 : 0);
    }
}

void wake_who_was_left(lks_world& world) {
    RigidScene& scene = world.rigid;
    for (std::size_t i = 0; i < scene.object_touches.size(); ++i) {
        const std::uint64_t pair = scene.object_pairs[i];
        if (scene.object_touches[i] != 0 && !touch(world, pair)) {
            wake(scene.bodies[static_cast<std::uint32_t>(pair)]);
        }
    }
}

} // namespace lks
