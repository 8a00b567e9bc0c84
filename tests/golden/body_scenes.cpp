// The scenes of single bodies: what they show holds for as long as somebody watches.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "support/bodies.h"
#include "support/demo_scenes.h"

using namespace support;

namespace {

lks_transform transform_of(const lks_demo::Scene& scene, std::size_t body) {
    lks_transform transform{};
    REQUIRE(lks_body_transform(scene.world(), scene.bodies()[body].id, &transform) == LKS_OK);
    return transform;
}

Vector place_of(const lks_demo::Scene& scene, std::size_t body) {
    return metres(transform_of(scene, body).position);
}

} // namespace

TEST_CASE("Newton's cradle hands on its impact, back and forth, and gains nothing") {
    const std::unique_ptr<lks_demo::Scene> scene = make_scene("newtons_cradle");
    // The beam, and five balls; at rest they are 0.4 m and a tenth of a millimetre from each other.
    REQUIRE(scene->bodies().size() == 6);
    const auto height = [&](std::size_t ball) { return place_of(*scene, ball).y - 0.9; };
    double least = 1e9;
    double gained = 0;
    int swings = 0;
    double highest = 0; // since the last swing
    bool left = true;
    while (scene->tick() < 600) {
        step(*scene);
        lks_fixed kinetic = 0;
        REQUIRE(lks_world_kinetic_energy(scene->world(), &kinetic) == LKS_OK);
        double energy = metres(kinetic);
        for (std::size_t ball = 1; ball <= 5; ++ball) {
            lks_fixed mass = 0;
            REQUIRE(lks_body_mass(scene->world(), scene->bodies()[ball].id, &mass) == LKS_OK);
            energy += metres(mass) * 9.81 * height(ball);
        }
        gained = std::max(gained, energy - least);
        least = std::min(least, energy);
        // Those in the middle hang; of the others one is up.
        for (std::size_t ball = 2; ball <= 4; ++ball) {
            CHECK(std::abs(place_of(*scene, ball).x - 0.4001 * (static_cast<double>(ball) - 3)) < 0.015);
        }
        CHECK(std::min(height(1), height(5)) < 0.005);
        const std::size_t up = left ? 1 : 5;
        highest = std::max(highest, height(up));
        if (height(left ? 5 : 1) > 0.1) {
            CHECK(highest > 0.35); // of the 0.44 m from which it was let go
            left = !left;
            highest = 0;
            ++swings;
        }
    }
    CHECK(swings >= 7);
    CHECK(gained < 2); // of 1.1 kJ, to and fro (rigid/free_figure.h)
}

TEST_CASE("the tower of boxes stands where it was put") {
    const std::unique_ptr<lks_demo::Scene> scene = make_scene("box_stack");
    double aside = 0;
    double down = 0;
    while (scene->tick() < 3600) {
        step(*scene);
        for (std::size_t box = 0; box < 10; ++box) {
            const Vector place = place_of(*scene, box);
            aside = std::max(aside, std::hypot(place.x + 1.3, place.z));
            down = std::max(down, std::abs(place.y - 0.2 - 0.4 * static_cast<double>(box)));
        }
    }
    CHECK(aside < 1e-5);
    CHECK(down < 1e-3); // at the top, of ten gaps
    CHECK(lks_world_awake_body_count(scene->world()) == 0);
}

TEST_CASE(
    "the cart's wheels stay on their hubs, its springs yield by some centimetres, and it comes to rest") {
    const std::unique_ptr<lks_demo::Scene> scene = make_scene("cart");
    // The chassis, four hubs and their wheels, the driver, six crates, and four arms of the front wheels.
    REQUIRE(scene->bodies().size() == 20);
    const auto place_on_chassis = [&](std::size_t hub) {
        return rotate(conjugate(transform_of(*scene, 0).rotation),
                      place_of(*scene, hub) - place_of(*scene, 0));
    };
    Vector begin[4];
    for (std::size_t i = 0; i < 4; ++i) {
        begin[i] = place_on_chassis(1 + 2 * i);
    }
    double off_hub = 0;
    double most = 0;
    while (scene->tick() < 900) {
        step(*scene);
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t hub = 1 + 2 * i;
            off_hub = std::max(off_hub,
                               std::abs((place_of(*scene, hub + 1) - place_of(*scene, hub)).length() - 0.15));
            most = std::max(most, (place_on_chassis(hub) - begin[i]).length());
        }
    }
    CAPTURE(off_hub);
    CAPTURE(most);
    CHECK(place_of(*scene, 0).x > 0.8); // among the crates
    CHECK(off_hub < 1e-3);
    CHECK(most > 0.02);
    CHECK(most < 0.15);
    CHECK(lks_world_awake_body_count(scene->world()) == 0);
}
