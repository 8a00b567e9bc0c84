#include <algorithm>

#include "measure.h"
#include "memory_count.h"
#include "sections.h"
#include "spheres.h"
#include "variant.h"

namespace lks_bench {
namespace {

double projections_per_tick(const Workload& workload, std::uint64_t constraints) {
    return static_cast<double>(constraints) * workload.substeps * workload.iterations;
}

// Some ticks in a row, as a second processor that did something else until now starts cold.
void measure_threads(const Workload& workload, double units, int rounds, Results& results) {
    constexpr int in_a_row = 5;
    const auto ticks = [&](Variant& variant, const std::string& name) {
        return Contender{name,
                         [&variant] {
                             for (int i = 0; i < in_a_row; ++i) {
                                 variant.tick();
                             }
                         },
                         units * in_a_row};
    };
    for (const std::string& one_worker : our_names()) {
        const std::string two_workers = with_two_workers(one_worker);
        const std::unique_ptr<Variant> one = make_variant(workload, one_worker);
        const std::unique_ptr<Variant> two = make_variant(workload, two_workers);
        for (const Measurement& m :
             measure_in_turns({ticks(*one, one_worker), ticks(*two, two_workers)}, rounds)) {
            results.push_back({workload.name, "threads", m.name, m.nanoseconds, "ns a projection", m.ratio,
                               m.least, 0, 0, m.times});
        }
    }
}

} // namespace

void measure_workload(const Workload& workload, int rounds, bool thrifty, Results& results) {
    const WorkloadAsset asset(workload);
    const std::uint64_t constraints =
        std::uint64_t{lks_asset_constraint_count(asset.get())} * workload.objects;
    const double units = projections_per_tick(workload, constraints);
    if (thrifty) {
        rounds = std::clamp(static_cast<int>(4e7 / units), 5, rounds);
    }
    std::vector<std::unique_ptr<Variant>> variants;
    std::vector<Contender> projections;
    std::vector<Contender> ticks;
    for (const std::string& name : variant_names(workload)) {
        Variant* variant = variants.emplace_back(make_variant(workload, name)).get();
        projections.push_back({name, [variant] { variant->project(); }, units});
        ticks.push_back({name, [variant] { variant->tick(); }, units});
    }
    for (const Measurement& m : measure_in_turns(projections, rounds)) {
        results.push_back(
            {workload.name, "projection", m.name, m.nanoseconds, "ns", m.ratio, m.least, 0, 0, m.times});
    }
    for (const Measurement& m : measure_in_turns(ticks, rounds)) {
        results.push_back({workload.name, "tick", m.name, m.nanoseconds, "ns a projection", m.ratio, m.least,
                           0, 0, m.times});
        results.push_back(
            {workload.name, "tick", m.name, m.nanoseconds * units * 1e-6, "ms", 0, m.least * units * 1e-6});
    }
    // That they rest on the same spheres, and do not fall through.
    const std::vector<FloatSphere> spheres = spheres_of(workload).front();
    for (std::size_t i = 0; workload.colliders && i < variants.size(); ++i) {
        const Resting found = resting(variants[i]->points(), spheres);
        results.push_back({workload.name, "deepest", ticks[i].name, 1000 * found.deepest, "mm"});
        results.push_back({workload.name, "resting", ticks[i].name, static_cast<double>(found.points),
                           "particles of an object"});
    }
    measure_threads(workload, units, rounds, results);
    const MemoryUse memory = count_memory(workload);
    const auto particles = static_cast<double>(lks_asset_vertex_count(asset.get()));
    const auto edges = static_cast<double>(lks_asset_constraint_count(asset.get()));
    results.push_back({workload.name, "constraints", "", static_cast<double>(constraints), ""});
    results.push_back({workload.name, "in runs", "", share_in_runs(*asset.get()), ""});
    results.push_back({workload.name, "asset", "", memory.asset / edges, "bytes a constraint"});
    results.push_back({workload.name, "object", "", memory.object / particles, "bytes a particle"});
}

} // namespace lks_bench
