#include "measure.h"
#include "sections.h"

namespace lks_bench {

void measure_overhead(int rounds, Results& results) {
    // Ropes of two particles and one constraint.
    constexpr std::uint32_t many = 1000;
    Workload none{.name = overhead_name, .title = "", .shape = Shape::rope, .objects = 0, .side = 2};
    Workload one = none;
    one.objects = 1;
    Workload thousand = none;
    thousand.objects = many;
    const BenchWorld empty(none, LKS_SIMD_AUTO);
    const BenchWorld single(one, LKS_SIMD_AUTO);
    const BenchWorld crowd(thousand, LKS_SIMD_AUTO);
    const auto ticks = [](const BenchWorld& bench, int count) {
        return Contender{"",
                         [world = bench.world(), count] {
                             for (int i = 0; i < count; ++i) {
                                 lks_world_step(world);
                             }
                         },
                         static_cast<double>(count)};
    };
    const std::vector<Measurement> measured =
        measure_in_turns({ticks(empty, 10000), ticks(single, 1000), ticks(crowd, 2)}, rounds);
    results.push_back(
        {overhead_name, "tick", "empty world", measured[0].nanoseconds, "ns", 0, measured[0].least});
    results.push_back({overhead_name, "tick", "one rope of two particles, 20 × 1", measured[1].nanoseconds,
                       "ns", 0, measured[1].least});
    results.push_back({overhead_name, "tick", "each of a thousand such ropes", measured[2].nanoseconds / many,
                       "ns", 0, measured[2].least / many});
}

} // namespace lks_bench
