#include "threads/platform.h"

#if defined(_WIN32)

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <cstdlib>
#include <new>

namespace lks {

// As in platform_posix.cpp.
struct Workers::State {
    struct Thread {
        State* state;
        std::uint32_t index;
        HANDLE handle;
    };

    SRWLOCK lock = SRWLOCK_INIT;
    CONDITION_VARIABLE woken = CONDITION_VARIABLE_INIT;
    CONDITION_VARIABLE rested = CONDITION_VARIABLE_INIT;
    void (*work)(void* context, std::uint32_t index) = nullptr;
    void* context = nullptr;
    std::uint64_t round = 0; // of waking
    std::uint32_t busy = 0;
    std::uint32_t count = 0;
    bool stopping = false;
    Thread threads[64];

    static DWORD WINAPI run(void* argument) {
        const auto* thread = static_cast<Thread*>(argument);
        State& state = *thread->state;
        std::uint64_t seen = 0;
        AcquireSRWLockExclusive(&state.lock);
        for (;;) {
            while (state.round == seen && !state.stopping) {
                SleepConditionVariableSRW(&state.woken, &state.lock, INFINITE, 0);
            }
            if (state.stopping) {
                break;
            }
            seen = state.round;
            ReleaseSRWLockExclusive(&state.lock);
            state.work(state.context, thread->index);
            AcquireSRWLockExclusive(&state.lock);
            if (--state.busy == 0) {
                WakeConditionVariable(&state.rested);
            }
        }
        ReleaseSRWLockExclusive(&state.lock);
        return 0;
    }
};

std::uint64_t current_thread() {
    return GetCurrentThreadId();
}

void give_way() {
    SwitchToThread();
}

bool Workers::start(std::uint32_t count, void (*work)(void* context, std::uint32_t index), void* context) {
    void* memory = std::malloc(sizeof(State));
    if (memory == nullptr) {
        return false;
    }
    state_ = ::new (memory) State;
    state_->work = work;
    state_->context = context;
    for (std::uint32_t i = 0; i < count; ++i) {
        State::Thread& thread = state_->threads[i];
        thread.state = state_;
        thread.index = i;
        thread.handle = CreateThread(nullptr, 0, State::run, &thread, 0, nullptr);
        if (thread.handle == nullptr) {
            stop();
            return false;
        }
        ++state_->count;
    }
    return true;
}

void Workers::wake() {
    if (state_ == nullptr) {
        return;
    }
    AcquireSRWLockExclusive(&state_->lock);
    ++state_->round;
    state_->busy = state_->count;
    WakeAllConditionVariable(&state_->woken);
    ReleaseSRWLockExclusive(&state_->lock);
}

void Workers::wait() {
    if (state_ == nullptr) {
        return;
    }
    AcquireSRWLockExclusive(&state_->lock);
    while (state_->busy != 0) {
        SleepConditionVariableSRW(&state_->rested, &state_->lock, INFINITE, 0);
    }
    ReleaseSRWLockExclusive(&state_->lock);
}

void Workers::stop() {
    if (state_ == nullptr) {
        return;
    }
    AcquireSRWLockExclusive(&state_->lock);
    state_->stopping = true;
    WakeAllConditionVariable(&state_->woken);
    ReleaseSRWLockExclusive(&state_->lock);
    for (std::uint32_t i = 0; i < state_->count; ++i) {
        WaitForSingleObject(state_->threads[i].handle, INFINITE);
        CloseHandle(state_->threads[i].handle);
    }
    std::free(state_);
    state_ = nullptr;
}

} // namespace lks

#endif
