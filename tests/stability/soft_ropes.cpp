// Ropes that their loads stretch to many times their length, which are solved at once: they hang where they
// should, gain nothing, and come together again from anywhere.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "stability/support/table.h"
#include "stability/support/trial.h"
#include "support/sanitised.h"

using namespace support;
using namespace stability;

namespace {

constexpr double gravity = 9.81;

struct Rate {
    std::uint32_t hz, substeps;
};

std::string rate_name(const Rate& rate) {
    return named(", ", rate.hz, " Hz × ", rate.substeps);
}

Subject subject_at(const Chain& chain, const Asset& rope, const Rate& rate) {
    Subject subject = subject_of(chain, rope);
    subject.masses = chain.masses();
    subject.world = world_def(rate.hz, rate.substeps);
    return subject;
}

// Segments of 5 cm and points of 10 g.
Chain bungee(std::uint32_t segments, double end_mass, double compliance, double damping) {
    Chain chain;
    chain.segments = segments;
    chain.length = 0.05 * segments;
    chain.particle_mass = 0.01;
    chain.end_mass = end_mass;
    chain.stretch = soft(compliance, damping);
    return chain;
}

// The greatest of all that gained, percent; both.
struct Gains {
    double fixed = 0, single = 0;

    void add(const Course& course, double& greatest) {
        greatest = course.gained_share() <= greatest ? greatest : course.gained_share();
    }
    void add(const Trial& trial) {
        add(trial.fixed(), fixed);
        add(trial.single(), single);
    }
};

// Held at one end, let go when it is level.
void swing_all(const Rate& rate) {
    Gains gains;
    double longest = 0;
    for (const std::uint32_t segments : {10u, 30u}) {
        for (const double end : {0.01, 0.1, 1., 10.}) {
            for (const double compliance : {1e-4, 1e-3, 1e-2, 1e-1}) {
                for (const double critical : {0., 0.3, 1., 10.}) {
                    if (sanitised && (critical == 0.3 || critical == 1)) {
                        continue;
                    }
                    const double damping = critical * 2 * std::sqrt(0.01 / compliance);
                    const Chain chain = bungee(segments, end, compliance, damping);
                    const Asset rope = chain.build();
                    Trial trial(subject_at(chain, rope, rate));
                    trial.pin(0);
                    trial.run(static_cast<int>(3 * rate.hz));
                    CHECK(trial.world().counters().speed_clamps == 0);
                    gains.add(trial);
                    longest = std::max(longest, trial.fixed().worst().stretch);
                }
            }
        }
    }
    const std::string scene = "128 ropes of 1e-4 to 0.1 m/N, 10 g to 10 kg at the end" + rate_name(rate);
    expect_at_most(scene, "energy gained, of the greatest motion", "%", 1, 100 * gains.fixed,
                   100 * gains.single);
    expect_at_least(scene, "the longest stretch", "%", 8000, 100 * longest, "as the SDK");
}

// How much lower its end is in the end, than it should be: parts of its length at rest.
void hang(double stretch, double damping, const Rate& rate) {
    Chain chain;
    chain.segments = 50;
    chain.length = 5;
    chain.direction = {0, -1, 0};
    chain.particle_mass = 0.02;
    chain.end_mass = 70;
    const double compliance = stretch * chain.length / chain.segments / (chain.end_mass * gravity);
    chain.stretch = soft(compliance, damping);
    const Asset rope = chain.build();
    Subject subject = subject_at(chain, rope, rate);
    const double swing = std::sqrt(gravity / (stretch * chain.length)); // rad/s
    subject.linear_damping = 2 * swing;
    Trial trial(subject);
    trial.pin(0);
    trial.run(static_cast<int>(40 / swing * rate.hz));
    double length = chain.length;
    for (std::uint32_t i = 0; i < chain.segments; ++i) {
        length += compliance * gravity * (chain.end_mass + chain.particle_mass * (chain.segments - 1.0 - i));
    }
    const auto off = [&](double y) { return 100 * std::abs(-y - length) / chain.length; };
    const std::string scene = named("rope of 5 m that 70 kg stretch by ", 100 * stretch, " %",
                                    damping > 0 ? ", damped" : "", rate_name(rate));
    expect_at_most(scene, "its end, from where it should be", "% of its length", 1e-4,
                   off(trial.positions().back().y), off(trial.twin_position(chain.segments).y));
    expect_last_kinetic_energy_at_most(scene, trial, 1e-6);
}

// Its points at random in a cube of 20 m. What is left of the energy of its springs, percent.
void blow_apart(double compliance, double damping, const Rate& rate) {
    double left = 0;
    double twin_left = 0;
    double clamps = 0;
    for (std::uint32_t seed = 0; seed < 4; ++seed) {
        const Chain chain = bungee(30, seed % 2 == 0 ? 0.01 : 1, compliance, damping);
        const Asset rope = chain.build();
        Trial trial(subject_at(chain, rope, rate));
        trial.pin(0);
        Random random(seed);
        std::vector<Vector> places(chain.segments + 1);
        for (std::size_t i = 1; i < places.size(); ++i) {
            const auto metres = [&random] { return 0.01 * static_cast<double>(random.between(-1000, 1000)); };
            places[i] = {metres(), metres(), metres()};
        }
        trial.put(places);
        trial.begin();
        trial.run(static_cast<int>(10 * rate.hz));
        const auto left_of = [](const Course& course) {
            return (course.last().kinetic_energy + course.last().elastic_energy) /
                   course.start().elastic_energy;
        };
        left = std::max(left, left_of(trial.fixed()));
        const double of_twin = left_of(trial.single());
        twin_left = of_twin <= twin_left ? twin_left : of_twin; // also where it is no number
        clamps += static_cast<double>(trial.world().counters().position_clamps);
    }
    const std::string scene =
        named("four ropes of ", compliance, " m/N, ", damping, " N·s/m, blown apart", rate_name(rate));
    expect_at_most(scene, "energy left, ten seconds later", "%", 6, 100 * left, 100 * twin_left);
    tell(scene, "positions clamped", "", clamps, "it clamps nothing");
}

} // namespace

TEST_CASE("soft ropes that are solved at once gain nothing, however far they are stretched") {
    swing_all({60, 20});
    swing_all({60, 5});
}

TEST_CASE("a soft rope hangs from its load where it should, at any stretch, damped or not") {
    for (const double stretch : {0.5, 2., 8.}) {
        for (const double damping : {0., 50.}) {
            for (const Rate& rate : {Rate{60, 5}, Rate{60, 20}}) {
                hang(stretch, damping, rate);
            }
        }
    }
}

TEST_CASE("soft ropes that were blown apart come to rest") {
    for (const double compliance : {1e-5, 1e-3, 1e-1}) {
        for (const double damping : {1., 50.}) {
            blow_apart(compliance, damping, {60, 20});
            blow_apart(compliance, damping, {60, 5});
        }
    }
}
