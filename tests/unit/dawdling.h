// Kernels that take long now and then, so that who takes which block of a tick changes from run to run.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <tuple>
#include <utility>

#include "kernels/kernels.h"
#include "unit/fixed_samples.h"
#include "unit/wide_kernels.h"

namespace lks::test {

// Sleeps, gives way or, nine times in ten, does nothing, each time anew. Where others want the processor
// giving way is what takes longest, and every kernel does it twice.
inline void dawdle() {
    static std::atomic<std::uint64_t> seed{0};
    Random random(seed.fetch_add(1, std::memory_order_relaxed));
    const std::uint64_t mood = random.below(256);
    if (mood == 0) {
        std::this_thread::sleep_for(std::chrono::microseconds(random.below(300)));
    } else if (mood < 26) {
        std::this_thread::yield();
    }
}

// All kernels of a table. One that is new does not compile here until it is among them.
constexpr auto all_of(auto& kernels) {
    auto& [level, side_by_side, constraints_a_block, project_distances, predict, ranges, greatest_gap,
           near_box, near_plane, respond, beyond_tether, chain, trees, contact_points, rows, hash_update,
           sum_stripes] = kernels;
    auto& [plane, sphere, capsule, box] = respond;
    auto& [measure, stretch, turn, divide, solve, push, stiffen, share, cross] = chain;
    auto& [factor_trees, solve_trees] = trees;
    auto& [begin_points, make_rows, measure_points] = contact_points;
    auto& [take, give_back] = rows;
    return std::tie(project_distances, predict, ranges, greatest_gap, near_box, near_plane, beyond_tether,
                    hash_update, sum_stripes, plane, sphere, capsule, box, measure, stretch, turn, divide,
                    solve, push, stiffen, share, cross, factor_trees, solve_trees, begin_points, make_rows,
                    measure_points, take, give_back);
}

// The kernel of this number, neither begun nor ended on time.
template <std::size_t number, typename Result, typename... Arguments>
Result call_late(Arguments... arguments) {
    struct Naps {
        Naps() { dawdle(); }
        ~Naps() { dawdle(); }
    };
    const Naps around;
    return std::get<number>(all_of(best_kernels()))(arguments...);
}

template <std::size_t number, typename Result, typename... Arguments>
void make_late(Result (*&kernel)(Arguments...)) {
    if (kernel != nullptr) {
        kernel = call_late<number, Result, Arguments...>;
    }
}

template <std::size_t... numbers>
void make_all_late(Kernels& kernels, std::index_sequence<numbers...>) {
    static_assert(sizeof(Kernels) == offsetof(Kernels, project_distances) +
                                         sizeof...(numbers) * sizeof(Kernels::project_distances),
                  "all_of() has not got all of them");
    const auto all = all_of(kernels);
    (make_late<numbers>(std::get<numbers>(all)), ...);
}

// The kernels of this machine, none of which starts or ends on time.
inline const Kernels& dawdling() {
    static const Kernels kernels = [] {
        Kernels late = best_kernels();
        late.constraints_a_block = 1024; // whatever this machine makes of it: there are blocks to steal
        make_all_late(late, std::make_index_sequence<std::tuple_size_v<decltype(all_of(late))>>());
        return late;
    }();
    return kernels;
}

} // namespace lks::test
