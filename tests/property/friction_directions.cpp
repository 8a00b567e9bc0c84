// Friction knows no compass: it pushes against the way that something slips, however bodies and axes are
// turned.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/bodies.h"
#include "support/builders.h"
#include "support/sanitised.h"

using namespace support;

namespace {

const double pi = std::acos(-1.0);

lks_body_def rough(double static_friction, double dynamic_friction) {
    lks_body_def def = lks_default_body_def();
    def.static_friction = fixed(static_friction);
    def.dynamic_friction = fixed(dynamic_friction);
    def.never_sleeps = 1;
    return def;
}

lks_vec3 fixed(const Vector& v) {
    return support::fixed(v.x, v.y, v.z);
}

// q then p, of turns that are small or whole quarters: exact enough for tests.
lks_rotation both(const lks_rotation& p, const lks_rotation& q) {
    const auto part = [](double value) { return static_cast<std::int32_t>(std::lround(value * 0x1p-30)); };
    const double px = p.x, py = p.y, pz = p.z, pw = p.w, qx = q.x, qy = q.y, qz = q.z, qw = q.w;
    return {part(pw * qx + px * qw + py * qz - pz * qy), part(pw * qy - px * qz + py * qw + pz * qx),
            part(pw * qz + px * qy - py * qx + pz * qw), part(pw * qw - px * qx - py * qy - pz * qz)};
}

// How far the topmost of some flat boxes upon each other, on a tilted base whose normal `up` turns +y to,
// goes in fifteen seconds, metres.
double drift_of_stack(const lks_rotation& up, int boxes, std::uint32_t substeps) {
    lks_world_def def = world_def(60, substeps);
    def.gravity = fixed(rotate(up, {1.2, -9.81, 1.6})); // 11.5° from the normal
    World world(def);
    lks_collider_def base = lks_default_collider_def();
    base.shape = LKS_SHAPE_BOX;
    base.half_extents = support::fixed(2, 0.2, 2);
    base.static_friction = support::fixed(0.6);
    base.dynamic_friction = support::fixed(0.5);
    base.transform.rotation = up;
    world.add(base);
    lks_body_def box = rough(0.6, 0.5);
    box.transform.rotation = up;
    std::vector<lks_body_id> ids;
    std::vector<Vector> places;
    for (int i = 0; i < boxes; ++i) {
        places.push_back(rotate(up, {0, 0.3 + 0.2 * i, 0}));
        ids.push_back(add_body(world, box_shape(0.25, 0.1, 0.25, 200), fixed(places.back()), box));
    }
    world.step(900);
    double worst = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        worst = std::max(worst, (state_of(world, ids[i]).position - places[i]).length());
    }
    return worst;
}

} // namespace

TEST_CASE("a plank that is thrown along the ground at any angle to its length goes straight, and slows as "
          "Coulomb says") {
    constexpr double friction = 0.5;
    for (const lks_body_shape& plank : {box_shape(1, 0.05, 0.1), box_shape(1, 0.01, 0.02),
                                        box_shape(1, 0.2, 0.3), box_shape(0.5, 0.01, 0.5)}) {
        for (const double angle : {0., 20., 45., 70.}) {
            for (const double speed : {1., 5., 20.}) {
                for (const std::uint32_t substeps : {1u, 4u, 20u}) {
                    if (sanitised && (substeps == 20 || speed > 5)) {
                        continue;
                    }
                    World world(world_def(60, substeps));
                    add_ground(world, friction);
                    lks_body_def def = rough(friction, friction);
                    const Vector way{std::cos(angle * pi / 180), 0, std::sin(angle * pi / 180)};
                    def.velocity = fixed(way * speed);
                    const lks_body_id id =
                        add_body(world, plank, support::fixed(0, metres(plank.half_extents.y), 0), def);
                    const auto ticks = static_cast<std::uint64_t>(0.7 * speed / (friction * 9.81) * 60);
                    world.step(ticks);
                    const BodyState state = state_of(world, id);
                    const double left = speed - friction * 9.81 * static_cast<double>(ticks) / 60;
                    INFO(metres(plank.half_extents.x)
                         << " x " << metres(plank.half_extents.z) << " at " << angle << " degrees, " << speed
                         << " m/s, " << substeps << " substeps");
                    CHECK(std::abs(cross(way, state.velocity).y) < 0.005 * left);
                    CHECK(std::abs(state.velocity.length() - left) < 0.01 * speed);
                    CHECK(std::abs(state.spin.y) < 0.1);
                }
            }
        }
    }
}

