// Two plates that meet at a sharp angle: the second one's push goes back into the first. Whatever falls into
// such a groove stays between the two.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/bodies.h"
#include "support/builders.h"
#include "support/sanitised.h"

using namespace support;

namespace {

constexpr double radius = 0.01;
constexpr double half_thickness = 0.025;
constexpr double length = 4;
constexpr double pi = 3.14159265358979323846;

// Plates along z, `degrees` apart, whose inner faces meet in the z axis, lifted; one may be vertical.
struct Groove {
    double degrees;
    bool upright = false; // the plate on the left
    bool swapped = false; // the right plate comes first
    double friction = 0.5;

    double angle(int side) const { return (upright ? (side > 0 ? degrees : 0) : degrees / 2) * pi / 180; }
    Vector normal(int side) const { return {-side * std::cos(angle(side)), std::sin(angle(side)), 0}; }
    int side_of(int plate) const { return (plate == 0) == swapped ? 1 : -1; }

    lks_collider_def plate(int side, double lift = 0) const {
        const Vector out = normal(side);
        const Vector up{side * std::sin(angle(side)), std::cos(angle(side)), 0};
        const Vector middle = up * (length / 2 - 0.2) - out * half_thickness;
        lks_collider_def def = lks_default_collider_def();
        def.shape = LKS_SHAPE_BOX;
        def.half_extents = fixed(length / 2 + 0.2, half_thickness, 3);
        def.static_friction = def.dynamic_friction = fixed(friction);
        def.transform = {fixed(middle.x, middle.y + lift, 0),
                         about(0, 0, 1, std::atan2(-out.x, out.y) * 180 / pi)};
        return def;
    }
    // How far behind a face; of what has left over the top or at the ends, nothing.
    double depth(const Vector& p) const {
        return std::hypot(p.x, p.y) > length - 0.5 || std::abs(p.z) > 2.9
                   ? -1
                   : -std::min(p.dot(normal(-1)), p.dot(normal(1)));
    }
};

// Along the middle of the groove, each at another phase of its way; of 10° they have 17 cm there.
Asset shower() {
    std::vector<Vector> points;
    for (int i = 0; i < 100; ++i) {
        points.push_back({0.01 * (i % 10 - 4.5), 0.0173 * (i % 50), 0.02 * (i / 10)});
    }
    return loose_points(points, std::vector<double>(points.size(), 0.01), radius);
}

Asset rope() {
    lks_rope_def def = straight_rope(20, 0.6);
    def.particle_radius = radius;
    return Asset(def);
}

Asset cloth() {
    Net net;
    net.side = 12;
    net.width = 0.1;
    net.radius = radius;
    return net.build();
}

struct Fall {
    double deepest = -1; // the centre of a particle behind a face, at the end of any tick
    double fastest = 0;

    void look(const World& world, const Groove& groove, lks_object_id object) {
        for (const Vector& p : world.positions_from(object, {})) {
            deepest = std::max(deepest, groove.depth(p));
        }
        for (const lks_vec3& v : world.velocities(object)) {
            fastest = std::max(fastest, metres(v).length());
        }
    }
};

Fall fall(const Groove& groove, const Asset& asset, double turn, double speed, const lks_world_def& rate) {
    World world(rate);
    for (int plate = 0; plate < 2; ++plate) {
        world.add(groove.plate(groove.side_of(plate)));
    }
    const double slant = groove.upright ? groove.degrees / 2 * pi / 180 : 0;
    lks_object_def def = object_def(asset, turned(at(std::tan(slant), 1, 0), 0.3, 1, 0.2, turn));
    def.velocity = fixed(-speed * std::sin(slant), -speed * std::cos(slant), 0);
    const lks_object_id object = world.add(def);
    Fall result;
    for (int tick = 0; tick < 60; ++tick) {
        world.step();
        result.look(world, groove, object);
    }
    return result;
}

} // namespace

