#include <cstring>

#include "measure.h"
#include "sections.h"

namespace lks_bench {

void measure_snapshots(int rounds, Results& results) {
    for (int level = LKS_SIMD_SCALAR; level <= LKS_SIMD_WASM; ++level) {
        const auto simd = static_cast<lks_simd>(level);
        if (lks_simd_is_available(simd) == 0) {
            continue;
        }
        const BenchWorld bench(*find_workload("cloth_256"), simd);
        lks_world* world = bench.world();
        std::size_t size = 0;
        lks_world_save_size(world, &size);
        std::vector<std::uint64_t> image(size / 8 + 1), copy(size / 8 + 1);
        std::size_t written = 0;
        volatile std::uint64_t sink = 0;
        const auto bytes = static_cast<double>(size);
        lks_world_save(world, image.data(), size, &written);
        const std::vector<Measurement> measured =
            measure_in_turns({{"memcpy", [&] { std::memcpy(copy.data(), image.data(), size); }, bytes},
                              {"save", [&] { lks_world_save(world, image.data(), size, &written); }, bytes},
                              {"load", [&] { lks_world_load(world, image.data(), size); }, bytes},
                              {"hash", [&] { sink = lks_world_hash(world); }, bytes}},
                             2 * rounds + 1);
        for (const Measurement& m : measured) {
            results.push_back(
                {snapshots_name, m.name, lks_simd_name(simd), 1 / m.nanoseconds, "GB/s", 0, 1 / m.least});
        }
    }
}

} // namespace lks_bench
