// A rope wound twenty times around a pole, and pulled: Euler's and Eytelwein's capstan. And poles that move
// off with a rope whose ends stay.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "stability/support/table.h"
#include "stability/support/trial.h"
#include "support/sanitised.h"

using namespace support;
using namespace stability;

namespace {

constexpr int a_turn = 24; // points
constexpr int loose = 20;  // hang down on either side

// The pole lies along z; the rope's first point hangs at its left, the last one, which is heavy, at its
// right.
struct Bounds {
    double joules;  // kinetic, at the end
    double sinks;   // metres
    double stretch; // percent, worst
};

struct WoundRope {
    std::vector<double> points{}, masses{};
    lks_rope_def def = lks_default_rope_def();
};

WoundRope wound_rope(double weight, int turns = 20) {
    WoundRope rope;
    std::vector<double>& points = rope.points;
    constexpr double radius = 0.1105, step = 0.03;
    for (int i = loose; i > 0; --i) {
        points.insert(points.end(), {-radius, -step * i, -0.22});
    }
    for (int i = 0; i <= turns * a_turn + a_turn / 2; ++i) {
        const double angle = std::numbers::pi - 2 * std::numbers::pi * i / a_turn;
        points.insert(points.end(),
                      {radius * std::cos(angle), radius * std::sin(angle), -0.22 + 0.022 * i / a_turn});
    }
    const double end = -0.22 + 0.022 * (turns + 0.5);
    for (int i = 1; i <= loose; ++i) {
        points.insert(points.end(), {radius, -step * i, end});
    }
    rope.masses.assign(points.size() / 3, 0.01);
    rope.masses.back() = weight;
    lks_rope_def& def = rope.def;
    def.segments = 0;
    def.length = 0;
    def.point_count = static_cast<std::uint32_t>(rope.masses.size());
    def.points = points.data();
    def.mass = def.linear_density = 0;
    def.vertex_masses = rope.masses.data();
    def.stretch = stiff();
    def.bend = off;
    def.particle_radius = 0.01;
    def.friction = 1;
    return rope;
}

Subject subject_of(const WoundRope& rope, const Asset& asset) {
    Subject subject;
    subject.asset = &asset;
    subject.masses = rope.masses;
    subject.materials = {stiff(), off, off};
    subject.rope = true;
    subject.radius = 0.01;
    return subject;
}

std::size_t add_pole(Trial& trial, double friction) {
    lks_collider_def pole = lks_default_collider_def();
    pole.shape = LKS_SHAPE_CAPSULE;
    pole.radius = support::fixed(0.1);
    pole.half_length = support::fixed(1);
    pole.transform = turned(at(0, 0, 0), 1, 0, 0, 90);
    pole.static_friction = support::fixed(friction);
    pole.dynamic_friction = support::fixed(friction);
    return trial.add(pole);
}

void wind(const std::string& scene, double friction, const Bounds& bounds) {
    const WoundRope rope = wound_rope(1);
    const Asset asset(rope.def);
    Trial trial(subject_of(rope, asset));
    add_pole(trial, friction);
    if (friction == 0) {
        trial.pin(0);
    }
    const double tail = trial.positions()[0].y;
    const double weight = trial.positions().back().y;
    trial.run(240);
    expect_depth_at_most(scene, trial, 1e-5);
    expect_stretch_at_most(scene, trial, bounds.stretch);
    expect_last_stretch_at_most(scene, trial, 1);
    expect_gain_at_most(scene, trial, 1);
    expect_last_kinetic_energy_at_most(scene, trial, bounds.joules);
    const std::uint32_t last = static_cast<std::uint32_t>(trial.size()) - 1;
    expect_at_most(scene, "weight sank", "m", bounds.sinks, weight - trial.positions()[last].y,
                   weight - trial.twin_position(last).y);
    if (friction > 0) {
        expect_at_most(scene, "tail slipped", "m", 0.003, std::abs(trial.positions()[0].y - tail),
                       std::abs(trial.twin_position(0).y - tail));
    }
    expect_nothing_clamped(trial);
}

// Of a rope that is pulled by more than it can give, and led back.
struct Pull {
    double metres;
    double stretch;      // percent, pulled
    double joules;       // kinetic, pulled
    double off;          // percent of the edges, pulled
    double back_joules;  // kinetic, led back
    double back_seconds; // until it has recovered; 0: it does not
    double back_off = 1; // percent of the edges, at the end
};

// Its tail is pinned, and its other end is led down within a second, stays there for five, is led back within
// one, and stays there: the pole holds the rope apart, whatever it wants.
void pull(const Pull& row) {
    const WoundRope rope = wound_rope(0.01);
    const Asset asset(rope.def);
    Subject subject = subject_of(rope, asset);
    subject.world = world_def(60, 20);
    subject.solver = LKS_ROPE_DIRECT;
    Trial trial(subject);
    add_pole(trial, 0.5);
    const auto last = static_cast<std::uint32_t>(trial.size()) - 1;
    trial.pin(0);
    trial.pin(last);
    trial.run(30);
    const Vector end = trial.positions()[last];
    const auto lead = [&](int tick) {
        trial.set_target(last, {end.x, end.y - row.metres * tick / 60, end.z});
        trial.run(1);
    };
    trial.begin();
    for (int tick = 1; tick <= 60; ++tick) {
        lead(tick);
    }
    trial.run(300);
    std::string scene = named("rope 20 times around a pole, pulled by ", row.metres, " m");
    expect_depth_at_most(scene, trial, 1e-5);
    expect_stretch_at_most(scene, trial, row.stretch, {0, row.off});
    expect_kinetic_energy_at_most(scene, trial, row.joules);
    expect_last_kinetic_energy_at_most(scene, trial, 1e-3);
    trial.begin();
    for (int tick = 59; tick >= 0; --tick) {
        lead(tick);
    }
    trial.run(600);
    scene += ", led back";
    if (row.back_seconds > 0) {
        expect_recovery_within(scene, trial, row.back_seconds);
    }
    expect_last_off_at_most(scene, trial, row.back_off);
    expect_kinetic_energy_at_most(scene, trial, row.back_joules);
    expect_last_kinetic_energy_at_most(scene, trial, 0.01);
    expect_nothing_clamped(trial);
}

struct MovingPole {
    int turns;
    double friction;
    std::uint32_t hz, substeps;
    double joules;      // at any time
    double end_joules;  // when the pole has been back for ten seconds
    double stretch;     // percent, at any time
    double off = 1;     // percent of the edges, at the end
    double seconds = 0; // from when the pole began to move until it has recovered; 0: it does not
};

// Both ends are pinned. place(seconds): of the pole, which is back where it was after so many.
void carry_off(const std::string& how, const MovingPole& row, double seconds,
               const std::function<Vector(double)>& place) {
    const WoundRope rope = wound_rope(0.01, row.turns);
    const Asset asset(rope.def);
    Subject subject = subject_of(rope, asset);
    subject.world = world_def(row.hz, row.substeps);
    subject.solver = LKS_ROPE_DIRECT;
    Trial trial(subject);
    const std::size_t pole = add_pole(trial, row.friction);
    trial.pin(0);
    trial.pin(static_cast<std::uint32_t>(trial.size()) - 1);
    trial.run(static_cast<int>(row.hz / 2));
    trial.begin();
    const auto ticks = static_cast<int>(seconds * row.hz);
    for (int tick = 1; tick <= ticks; ++tick) {
        const Vector p = place(tick / static_cast<double>(row.hz));
        trial.move_to(pole, support::fixed(p.x, p.y, p.z));
        trial.run(1);
    }
    trial.run(static_cast<int>(10 * row.hz));
    const std::string scene = named("rope ", row.turns, " times around a ", row.friction > 0 ? "" : "smooth ",
                                    "pole, ", how, ", ", row.hz, " Hz × ", row.substeps);
    expect_worst_stretch_at_most(scene, trial, row.stretch);
    if (row.seconds > 0) {
        expect_recovery_within(scene, trial, row.seconds);
    }
    expect_last_off_at_most(scene, trial, row.off);
    expect_kinetic_energy_at_most(scene, trial, row.joules);
    expect_last_kinetic_energy_at_most(scene, trial, row.end_joules);
    tell(scene, "speeds clamped", "", static_cast<double>(trial.world().counters().speed_clamps),
         "it clamps nothing");
}

// By 3 m within a second, and back after five. The rope has no room for it.
Vector lift(double time) {
    const double up = time < 1 ? time : time < 6 ? 1 : 7 - time;
    return {0, 3 * up, 0};
}

Vector shake(double time) {
    return {0.5 * std::sin(20 * std::numbers::pi * time), 0, 0};
}

} // namespace

