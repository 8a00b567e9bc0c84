// A free body that spins as fast as it may keeps its angular momentum and gains no energy, whatever its
// shape; no more does one that something stops.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/bodies.h"
#include "support/sanitised.h"

using namespace support;

namespace {

constexpr double g = 9.81;

const Vector boxes[] = {{0.5, 0.1, 0.3}, {0.05, 0.4, 0.05}, {0.4, 0.02, 0.4}, {0.13, 0.04, 0.05}};

// Of one kilogram.
Vector momentum_of(const BodyState& body, const Vector& extents) {
    const lks_rotation back = conjugate(body.rotation);
    const Vector own = rotate(back, body.spin);
    const Vector square{extents.x * extents.x, extents.y * extents.y, extents.z * extents.z};
    return rotate(body.rotation, Vector{own.x * (square.y + square.z), own.y * (square.z + square.x),
                                        own.z * (square.x + square.y)} *
                                     (1.0 / 3));
}

// Evenly over the directions, and nearly along the three axes.
Vector some_axis(int which) {
    if (which < 3) {
        return Vector{which == 0 ? 1.0 : 1e-3, which == 1 ? 1.0 : 1e-3, which == 2 ? 1.0 : 1e-3};
    }
    const double z = 0.8 - 0.4 * (which - 3), around = 2.4 * which, across = std::sqrt(1 - z * z);
    return {across * std::cos(around), across * std::sin(around), z};
}

struct Drift {
    double gained = -1, lost = 0, turned = 0;
    std::uint64_t clamps = 0;
};

void follow(Drift& drift, std::uint32_t substeps, const Vector& extents, const Vector& spin, int ticks) {
    World world(world_def(60, substeps));
    REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
    lks_body_def def = lks_default_body_def();
    def.never_sleeps = 1;
    def.angular_velocity = fixed(spin.x, spin.y, spin.z);
    const lks_body_id body = add_body(world, box_shape(extents.x, extents.y, extents.z, 10), {}, def);
    const double energy = energy_of(world);
    const Vector momentum = momentum_of(state_of(world, body), extents);
    for (int tick = 0; tick < ticks; tick += 20) {
        world.step(20);
        const double gained = energy_of(world) / energy - 1;
        const Vector off = momentum_of(state_of(world, body), extents) - momentum;
        drift.gained = std::max(drift.gained, gained);
        drift.lost = std::max(drift.lost, -gained);
        drift.turned = std::max(drift.turned, off.length() / momentum.length());
    }
    drift.clamps += world.counters().speed_clamps;
}

} // namespace

TEST_CASE("a free body that spins as fast as it may keeps its momentum and its energy") {
    const int ticks = long_runs() ? 36000 : sanitised ? 120 : 600;
    for (const std::uint32_t substeps : {1u, 8u, 20u}) {
        World world(world_def(60, substeps));
        const double limit = metres(lks_world_spin_limit(world));
        for (const double share : {0.6, 0.73, 0.92, 1.0}) {
            for (const Vector& extents : boxes) {
                Drift drift;
                for (int axis = 0; axis < 8; ++axis) {
                    const Vector direction = some_axis(axis);
                    follow(drift, substeps, extents, direction * (share * limit / 1.000001), ticks);
                }
                INFO(substeps << " substeps, half extents " << extents.x << " " << extents.y << " "
                              << extents.z << ", " << share * limit << " rad/s: energy " << drift.gained
                              << ", momentum " << drift.turned);
                CHECK(drift.gained <= 1e-6);
                CHECK(drift.lost <= (long_runs() ? 3e-4 : 1e-5));
                CHECK(drift.turned <= (long_runs() ? 1e-3 : 1e-5));
                CHECK(drift.clamps == 0);
            }
        }
    }
}

namespace {

// How much more energy it has at any time than it had, as a share, in two seconds on the ground or about a
// joint.
double gain_of_what_is_stopped(std::uint32_t substeps, const Vector& extents, int axis, bool hangs) {
    World world(world_def(60, substeps));
    add_ground(world);
    const Vector spin = some_axis(axis) * (0.99 * metres(lks_world_spin_limit(world)));
    lks_body_def def = lks_default_body_def();
    def.never_sleeps = 1;
    def.angular_velocity = fixed(spin.x, spin.y, spin.z);
    const double height = hangs ? 20 : extents.length() + 0.1;
    const lks_body_id body =
        add_body(world, box_shape(extents.x, extents.y, extents.z, 10), fixed(0, height, 0), def);
    if (hangs) {
        add_joint(world, lks_default_joint_def(), add_anchor(world, fixed(0, height, 0)), body);
    }
    const double mass = 80 * extents.x * extents.y * extents.z;
    const double energy = energy_of(world);
    double gained = 0;
    for (int tick = 0; tick < 120; ++tick) {
        world.step();
        const double fallen = height - state_of(world, body).position.y;
        gained = std::max(gained, (energy_of(world) - mass * g * fallen) / energy - 1);
    }
    return gained;
}

} // namespace

TEST_CASE("what spins as fast as it may gains no energy from what stops it") {
    for (const std::uint32_t substeps : {1u, 8u}) {
        for (const Vector& extents : boxes) {
            for (int axis = 0; axis < 8; ++axis) {
                for (const bool hangs : {false, true}) {
                    INFO(substeps << " substeps, half extents " << extents.x << " " << extents.y << " "
                                  << extents.z << ", axis " << axis << (hangs ? ", on a joint" : ""));
                    CHECK(gain_of_what_is_stopped(substeps, extents, axis, hangs) <= 1e-6);
                }
            }
        }
    }
}
