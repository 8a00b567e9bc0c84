#include <algorithm>
#include <cmath>

#include "experiment.h"
#include "paper.h"

namespace lks_accuracy {

using reference::Engine;

namespace {

constexpr int frames = 100;

std::vector<double> forces_of(Engine engine, double rate_hz, int iterations, lks_rope_solver solver) {
    reference::ParticleScene scene = reference::make_rope(19, 19, 1, {1e-8, 0, 1, 0}, {1, 0, 0});
    scene.solver = solver;
    scene.record_forces = true;
    scene.tick_rate_hz = rate_hz;
    const reference::Model model = model_of(scene);
    const auto fixed_end =
        std::find_if(model.edges.begin(), model.edges.end(),
                     [](const reference::Edge& edge) { return edge.a == 0 || edge.b == 0; });
    const auto simulation = simulate(engine, scene, {1, iterations});
    std::vector<double> forces;
    for (int frame = 0; frame < frames; ++frame) {
        simulation->tick();
        forces.push_back(simulation->force(static_cast<std::size_t>(fixed_end - model.edges.begin())));
    }
    return forces;
}

} // namespace

std::vector<ChainRun> run_chain(const std::vector<Engine>& engines, double rate_hz,
                                const std::vector<int>& iterations, lks_rope_solver solver) {
    std::vector<ChainRun> runs{
        {name_of(Engine::newton), rate_hz, 0, forces_of(Engine::newton, rate_hz, 1, solver)}};
    const std::string suffix = solver == LKS_ROPE_DIRECT ? at_once_suffix : "";
    const std::vector<double> exact = runs.front().forces;
    const double peak = *std::max_element(exact.begin(), exact.end());
    for (const Engine engine : engines) {
        for (const int count : iterations) {
            ChainRun run{name_of(engine) + suffix, rate_hz, count, forces_of(engine, rate_hz, count, solver)};
            run.first_error = std::abs(run.forces[0] / exact[0] - 1);
            for (std::size_t frame = 0; frame < exact.size(); ++frame) {
                const double error = std::abs(run.forces[frame] - exact[frame]);
                run.worst_of_peak = std::max(run.worst_of_peak, error / peak);
                if (frame >= chain_frames_of_start) {
                    run.worst_error = std::max(run.worst_error, error / exact[frame]);
                }
            }
            runs.push_back(std::move(run));
        }
    }
    return runs;
}

} // namespace lks_accuracy
