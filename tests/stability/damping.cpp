// Damping from none to a thousand times critical.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "stability/support/jointed.h"
#include "stability/support/nets.h"
#include "stability/support/table.h"
#include "stability/support/trial.h"
#include "support/sanitised.h"

using namespace support;
using namespace stability;

namespace {

constexpr double factors[] = {0, 0.1, 1, 10, 100, 1e3};

std::string name_of(const std::string& what, double factor) {
    return named(what, ", ", factor, " × critical");
}

} // namespace

TEST_CASE("a spring with up to a thousand times its critical damping follows the implicit solution") {
    // One kilogram and 1e-3 m/N, let go 10 cm beyond its rest length, weightless, for two seconds.
    const double stiffness = 1000;
    for (const double factor : factors) {
        const double damping = factor * 2 * std::sqrt(stiffness);
        Chain spring;
        spring.segments = 1;
        spring.length = 1;
        spring.stretch = soft(1 / stiffness, damping);
        const Asset asset = spring.build();
        Subject subject = subject_of(spring, asset);
        subject.world.gravity = {};
        Trial trial(subject);
        trial.pin(0);
        trial.put({{0, 0, 0}, {1.1, 0, 0}});
        trial.run(120);
        const double h = 1.0 / 1200;
        double x = 0.1, v = 0;
        for (int substep = 0; substep < 2400; ++substep) {
            v = (v - h * stiffness * x) / (1 + h * damping + h * h * stiffness);
            x += h * v;
        }
        const auto error = [&](double end) { return std::abs(end - 1 - x) / 0.1; };
        const std::string name = name_of("spring", factor);
        expect_at_most(name, "off the implicit solution after 2 s, of its start", "%", 1e-3,
                       100 * error(trial.positions()[1].x), 100 * error(trial.twin_position(1).x));
        expect_at_most(name, "energy gained, of the start's", "%", 1e-3,
                       100 * trial.fixed().gained() / trial.fixed().start().elastic_energy,
                       100 * trial.single().gained() / trial.single().start().elastic_energy);
    }
}

namespace {

void hang_cloths(bool tethered) {
    // A thousand times critical, one iteration a substep does not stop what gravity adds in it.
    const double plain[2][6] = {{4, 4, 4, 10, 40, 200}, {200, 200, 200, 200, 600, 1200}};
    const double held[2][6] = {{4, 4, 4, 10, 15, 40}, {200, 200, 200, 200, 600, 1000}};
    const auto& bounds = tethered ? held : plain;
    // Soft, they hang longer than their threads are by nature.
    const Aftermath plain_after[2][6] = {{{}, {}, {}, {}, {18}, {0, 40}},
                                         {{0, 2}, {0, 3}, {0, 6}, {0, 48}, {0, 83}, {0, 88}}};
    const Aftermath held_after[2][6] = {{{}, {}, {}, {}, {}, {0, 8}},
                                        {{0, 2}, {0, 3}, {0, 6}, {0, 48}, {0, 84}, {0, 88}}};
    const auto& aftermaths = tethered ? held_after : plain_after;
    for (const int soft_one : {0, 1}) {
        const double compliance = soft_one ? 1e-2 : 1e-6;
        for (int i = 0; i < 6; i += sanitised ? 3 : 1) {
            const double factor = factors[i];
            Net net = small_net(tethered);
            const double critical = 2 * std::sqrt(net.particle_mass / compliance);
            net.stretch = net.shear = net.bend = soft(compliance, factor * critical);
            HangingNet hanging(net);
            Trial& trial = hanging.trial;
            const Aftermath& aftermath = aftermaths[soft_one][i];
            trial.run(aftermath.seconds > 0 ? 1200 : 240);
            const std::string name = name_of(
                named(tethered ? "tethered cloth" : "cloth", " 12 × 12, ", compliance, " m/N"), factor);
            expect_gain_at_most(name, trial, 1);
            expect_stretch_at_most(name, trial, bounds[soft_one][i], aftermath);
            expect_nothing_clamped(trial);
        }
    }
}

// Three capsules in a level chain on soft joints, let go.
void hang_joints(double factor) {
    Jointed scene(world_def(60, 20));
    std::size_t above = scene.add_anchor({});
    const double mass = 1, compliance = 1e-4;
    for (int i = 0; i < 3; ++i) {
        lks_body_def def = lks_default_body_def();
        def.transform = turned(at(0.15 + 0.3 * i, 0, 0), 0, 0, 1, -90);
        def.mass = support::fixed(mass);
        const std::size_t link = scene.add(capsule_shape(0.05, 0.1), def);
        lks_joint_def joint = lks_default_joint_def();
        joint.frame_a.position = support::fixed(0, i == 0 ? 0 : 0.15, 0);
        joint.frame_b.position = support::fixed(0, -0.15, 0);
        joint.compliance = support::fixed(compliance);
        joint.damping = support::fixed(factor * 2 * std::sqrt(mass / compliance));
        scene.join(joint, above, link);
        above = link;
    }
    const JointCourse course = run(scene, 240);
    const std::string name = name_of("3 links on joints of 1e-4 m/N", factor);
    expect_at_most(name, "energy gained, of the greatest motion", "%", 1, 100 * course.gained_share.fixed,
                   100 * course.gained_share.single);
    // Three kilograms that swing hang on it with some ninety newtons.
    expect_at_most(name, "joints apart, worst", "mm",
                   factor > 100  ? 2
                   : factor > 10 ? 8
                                 : 40,
                   1000 * course.gap.fixed, 1000 * course.gap.single);
}

// The chain of mass_ratios, in bodies whose motion is damped by so much a second.
void hang_damped_bodies(double damping) {
    Jointed scene(world_def(60, 20));
    scene.add_chain(8, 10, damping);
    const JointCourse course = run(scene, 240);
    const std::string name = named("8 links jointed, 1:10 at the end, bodies damped by ", damping, " 1/s");
    expect_at_most(name, "energy gained, of the greatest motion", "%", 0.1, 100 * course.gained_share.fixed,
                   100 * course.gained_share.single);
    expect_at_most(name, "joints apart, worst", "mm", 1e-5, 1000 * course.gap.fixed,
                   1000 * course.gap.single);
}

} // namespace

TEST_CASE("a cloth with up to a thousand times its critical damping gains nothing") {
    hang_cloths(false);
    hang_cloths(true);
}

TEST_CASE("joints with up to a thousand times their critical damping hold and gain nothing") {
    for (const double factor : factors) {
        hang_joints(factor);
    }
}

TEST_CASE("bodies that are damped by nothing or by the most that there is hold together and gain nothing") {
    for (const double damping : {0.0, 1.0, 30.0, 1000.0}) {
        hang_damped_bodies(damping);
    }
}
