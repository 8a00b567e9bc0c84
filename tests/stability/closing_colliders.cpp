// Kinematic colliders that close on a cloth and leave it no way out, and open again.
#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <vector>

#include "stability/support/nets.h"
#include "stability/support/table.h"
#include "stability/support/trial.h"
#include "support/sanitised.h"

using namespace support;
using namespace stability;

namespace {

Net small_net() {
    return kilogram_net(20, 1);
}

lks_collider_def block(double x, double y, double z, const lks_vec3& position) {
    lks_collider_def def = lks_default_collider_def();
    def.shape = LKS_SHAPE_BOX;
    def.half_extents = fixed(x, y, z);
    def.transform.position = position;
    return def;
}

struct Bounds {
    double stretch; // percent, while it is shut, and afterwards
    double joules;  // kinetic, while it is shut
    double off;     // percent of the edges, in the end
    double seconds; // from when it opens until it has recovered
};

void judge(const std::string& scene, Trial& trial, int closed_ticks, const Bounds& bounds,
           const std::function<void(double)>& open) {
    trial.run(closed_ticks);
    expect_worst_stretch_at_most(scene + ", closed", trial, bounds.stretch);
    expect_kinetic_energy_at_most(scene + ", closed", trial, bounds.joules);
    trial.begin();
    for (int tick = 1; tick <= 30; ++tick) {
        open(tick / 30.0);
        trial.run(1);
    }
    trial.run(270);
    expect_worst_stretch_at_most(scene + ", opened", trial, bounds.stretch);
    expect_recovery_within(scene + ", opened", trial, bounds.seconds);
    expect_last_off_at_most(scene + ", opened", trial, bounds.off);
    expect_kinetic_energy_at_most(scene + ", opened", trial, 10);
    // Out of all of them, once there is room.
    trial.begin();
    trial.run(1);
    expect_depth_at_most(scene + ", opened, at the end", trial, 1e-5);
    expect_nothing_clamped(trial);
}

void meet(const std::string& scene, const Net& net) {
    const Asset asset = net.build();
    Trial trial(subject_of(net, asset));
    trial.pin(0);
    trial.pin(19);
    const auto left = [](double shut) { return fixed(0, -0.2, -1.0 + 0.65 * shut); };
    const auto right = [](double shut) { return fixed(0, -0.2, 1.0 - 0.65 * shut); };
    // Higher and wider than the cloth, pins and all, and a metre thick: shut, they overlap by 30 cm.
    const std::size_t a = trial.add(block(1, 1.5, 0.5, left(0)));
    const std::size_t b = trial.add(block(1, 1.5, 0.5, right(0)));
    trial.run(120);
    trial.begin();
    for (int tick = 1; tick <= 30; ++tick) {
        trial.move_to(a, left(tick / 30.0));
        trial.move_to(b, right(tick / 30.0));
        trial.run(1);
    }
    judge(scene, trial, 120, {400, 30, 1, 0.3}, [&](double opened) {
        trial.move_to(a, left(1 - opened));
        trial.move_to(b, right(1 - opened));
    });
}

} // namespace

TEST_CASE("two blocks meet on a hanging cloth and go into each other, with and without tethers") {
    Net net = small_net();
    if (!sanitised) {
        meet("cloth between two blocks", net);
    }
    net.anchors = {0, 19};
    meet("tethered cloth between two blocks", net);
}

TEST_CASE("a press goes through the ground with a cloth under it") {
    const Net net = small_net();
    const Asset asset = net.build();
    Subject subject = subject_of(net, asset);
    subject.transform = turned(at(0, 0.05, 0), 1, 0, 0, 90);
    Trial trial(subject);
    lks_collider_def ground = lks_default_collider_def();
    ground.shape = LKS_SHAPE_PLANE;
    trial.add(ground);
    const auto height = [](double shut) { return fixed(0, 0.5 - 0.4 * shut, 0); };
    const std::size_t press = trial.add(block(0.3, 0.2, 0.3, height(0)));
    trial.run(60);
    trial.begin();
    for (int tick = 1; tick <= 30; ++tick) {
        trial.move_to(press, height(tick / 30.0));
        trial.run(1);
    }
    judge("cloth under a press", trial, 120, {600, 5, 2, 0.3},
          [&](double opened) { trial.move_to(press, height(1 - opened)); });
}

struct Crush {
    double room;    // m between opposite walls where they are nearest; negative: into each other
    double stretch; // percent, while it is shut, and afterwards
    double joules;  // kinetic, while it is shut
    double opened;  // the same afterwards
    double off;     // percent of the edges, in the end: nothing keeps a cloth from staying folded into itself
    double rest;    // J, kinetic, in the end
};

// From 2 m apart within half a second, and back after two. The cloth hangs askew: one that lies along the
// walls has nowhere to fold to, and is crushed within its plane.
void crush(const std::string& scene, const Crush& bounds) {
    const Net net = small_net();
    const Asset asset = net.build();
    Subject subject = subject_of(net, asset);
    subject.transform = turned(at(0, 0.5, 0), 1, 0.3, 0, 20);
    Trial trial(subject);
    const Vector ways[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    constexpr double thickness = 0.5;
    const auto place = [&](const Vector& way, double shut) {
        const double away = thickness + 1 - (1 - bounds.room / 2) * shut;
        return fixed(way.x * away, way.y * away, way.z * away);
    };
    const auto extent = [](double way) { return way == 0 ? 3 : thickness; };
    std::vector<std::size_t> walls;
    for (const Vector& way : ways) {
        walls.push_back(trial.add(block(extent(way.x), extent(way.y), extent(way.z), place(way, 0))));
    }
    const auto move = [&](double shut) {
        for (std::size_t i = 0; i < walls.size(); ++i) {
            trial.move_to(walls[i], place(ways[i], shut));
        }
        trial.run(1);
    };
    trial.run(15);
    trial.begin();
    for (int tick = 1; tick <= 30; ++tick) {
        move(tick / 30.0);
    }
    trial.run(120);
    expect_worst_stretch_at_most(scene + ", closed", trial, bounds.stretch);
    expect_kinetic_energy_at_most(scene + ", closed", trial, bounds.joules);
    expect_last_kinetic_energy_at_most(scene + ", closed", trial, 1e-6);
    trial.begin();
    for (int tick = 1; tick <= 30; ++tick) {
        move(1 - tick / 30.0);
    }
    trial.run(270);
    expect_worst_stretch_at_most(scene + ", opened", trial, bounds.stretch);
    expect_kinetic_energy_at_most(scene + ", opened", trial, bounds.opened);
    expect_last_kinetic_energy_at_most(scene + ", opened", trial, bounds.rest);
    expect_last_off_at_most(scene + ", opened", trial, bounds.off);
    trial.begin();
    trial.run(1);
    expect_depth_at_most(scene + ", opened, at the end", trial, 1e-5);
    expect_nothing_clamped(trial);
}

TEST_CASE("six walls close on a cloth from all sides and open again") {
    crush("cloth between six walls, 40 cm of room", {0.4, 300, 60, 30, 15, 0.1});
    crush("cloth between six walls, 20 cm of room", {0.2, 400, 60, 90, 40, 0.1});
    crush("cloth between six walls, no room", {-0.2, 600, 250, 1500, 80, 10});
}
