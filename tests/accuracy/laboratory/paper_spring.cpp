// The paper's spring: XPBD swings as the implicit step does at any step and number of iterations, PBD does
// not.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>

#include "accuracy/paper.h"

using namespace lks_accuracy;
using reference::Engine;

TEST_CASE("the spring's period is within 0.1 % of the implicit solution at any step and iteration count") {
    for (const Engine engine :
         {Engine::fixed_point, Engine::single_precision, Engine::xpbd, Engine::newton}) {
        double worst = 0;
        for (const double rate : {30.0, 60.0, 120.0, 240.0, 1000.0}) {
            for (const int iterations : {1, 2, 5, 10, 20, 50}) {
                const SpringRun run = run_spring(engine, rate, iterations);
                INFO(name_of(engine) << ", " << rate << " Hz, " << iterations << " iterations");
                CHECK(run.period == doctest::Approx(implicit_spring_period(rate)).epsilon(0.001));
                worst = std::max(worst, std::abs(run.period / implicit_spring_period(rate) - 1));
            }
        }
        std::printf("spring, %-12s period off by at most %.1e %%\n", name_of(engine), 100 * worst);
    }
    // And that one goes to the analytic period with the step.
    CHECK(implicit_spring_period(100000) == doctest::Approx(analytic_spring_period()).epsilon(1e-6));
    CHECK(implicit_spring_period(60) > 1.08 * analytic_spring_period());
}

TEST_CASE("PBD's period depends on iterations and step, as its formula says") {
    constexpr double stiffness = 0.1;
    double last = 1e9;
    for (const int iterations : {1, 5, 10}) {
        // What is left of C after n iterations: x(n+1) = (1 - k)^n · (2x(n) - x(n-1)).
        const double kept = std::pow(1 - stiffness, iterations);
        const double expected = 2 * std::acos(-1.0) / 60 / std::acos(std::sqrt(kept));
        const SpringRun run = run_spring(Engine::pbd, 60, iterations, stiffness);
        std::printf("spring, PBD, k = 0.1, %2d iterations: period %.4f s (spring %.4f s)\n", iterations,
                    run.period, analytic_spring_period());
        CHECK(run.period == doctest::Approx(expected).epsilon(1e-6));
        CHECK(run.period < 0.75 * last);
        last = run.period;
    }
    // The scaled stiffness hides the iterations, not the step.
    const double at_60 = run_spring(Engine::pbd_scaled, 60, 10, stiffness).period;
    CHECK(run_spring(Engine::pbd_scaled, 60, 1, stiffness).period == doctest::Approx(at_60).epsilon(1e-6));
    CHECK(run_spring(Engine::pbd_scaled, 120, 10, stiffness).period ==
          doctest::Approx(at_60 / 2).epsilon(1e-6));
}
