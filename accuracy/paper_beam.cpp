#include <algorithm>
#include <cmath>
#include <utility>

#include "paper.h"
#include "reference/implicit.h"

namespace lks_accuracy {
namespace {

constexpr int frames = 50;
constexpr double frame_seconds = 0.008;
constexpr std::size_t columns = 11;
constexpr std::size_t rows = 3;
constexpr double length = 1;
constexpr double height = 0.2;
constexpr double mass = 40; // kg: 200 kg/m²
constexpr double young = 1e5;
constexpr double poisson = 0.3;

reference::Model beam() {
    reference::Model model;
    std::vector<std::array<double, 2>> places;
    for (std::size_t column = 0; column < columns; ++column) {
        for (std::size_t row = 0; row < rows; ++row) {
            places.push_back({length * static_cast<double>(column) / (columns - 1),
                              height * (static_cast<double>(row) / (rows - 1) - 0.5)});
            model.positions.push_back({places.back()[0], places.back()[1], 0});
            if (column == 0) {
                model.pins.push_back(static_cast<std::uint32_t>(row));
            }
        }
    }
    model.masses.assign(places.size(), mass / static_cast<double>(places.size()));
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        model.triangles.push_back(reference::make_triangle(
            {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)},
            {places[a], places[b], places[c]}, young, poisson));
    };
    for (std::size_t column = 0; column + 1 < columns; ++column) {
        for (std::size_t row = 0; row + 1 < rows; ++row) {
            const std::size_t corner = column * rows + row;
            add(corner, corner + rows, corner + rows + 1);
            add(corner, corner + rows + 1, corner + 1);
        }
    }
    return model;
}

template <typename Positions>
double tip_of(const Positions& positions) {
    return positions[(columns - 1) * rows + rows / 2].y;
}

double farthest(const std::vector<double>& a, const std::vector<double>& b) {
    double most = 0;
    for (std::size_t frame = 0; frame < a.size(); ++frame) {
        most = std::max(most, std::abs(a[frame] - b[frame]));
    }
    return most;
}

template <typename Scalar>
BeamRun sweep(reference::Engine engine, const reference::Model& model, const reference::Settings& settings,
              const BeamRun& exact) {
    reference::PositionBased<Scalar> solver(model, settings, reference::Method::xpbd);
    BeamRun run{name_of(engine), settings.iterations};
    for (int frame = 0; frame < frames; ++frame) {
        solver.tick();
        run.tip.push_back(tip_of(solver.positions()));
    }
    run.worst_distance = farthest(run.tip, exact.tip);
    return run;
}

} // namespace

Beam run_beam(const std::vector<int>& iterations) {
    const reference::Model model = beam();
    reference::Settings settings;
    settings.tick_rate_hz = 1 / frame_seconds;
    settings.substeps = 1;
    Beam beam;
    reference::ImplicitEuler newton(model, settings, reference::Linearisation::full);
    BeamRun exact{name_of(reference::Engine::newton)};
    for (int frame = 0; frame < frames; ++frame) {
        newton.tick();
        must_have_converged(newton);
        exact.tip.push_back(tip_of(newton.positions()));
    }
    for (const reference::Residual& residual : newton.residuals()) {
        beam.newton_residual.push_back(residual.constraints);
    }
    beam.runs.push_back(exact);
    for (const int count : iterations) {
        settings.iterations = count;
        beam.runs.push_back(sweep<double>(reference::Engine::xpbd, model, settings, exact));
    }
    for (std::size_t i = 0; i < iterations.size(); ++i) {
        settings.iterations = iterations[i];
        BeamRun run = sweep<float>(reference::Engine::xpbd_single, model, settings, exact);
        run.rounding = farthest(run.tip, beam.runs[i + 1].tip);
        beam.runs.push_back(std::move(run));
    }

    // One frame in the middle of the fall, by iteration.
    constexpr int iterations_looked_at = 100;
    settings.iterations = 20;
    reference::PositionBased<double> solver(model, settings, reference::Method::xpbd);
    solver.tick(frames / 2);
    solver.begin_substep();
    for (int iteration = 0; iteration <= iterations_looked_at; ++iteration) {
        const reference::Residual residual =
            residual_of(model, frame_seconds, solver.positions(), solver.predicted(), solver.multipliers());
        beam.residual.push_back(residual.constraints);
        beam.momentum_residual.push_back(residual.momentum);
        solver.iterate();
    }
    return beam;
}

} // namespace lks_accuracy
