// What passes a box clear of it is not touched: its edge is no wall that goes on.
#include <doctest/doctest.h>

#include <cmath>

#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

// Frictionless and without weight, over a box's edge from beside it, `gap` metres clear.
void pass(const char* name, const lks_body_shape& shape, double height, double gap, double speed,
          std::uint32_t substeps) {
    World world(weightless(substeps));
    lks_collider_def box = lks_default_collider_def();
    box.shape = LKS_SHAPE_BOX;
    box.half_extents = fixed(0.5, 0.5, 0.5);
    box.static_friction = box.dynamic_friction = 0;
    world.add(box);
    lks_body_def def = lks_default_body_def();
    def.static_friction = def.dynamic_friction = 0;
    def.velocity = fixed(speed, 0, 0);
    // Where it is within a tick depends on where it began.
    for (int start = 0; start < 12; ++start) {
        const double x = -1.4 - 0.013 * start;
        const lks_body_id body = add_body(world, shape, fixed(x, 0.5 + height + gap, 0), def);
        world.step(static_cast<int>(3 / speed * 60));
        lks_vec3 velocity{};
        lks_vec3 spin{};
        REQUIRE(lks_body_velocity(world, body, &velocity, &spin) == LKS_OK);
        INFO(name << " at " << speed << " m/s, " << gap << " m clear, " << substeps << " substeps, from "
                  << x);
        CHECK((metres(velocity) - Vector{speed, 0, 0}).length() < 1e-6 * speed);
        CHECK(metres(spin).length() < 1e-6);
        REQUIRE(lks_world_remove_body(world, body) == LKS_OK);
    }
}

} // namespace

TEST_CASE("what passes over a box's edge a few millimetres clear goes on as it was") {
    lks_body_shape level = capsule_shape(0.1, 0.2);
    level.transform.rotation = about(0, 0, 1, 70);
    const double ends = 0.1 + 0.2 * std::cos(70 * std::acos(-1.0) / 180);
    for (const std::uint32_t substeps : {8u, 20u}) {
        for (const double speed : {3., 6., 10., 20.}) {
            pass("ball", ball_shape(0.2), 0.2, 0.01, speed, substeps);
            pass("capsule", level, ends, 0.01, speed, substeps);
        }
        pass("ball", ball_shape(0.2), 0.2, 0.003, 6, substeps);
        pass("box", box_shape(0.2, 0.2, 0.2), 0.2, 0.003, 10, substeps);
    }
}
