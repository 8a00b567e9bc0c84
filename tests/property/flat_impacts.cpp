// What comes down flat on several contacts at once is thrown back flat: shapes of one body, and colliders
// side by side.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

struct Bounce {
    double height = 0; // to which its lowest point rises again, metres
    double spin = 0;   // rad/s, after the first bounce
};

lks_body_def bouncing(double restitution) {
    lks_body_def def = lks_default_body_def();
    def.restitution = fixed(restitution);
    def.never_sleeps = 1;
    return def;
}

// From so high above the ground, or whatever `clearance` says is below it then.
Bounce bounce(World& world, lks_body_id id, double clearance) {
    Bounce result;
    const double start = state_of(world, id).position.y;
    bool up = false;
    for (int tick = 0; tick < 120; ++tick) {
        world.step();
        const BodyState state = state_of(world, id);
        if (state.velocity.y > 0.1 && !up) {
            up = true;
            result.spin = state.spin.length();
        }
        if (up && state.velocity.y < 0) {
            break;
        }
        if (up) {
            result.height = std::max(result.height, state.position.y - start + clearance);
        }
    }
    return result;
}

// A plate on four feet.
lks_body_id add_table(World& world, bool balls, double restitution, double height) {
    std::vector<lks_body_shape> shapes;
    lks_body_shape top = box_shape(0.5, 0.05, 0.4, 300);
    shapes.push_back(top);
    for (const double x : {-0.4, 0.4}) {
        for (const double z : {-0.3, 0.3}) {
            lks_body_shape foot = balls ? ball_shape(0.08, 300) : box_shape(0.05, 0.1, 0.05, 300);
            foot.transform.position = fixed(x, balls ? -0.1 : -0.15, z);
            shapes.push_back(foot);
        }
    }
    lks_body_def def = bouncing(restitution);
    def.shapes = shapes.data();
    def.shape_count = static_cast<std::uint32_t>(shapes.size());
    def.transform.position = fixed(0, (balls ? 0.18 : 0.25) + height, 0);
    lks_body_id id{};
    REQUIRE(lks_world_add_body(world, &def, &id) == LKS_OK);
    return id;
}

} // namespace

TEST_CASE("a table that falls on its four feet rises to what its restitution gives, and does not turn") {
    for (const bool balls : {true, false}) {
        for (const double restitution : {0.5, 0.9, 1.}) {
            for (const std::uint32_t substeps : {8u, 20u}) {
                World world(world_def(60, substeps));
                add_ground(world);
                const Bounce seen = bounce(world, add_table(world, balls, restitution, 0.5), 0.5);
                INFO((balls ? "balls, " : "boxes, ") << restitution << ", " << substeps << " substeps: "
                                                     << seen.height << " m, " << seen.spin << " rad/s");
                CHECK(seen.height == doctest::Approx(0.5 * restitution * restitution).epsilon(0.05));
                CHECK(seen.spin < 0.1);
            }
        }
    }
}

TEST_CASE("a box that falls across the seam of tiles is thrown back as from one ground") {
    for (const double aside : {0., 0.1, 0.3}) {
        for (const double restitution : {0.5, 1.}) {
            for (const std::uint32_t substeps : {8u, 20u}) {
                World world(world_def(60, substeps));
                for (const double x : {-1., 1.}) {
                    for (const double z : {-1., 1.}) {
                        add_box(world, fixed(1, 0.5, 1), fixed(x, -0.5, z));
                    }
                }
                const lks_body_id box = add_body(world, box_shape(0.4, 0.2, 0.4),
                                                 fixed(aside, 0.7, aside / 2), bouncing(restitution));
                const Bounce seen = bounce(world, box, 0.5);
                INFO(aside << " m aside, " << restitution << ", " << substeps << " substeps: " << seen.height
                           << " m, " << seen.spin << " rad/s");
                CHECK(seen.height == doctest::Approx(0.5 * restitution * restitution).epsilon(0.05));
                CHECK(seen.spin < 0.1);
            }
        }
    }
}

TEST_CASE("a ball between two that come to meet stays, and they go back as fast") {
    World world(weightless(20));
    lks_body_def def = bouncing(1);
    const lks_body_id middle = add_body(world, ball_shape(0.2), {}, def);
    def.velocity = fixed(3, 0, 0);
    const lks_body_id left = add_body(world, ball_shape(0.2), fixed(-1, 0, 0), def);
    def.velocity = fixed(-3, 0, 0);
    const lks_body_id right = add_body(world, ball_shape(0.2), fixed(1, 0, 0), def);
    world.step(60);
    CHECK(state_of(world, middle).velocity.length() < 1e-3);
    CHECK(state_of(world, left).velocity.x == doctest::Approx(-3).epsilon(1e-3));
    CHECK(state_of(world, right).velocity.x == doctest::Approx(3).epsilon(1e-3));
}
