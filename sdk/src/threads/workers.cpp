#include "threads/workers.h"

#include <lockstitch/tasks.h>

#include <cstdlib>
#include <new>

#include "threads/platform.h"

namespace lks {

// Taken from the C library, not from the game's allocator, which may be used by one thread only.
struct Workers::State {
    struct Worker {
        State* state;
        std::uint32_t index;
        Thread thread;
    };

    Mutex mutex;
    Condition woken;
    Condition rested;
    void (*work)(void* context, std::uint32_t index) = nullptr;
    void* context = nullptr;
    std::uint64_t round = 0; // of waking
    std::uint32_t busy = 0;
    std::uint32_t count = 0;
    bool stopping = false;
    Worker workers[LKS_MAX_WORKERS];

    static void run(void* argument) {
        const auto* worker = static_cast<Worker*>(argument);
        worker->state->work_when_woken(worker->index);
    }

    void work_when_woken(std::uint32_t index) {
        std::uint64_t seen = 0;
        mutex.lock();
        for (;;) {
            while (round == seen && !stopping) {
                woken.wait(mutex);
            }
            if (stopping) {
                break;
            }
            seen = round;
            mutex.unlock();
            work(context, index);
            mutex.lock();
            if (--busy == 0) {
                rested.wake_all();
            }
        }
        mutex.unlock();
    }
};

bool Workers::start(std::uint32_t count, void (*work)(void* context, std::uint32_t index), void* context) {
    if (!has_threads) {
        return true;
    }
    void* memory = std::malloc(sizeof(State));
    if (memory == nullptr) {
        return false;
    }
    state_ = ::new (memory) State;
    state_->work = work;
    state_->context = context;
    for (std::uint32_t i = 0; i < count; ++i) {
        State::Worker& worker = state_->workers[i];
        worker.state = state_;
        worker.index = i;
        if (!worker.thread.start(State::run, &worker)) {
            stop();
            return false;
        }
        ++state_->count;
    }
    return true;
}

void Workers::wake() {
    if (state_ != nullptr) {
        state_->mutex.lock();
        ++state_->round;
        state_->busy = state_->count;
        state_->woken.wake_all();
        state_->mutex.unlock();
    }
}

void Workers::wait() {
    if (state_ != nullptr) {
        state_->mutex.lock();
        while (state_->busy != 0) {
            state_->rested.wait(state_->mutex);
        }
        state_->mutex.unlock();
    }
}

void Workers::stop() {
    if (state_ == nullptr) {
        return;
    }
    state_->mutex.lock();
    state_->stopping = true;
    state_->woken.wake_all();
    state_->mutex.unlock();
    for (std::uint32_t i = 0; i < state_->count; ++i) {
        state_->workers[i].thread.join();
    }
    state_->~State();
    std::free(state_);
    state_ = nullptr;
}

} // namespace lks
