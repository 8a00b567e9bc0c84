// Soft constraints whose multipliers are many times as long as they are: in a substep of a sixtieth of a
// second a light rope would go far if what hangs on it did not hold it.
#include <doctest/doctest.h>

#include <cstdio>

#include "reference/particle_scene.h"

using namespace reference;

TEST_CASE("soft ropes in long substeps hang as low as in double precision, at multipliers of any length") {
    constexpr int segments = 10;
    constexpr double length = 0.03; // of a segment
    constexpr double link = 0.001;  // kg, of a particle
    constexpr double compliance = 0.01;
    for (const double weight : {0.1, 0.5, 2.0, 20.0, 400.0}) {
        ParticleScene scene = make_rope(segments, segments * length, link, {compliance, 0, 1, 0}, {0, -1, 0});
        scene.masses.back() = weight;
        scene.solver = LKS_ROPE_SWEPT;
        scene.linear_damping = 4;
        // XPBD's λ as a length, (w_a + w_b + α̃)·λ.
        const double squared_rate = scene.tick_rate_hz * scene.tick_rate_hz;
        const double multiplier = weight * 9.81 * (2 / link + compliance * squared_rate) / squared_rate;
        const auto lowest = [&](Engine engine) {
            const auto simulation = simulate(engine, scene, {1, 200});
            for (int tick = 0; tick < 120; ++tick) {
                simulation->tick();
            }
            return simulation->positions().back().y;
        };
        const double ours = lowest(Engine::fixed_point);
        const double twin = lowest(Engine::double_precision);
        std::printf("%.1f kg, multipliers of %.1f m: at %.6f m, %.1e m from double precision\n", weight,
                    multiplier, ours, ours - twin);
        INFO(weight << " kg");
        CHECK(ours < -1.3 * segments * length); // it is stretched
        CHECK(ours == doctest::Approx(twin).epsilon(1e-6));
    }
}