TEST_CASE(
    "a rope wound around a pole that moves off, or is shaken, with its ends held, keeps its energy bounded") {
    // The pole at 3 m/s has 8 J for the rope of five turns, shaken at up to 31 m/s 2.6 kJ for that of twenty.
    const MovingPole lifted[] = {{3, 0.3, 60, 10, 1000, 1, 2000, 60},
                                 {5, 0, 240, 1, 5000, 20, 4000, 1, 15},
                                 {5, 0, 60, 5, 20000, 20, 4000, 1, 15},
                                 {5, 0, 60, 10, 200000, 20, 5000, 1, 15}};
    // Under sanitizers all of it takes minutes: one row.
    for (const MovingPole& row : lifted) {
        carry_off("lifted by 3 m and back", row, 7, lift);
        if (sanitised) {
            break;
        }
    }
    const MovingPole shaken[] = {{20, 0, 60, 5, 5000, 100, 3000, 1, 2},
                                 {20, 0.5, 240, 1, 5000, 100, 5000, 60},
                                 {10, 0.2, 60, 10, 5000, 20, 4000, 1, 3}};
    for (const MovingPole& row : shaken) {
        if (!sanitised) {
            carry_off("shaken by 0.5 m ten times a second", row, 2, shake);
        }
    }
}

TEST_CASE("a rope wound twenty times around a pole and pulled further than it can give comes to rest") {
    pull({0.1, 150, 0.02, 7, 0.01, 2});
    if (!sanitised) {
        pull({0.5, 2000, 1500, 12, 0.1, 0, 7});
        pull({10, 7000, 50, 12, 5, 0, 7});
    }
}

TEST_CASE("a rope wound twenty times around a pole holds a weight") {
    if (!sanitised) {
        wind("rope 20 times around a pole, friction 0.5", 0.5, {1e-4, 0.015, 2});
    }
    wind("rope 20 times around a smooth pole, its tail pinned", 0, {0.2, 0.3, 2});
}
