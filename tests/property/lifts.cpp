// What lies on a lift lies there as on the ground, whichever way it goes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/bodies.h"
#include "support/builders.h"
#include "support/sanitised.h"

using namespace support;

namespace {

lks_collider_id add_platform(World& world) {
    lks_collider_def def = lks_default_collider_def();
    def.shape = LKS_SHAPE_BOX;
    def.half_extents = fixed(4, 0.1, 4);
    def.transform.position = fixed(0, -0.1, 0);
    return world.add(def);
}

// So many ticks at a speed, from where it is; its top is at `height` then.
void ride(World& world, lks_collider_id platform, double speed, int ticks, double& height) {
    for (int tick = 0; tick < ticks; ++tick) {
        height += speed / 60;
        lks_transform to = lks_transform_identity();
        to.position = fixed(0, height - 0.1, 0);
        REQUIRE(lks_collider_move_to(world, platform, to) == LKS_OK);
        world.step(1);
    }
}

std::vector<Vector> places(const World& world, const std::vector<lks_body_id>& bodies, double height) {
    std::vector<Vector> all;
    for (const lks_body_id body : bodies) {
        lks_transform transform{};
        REQUIRE(lks_body_transform(world, body, &transform) == LKS_OK);
        Vector p = metres(transform.position);
        p.y -= height;
        all.push_back(p);
    }
    return all;
}

} // namespace

TEST_CASE("a stack on a lift that goes up or down stands as on the ground") {
    for (const std::uint32_t substeps : {4u, 8u, 20u}) {
        if (sanitised && substeps != 8) {
            continue;
        }
        std::vector<Vector> still;
        for (const double speed : {0., 0.3, 1., -1., 3., -3.}) {
            World world(world_def(60, substeps));
            const lks_collider_id platform = add_platform(world);
            std::vector<lks_body_id> boxes;
            for (int i = 0; i < 5; ++i) {
                lks_body_def def = lks_default_body_def();
                def.never_sleeps = 1;
                def.velocity = fixed(0, speed, 0);
                boxes.push_back(
                    add_body(world, box_shape(0.25, 0.25, 0.25), fixed(0, 0.25 + 0.5 * i, 0), def));
            }
            double height = 0;
            ride(world, platform, speed, 600, height);
            const std::vector<Vector> now = places(world, boxes, height);
            if (speed == 0) {
                still = now;
            }
            INFO(substeps << " substeps, " << speed << " m/s");
            for (std::size_t i = 0; i < boxes.size(); ++i) {
                CHECK((now[i] - still[i]).length() < 1e-6);
                CHECK(std::abs(now[i].y - (0.25 + 0.5 * static_cast<double>(i))) < 0.0015);
            }
        }
    }
}

TEST_CASE("a ragdoll that lies on a lift stays there") {
    for (const double speed : {1., 3., -1., -3.}) {
        World world(world_def(60, 8));
        const lks_collider_id platform = add_platform(world);
        Humanoid humanoid;
        humanoid.def.transform.position = fixed(0, 0.3, -0.8);
        humanoid.def.transform.rotation = about(1, 0, 0, 90);
        std::vector<lks_body_id> bones(LKS_HUMANOID_BONES);
        REQUIRE(humanoid.add(world, bones.data()) == LKS_OK);
        double height = 0;
        for (int tick = 0; tick < 60; ++tick) { // it starts within a second
            ride(world, platform, speed * tick / 60, 1, height);
        }
        ride(world, platform, speed, 540, height);
        const std::vector<Vector> before = places(world, bones, height);
        ride(world, platform, speed, 600, height);
        const std::vector<Vector> after = places(world, bones, height);
        double farthest = 0;
        for (std::size_t i = 0; i < bones.size(); ++i) {
            farthest = std::max(farthest, (after[i] - before[i]).length());
        }
        INFO(speed << " m/s: moved by " << farthest << " m in ten seconds");
        CHECK(farthest < 0.01);
    }
}
