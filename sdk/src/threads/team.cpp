#include "threads/team.h"

#include "threads/platform.h"

namespace lks {
namespace {

// Loops before others are let run, some microseconds; and after they were, until they are again: where there
// are more threads than processors it is one of those that has the work.
constexpr std::uint32_t patience = 4000;
constexpr std::uint32_t later_patience = 100;

class Patience {
public:
    void wait() {
        if (++loops_ >= patience) {
            loops_ = patience - later_patience;
            give_way();
        }
    }

private:
    std::uint32_t loops_ = 0;
};

} // namespace

void Team::open() {
    caller_ = current_thread();
    closed_.store(false, std::memory_order_release);
}

void Team::close() {
    closed_.store(true, std::memory_order_release);
}

void Team::run(const Stage& stage) {
    stage_ = stage;
    done_.store(0, std::memory_order_relaxed);
    ++number_;
    claim_.store(number_ << 32 | std::uint64_t{stage.blocks} << 16, std::memory_order_release);
    while (take_block(0)) {}
    Patience patience_left;
    while (done_.load(std::memory_order_acquire) != stage.blocks) {
        patience_left.wait();
    }
}

bool Team::take_block(std::uint32_t worker) {
    std::uint64_t claim = claim_.load(std::memory_order_acquire);
    for (;;) {
        const std::uint64_t block = claim & block_mask;
        if (block >= (claim >> 16 & block_mask)) {
            return false;
        }
        // Who takes a block holds the stage: it is not over before the block is done.
        if (claim_.compare_exchange_weak(claim, claim + 1, std::memory_order_acq_rel,
                                         std::memory_order_acquire)) {
            stage_.run(stage_.context, static_cast<std::uint32_t>(block), worker);
            done_.fetch_add(1, std::memory_order_release);
            return true;
        }
    }
}

void Team::help(std::uint32_t worker) {
    const bool on_callers_thread = current_thread() == caller_;
    Patience patience_left;
    while (!closed_.load(std::memory_order_acquire)) {
        if (take_block(worker)) {
            patience_left = Patience();
        } else if (on_callers_thread) {
            return;
        } else {
            patience_left.wait();
        }
    }
}

} // namespace lks
