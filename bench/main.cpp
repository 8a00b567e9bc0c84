// lockstitch-bench: ns a constraint projection and ms a tick, of every instruction set this machine has,
// beside a plain float32 loop; and snapshots beside memcpy.
#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "float_runs.h"
#include "measure.h"
#include "plain_float.h"
#include "solver/distance.h"
#include "solver/world.h"
#include "workloads.h"

namespace lks_bench {
namespace {

std::vector<lks_simd> available_levels() {
    std::vector<lks_simd> levels;
    for (int level = LKS_SIMD_SCALAR; level <= LKS_SIMD_WASM; ++level) {
        if (lks_simd_is_available(static_cast<lks_simd>(level)) != 0) {
            levels.push_back(static_cast<lks_simd>(level));
        }
    }
    return levels;
}

// All projections of one substep on the objects as they stand, which are put back afterwards.
class Projections {
public:
    explicit Projections(lks_world* world) : world_(world) {
        for (lks::ObjectSlot& slot : world->objects) {
            saved_.emplace_back(slot.object->particles.begin(), slot.object->particles.end());
        }
    }

    void run(std::uint32_t passes) {
        for (std::uint32_t pass = 0; pass < passes; ++pass) {
            for (lks::ObjectSlot& slot : world_->objects) {
                project(*slot.object);
            }
        }
    }

    void restore() {
        for (std::size_t i = 0; i < saved_.size(); ++i) {
            std::memcpy(world_->objects[i].object->particles.data(), saved_[i].data(),
                        saved_[i].size() * sizeof(std::int64_t));
        }
    }

private:
    void project(lks::Object& object) const {
        const lks_asset& asset = object.asset();
        const lks::DistanceArrays arrays{object.axis(0),
                                         object.axis(1),
                                         object.axis(2),
                                         object.start_axis(0),
                                         object.start_axis(1),
                                         object.start_axis(2),
                                         object.multipliers.empty() ? nullptr : object.multipliers.data()};
        for (std::uint32_t b = 0; b < asset.batches.size(); ++b) {
            const lks::Batch& batch = asset.batches[b];
            project_distances(asset, object.coefficients(), b, {batch.first, batch.first + batch.count},
                              arrays, *world_->kernels);
        }
    }

