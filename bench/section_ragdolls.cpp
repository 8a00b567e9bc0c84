#include <algorithm>
#include <chrono>
#include <cstring>
#include <memory>

#include "bullet_crowd.h"
#include "crowd_errors.h"
#include "measure.h"
#include "our_crowd.h"
#include "sections.h"

namespace lks_bench {
namespace {

// Of one fall.
struct Run {
    std::string name;
    std::unique_ptr<CrowdWorld> world;
    double milliseconds = 0;
    double slowest = 0;
    CrowdErrors errors{};
    CrowdErrors limits{};
    double contacts = 0;
    double least_energy = 0;
    double gained = 0;

    void tick() {
        const auto start = std::chrono::steady_clock::now();
        world->tick();
        const double taken =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        milliseconds += taken;
        slowest = std::max(slowest, taken);
        errors.add(world->joint_errors());
        limits.add(world->limit_errors());
        contacts += static_cast<double>(world->contacts());
        const double energy = world->energy();
        gained = std::max(gained, energy - least_energy);
        least_energy = std::min(least_energy, energy);
    }
};

void measure_snapshots_of(const char* name, lks_world* world, int rounds, Results& results) {
    std::size_t size = 0;
    lks_world_save_size(world, &size);
    std::vector<std::uint64_t> image(size / 8 + 1), copy(size / 8 + 1);
    std::size_t written = 0;
    lks_world_save(world, image.data(), size, &written);
    volatile std::uint64_t sink = 0;
    const std::vector<Measurement> measured =
        measure_in_turns({{"memcpy", [&] { std::memcpy(copy.data(), image.data(), size); }},
                          {"save", [&] { lks_world_save(world, image.data(), size, &written); }},
                          {"load", [&] { lks_world_load(world, image.data(), size); }},
                          {"hash", [&] { sink = lks_world_hash(world); }}},
                         rounds);
    results.push_back({name, "snapshot, bytes", "8 substeps", static_cast<double>(size), ""});
    for (const Measurement& m : measured) {
        results.push_back(
            {name, "snapshot, " + m.name, "8 substeps", m.nanoseconds / 1e6, "ms", 0, m.least / 1e6});
    }
}

void measure_fall(const char* name, const Crowd& crowd, int rounds, Results& results) {
    const int ticks = fall_ticks(rounds);
    std::vector<Run> runs;
    lks_world* first = nullptr;
    for (const std::uint32_t substeps : {8u, 4u, 2u, 1u}) {
        auto world = std::make_unique<OurCrowd>(crowd, substeps);
        first = first == nullptr ? world->world() : first;
        runs.push_back(
            {std::to_string(substeps) + (substeps == 1 ? " substep" : " substeps"), std::move(world)});
    }
    for (const int steps : {1, 4}) {
        if (std::unique_ptr<CrowdWorld> bullet = make_bullet_crowd(crowd, steps)) {
            runs.push_back(
                {"Bullet, " + std::to_string(steps) + (steps == 1 ? " step" : " steps"), std::move(bullet)});
        }
    }
    for (Run& run : runs) {
        run.least_energy = run.world->energy();
    }
    // All take turns, tick by tick.
    for (int tick = 0; tick < ticks; ++tick) {
        for (Run& run : runs) {
            run.tick();
        }
    }
    results.push_back({name, ticks_title(ticks), "", static_cast<double>(ticks), ""});
    for (const Run& run : runs) {
        results.push_back({name, "whole tick", run.name, run.milliseconds / ticks, "ms",
                           run.milliseconds / runs.front().milliseconds});
    }
    for (const Run& run : runs) {
        results.push_back({name, "slowest tick", run.name, run.slowest, "ms"});
        run.errors.report(name, "joint error", run.name, results);
        run.limits.report(name, "beyond limits", run.name, 1, "degrees", results);
        results.push_back({name, "energy gained", run.name, run.gained, "J"});
        results.push_back({name, "contacts, mean", run.name, run.contacts / ticks, ""});
    }
    measure_snapshots_of(name, first, rounds, results);
}

} // namespace

void measure_ragdolls(int rounds, Results& results) {
    measure_fall(ragdolls_name, CrowdBlock(), rounds, results);
}

void measure_pile(int rounds, Results& results) {
    measure_fall(pile_name, CrowdPile(), rounds, results);
}

} // namespace lks_bench
