#include "accuracy_command.h"

#include <algorithm>
#include <cstdio>
#include <exception>

#include "accuracy_report.h"
#include "report_files.h"
#include "spring.h"
#include "stairs.h"

namespace lks_accuracy {
namespace {

using reference::Engine;

constexpr int failed = 1;
constexpr int bad_use = 2;

struct Part {
    const char* name;
    const char* title;
};

constexpr Part parts[] = {
    {"paper_spring", "the period of a spring, by step and iterations"},
    {"paper_chain", "the force at a chain's fixed end against Newton"},
    {"paper_beam", "a cantilever beam of triangles: residual and tip against Newton"},
    {"paper_cloth", "sag of a hanging cloth by iterations, PBD beside"},
    {"paper_balloon", "a shell around a volume, each with its compliance"},
    {"spring", "cost against error: a spring and the analytic solution"},
    {"rope_swing", "cost against error: a rope that swings freely"},
    {"rope_heavy_end", "cost against error: a rope with 100 times its links' mass at the end"},
    {"cloth_hang", "cost against error: a cloth held at two corners"},
    {"cloth_fine", "cost against error: the same of 64 × 64 vertices"},
    {"cloth_drape", "cost against error: a cloth that falls on a ball"},
    {"ragdoll_stairs", "cost against error: four humanoids on stairs, beside Bullet"},
};

void measure_paper(const std::string& part, const AccuracyOptions& options, Paper& paper) {
    const std::vector<int> iterations{20, 40, 80, 160};
    if (part == "paper_spring") {
        for (const double rate : {30.0, 60.0, 120.0}) {
            for (const Engine engine : {Engine::fixed_point, Engine::pbd}) {
                for (const int count : {1, 5, 10}) {
                    paper.spring.push_back(run_spring(engine, rate, count));
                }
            }
        }
    } else if (part == "paper_chain") {
        for (const double rate : {60.0, 125.0}) {
            const std::vector<ChainRun> runs = run_chain(
                {Engine::fixed_point, Engine::single_precision, Engine::xpbd_jacobi}, rate, {50, 100, 1000});
            paper.chain.insert(paper.chain.end(), runs.begin(), runs.end());
            const std::vector<ChainRun> direct =
                run_chain({Engine::fixed_point, Engine::single_precision, Engine::double_precision}, rate,
                          {1, 5}, LKS_ROPE_DIRECT);
            paper.chain.insert(paper.chain.end(), direct.begin() + 1, direct.end()); // Newton is there
        }
    } else if (part == "paper_beam") {
        paper.beam = run_beam({1, 5, 10, 20, 100});
    } else if (part == "paper_cloth") {
        paper.cloth_scene = options.quick ? ClothHang{16, 1e-2, 3} : ClothHang{64, 0.3, 3, 0.3};
        paper.cloth =
            run_cloth(paper.cloth_scene, {Engine::fixed_point, Engine::xpbd, Engine::pbd}, iterations);
    } else {
        paper.balloon = run_balloon({1e-2, 1e-1}, {1e-4, 1e-2, 1e-1}, {10, 40});
    }
}

Experiment measure_part(const std::string& part, const AccuracyOptions& options, const Progress& progress) {
    const Grid grid = options.quick ? quick_grid() : whole_grid();
    const bool a_minute = options.long_times || !options.quick;
    if (part == "spring") {
        return measure_spring(grid, a_minute ? std::vector<int>{1, 10, 60} : std::vector<int>{1, 10},
                              progress);
    }
    if (part == "ragdoll_stairs") {
        // Beyond, joints are as near as their numbers allow.
        constexpr int most_passes = 40;
        const Grid small{grid.substeps, grid.iterations, std::min(grid.most_passes, most_passes)};
        return measure_stairs(small, options.quick ? 60 : 300, progress);
    }
    std::vector<MeasuredScene> scenes = measured_scenes();
    scenes.push_back(cloth_fine());
    MeasuredScene scene = *std::find_if(
        scenes.begin(), scenes.end(), [&](const MeasuredScene& candidate) { return candidate.name == part; });
    if (options.long_times && scene.may_be_tethered()) {
        // Air brings it to rest.
        scene.ticks = 600;
        scene.deviation_tick = 600;
    }
    if (a_minute && scene.is_regular) {
        scene.later_ticks = {600, 3600};
    }
    return measure_particles(scene, grid, progress);
}

} // namespace

int run_accuracy(const AccuracyOptions& options, const std::function<void(const std::string&)>& complain,
                 const std::function<void(const std::string&)>& progress) {
    if (options.list) {
        for (const Part& part : parts) {
            std::printf("%-16s %s\n", part.name, part.title);
        }
        return 0;
    }
    std::vector<std::string> chosen = options.parts;
    if (chosen.empty()) {
        for (const Part& part : parts) {
            chosen.push_back(part.name);
        }
    }
    for (const std::string& name : chosen) {
        if (std::none_of(std::begin(parts), std::end(parts),
                         [&](const Part& part) { return name == part.name; })) {
            complain("There is no experiment '" + name + "'; --list shows all.");
            return bad_use;
        }
    }
    if (!options.report.empty() && !lks_bench::prepare_report(options.report, complain)) {
        return failed;
    }
    Measured measured;
    try {
        for (const std::string& name : chosen) {
            if (name.rfind("paper_", 0) == 0) {
                progress(name);
                measure_paper(name, options, measured.paper);
            } else {
                measured.experiments.push_back(measure_part(name, options, progress));
            }
        }
    } catch (const std::exception& error) {
        complain(error.what());
        return failed;
    }
    const std::vector<Section> sections = sections_of(measured);
    if (options.json) {
        lks_bench::Results results;
        for (const Section& section : sections) {
            results.insert(results.end(), section.results.begin(), section.results.end());
        }
        std::fputs(lks_bench::to_json(results).c_str(), stdout);
    } else {
        for (const Section& section : sections) {
            std::fputs(section.text.c_str(), stdout);
        }
    }
    std::string error;
    if (!options.report.empty() && !write_report(options.report, sections, error)) {
        complain(error);
        return failed;
    }
    return 0;
}

} // namespace lks_accuracy
