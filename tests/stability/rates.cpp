// Ticks of 10 to 1000 Hz, with 1 to 100 substeps.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "stability/support/jointed.h"
#include "stability/support/nets.h"
#include "stability/support/table.h"
#include "stability/support/trial.h"
#include "support/sanitised.h"

using namespace support;
using namespace stability;

namespace {

struct Rate {
    std::uint32_t hz, substeps;
    double stretch; // percent
    Aftermath aftermath{};
    Aftermath tethered{};
};

int ticks_of(std::uint32_t hz, std::uint32_t substeps) {
    const double seconds = long_runs() ? 3 : hz * substeps > 20000 ? 0.1 : 1;
    return static_cast<int>(seconds * hz);
}

// Of 32 × 32, let go when it is level, for three seconds.
void hang(const Rate& rate, bool tethered) {
    Net net;
    net.side = 32;
    net.particle_mass = 1.0 / (32 * 32);
    if (tethered) {
        net.anchors = {0, net.side - 1};
    }
    HangingNet hanging(net, world_def(rate.hz, rate.substeps));
    Trial& trial = hanging.trial;
    trial.run(ticks_of(rate.hz, rate.substeps));
    const std::string name =
        named(tethered ? "tethered cloth" : "cloth", " 32 × 32, ", rate.hz, " Hz × ", rate.substeps);
    expect_stretch_at_most(name, trial, rate.stretch, tethered ? rate.tethered : rate.aftermath);
    // At 100,000 substeps a second the roundings of projections, 2^-31 m and more, are speeds.
    expect_gain_at_most(name, trial, rate.hz * rate.substeps > 20000 ? 20 : 1);
    expect_nothing_clamped(trial);
}

constexpr Rate rates[] = {{10, 1, 6e4, {0, 85}, {0, 82}},
                          {10, 10, 1e3, {0, 75}, {0, 60}},
                          {10, 100, 30},
                          {30, 1, 1e4, {0, 88}, {0, 78}},
                          {60, 1, 2500, {0, 87}, {0, 75}},
                          {60, 5, 200, {0, 13}, {0, 3}},
                          {60, 20, 20},
                          {60, 100, 2},
                          {240, 1, 300, {0, 18}, {0, 9}},
                          {240, 20, 4},
                          {1000, 1, 25},
                          {1000, 10, 1},
                          {1000, 100, 0.25}};

// Two metres, pinned at one end and let go when level. In a substep of 0.1 s it falls by two segments of 40,
// and by five of 99.
void let_go(std::uint32_t segments, double end, const Rate& rate, std::uint32_t solver = LKS_ROPE_DIRECT) {
    Chain chain;
    chain.segments = segments;
    chain.solver = solver;
    chain.particle_mass = 0.01;
    chain.end_mass = 0.01 * end;
    const Asset asset = chain.build();
    Subject subject = subject_of(chain, asset);
    subject.masses = chain.masses();
    subject.world = world_def(rate.hz, rate.substeps);
    Trial trial(subject);
    trial.pin(0);
    const double seconds = rate.hz * rate.substeps > 20000 && !long_runs() ? 0.5 : 5;
    trial.run(static_cast<int>(seconds * rate.hz));
    const std::string heavy = end > 1 ? named(", 1:", end, " at the end") : "";
    const std::string automatic = solver == LKS_ROPE_AUTOMATIC ? "automatic " : "";
    const std::string name =
        named(automatic, "rope of ", segments, heavy, ", ", rate.hz, " Hz × ", rate.substeps);
    expect_stretch_at_most(name, trial, rate.stretch, rate.aftermath);
    expect_gain_at_most(name, trial, 1);
    expect_nothing_clamped(trial);
}

constexpr Rate light_rope[] = {{10, 1, 0.1},     {10, 10, 0.06},   {10, 100, 7e-4},   {20, 1, 0.12},
                               {30, 1, 0.12},    {60, 1, 0.12},    {60, 5, 0.2},      {60, 20, 0.05},
                               {60, 100, 3e-4},  {240, 1, 0.18},   {240, 20, 1.5e-3}, {1000, 1, 0.1},
                               {1000, 10, 3e-4}, {1000, 100, 3e-7}};
constexpr Rate heavy_rope[] = {{10, 1, 0.12},    {10, 10, 0.15},   {10, 100, 5e-5},   {20, 1, 0.12},
                               {30, 1, 0.1},     {60, 1, 0.06},    {60, 5, 1.6e-3},   {60, 20, 4e-5},
                               {60, 100, 3e-4},  {240, 1, 2.5e-3}, {240, 20, 1.5e-3}, {1000, 1, 4e-4},
                               {1000, 10, 3e-4}, {1000, 100, 3e-7}};
constexpr Rate fine_rope[] = {{10, 1, 0.08}, {10, 2, 0.1}, {10, 10, 0.04}, {20, 1, 0.12}, {60, 1, 0.13}};
constexpr Rate fine_heavy_rope[] = {
    {10, 1, 0.12}, {10, 2, 0.12}, {10, 10, 5e-3}, {20, 1, 0.12}, {60, 1, 0.13}};
// Ten tonnes: the first solves of a substep push the particle beside the pin aside, by more than 16 m.
constexpr Rate heaviest_rope[] = {{10, 1, 0.15}, {10, 2, 0.15}, {10, 10, 0.15}, {60, 1, 0.2}, {60, 5, 0.15}};

// Swept from 960 substeps a second on, and solved at once below.
constexpr Rate automatic_rope[] = {{10, 1, 0.12}, {60, 1, 0.18},  {60, 5, 0.09},
                                   {60, 20, 6},   {60, 100, 0.5}, {240, 1, 0.17},
                                   {240, 4, 8.5}, {1000, 1, 8},   {1000, 10, 0.25}};

// A weight of 1:10,000 in the middle of 40 segments, between pins as far apart as they are long: solves come
// near it by half at a time.
void hang_between_pins(const Rate& rate) {
    constexpr std::uint32_t segments = 40;
    std::vector<double> masses(segments + 1, 0.01), points;
    masses[segments / 2] = 100;
    for (std::uint32_t i = 0; i <= segments; ++i) {
        points.insert(points.end(), {2.0 * i / segments, 0, 0});
    }
    lks_rope_def def = lks_default_rope_def();
    def.segments = 0;
    def.length = def.mass = def.linear_density = def.particle_radius = 0;
    def.point_count = segments + 1;
    def.points = points.data();
    def.vertex_masses = masses.data();
    def.stretch = stiff();
    def.bend = off;
    def.solver = LKS_ROPE_DIRECT;
    const Asset asset(def);
    Subject subject;
    subject.asset = &asset;
    subject.masses = masses;
    subject.materials = {stiff(), off, off};
    subject.rope = true;
    subject.solver = def.solver;
    subject.world = world_def(rate.hz, rate.substeps);
    Trial trial(subject);
    trial.pin(0);
    trial.pin(segments);
    trial.run(static_cast<int>(20 * rate.hz));
    const std::string name = named("weight of 1:10000 between two pins, ", rate.hz, " Hz × ", rate.substeps);
    expect_stretch_at_most(name, trial, rate.stretch, rate.aftermath);
    expect_nothing_clamped(trial);
}

struct BodyRate {
    std::uint32_t hz, substeps;
    double gap; // millimetres
};

// Eight links, ten times the weight at the end, let go when they are level.
void swing(const BodyRate& rate) {
    Jointed scene(world_def(rate.hz, rate.substeps));
    scene.add_chain(8, 10);
    const JointCourse course = run(scene, ticks_of(rate.hz, rate.substeps));
    const std::string name = named("8 links jointed, 1:10 at the end, ", rate.hz, " Hz × ", rate.substeps);
    expect_at_most(name, "joints apart, worst", "mm", rate.gap, 1000 * course.gap.fixed,
                   1000 * course.gap.single);
    expect_at_most(name, "energy gained, of the greatest motion", "%", 1, 100 * course.gained_share.fixed,
                   100 * course.gained_share.single);
    CHECK(scene.world().counters().speed_clamps == 0);
}

// With a heavy end at few substeps, of which each takes what it pulls with in free fall alone for 98 km at 10
// Hz and 1 : 10⁶. For five seconds.
void swing_heavy(std::uint32_t links, double ratio, const BodyRate& rate) {
    Jointed scene(world_def(rate.hz, rate.substeps));
    scene.add_chain(links, ratio);
    const JointCourse course = run(scene, static_cast<int>(5 * rate.hz));
    const std::string name =
        named(links, " links jointed, 1:", ratio, " at the end, ", rate.hz, " Hz × ", rate.substeps);
    expect_at_most(name, "joints apart, worst", "mm", rate.gap, 1000 * course.gap.fixed,
                   1000 * course.gap.single);
    expect_at_most(name, "joints apart, at the end", "mm", 1e-4, 1000 * scene.gap(), 1000 * scene.twin_gap());
    expect_at_most(name, "energy gained, of the greatest motion", "%", 0.1, 100 * course.gained_share.fixed,
                   100 * course.gained_share.single);
    CHECK(scene.world().counters().speed_clamps == 0);
}

// A box and a capsule fall on the ground from 20 cm.
void fall(const BodyRate& rate) {
    Jointed scene(world_def(rate.hz, rate.substeps));
    scene.add_ground(0.5);
    lks_body_def def = lks_default_body_def();
    def.transform = turned(at(0, 0.5, 0), 1, 2, 3, 20);
    const std::size_t box = scene.add(box_shape(0.2, 0.2, 0.2), def);
    def.transform = turned(at(2, 0.5, 0), 0, 0, 1, 80);
    const std::size_t capsule = scene.add(capsule_shape(0.1, 0.2), def);
    const JointCourse course = run(scene, ticks_of(rate.hz, rate.substeps));
    const std::string name = named("box and capsule that fall, ", rate.hz, " Hz × ", rate.substeps);
    expect_at_most(name, "energy gained, of the greatest motion", "%", 1, 100 * course.gained_share.fixed,
                   100 * course.gained_share.single);
    if (scene.position(box).y < 0.45) {
        expect_at_least(name, "capsule's middle above the ground, at the end", "m", 0.09,
                        scene.position(capsule).y, scene.twin_position(capsule).y);
    }
    CHECK(scene.world().counters().speed_clamps == 0);
}

} // namespace