TEST_CASE("what bounces leaves alike, however the scene is turned") {
    for (const std::uint32_t substeps : {8u, 20u, 100u}) {
        BodyState first{};
        for (const double degrees : {0., 22.5, 45., 67.5, 90., 200.}) {
            World world(weightless(substeps));
            const lks_rotation turn = about(0, 1, 0, degrees);
            add_ground(world, 0.5, &turn);
            lks_body_def def = rough(0.5, 0.5);
            def.restitution = support::fixed(0.5);
            def.transform.rotation = both(turn, both(about(0, 1, 0, 45), about(0, 0, 1, 30)));
            def.velocity = fixed(rotate(turn, {2, -3, 0}));
            const lks_body_id id = add_body(world, capsule_shape(0.1, 0.4), support::fixed(0, 0.8, 0), def);
            world.step(20);
            BodyState state = state_of(world, id);
            const lks_rotation back = about(0, 1, 0, -degrees);
            state.velocity = rotate(back, state.velocity);
            state.spin = rotate(back, state.spin);
            if (degrees == 0) {
                first = state;
                CHECK(state.spin.length() > 1); // it has bounced
            }
            INFO(substeps << " substeps, turned by " << degrees);
            CHECK((state.velocity - first.velocity).length() < 1e-5);
            CHECK((state.spin - first.spin).length() < 1e-4);
        }
    }
}

TEST_CASE("stacks on a slope stand as well whichever axis is up") {
    const lks_rotation ups[] = {about(0, 1, 0, 0), about(1, 0, 0, 90), about(0, 0, 1, -90),
                                about(0.3, 0.5, 0.1, 37)};
    for (const int boxes : {2, 3, 5}) {
        for (const std::uint32_t substeps : {4u, 8u, 20u}) {
            double least = 1e9, most = 0;
            for (const lks_rotation& up : ups) {
                const double drift = drift_of_stack(up, boxes, substeps);
                least = std::min(least, drift);
                most = std::max(most, drift);
            }
            INFO(boxes << " boxes, " << substeps << " substeps: " << least << " to " << most);
            CHECK(most < 1.1 * least + 1e-5);
            CHECK(most < 4e-3);
        }
    }
}

TEST_CASE("static friction holds what gravity pulls harder by a factor, too") {
    for (const double factor : {1., 3., 10., 50.}) {
        for (const std::uint32_t substeps : {4u, 8u, 20u}) {
            // 24° of the 26.6° at which it begins to slide.
            World world(world_def(60, substeps));
            const lks_rotation slope = about(0, 0, 1, 24);
            lks_collider_def plane = lks_default_collider_def();
            plane.shape = LKS_SHAPE_PLANE;
            plane.static_friction = support::fixed(0.5);
            plane.dynamic_friction = support::fixed(0.1);
            plane.transform.rotation = slope;
            world.add(plane);
            lks_body_def def = rough(0.5, 0.1);
            def.gravity_factor = support::fixed(factor);
            def.transform.rotation = slope;
            const Vector place = rotate(slope, {0, 0.2, 0});
            const lks_body_id box = add_body(world, box_shape(0.5, 0.2, 0.5), fixed(place), def);
            world.step(180);
            INFO("factor " << factor << ", " << substeps << " substeps");
            CHECK((state_of(world, box).position - place).length() < 0.02);
        }
    }
}
