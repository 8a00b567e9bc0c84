// What has come to rest stays there: a million ticks without creep, drift or energy.
#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

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

double farthest(const std::vector<Vector>& a, const std::vector<Vector>& b) {
    double distance = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        distance = std::max(distance, (a[i] - b[i]).length());
    }
    return distance;
}

std::vector<Vector> twin_positions(const Trial& trial) {
    std::vector<Vector> positions;
    for (std::uint32_t i = 0; i < trial.size(); ++i) {
        positions.push_back(trial.twin_position(i));
    }
    return positions;
}

// Lets it come to rest, and looks how far it gets from there, and how fast it is, a thousand times.
void rest(const std::string& what, Trial& trial, int settling, const Bounds& bounds) {
    trial.skip(settling);
    trial.begin();
    const std::vector<Vector> start = trial.positions();
    const std::vector<Vector> twin_start = twin_positions(trial);
    double moved = 0, twin_moved = 0;
    for (int look = 0; look < 1000; ++look) {
        trial.skip(ticks_of_rest() / 1000 - 1);
        trial.run(1);
        moved = std::max(moved, farthest(trial.positions(), start));
        twin_moved = std::max(twin_moved, farthest(twin_positions(trial), twin_start));
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
        rest(limp ? "soft cloth that hangs" : "cloth that hangs", trial, 2000, {1e-6, 1e-9});
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
    rest("rope that hangs", trial, 2000, {1e-6, 1e-9});
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
        rest("cloth over a ball", trial, 2000, {1e-5, 1e-9});
    }
}

TEST_CASE("bodies that may not sleep stay where they are") {
    World world(world_def(60, 10));
    add_ground(world);
    lks_body_def def = lks_default_body_def();
    def.never_sleeps = 1;
    std::vector<lks_body_id> bodies;
    bodies.push_back(add_body(world, box_shape(0.2, 0.2, 0.2), fixed(0, 0.2, 0), def));
    bodies.push_back(add_body(world, ball_shape(0.2), fixed(3, 0.2, 0), def));
    bodies.push_back(add_body(world, box_shape(0.2, 0.2, 0.2), fixed(6, 0.2, 0), def));
    bodies.push_back(add_body(world, box_shape(0.2, 0.2, 0.2), fixed(6, 0.6, 0), def));
    const char* names[] = {"box on the ground", "ball on the ground", "lower of two boxes",
                           "upper of two boxes", "last of a chain of four"};
    lks_body_id above = add_anchor(world, fixed(9, 3, 0));
    for (int i = 0; i < 4; ++i) {
        const lks_body_id link = add_body(world, capsule_shape(0.05, 0.1), fixed(9, 2.8 - 0.3 * i, 0), def);
        lks_joint_def joint = lks_default_joint_def();
        joint.frame_a.position = fixed(0, i == 0 ? -0.05 : -0.15, 0);
        joint.frame_b.position = fixed(0, 0.15, 0);
        add_joint(world, joint, above, link);
        above = link;
    }
    bodies.push_back(above);
    world.step(600);
    std::vector<Vector> start;
    for (const lks_body_id body : bodies) {
        start.push_back(state_of(world, body).position);
    }
    std::vector<double> moved(bodies.size());
    double energy = 0;
    for (int look = 0; look < 1000; ++look) {
        world.step(static_cast<std::uint64_t>(ticks_of_rest() / 1000));
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            moved[i] = std::max(moved[i], (state_of(world, bodies[i]).position - start[i]).length());
        }
        energy = std::max(energy, energy_of(world));
    }
    // Metres, however long: what boxes that may not sleep tremble by.
    const double bounds[] = {2e-6, 0, 4e-6, 1e-5, 0};
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        expect_at_most(named(names[i], ", ", ticks_of_rest(), " ticks of rest"), "moved", "m", bounds[i],
                       moved[i]);
    }
    expect_at_most(named("all five, ", ticks_of_rest(), " ticks of rest"), "kinetic energy, worst", "J", 1e-5,
                   energy);
}