TEST_CASE("a cloth hangs at any tick rate and any number of substeps, with and without tethers") {
    for (const Rate& rate : rates) {
        if (sanitised && rate.substeps > 10) {
            continue;
        }
        hang(rate, false);
        hang(rate, true);
    }
}

TEST_CASE("a rope that is solved at once hangs at any tick rate and any number of substeps") {
    for (const Rate& rate : light_rope) {
        let_go(40, 1, rate);
    }
    for (const Rate& rate : heavy_rope) {
        if (sanitised && rate.substeps > 10) {
            continue;
        }
        let_go(40, 100, rate);
    }
    for (const Rate& rate : fine_rope) {
        let_go(99, 1, rate);
    }
    for (const Rate& rate : fine_heavy_rope) {
        let_go(99, 1e4, rate);
    }
    for (const Rate& rate : heaviest_rope) {
        for (const std::uint32_t segments : {10u, 20u, 40u}) {
            let_go(segments, 1e6, rate);
        }
    }
    let_go(20, 1e5, {10, 1, 0.15});
    let_go(99, 1e6, {10, 2, 0.15});
    for (const Rate& rate : {Rate{10, 1, 1}, Rate{10, 2, 0.2}, Rate{60, 1, 0.2}}) {
        hang_between_pins(rate);
    }
}

