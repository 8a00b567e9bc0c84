// Damping from none to a thousand times critical.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "stability/support/table.h"
#include "stability/support/trial.h"

using namespace support;
using namespace stability;

namespace {

constexpr double factors[] = {0, 0.1, 1, 10, 1e3};

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

TEST_CASE("a cloth with up to a thousand times its critical damping gains nothing") {
    // A thousand times critical, one iteration a substep does not stop what gravity adds in it.
    const double bounds[2][5] = {{4, 4, 4, 10, 200}, {200, 200, 200, 200, 1200}};
    for (const int soft_one : {0, 1}) {
        const double compliance = soft_one ? 1e-2 : 1e-6;
        for (int i = 0; i < 5; ++i) {
            const double factor = factors[i];
            Net net;
            net.side = 12;
            net.width = 1;
            net.particle_mass = 0.01;
            const double critical = 2 * std::sqrt(net.particle_mass / compliance);
            net.stretch = net.shear = net.bend = soft(compliance, factor * critical);
            const Asset asset = net.build();
            Subject subject = subject_of(net, asset);
            subject.transform = turned(lks_transform_identity(), 1, 0, 0, 90);
            Trial trial(subject);
            trial.pin(0);
            trial.pin(net.side - 1);
            trial.run(240);
            const std::string name = name_of(named("cloth 12 × 12, ", compliance, " m/N"), factor);
            expect_gain_at_most(name, trial, 1);
            expect_stretch_at_most(name, trial, bounds[soft_one][i]);
            expect_nothing_clamped(trial);
        }
    }
}