TEST_CASE("nothing passes a plate of a groove of ten degrees or more, at any speed and in any order") {
    const Asset things[] = {shower(), rope(), cloth()};
    for (const double degrees : {10., 20., 40., 60., 90.}) {
        for (const std::uint32_t substeps : {1u, 4u, 20u}) {
            for (const double speed : {5., 30., 100.}) {
                double deepest = -1;
                for (int variant = 0; variant < (sanitised ? 1 : 4); ++variant) {
                    const Groove groove{degrees, variant % 2 == 1, variant / 2 == 1};
                    for (const Asset& thing : things) {
                        const double turn = &thing == things ? 0 : 85;
                        deepest = std::max(deepest,
                                           fall(groove, thing, turn, speed, world_def(60, substeps)).deepest);
                    }
                }
                INFO(degrees << " degrees, " << substeps << " substeps, " << speed << " m/s: " << deepest);
                // What is pushed by less than a millimetre a substep sinks: most where it is narrow.
                CHECK(deepest < (degrees == 10 ? 0.01 : 0));
            }
        }
    }
}

TEST_CASE("a groove makes nothing faster") {
    const Asset points = shower();
    for (const double degrees : {10., 20., 60.}) {
        for (const std::uint32_t substeps : {1u, 8u, 20u}) {
            const Groove groove{degrees, false, false, 0};
            const double fastest = fall(groove, points, 0, 100, weightless(substeps)).fastest;
            INFO(degrees << " degrees, " << substeps << " substeps: " << fastest);
            CHECK(fastest < 100.01);
        }
    }
}

TEST_CASE("where two plates leave no room a particle stays on the side it came from") {
    const Asset points = loose_points({{0, 0, 0}, {0, 0, 0.5}}, {1, 1}, 0.001);
    for (const double degrees : {1., 2., 3.}) {
        for (const std::uint32_t substeps : {1u, 4u, 8u}) {
            const double deepest = fall({degrees}, points, 0, 100, weightless(substeps)).deepest;
            INFO(degrees << " degrees, " << substeps << " substeps: " << deepest);
            CHECK(deepest < 0.001);
        }
    }
}

TEST_CASE("a groove that comes up at 100 m/s takes what hangs in the air along") {
    const Asset points = shower();
    for (const double degrees : {10., 20., 40., 60.}) {
        for (const std::uint32_t substeps : {1u, 8u, 20u}) {
            const Groove groove{degrees};
            World world(weightless(substeps));
            lks_collider_id plates[2];
            for (int plate = 0; plate < 2; ++plate) {
                plates[plate] = world.add(groove.plate(groove.side_of(plate), -5));
            }
            const lks_object_id object = world.add(points, at(0, -4, 0));
            Fall result;
            for (int tick = 1; tick <= 3; ++tick) {
                for (int plate = 0; plate < 2; ++plate) {
                    const double lift = 100. / 60 * tick - 5;
                    REQUIRE(lks_collider_move_to(world, plates[plate],
                                                 groove.plate(groove.side_of(plate), lift).transform) ==
                            LKS_OK);
                }
                world.step();
            }
            result.look(world, groove, object);
            INFO(degrees << " degrees, " << substeps << " substeps: " << result.deepest);
            CHECK(result.deepest < 0);
        }
    }
}

TEST_CASE("nothing passes between two bars that touch") {
    const Asset points = shower();
    for (const std::uint32_t substeps : {1u, 4u, 20u}) {
        for (const double speed : {5., 100.}) {
            World world(world_def(60, substeps));
            for (const int side : {-1, 1}) {
                lks_collider_def bar = lks_default_collider_def();
                bar.shape = LKS_SHAPE_CAPSULE;
                bar.half_length = fixed(3);
                bar.transform = {fixed(0.5 * side, 0, 0), about(1, 0, 0, 90)};
                world.add(bar);
            }
            lks_object_def def = object_def(points, at(0, 1, 0));
            def.velocity = fixed(0, -speed, 0);
            const lks_object_id object = world.add(def);
            double lowest = 1;
            for (int tick = 0; tick < 60; ++tick) {
                world.step();
                for (const Vector& p : world.positions_from(object, {})) {
                    lowest = std::min(lowest, p.y);
                }
            }
            // Where both are a particle's radius away.
            INFO(substeps << " substeps, " << speed << " m/s: " << lowest);
            CHECK(lowest > 0.08);
        }
    }
}
