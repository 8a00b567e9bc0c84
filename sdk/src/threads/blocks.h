// A range of elements cut into blocks, for a team or for the caller alone.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "threads/team.h"

namespace lks {

// Calls use(first, end, worker) for parts of `count` elements, `size` each but for the last: one after the
// other, or, with a team, at the same time. Without a team it is one part.
template <typename Use>
void run_blocks(Team* team, std::uint32_t count, std::uint32_t size, const Use& use) {
    constexpr std::uint32_t greatest_blocks = 65535;
    if (team == nullptr || count <= size) {
        if (count != 0) {
            use(0u, count, 0u);
        }
        return;
    }
    struct Context {
        const Use& use;
        std::uint32_t count;
        std::uint32_t size;
    };
    Context context{use, count, std::max(size, count / greatest_blocks + 1)};
    const auto run = [](void* argument, std::uint32_t block, std::uint32_t worker) {
        const Context& c = *static_cast<Context*>(argument);
        const std::uint32_t first = block * c.size;
        c.use(first, std::min(c.size, c.count - first) + first, worker);
    };
    team->run({run, &context, (count + context.size - 1) / context.size});
}

// Calls use(index, worker) for each element, in the same way.
template <typename Use>
void run_each(Team* team, std::size_t count, std::uint32_t size, const Use& use) {
    run_blocks(team, static_cast<std::uint32_t>(count), size,
               [&](std::uint32_t first, std::uint32_t end, std::uint32_t worker) {
                   for (std::uint32_t i = first; i < end; ++i) {
                       use(i, worker);
                   }
               });
}

} // namespace lks
