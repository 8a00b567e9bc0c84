// The ragdolls of the demo scenes themselves: joints, limits, energy, and how they come to rest, or are held.
#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "scenes/mannequin.h"
#include "support/bodies.h"
#include "support/demo_scenes.h"
#include "support/events.h"
#include "support/scene_solids.h"

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

// Kinetic, and potential of all bodies.
double energy_of(const lks_demo::Scene& scene) {
    lks_fixed kinetic = 0;
    REQUIRE(lks_world_kinetic_energy(scene.world(), &kinetic) == LKS_OK);
    double sum = support::metres(kinetic);
    for (const lks_demo::BodyLook& look : scene.bodies()) {
        lks_fixed mass = 0;
        lks_transform transform{};
        REQUIRE(lks_body_mass(scene.world(), look.id, &mass) == LKS_OK);
        REQUIRE(lks_body_transform(scene.world(), look.id, &transform) == LKS_OK);
        sum += support::metres(mass) * 9.81 * support::metres(transform.position.y);
    }
    return sum;
}

bool are_neighbours(const lks_demo::Mannequin& mannequin, std::size_t i, std::size_t j) {
    constexpr std::size_t bones = LKS_HUMANOID_BONES;
    const auto hangs_on = [&](std::size_t child, std::size_t parent) {
        return child % bones != 0 && child - child % bones + mannequin.bones[child % bones].parent == parent;
    };
    return hangs_on(i, j) || hangs_on(j, i);
}

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
        {"ragdoll_stairs", 1, 5e-4, 2.0, 0.5, 600},
        {"ragdoll_pile", 30, 1e-3, 3.0, 0.5, 600},
    };
    for (const Bounds& bounds : all) {
        CAPTURE(bounds.scene);
        const std::unique_ptr<lks_demo::Scene> scene = support::make_scene(bounds.scene);
        REQUIRE(lks_world_joint_count(scene->world()) == bounds.figures * (LKS_HUMANOID_BONES - 1));
        Seen seen;
        double least = energy_of(*scene);
        double gained = 0;
        while (lks_world_awake_body_count(scene->world()) > 0 && scene->tick() < bounds.asleep) {
            support::step(*scene);
            look_at_joints(scene->world(), mannequin, seen);
            const double energy = energy_of(*scene);
            gained = std::max(gained, energy - least);
            least = std::min(least, energy);
        }
        CHECK(lks_world_awake_body_count(scene->world()) == 0);
        CAPTURE(scene->tick());
        CHECK(seen.sum < 1e-6 * static_cast<double>(seen.count));
        CHECK(seen.worst < bounds.worst_error);
        CHECK(seen.degrees < bounds.worst_degrees);
        CHECK(seen.degrees_now < bounds.resting_degrees);
        // Of 3 and 91 kJ: what overlaps parts.
        CHECK(gained < 5);
        CHECK(support::deepest_overlap(*scene, [&](std::size_t i, std::size_t j) {
                  return are_neighbours(mannequin, i, j);
              }) < 2e-3);
        lks_world_counters counters{};
        REQUIRE(lks_world_get_counters(scene->world(), &counters) == LKS_OK);
        CHECK(counters.lost_contacts == 0);
    }
}

TEST_CASE("what is held by ropes, and what wears or walks, stays together in the scenes, too") {
    struct Held {
        std::string scene;
        std::uint32_t ticks;
        double joints;      // metres apart, worst
        double attachments; // the same, once they have come together
        std::uint32_t torn; // attachments
    };
    for (const Held& held :
         {Held{"ragdoll_hang", 420, 2e-3, 2e-3, 1}, Held{"ragdoll_cape", 480, 1e-4, 1e-5, 0},
          Held{"spider", 480, 1e-6, 0, 0}, Held{"sentry", 420, 1e-3, 6e-2, 0}}) {
        CAPTURE(held.scene);
        const std::unique_ptr<lks_demo::Scene> scene = support::make_scene(held.scene);
        lks_world* world = scene->world();
        constexpr std::uint32_t kinds =
            LKS_EVENT_BIT(LKS_EVENT_JOINT_BROKE) | LKS_EVENT_BIT(LKS_EVENT_ATTACHMENT_BROKE);
        REQUIRE(lks_world_record_events(world, kinds, 0, 100) == LKS_OK);
        const std::uint32_t joint_count = lks_world_joint_count(world);
        const std::uint32_t attachment_count = lks_world_attachment_count(world);
        CHECK((attachment_count > 0) == (held.attachments > 0));
        double joints = 0;
        double attachments = 0;
        std::uint32_t torn = 0;
        while (scene->tick() < held.ticks) {
            support::step(*scene);
            for (std::uint32_t i = 0; i < joint_count; ++i) {
                joints = std::max(joints, support::error_of(world, {i, 1}));
            }
            for (std::uint32_t i = 0; i < attachment_count && scene->tick() > 30; ++i) {
                lks_fixed error = 0;
                if (lks_world_has_attachment(world, {i, 1}) == 1) {
                    REQUIRE(lks_attachment_error(world, {i, 1}, &error) == LKS_OK);
                    attachments = std::max(attachments, support::metres(error));
                }
            }
            for (std::uint32_t i = 0; i < lks_world_event_count(world); ++i) {
                const lks_event& event = lks_world_events(world)[i];
                CHECK(event.kind == LKS_EVENT_ATTACHMENT_BROKE);
                CHECK(support::metres(event.strength) > 2500);
                CHECK(scene->tick() > 180); // it is pulled at three seconds
                ++torn;
            }
        }
        CHECK(lks_world_joint_count(world) == joint_count);
        CHECK(torn == held.torn);
        CHECK(joints < held.joints);
        CHECK(attachments <= held.attachments);
    }
}
