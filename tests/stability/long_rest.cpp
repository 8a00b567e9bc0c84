// What has come to rest stays there: a million ticks without creep, drift or energy.
#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "stability/support/jointed.h"
#include "stability/support/table.h"
#include "stability/support/trial.h"
#include "support/bodies.h"

using namespace support;
using namespace stability;

namespace {

int ticks_of_rest() {
    return long_runs() ? 1000000 : 1000;
}

struct Bounds {
    double metres, joules;
};

// Lets it come to rest, and looks how far it gets from there, and how fast it is, after every tick.
void rest(const std::string& what, Trial& trial, int settling, const Bounds& bounds) {
    trial.skip(settling);
    trial.begin();
    const std::vector<Vector> start = trial.positions();
    const std::vector<Vector> twin_start = trial.twin_positions();
    double moved = 0, twin_moved = 0;
    for (int tick = 0; tick < ticks_of_rest(); ++tick) {
        trial.run(1);
        moved = std::max(moved, farthest(trial.positions(), start));
        twin_moved = std::max(twin_moved, farthest(trial.twin_positions(), twin_start));
    }
    const std::string scene = named(what, ", ", ticks_of_rest(), " ticks of rest");
    expect_at_most(scene, "moved", "m", bounds.metres, moved, twin_moved);
    expect_kinetic_energy_at_most(scene, trial, bounds.joules);
    expect_nothing_clamped(trial);
}

lks_collider_def ground() {
    lks_collider_def def = lks_default_collider_def();
    def.shape = LKS_SHAPE_PLANE;
    return def;
}

Net small_net() {
    Net net;
    net.side = 10;
    net.width = 1;
    net.particle_mass = 0.01;
    net.radius = 0.01;
    return net;
}

Subject resting(Subject subject) {
    subject.world = world_def(60, 10);
    subject.linear_damping = 2;
    return subject;
}

} // namespace

TEST_CASE("a cloth that hangs stays where it is") {
    for (const bool limp : {false, true}) {
        Net net = small_net();
        if (limp) {
            net.shear = soft(1e-5);
            net.bend = soft(1e-3, 0.1);
        }
        const Asset asset = net.build();
        Trial trial(resting(subject_of(net, asset)));
        trial.pin(0);
        trial.pin(9);
        rest(limp ? "soft cloth that hangs" : "cloth that hangs", trial, 2000, {1e-7, 1e-10});
    }
}

TEST_CASE("a rope that hangs stays where it is") {
    Chain chain;
    chain.particle_mass = 0.01;
    const Asset asset = chain.build();
    Trial trial(resting(subject_of(chain, asset)));
    trial.pin(0);
    trial.pin(19);
    trial.set_target(19, {1, 0, 0});
    rest("rope that hangs", trial, 2000, {1e-7, 1e-10});
}

TEST_CASE("a cloth that lies on the ground or on a ball stays where it is") {
    const Net net = small_net();
    const Asset asset = net.build();
    Subject subject = resting(subject_of(net, asset));
    subject.transform = turned(at(0, 0.6, 0), 1, 0, 0, 90);
    {
        Trial trial(subject);
        trial.add(ground());
        rest("cloth on the ground", trial, 2000, {0, 0});
    }
    {
        Trial trial(subject);
        trial.add(ground());
        lks_collider_def ball = lks_default_collider_def();
        ball.radius = fixed(0.3);
        ball.transform.position = fixed(0, 0.2, 0);
        trial.add(ball);
        rest("cloth over a ball", trial, 2000, {1e-6, 1e-10});
    }
}

TEST_CASE("bodies that may not sleep stay where they are") {
    Jointed scene(world_def(60, 10));
    scene.add_ground(0.5);
    lks_body_def def = lks_default_body_def();
    const auto put = [&](const lks_body_shape& shape, const lks_vec3& position) {
        def.transform.position = position;
        return scene.add(shape, def);
    };
    struct Still {
        const char* name;
        std::size_t body;
        double metres; // however long: what boxes that may not sleep tremble by
        Worst moved{};
        Vector start{}, twin_start{};
    };
    std::vector<Still> still{{"box on the ground", put(box_shape(0.2, 0.2, 0.2), fixed(0, 0.2, 0)), 2e-6},
                             {"ball on the ground", put(ball_shape(0.2), fixed(3, 0.2, 0)), 0}};
    std::size_t above = scene.add_anchor(fixed(9, 3, 0));
    for (int i = 0; i < 4; ++i) {
        const std::size_t link = put(capsule_shape(0.05, 0.1), fixed(9, 2.8 - 0.3 * i, 0));
        lks_joint_def joint = lks_default_joint_def();
        joint.frame_a.position = fixed(0, i == 0 ? -0.05 : -0.15, 0);
        joint.frame_b.position = fixed(0, 0.15, 0);
        scene.join(joint, above, link);
        above = link;
    }
    still.push_back({"last of a chain of four", above, 0});
    scene.step(600);
    for (Still& one : still) {
        one.start = scene.position(one.body);
        one.twin_start = scene.twin_position(one.body);
    }
    Worst energy;
    for (int tick = 0; tick < ticks_of_rest(); ++tick) {
        scene.step();
        for (Still& one : still) {
            one.moved.add((scene.position(one.body) - one.start).length(),
                          (scene.twin_position(one.body) - one.twin_start).length());
        }
        energy.add(scene.kinetic_energy(), scene.twin_kinetic_energy());
    }
    for (const Still& one : still) {
        expect_at_most(named(one.name, ", ", ticks_of_rest(), " ticks of rest"), "moved", "m", one.metres,
                       one.moved.fixed, one.moved.single);
    }
    expect_at_most(named("all three, ", ticks_of_rest(), " ticks of rest"), "kinetic energy, worst", "J",
                   1e-5, energy.fixed, energy.single);
}

TEST_CASE("two boxes upon each other that may not sleep stay where they are") {
    Jointed scene(world_def(60, 10));
    scene.add_ground(0.5, true);
    for (const double height : {0.2, 0.6}) {
        lks_body_def def = lks_default_body_def();
        def.transform.position = fixed(0, height, 0);
        scene.add(box_shape(0.2, 0.2, 0.2), def);
    }
    scene.step(600);
    const Vector start[] = {scene.position(0), scene.position(1)};
    const Vector twin_start[] = {scene.twin_position(0), scene.twin_position(1)};
    Worst moved[2], energy;
    for (int tick = 0; tick < ticks_of_rest(); ++tick) {
        scene.step();
        for (std::size_t i = 0; i < 2; ++i) {
            moved[i].add((scene.position(i) - start[i]).length(),
                         (scene.twin_position(i) - twin_start[i]).length());
        }
        energy.add(scene.kinetic_energy(), scene.twin_kinetic_energy());
    }
    const std::string name = named("two boxes upon each other, ", ticks_of_rest(), " ticks of rest");
    expect_at_most(name, "the lower one moved", "m", 4e-6, moved[0].fixed, moved[0].single);
    expect_at_most(name, "the upper one moved", "m", 1e-5, moved[1].fixed, moved[1].single);
    expect_at_most(name, "kinetic energy, worst", "J", 1e-9, energy.fixed, energy.single);
}
