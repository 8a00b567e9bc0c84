// A collider that is added where things already are: what it overlaps is put out of it, and not shot.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "stability/support/nets.h"
#include "stability/support/table.h"
#include "stability/support/trial.h"
#include "support/bodies.h"

using namespace support;
using namespace stability;

namespace {

lks_collider_def ball(double radius, const lks_vec3& position) {
    lks_collider_def def = lks_default_collider_def();
    def.radius = support::fixed(radius);
    def.transform.position = position;
    return def;
}

Net small_net() {
    return kilogram_net(16, 1.5);
}

} // namespace

TEST_CASE("a ball that appears in a cloth pushes it aside") {
    // Inextensible, it has nowhere to go but up where it stands on its edge.
    for (const bool standing : {false, true}) {
        const Net net = small_net();
        const Asset asset = net.build();
        Subject subject = subject_of(net, asset);
        subject.transform = standing ? at(0, 1, 0) : turned(at(0, 1, 0), 3, 1, 2, 70);
        Trial trial(subject);
        lks_collider_def ground = lks_default_collider_def();
        ground.shape = LKS_SHAPE_PLANE;
        trial.add(ground);
        trial.run(180);
        trial.add(ball(0.3, support::fixed(0.1, 0, 0)));
        trial.begin();
        const std::string scene =
            named("ball of 60 cm appears in a cloth that ", standing ? "stands" : "lies", " on the ground");
        trial.run(192);
        expect_kinetic_energy_at_most(scene, trial, standing ? 100 : 30);
        expect_out_within(scene, trial, 0.2);
        expect_last_kinetic_energy_at_most(scene, trial, standing ? 60 : 0.1);
        expect_last_off_at_most(scene, trial, standing ? 5 : 40);
        expect_nothing_clamped(trial);
    }
}

TEST_CASE("a ball that appears in a cloth that hangs pushes it aside, with and without tethers") {
    for (const bool tethered : {false, true}) {
        Net net = small_net();
        if (tethered) {
            net.anchors = {0, 15};
        }
        const Asset asset = net.build();
        Trial trial(subject_of(net, asset));
        trial.pin(0);
        trial.pin(15);
        trial.run(60);
        // All of the cloth that is in it finds its way out on the same side.
        trial.add(ball(0.3, support::fixed(0.1, 0, 0.15)));
        trial.begin();
        trial.run(300);
        const std::string scene =
            named("ball of 60 cm appears in a ", tethered ? "tethered " : "", "cloth that hangs");
        expect_kinetic_energy_at_most(scene, trial, 30);
        expect_out_within(scene, trial, 0.2);
        expect_recovery_within(scene, trial, 1);
        expect_last_stretch_at_most(scene, trial, 5);
        expect_nothing_clamped(trial);
    }
}

TEST_CASE("a ball that appears in a pile of boxes pushes them aside") {
    World world(world_def(60, 20));
    add_ground(world);
    std::vector<lks_body_id> boxes;
    for (int i = 0; i < 27; ++i) {
        lks_body_def def = lks_default_body_def();
        def.never_sleeps = 1;
        boxes.push_back(add_body(
            world, box_shape(0.1, 0.1, 0.1),
            support::fixed(0.25 * (i % 3) - 0.25, 0.15 + 0.22 * (i / 9), 0.25 * (i / 3 % 3) - 0.25), def));
    }
    world.step(180);
    world.add(ball(0.4, support::fixed(0, 0.2, 0)));
    double worst = 0, fastest = 0;
    int out_after = 0, at_rest_after = 0; // ticks, for good
    for (int tick = 1; tick <= 360; ++tick) {
        world.step();
        worst = std::max(worst, energy_of(world));
        at_rest_after = energy_of(world) < 0.1 ? at_rest_after : tick;
        for (const lks_body_id box : boxes) {
            const BodyState state = state_of(world, box);
            fastest = std::max(fastest, state.velocity.length());
            if ((state.position - Vector{0, 0.2, 0}).length() < 0.4) {
                out_after = tick;
            }
        }
    }
    const char* const no_twin = "it knows no boxes that touch each other";
    const std::string scene = "ball of 80 cm appears in a pile of 27 boxes";
    expect_at_most(scene, "fastest box", "m/s", 4, fastest, no_twin);
    expect_at_most(scene, "kinetic energy, worst", "J", 100, worst, no_twin);
    expect_at_most(scene, "no box's middle in it after", "s", 4, out_after / 60.0, no_twin);
    expect_at_most(scene, "less than 0.1 J for good after", "s", 5, at_rest_after / 60.0, no_twin);
    expect_at_most(scene, "kinetic energy, after 6 s", "J", 0.01, energy_of(world), no_twin);
}
