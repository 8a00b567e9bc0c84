// An object's particles, or the constraints of one of its batches, cut into blocks for a team.
#pragma once

#include <algorithm>
#include <cstdint>

#include "collide/second_look.h"
#include "kernels/kernels.h"
#include "threads/blocks.h"

namespace lks {

// How many blocks a phase of one object is divided into at most.
inline constexpr std::uint32_t greatest_block_count = 64;

class ObjectBlocks {
public:
    // team: null, or who helps.
    ObjectBlocks(Team* team, std::uint32_t workers) : team_(team), workers_(workers) {}

    bool is_alone() const { return team_ == nullptr; }

    // Calls use(block, first, count) for parts of `count` elements of about `grain` each, one after the
    // other or at the same time, and returns how many parts. Parts begin at whole groups of the kernels and
    // at whole words of FarPushes.
    template <typename Use>
    std::uint32_t cut(std::uint32_t count, std::uint32_t grain, const Use& use) const {
        const std::uint32_t wanted = wanted_blocks(count, grain);
        if (is_alone() || wanted < 2) {
            use(0u, 0u, count);
            return 1;
        }
        static_assert(particles_a_look % widest_group == 0);
        const std::uint32_t size = (count / wanted + particles_a_look) / particles_a_look * particles_a_look;
        run_blocks(team_, count, size, [&](std::uint32_t first, std::uint32_t end, std::uint32_t) {
            use(first / size, first, end - first);
        });
        return (count + size - 1) / size;
    }

    // The same of particles.
    template <typename Use>
    std::uint32_t cut_particles(std::uint32_t count, const Use& use) const {
        return cut(count, particles_a_block, use);
    }

private:
    // As many for each worker: for one that is left over the others would wait. What is a little too small
    // for one more counts as one: a grid's batches have a power of two, or somewhat less.
    std::uint32_t wanted_blocks(std::uint32_t count, std::uint32_t grain) const {
        const std::uint32_t most = blocks_a_worker * workers_;
        const std::uint32_t wanted = (count + grain / 4) / grain;
        return std::min(wanted < workers_ ? wanted : wanted < most ? workers_ : most, greatest_block_count);
    }

    // As Kernels::constraints_a_block.
    static constexpr std::uint32_t particles_a_block = 2048;
    // More would even out the last blocks of a phase better, and cost more taking.
    static constexpr std::uint32_t blocks_a_worker = 2;

    Team* team_;
    std::uint32_t workers_;
};

} // namespace lks