TEST_CASE("a rope that its world chooses the solver of hangs at any tick rate and any number of substeps") {
    for (const Rate& rate : automatic_rope) {
        let_go(20, 1, rate, LKS_ROPE_AUTOMATIC);
    }
}

TEST_CASE("bodies hang on their joints and fall at any tick rate and any number of substeps") {
    for (const BodyRate& rate :
         {BodyRate{10, 1, 0.5}, BodyRate{10, 10, 1e-4}, BodyRate{10, 100, 1e-5}, BodyRate{30, 1, 0.01},
          BodyRate{60, 1, 1e-3}, BodyRate{60, 5, 1e-5}, BodyRate{60, 20, 1e-5}, BodyRate{60, 100, 1e-5},
          BodyRate{240, 1, 1e-5}, BodyRate{240, 20, 1e-5}, BodyRate{1000, 1, 1e-5}, BodyRate{1000, 10, 1e-5},
          BodyRate{1000, 100, 1e-5}}) {
        swing(rate);
        fall(rate);
    }
}

TEST_CASE("bodies of a million times the mass hang on joints at any tick rate") {
    for (const double ratio : {1e4, 1e5, 1e6}) {
        for (const BodyRate& rate :
             {BodyRate{60, 1, 1e-4}, BodyRate{30, 1, 1e-4}, BodyRate{10, 1, 1e-4}, BodyRate{10, 10, 1e-4}}) {
            swing_heavy(2, ratio, rate);
        }
        for (const BodyRate& rate :
             {BodyRate{60, 1, 0.1}, BodyRate{30, 1, 1}, BodyRate{10, 1, 300}, BodyRate{10, 10, 1e-4}}) {
            swing_heavy(8, ratio, rate);
        }
    }
    swing_heavy(3, 1e6, {60, 1, 5});
    swing_heavy(3, 1e6, {10, 1, 1000});
    swing_heavy(3, 1e6, {10, 10, 1e-4});
    swing_heavy(20, 1e6, {60, 1, 0.1});
}
