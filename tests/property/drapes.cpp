// Cloth that falls on a ragdoll comes to lie on it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

// How deep a point is in a bone's shape; less than zero: outside, by about as much.
double depth(const lks_body_shape& shape, const BodyState& bone, const Vector& point) {
    const lks_rotation back = conjugate(bone.rotation);
    const Vector p = rotate(back, point - bone.position);
    if (shape.shape == LKS_SHAPE_BOX) {
        const Vector half = metres(shape.half_extents);
        return std::min({half.x - std::abs(p.x), half.y - std::abs(p.y), half.z - std::abs(p.z)});
    }
    const double half = metres(shape.half_length);
    const Vector axis{0, std::clamp(p.y, -half, half), 0};
    return metres(shape.radius) - (p - axis).length();
}

} // namespace

TEST_CASE("a cloth that falls on a ragdoll comes to lie on it, in none of its bones, and none of it falls "
          "through") {
    World world(world_def(60, 8));
    add_ground(world);
    Humanoid human;
    // On its back, arms at its sides.
    human.def.transform.position = fixed(0, 0.15, -0.9);
    human.def.transform.rotation = about(1, 0, 0, 90);
    lks_body_id bodies[LKS_HUMANOID_BONES];
    REQUIRE(human.add(world, bodies) == LKS_OK);
    world.step(240);
    // 1.2 m wide, from above the chest; the ground goes on around it.
    Net net;
    net.side = 41;
    net.width = 1.2;
    net.particle_mass = 0.0003;
    net.radius = 0.008;
    net.bend = off;
    const Asset cloth = net.build();
    lks_transform place = lks_transform_identity();
    const Vector chest = state_of(world, bodies[LKS_HUMANOID_CHEST]).position;
    place.position = fixed(chest.x, 0.8, chest.z);
    place.rotation = about(1, 0, 0, 90);
    const lks_object_id sheet = world.add(cloth, place);
    double deepest = -1;
    double lowest = 1;
    for (int tick = 0; tick < 600; ++tick) {
        world.step();
        std::vector<BodyState> bones;
        for (const lks_body_id body : bodies) {
            bones.push_back(state_of(world, body));
        }
        for (const lks_vec3& at : world.positions(sheet)) {
            const Vector point = metres(at);
            lowest = std::min(lowest, point.y);
            for (std::size_t i = 0; i < bones.size(); ++i) {
                deepest = std::max(deepest, depth(human.shapes[i], bones[i], point));
            }
        }
    }
    double highest = 0;
    double fastest = 0;
    std::size_t on_it = 0;
    for (const lks_vec3& at : world.positions(sheet)) {
        highest = std::max(highest, metres(at).y);
        on_it += metres(at).y > 0.12 ? 1 : 0;
    }
    for (const lks_vec3& v : world.velocities(sheet)) {
        fastest = std::max(fastest, metres(v).length());
    }
    const double chest_top = state_of(world, bodies[LKS_HUMANOID_CHEST]).position.y + 0.1;
    INFO("deepest " << deepest << " m, lowest " << lowest << ", highest " << highest << " on a chest at "
                    << chest_top << ", fastest " << fastest << " m/s, on it " << on_it);
    CHECK(deepest < -5e-3); // of 8 mm around each particle
    CHECK(lowest > 0);
    CHECK(highest > chest_top);
    CHECK(highest < chest_top + 0.1);
    CHECK(on_it > 300);
    CHECK(fastest < 0.01);
}
