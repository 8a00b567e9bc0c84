// The thread that steps a world, and others that help it through the stages of a tick.
//
// A stage is a number of blocks that may run in any order and at the same time. The next block to take and
// the stage it belongs to are one atomic word, so that nobody takes a block of a stage that is over. The
// caller takes blocks like everybody else and then waits only for those that somebody else has taken: helpers
// that come late, or never, hold up nothing.
#pragma once

#include <atomic>
#include <cstdint>

namespace lks {

struct Stage {
    void (*run)(void* context, std::uint32_t block, std::uint32_t worker);
    void* context;
    std::uint32_t blocks; // at most 65535
};

class Team {
public:
    // By the caller, worker 0. Between open and close.
    void open();
    void run(const Stage& stage);
    void close();

    // By helpers, until the team is closed. On the caller's own thread only while there is something to take.
    void help(std::uint32_t worker);

private:
    static constexpr std::uint64_t block_mask = 0xffff;

    // False: nothing is left to take.
    bool take_block(std::uint32_t worker);

    // Stage number, blocks, next block: 32, 16 and 16 bits.
    std::atomic<std::uint64_t> claim_{0};
    std::atomic<std::uint32_t> done_{0};
    std::atomic<bool> closed_{true};
    Stage stage_{};
    std::uint64_t number_ = 0;
    std::uint64_t caller_ = 0;
};

} // namespace lks
