// The reference solvers against each other and against what can be worked out by hand.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>

#include "reference/implicit.h"
#include "reference/particle_scene.h"
#include "reference/position_based.h"
#include "support/numbers.h"

using namespace reference;

namespace {

ParticleScene swinging_rope() {
    return make_rope(8, 1, 0.1, {1e-3, 5, 1, 0}, {1, 0.3, 0.2});
}

double distance(const std::vector<support::Vector>& a, const std::vector<support::Vector>& b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        worst = std::max(worst, (a[i] - b[i]).length());
    }
    return worst;
}

std::vector<support::Vector> positions_after(Engine engine, const ParticleScene& scene,
                                             const Schedule& schedule, int ticks) {
    const auto simulation = simulate(engine, scene, schedule);
    for (int tick = 0; tick < ticks; ++tick) {
        simulation->tick();
    }
    return simulation->positions();
}

// One of each kind, none in a symmetric place.
Model all_kinds() {
    Model model;
    model.positions = {{0, 0, 0}, {1, 0.1, 0}, {0.2, 0.9, 0.1}, {0.3, 0.2, 1.1}};
    model.masses = {1, 2, 0.5, 1.5};
    model.edges = {{0, 1, 1.2, 1e-3, 0}};
    model.triangles = {make_triangle({0, 1, 2}, {{{0, 0}, {1.1, 0}, {0.1, 0.8}}}, 50, 0.3)};
    model.volumes = {{{0, 1, 2, 3}, {{{0, 2, 1}}, {{0, 1, 3}}, {{1, 2, 3}}, {{0, 3, 2}}}, 0.2, 1e-3}};
    return model;
}

} // namespace

TEST_CASE("the gradients of all constraints are the differences of their values") {
    const Model model = all_kinds();
    Points x;
    for (const support::Vector& p : model.positions) {
        x.emplace_back(p);
    }
    constexpr double step = 1e-6;
    Block<double> block, above, below;
    for (std::size_t i = 0; i < constraint_count(model); ++i) {
        evaluate(model, i, x, block);
        for (std::size_t k = 0; k < block.particles.size(); ++k) {
            for (double Vector3<double>::*axis :
                 {&Vector3<double>::x, &Vector3<double>::y, &Vector3<double>::z}) {
                Points moved = x;
                moved[block.particles[k]].*axis += step;
                evaluate(model, i, moved, above);
                moved[block.particles[k]].*axis -= 2 * step;
                evaluate(model, i, moved, below);
                for (std::size_t row = 0; row < block.rows; ++row) {
                    INFO("constraint " << i << ", row " << row << ", particle " << k);
                    CHECK(block.slope(row, k).*axis ==
                          doctest::Approx((above.value[row] - below.value[row]) / (2 * step)).epsilon(1e-6));
                }
            }
        }
    }
}

TEST_CASE("Newton solves eq. 8 and 9 to rounding, at second order, with constraints of every kind") {
    // Wrong curvature would still converge, but only by a factor a step.
    Model model = all_kinds();
    model.pins = {0};
    Settings settings;
    settings.substeps = 1;
    settings.tick_rate_hz = 10;
    ImplicitEuler newton(model, settings, Linearisation::full);
    newton.tick(3);
    CHECK(newton.converged());
    const std::vector<Residual>& residuals = newton.residuals();
    REQUIRE(residuals.size() >= 4);
    CHECK(residuals.size() <= 9);
    CHECK(residuals.back().constraints < 1e-11);
    CHECK(residuals.back().momentum < 1e-11);
    const double last_but_one = residuals[residuals.size() - 2].constraints;
    const double before = residuals[residuals.size() - 3].constraints;
    CHECK(last_but_one < 100 * before * before);
}

TEST_CASE("Newton keeps an inextensible rope's length to 1e-9, and carries its weight") {
    ParticleScene scene = make_rope(8, 1, 0.1, {0, 0, 1, 0}, {0, -1, 0});
    const auto hanging = simulate(Engine::newton, scene, {1, 1});
    hanging->tick();
    CHECK(hanging->force(0) + hanging->force(1) > 0);
    double most = 0;
    for (std::size_t edge = 0; edge < 8; ++edge) {
        most = std::max(most, hanging->force(edge));
    }
    CHECK(most == doctest::Approx(8 * 0.1 * 9.81).epsilon(1e-6));

    scene = make_rope(8, 1, 0.1, {0, 0, 1, 0}, {1, 0, 0});
    const auto swinging = simulate(Engine::newton, scene, {20, 1});
    for (int tick = 0; tick < 60; ++tick) {
        swinging->tick();
    }
    CHECK(stretch_of(model_of(scene), swinging->positions()).worst < 1e-9);
}

TEST_CASE("XPBD to the letter, and in the SDK's form, is one method: 1e-12 m in a second") {
    for (const Schedule& schedule : {Schedule{10, 1}, Schedule{4, 5}}) {
        const auto literal = positions_after(Engine::xpbd, swinging_rope(), schedule, 60);
        CHECK(distance(literal, positions_after(Engine::double_precision, swinging_rope(), schedule, 60)) <
              1e-12);
        CHECK(distance(literal, positions_after(Engine::fixed_point, swinging_rope(), schedule, 60)) < 1e-7);
        const double single =
            distance(literal, positions_after(Engine::xpbd_single, swinging_rope(), schedule, 60));
        CHECK(single > 1e-7);
        CHECK(single < 1e-2);
    }
}

TEST_CASE("one after the other, all at once and by a direct solve end in the same place") {
    ParticleScene scene = swinging_rope();
    scene.materials[0].damping = 0;
    const auto swept = positions_after(Engine::xpbd, scene, {1, 3000}, 10);
    // Not to the last digit: each takes its own gradients on the way, and keeps what they gave (g ≈ 0).
    CHECK(distance(swept, positions_after(Engine::xpbd_jacobi, scene, {1, 20000}, 10)) < 5e-4);
    CHECK(distance(swept, positions_after(Engine::direct_constraints, scene, {1, 20}, 10)) < 2e-3);
    // They differ from the exact step by the geometric stiffness that eq. 16 leaves out: by less in small
    // steps.
    const double coarse = distance(positions_after(Engine::direct_constraints, scene, {1, 20}, 30),
                                   positions_after(Engine::newton, scene, {1, 1}, 30));
    const double fine = distance(positions_after(Engine::direct_constraints, scene, {20, 20}, 30),
                                 positions_after(Engine::newton, scene, {20, 1}, 30));
    std::printf("rope, eq. 16 against the exact step, 0.5 s: %.1e m at 1 substep, %.1e m at 20\n", coarse,
                fine);
    CHECK(fine < coarse / 10);
}

TEST_CASE("a weight on a spring hangs where it should in every solver that knows compliance") {
    ParticleScene scene = make_rope(1, 1, 2, {1e-3, 0, 1, 0}, {0, -1, 0});
    scene.linear_damping = 10;
    scene.record_forces = true;
    for (const Engine engine :
         {Engine::fixed_point, Engine::double_precision, Engine::single_precision, Engine::xpbd,
          Engine::xpbd_single, Engine::xpbd_jacobi, Engine::direct_constraints, Engine::newton}) {
        const auto simulation = simulate(engine, scene, {2, 3});
        for (int tick = 0; tick < 300; ++tick) {
            simulation->tick();
        }
        INFO(name_of(engine));
        CHECK(simulation->positions()[1].y == doctest::Approx(-1 - 1e-3 * 2 * 9.81).epsilon(1e-6));
        CHECK(simulation->force(0) == doctest::Approx(2 * 9.81).epsilon(1e-3));
    }
}