    lks_world* world_;
    std::vector<std::vector<std::int64_t>> saved_;
};

// Whether a float32 kernel comes to what double precision comes to, in ten passes: it must not be fast by
// being wrong.
bool is_right(const FloatRuns& cloth, void (*project)(FloatRuns&)) {
    FloatRuns work = cloth;
    std::vector<double> x(cloth.x.begin(), cloth.x.end());
    std::vector<double> y(cloth.y.begin(), cloth.y.end());
    std::vector<double> z(cloth.z.begin(), cloth.z.end());
    for (int pass = 0; pass < 10; ++pass) {
        project(work);
        project_double(cloth, x, y, z);
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double distance = std::abs(x[i] - static_cast<double>(work.x[i])) +
                                std::abs(y[i] - static_cast<double>(work.y[i])) +
                                std::abs(z[i] - static_cast<double>(work.z[i]));
        if (!(distance < 1e-5)) {
            return false;
        }
    }
    return true;
}

struct Options {
    std::vector<std::string> names;
    int rounds = 21;
    bool json = false;
    bool list = false;
};

void print(const Options& options, const Workload& workload, const char* what,
           const std::vector<Measurement>& results) {
    for (const Measurement& result : results) {
        if (options.json) {
            std::printf("{\"workload\": \"%s\", \"measured\": \"%s\", \"variant\": \"%s\", \"ns\": %.4f, "
                        "\"least_ns\": %.4f, \"ratio\": %.4f}\n",
                        workload.name.c_str(), what, result.name.c_str(), result.nanoseconds, result.least,
                        result.ratio);
        } else {
            std::printf("  %-22s %-10s %8.2f ns  least %8.2f  x %.3f\n", result.name.c_str(), what,
                        result.nanoseconds, result.least, result.ratio);
        }
    }
    std::fflush(stdout);
}

void measure_workload(const Options& options, const Workload& workload) {
    std::vector<std::unique_ptr<BenchWorld>> worlds;
    std::vector<std::unique_ptr<Projections>> projections;
    std::vector<Contender> passes;
    std::vector<Contender> ticks;
    for (const lks_simd level : available_levels()) {
        worlds.push_back(std::make_unique<BenchWorld>(workload, level));
        lks_world* world = worlds.back()->world();
        projections.push_back(std::make_unique<Projections>(world));
        Projections* pass = projections.back().get();
        const auto constraints = static_cast<double>(worlds.back()->constraints());
        const std::uint32_t per_tick = workload.substeps * workload.iterations;
        passes.push_back({lks_simd_name(level),
                          [pass, per_tick] {
                              pass->run(per_tick);
                              pass->restore();
                          },
                          constraints * per_tick});
        ticks.push_back({lks_simd_name(level), [world] { lks_world_step(world); }, constraints * per_tick});
    }
    const BenchWorld pair(workload, available_levels().back(), 2);
    ticks.push_back({std::string(lks_simd_name(available_levels().back())) + ", 2 workers",
                     [world = pair.world()] { lks_world_step(world); }, ticks.back().units});
    if (!options.json) {
        std::printf("%s: %s, %llu constraints\n", workload.name.c_str(), workload.title.c_str(),
                    static_cast<unsigned long long>(worlds[0]->constraints()));
    }
    FloatRuns runs;
    FloatCloth coloured;
    FloatCloth indexed;
    if (!workload.rope && workload.compliance == 0) {
        const lks_asset& asset = worlds[0]->world()->objects[0].object->asset();
        coloured = make_float_cloth(asset, true);
        indexed = make_float_cloth(asset, false);
        const double units = 20.0 * asset.constraint_count();
        runs = make_float_runs(asset, 0, workload.side - 1);
        const auto add_runs = [&](const char* name, void (*project)(FloatRuns&)) {
            FloatRuns* work = &runs;
            if (!is_right(runs, project)) {
                std::fprintf(stderr, "lockstitch-bench: %s is not what double precision comes to.\n", name);
                std::exit(1);
            }
            passes.push_back({name,
                              [work, project] {
                                  for (int pass = 0; pass < 20; ++pass) {
                                      project(*work);
                                  }
                              },
                              units});
        };
        add_runs("float32 runs, scalar", project_float_runs_scalar);
#if defined(LKS_BENCH_X86)
        if (lks_simd_is_available(LKS_SIMD_AVX2) != 0) {
            add_runs("float32 runs, AVX2", project_float_runs_avx2);
        }
        if (lks_simd_is_available(LKS_SIMD_AVX512) != 0) {
            add_runs("float32 runs, AVX-512", project_float_runs_avx512);
        }
#endif
        for (auto [name, cloth] : {std::pair{"float32 plain, coloured", &coloured},
                                   std::pair{"float32 plain, by index", &indexed}}) {
            FloatCloth* work = cloth;
            passes.push_back({name,
                              [work] {
                                  for (int pass = 0; pass < 20; ++pass) {
                                      project_float(*work);
                                  }
                              },
                              units});
        }
    }
    print(options, workload, "projection", measure_in_turns(passes, options.rounds));
    print(options, workload, "tick", measure_in_turns(ticks, options.rounds));
}

void measure_snapshots(const Options& options) {
    const Workload* workload = nullptr;
    for (const Workload& candidate : workloads()) {
        workload = candidate.name == "cloth_256" ? &candidate : workload;
    }
    for (const lks_simd level : available_levels()) {
        const BenchWorld bench(*workload, level);
        lks_world* world = bench.world();
        std::size_t size = 0;
        lks_world_save_size(world, &size);
        std::vector<std::uint64_t> image(size / 8 + 1), copy(size / 8 + 1);
        std::size_t written = 0;
        volatile std::uint64_t sink = 0;
        const auto bytes = static_cast<double>(size);
        const std::vector<Measurement> results =
            measure_in_turns({{"memcpy", [&] { std::memcpy(copy.data(), image.data(), size); }, bytes},
                              {"save", [&] { lks_world_save(world, image.data(), size, &written); }, bytes},
                              {"load", [&] { lks_world_load(world, image.data(), size); }, bytes},
                              {"hash", [&] { sink = lks_world_hash(world); }, bytes}},
                             2 * options.rounds + 1);
        for (const Measurement& result : results) {
            if (options.json) {
                std::printf("{\"workload\": \"snapshots\", \"variant\": \"%s\", \"measured\": \"%s\", "
                            "\"gb_per_s\": %.3f}\n",
                            lks_simd_name(level), result.name.c_str(), 1 / result.nanoseconds);
            } else {
                std::printf("snapshot of cloth_256, %-8s %-7s %7.2f GB/s\n", lks_simd_name(level),
                            result.name.c_str(), 1 / result.nanoseconds);
            }
        }
    }
}

int run(const Options& options) {
    if (options.list) {
        for (const Workload& workload : workloads()) {
            std::printf("%-20s %s\n", workload.name.c_str(), workload.title.c_str());
        }
        std::printf("%-20s %s\n", "snapshots", "save, load and hash of cloth_256 beside memcpy");
        return 0;
    }
    std::vector<const Workload*> chosen;
    bool snapshots = options.names.empty();
    for (const std::string& name : options.names) {
        const std::size_t before = chosen.size();
        for (const Workload& workload : workloads()) {
            if (workload.name == name) {
                chosen.push_back(&workload);
            }
        }
        snapshots = snapshots || name == "snapshots";
        if (chosen.size() == before && name != "snapshots") {
            std::fprintf(stderr, "lockstitch-bench: There is no workload '%s'; --list shows all.\n",
                         name.c_str());
            return 2;
        }
    }
    if (options.names.empty()) {
        for (const Workload& workload : workloads()) {
            chosen.push_back(&workload);
        }
    }
    for (const Workload* workload : chosen) {
        measure_workload(options, *workload);
    }
    if (snapshots) {
        measure_snapshots(options);
    }
    return 0;
}

} // namespace
} // namespace lks_bench

int main(int argc, char** argv) {
    lks_bench::Options options;
    CLI::App app{"What a constraint projection and a tick cost, on every instruction set of this machine"};
    app.add_option("WORKLOAD", options.names, "What to measure; everything by default");
    app.add_option("--rounds", options.rounds, "How often each is measured; medians are printed")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    app.add_flag("--json", options.json, "One JSON object a line");
    app.add_flag("--list", options.list, "The workloads");
    app.footer(
        "\nNanoseconds are per constraint and iteration; 'x' is the ratio to the first line, taken within\n"
        "rounds in which all take turns.\n\nExamples:\n  lockstitch-bench cloth_64\n"
        "  lockstitch-bench snapshots\n  lockstitch-bench --rounds 101 --json cloth_64 cloth_256");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) {
            return app.exit(error);
        }
        std::fprintf(stderr, "lockstitch-bench: %s; `lockstitch-bench --help` shows how.\n", error.what());
        return 2;
    }
    return lks_bench::run(options);
}
