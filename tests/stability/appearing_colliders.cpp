// A collider that is added where things already are: what it overlaps is put out of it, and not shot.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "stability/support/jointed.h"
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
        expect_worst_stretch_at_most(scene, trial, standing ? 220 : 1300);
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
        expect_worst_stretch_at_most(scene, trial, 20);
        expect_kinetic_energy_at_most(scene, trial, 30);
        expect_out_within(scene, trial, 0.2);
        expect_recovery_within(scene, trial, 1);
        expect_last_stretch_at_most(scene, trial, 5);
        expect_nothing_clamped(trial);
    }
}

TEST_CASE("a ball that appears in a pile of boxes pushes them aside") {
    Jointed pile(world_def(60, 20));
    pile.add_ground(0.5, true);
    for (int i = 0; i < 27; ++i) {
        const int layer = i / 9;
        const int row = i / 3 % 3;
        lks_body_def def = lks_default_body_def();
        def.transform.position =
            support::fixed(0.25 * (i % 3) - 0.25, 0.15 + 0.22 * layer, 0.25 * row - 0.25);
        pile.add(box_shape(0.1, 0.1, 0.1), def);
    }
    pile.step(180);
    pile.add_later(ball(0.4, support::fixed(0, 0.2, 0)));
    const auto is_in = [](const Vector& place) { return (place - Vector{0, 0.2, 0}).length() < 0.4; };
    Worst energy, speed, out_after, at_rest_after; // the latter for good, s
    for (int tick = 1; tick <= 360; ++tick) {
        pile.step();
        const double now = tick / 60.0;
        energy.add(pile.kinetic_energy(), pile.twin_kinetic_energy());
        at_rest_after.add(pile.kinetic_energy() < 0.1 ? 0 : now, pile.twin_kinetic_energy() < 0.1 ? 0 : now);
        for (std::size_t i = 0; i < pile.size(); ++i) {
            speed.add(state_of(pile.world(), pile.id(i)).velocity.length(), pile.twin_velocity(i).length());
            out_after.add(is_in(pile.position(i)) ? now : 0, is_in(pile.twin_position(i)) ? now : 0);
        }
    }
    const std::string scene = "ball of 80 cm appears in a pile of 27 boxes";
    expect_at_most(scene, "fastest box", "m/s", 4, speed.fixed, speed.single);
    expect_at_most(scene, "kinetic energy, worst", "J", 100, energy.fixed, energy.single);
    expect_at_most(scene, "no box's middle in it after", "s", 4, out_after.fixed, out_after.single);
    expect_at_most(scene, "less than 0.1 J for good after", "s", 5, at_rest_after.fixed,
                   at_rest_after.single);
    expect_at_most(scene, "kinetic energy, after 6 s", "J", 0.01, pile.kinetic_energy(),
                   pile.twin_kinetic_energy());
}
