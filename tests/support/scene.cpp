#include "support/scene.h"

#include <doctest/doctest.h>

namespace support {
namespace {

constexpr std::uint32_t net_side = 12;

Asset build_net(const lks_allocator& allocator) {
    Net net;
    net.side = net_side;
    net.width = 1.1;
    net.particle_mass = 0.002;
    net.shear = soft(1e-6, 10);
    net.bend = soft(1e-4);
    net.radius = 0.01;
    return net.build(allocator);
}

Asset build_mesh(const lks_allocator& allocator) {
    const Mesh mesh = wavy_mesh(9, 0.75);
    lks_cloth_def def = mesh.def();
    def.area_density = 0.3;
    def.particle_radius = 0.015;
    def.friction = 0.8;
    def.allocator = allocator;
    return Asset(def);
}

Asset build_rope(const lks_allocator& allocator) {
    lks_rope_def def = lks_default_rope_def();
    def.length = 1.5;
    def.segments = 24;
    def.particle_radius = 0.02;
    def.allocator = allocator;
    return Asset(def);
}

} // namespace

SceneAssets::SceneAssets(const lks_allocator& allocator)
    : net(build_net(allocator)), mesh(build_mesh(allocator)), rope(build_rope(allocator)) {}

Scene::Scene(const SceneAssets& assets, const lks_vec3& offset, const lks_world_def& def, Order order)
    : world(def), offset_(offset) {
    lks_collider_def shape = lks_default_collider_def();
    shape.shape = LKS_SHAPE_PLANE;
    shape.transform = at(place(0, 0, 0));
    ground = world.add(shape);

    shape = lks_default_collider_def();
    shape.radius = fixed(0.3);
    shape.transform = at(place(0.1, 0.5, 0.2));
    ball = world.add(shape);

    shape = lks_default_collider_def();
    shape.shape = LKS_SHAPE_CAPSULE;
    shape.radius = fixed(0.1);
    shape.half_length = fixed(0.4);
    shape.transform = turned(at(place(2, 0.8, 0)), 1, 0, 0, 90);
    bar = world.add(shape);

    shape = lks_default_collider_def();
    shape.shape = LKS_SHAPE_BOX;
    shape.half_extents = fixed(0.2, 0.15, 0.25);
    shape.transform = at(place(-0.6, 0.6, 0.3));
    crate = world.add(shape);

    if (order == Order::usual) {
        add_net(assets);
        add_mesh(assets);
        add_rope(assets);
    } else {
        add_rope(assets);
        add_mesh(assets);
        add_net(assets);
    }
}

void Scene::add_net(const SceneAssets& assets) {
    net = world.add(assets.net, at(place(0, 1.4, 0.1)));
    world.pin(net, 0);
    world.pin(net, net_side - 1);
}

void Scene::add_mesh(const SceneAssets& assets) {
    lks_object_def def = object_def(assets.mesh, turned(at(place(0.1, 1.0, 0.2)), 1, 0, 0, -80));
    def.velocity = fixed(0.1, -0.5, 0.2);
    def.linear_damping = fixed(0.2);
    mesh = world.add(def);
}

void Scene::add_rope(const SceneAssets& assets) {
    lks_object_def def = object_def(assets.rope, at(place(1.3, 1.0, 0)));
    def.record_forces = 1;
    def.gravity_factor = fixed(0.9);
    rope = world.add(def);
}

void Scene::give_inputs(std::uint64_t tick) {
    lks_fixed sine = 0;
    lks_fixed cosine = 0;
    REQUIRE(lks_sin_cos(LKS_FIXED(static_cast<int64_t>(tick * 6 % 360)), &sine, &cosine) == LKS_OK);

    // A corner of the net swings, the crate goes round and turns.
    world.set_target(net, 0, place(-0.55, 1.95, 0.1) + lks_vec3{sine / 8, cosine / 16, sine / 4});
    lks_transform pose = at(place(-0.6, 0.6, 0.3) + lks_vec3{sine / 4, 0, cosine / 4});
    REQUIRE(lks_rotation_from_axis_angle_fixed(lks_vec3{LKS_FIXED(1), LKS_FIXED(2), 0},
                                               LKS_FIXED(static_cast<int64_t>(tick * 4 % 360)),
                                               &pose.rotation) == LKS_OK);
    REQUIRE(lks_collider_move_to(world, crate, pose) == LKS_OK);

    if (tick % 7 == 3) {
        REQUIRE(lks_object_apply_impulse(world, rope, static_cast<uint32_t>(tick % 25),
                                         fixed(0.01, 0.02, -0.01)) == LKS_OK);
    }
    if (tick % 31 == 30) {
        REQUIRE(lks_object_add_velocity(world, mesh, fixed(0, 0.6, 0.1)) == LKS_OK);
    }
}

void Scene::tick(std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
        give_inputs(world.tick());
        world.step();
    }
}

} // namespace support
