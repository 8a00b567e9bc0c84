#include "memory_count.h"

#include <cstdlib>

#include "asset/asset.h"

namespace lks_bench {
namespace {

class Counter {
public:
    lks_allocator allocator() { return {allocate, release, this}; }
    double bytes() const { return bytes_; }

private:
    static void* allocate(void* user, std::size_t size, std::size_t alignment) {
        static_cast<Counter*>(user)->bytes_ += static_cast<double>(size);
        return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    }
    static void release(void* user, void* memory, std::size_t size) {
        static_cast<Counter*>(user)->bytes_ -= static_cast<double>(size);
        std::free(memory);
    }

    double bytes_ = 0;
};

} // namespace

MemoryUse count_memory(const Workload& workload) {
    Workload few = workload;
    few.warm_ticks = 0;
    few.objects = 0;
    Workload more = few;
    more.objects = 64;
    Counter asset;
    const WorkloadAsset made(few, asset.allocator());
    Counter none;
    const BenchWorld without(few, LKS_SIMD_AUTO, 1, none.allocator());
    Counter many;
    const BenchWorld with(more, LKS_SIMD_AUTO, 1, many.allocator());
    return {asset.bytes(), (many.bytes() - none.bytes()) / more.objects};
}

double share_in_runs(const lks_asset& asset) {
    std::uint32_t singles = 0;
    for (const lks::Batch& batch : asset.batches) {
        singles += batch.first + batch.count - batch.first_single;
    }
    return 1.0 - static_cast<double>(singles) / asset.constraint_count();
}

} // namespace lks_bench
