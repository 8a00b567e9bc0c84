// Kernels that take long now and then, so that who takes which block of a tick changes from run to run.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

#include "kernels/kernels.h"
#include "unit/fixed_samples.h"

namespace lks::test {

// Sleeps, gives way or does nothing, each time anew.
inline void dawdle() {
    static std::atomic<std::uint64_t> seed{0};
    Random random(seed.fetch_add(1, std::memory_order_relaxed));
    const std::uint64_t mood = random.below(128);
    if (mood == 0) {
        std::this_thread::sleep_for(std::chrono::microseconds(random.below(300)));
    } else if (mood < 32) {
        std::this_thread::yield();
    }
}

inline const Kernels& prompt() {
    static const Kernels& kernels = *find_kernels(LKS_SIMD_AUTO);
    return kernels;
}

// The kernels of this machine, none of which starts or ends on time.
inline const Kernels& dawdling() {
    static const Kernels kernels = [] {
        Kernels late = prompt();
        late.constraints_a_block = 1024; // whatever this machine makes of it: there are blocks to steal
        late.project_distances = [](const DistanceTask& task) {
            dawdle();
            prompt().project_distances(task);
            dawdle();
        };
        late.predict = [](const PredictionTask& task) {
            dawdle();
            return prompt().predict(task);
        };
        late.range = [](const std::int64_t* values, std::size_t count) {
            dawdle();
            return prompt().range(values, count);
        };
        late.near_box = [](const BoxTask& task, std::uint32_t first, std::uint32_t count) {
            dawdle();
            return prompt().near_box(task, first, count);
        };
        late.beyond_tether = [](const TetherTask& task, std::uint32_t first, std::uint32_t count) {
            dawdle();
            return prompt().beyond_tether(task, first, count);
        };
        return late;
    }();
    return kernels;
}

} // namespace lks::test
