#include <cmath>

#include "paper.h"

namespace lks_accuracy {
namespace {

using reference::Engine;

constexpr int frames = 100;
const double pi = std::acos(-1.0);
const double angular_frequency = 1 / std::sqrt(spring_compliance * spring_mass);

} // namespace

// A linear oscillator keeps y(n+1) = a·y(n) - b·y(n-1): least squares over what has not died away yet.
double spring_period(const std::vector<double>& elongations, double step) {
    double pp = 0, pq = 0, qq = 0, pr = 0, qr = 0;
    for (std::size_t n = 1; n + 1 < elongations.size(); ++n) {
        const double p = elongations[n];
        const double q = elongations[n - 1];
        const double r = elongations[n + 1];
        pp += p * p;
        pq += p * q;
        qq += q * q;
        pr += p * r;
        qr += q * r;
    }
    const double determinant = pp * qq - pq * pq;
    const double a = (pr * qq - qr * pq) / determinant;
    const double b = -(qr * pp - pr * pq) / determinant;
    const double cosine = a / (2 * std::sqrt(b));
    return b > 0 && std::abs(cosine) < 1 ? 2 * pi * step / std::acos(cosine) : 0;
}

reference::ParticleScene spring_scene() {
    reference::ParticleScene scene =
        reference::make_rope(1, 1, spring_mass, {spring_compliance, 0, 1, 0}, {1, 0, 0});
    scene.start[1].x = 1.5;
    scene.gravity = {};
    return scene;
}

double analytic_spring_period() {
    return 2 * pi / angular_frequency;
}

double implicit_spring_period(double rate_hz) {
    return 2 * pi / (rate_hz * std::atan(angular_frequency / rate_hz));
}

SpringRun run_spring(Engine engine, double rate_hz, int iterations, double stiffness) {
    reference::ParticleScene scene = spring_scene();
    scene.tick_rate_hz = rate_hz;
    const auto simulation = simulate(engine, scene, {1, iterations}, stiffness);
    SpringRun run{name_of(engine), rate_hz, iterations};
    for (int frame = 0; frame < frames; ++frame) {
        run.elongations.push_back(simulation->positions()[1].x - 1);
        simulation->tick();
    }
    run.period = spring_period(run.elongations, 1 / rate_hz);
    return run;
}

} // namespace lks_accuracy
