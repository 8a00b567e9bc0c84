// The ragdolls of the demo scenes themselves: joints, limits, and that they come to rest.
#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "scenes/mannequin.h"
#include "scenes/scene.h"
#include "support/bodies.h"

namespace {

// Bounds are those that a game is promised with 8 substeps of 60 Hz, tighter where far less is reached.
struct Bounds {
    std::string scene;
    std::uint32_t figures;
    double worst_error;     // metres
    double worst_degrees;   // beyond a joint's limits, in any tick
    double resting_degrees; // the same when all sleep
    std::uint32_t asleep;   // ticks until then at the most
};

struct Seen {
    double sum = 0;
    double worst = 0;
    double degrees = 0;     // in any tick
    double degrees_now = 0; // in the last one
    std::uint64_t count = 0;
};

void look_at_joints(const lks_world* world, const lks_demo::Mannequin& mannequin, Seen& seen) {
    constexpr std::uint32_t per_figure = LKS_HUMANOID_BONES - 1;
    seen.degrees_now = 0;
    for (std::uint32_t i = 0; i < lks_world_joint_count(world); ++i) {
        const lks_joint_id joint{i, 1}; // nothing was removed: indices and generations are those of the first
        const double error = support::error_of(world, joint);
        seen.sum += error;
        ++seen.count;
        seen.worst = std::max(seen.worst, error);
        seen.degrees_now = std::max(
            seen.degrees_now, support::degrees_beyond(world, mannequin.bones[1 + i % per_figure], joint));
    }
    seen.degrees = std::max(seen.degrees, seen.degrees_now);
}

} // namespace

TEST_CASE("the mannequins of the scenes hold together, keep to their limits and fall asleep") {
    const lks_demo::Mannequin mannequin;
    const Bounds all[] = {
        {"ragdoll_stairs", 1, 1e-4, 1.0, 0.5, 600},
        {"ragdoll_pile", 30, 1e-3, 3.0, 0.5, 600},
    };
    for (const Bounds& bounds : all) {
        CAPTURE(bounds.scene);
        std::string error;
        const std::unique_ptr<lks_demo::Scene> scene = lks_demo::create_scene(bounds.scene, {}, error);
        REQUIRE_MESSAGE(scene != nullptr, error);
        REQUIRE(lks_world_joint_count(scene->world()) == bounds.figures * (LKS_HUMANOID_BONES - 1));
        Seen seen;
        while (lks_world_awake_body_count(scene->world()) > 0 && scene->tick() < bounds.asleep) {
            REQUIRE_MESSAGE(scene->step(error), error);
            look_at_joints(scene->world(), mannequin, seen);
        }
        CHECK(lks_world_awake_body_count(scene->world()) == 0);
        CAPTURE(scene->tick());
        CHECK(seen.sum < 1e-6 * static_cast<double>(seen.count));
        CHECK(seen.worst < bounds.worst_error);
        CHECK(seen.degrees < bounds.worst_degrees);
        CHECK(seen.degrees_now < bounds.resting_degrees);
        lks_world_counters counters{};
        REQUIRE(lks_world_get_counters(scene->world(), &counters) == LKS_OK);
        CHECK(counters.lost_contacts == 0);
    }
}
