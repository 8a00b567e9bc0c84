// lockstitch-bench: every variant of every workload as a Google Benchmark of its own, with that library's
// filters, repetitions, interleaving and formats. `lockstitch bench` measures in turns and writes reports.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <map>

#include "variant.h"

namespace lks_bench {
namespace {

// Made when it is first run, and kept for its repetitions.
Variant& variant_of(const Workload& workload, const std::string& name) {
    static std::map<std::string, std::unique_ptr<Variant>> made;
    std::unique_ptr<Variant>& variant = made[workload.name + "/" + name];
    if (variant == nullptr) {
        variant = make_variant(workload, name);
    }
    return *variant;
}

void run(benchmark::State& state, const Workload& workload, const std::string& name,
         void (Variant::*work)()) {
    Variant& variant = variant_of(workload, name);
    for (auto _ : state) {
        (variant.*work)();
    }
    const WorkloadAsset asset(workload);
    const double units = static_cast<double>(lks_asset_constraint_count(asset.get())) * workload.objects *
                         workload.substeps * workload.iterations;
    using benchmark::Counter;
    state.counters["s/projection"] = Counter(units, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

// In names of benchmarks, commas and blanks would need quotes in a filter.
std::string file_like(std::string name) {
    for (char& c : name) {
        c = c == ' ' ? '_' : c;
    }
    name.erase(std::remove(name.begin(), name.end(), ','), name.end());
    return name;
}

void add(const Workload& workload, const std::string& variant, const char* what, void (Variant::*work)()) {
    benchmark::RegisterBenchmark(
        (workload.name + "/" + what + "/" + file_like(variant)).c_str(),
        [&workload, variant, work](benchmark::State& state) { run(state, workload, variant, work); })
        ->Unit(benchmark::kMicrosecond);
}

void add_all() {
    for (const std::vector<Workload>* list : {&workloads(), &growth_workloads()}) {
        for (const Workload& workload : *list) {
            for (const std::string& name : variant_names(workload)) {
                add(workload, name, "projections", &Variant::project);
                add(workload, name, "tick", &Variant::tick);
            }
            for (const std::string& name : our_names()) {
                add(workload, with_two_workers(name), "tick", &Variant::tick);
            }
        }
    }
}

} // namespace
} // namespace lks_bench

int main(int argc, char** argv) {
    if (argc == 2 && (std::strcmp(argv[1], "--help") == 0 || std::strcmp(argv[1], "-h") == 0)) {
        std::puts("What a tick and its constraint projections cost: WORKLOAD/projections|tick/VARIANT.\n\n"
                  "Examples:\n"
                  "  lockstitch-bench --benchmark_list_tests\n"
                  "  lockstitch-bench --benchmark_filter='cloth_64/projections/'\n"
                  "  lockstitch-bench --benchmark_filter=ropes_200/tick --benchmark_repetitions=9 \\\n"
                  "      --benchmark_enable_random_interleaving=true --benchmark_format=json\n\n"
                  "The other options are Google Benchmark's. `lockstitch bench --report DIR` measures\n"
                  "everything in turns and writes tables and plots.");
        return 0;
    }
    lks_bench::add_all();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
        return 2;
    }
    if (benchmark::RunSpecifiedBenchmarks() == 0) {
        std::fprintf(stderr, "lockstitch-bench: nothing matches; --benchmark_list_tests shows all names.\n");
        return 2;
    }
    return 0;
}
