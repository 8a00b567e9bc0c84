#pragma once

#if !defined(WIN32_LEAN_AND_MEAN)
#define WIN32_LEAN_AND_MEAN
#endif
#if !defined(NOMINMAX)
#define NOMINMAX
#endif
#include <windows.h>

#include <cstdint>

namespace lks {

inline constexpr bool has_threads = true;

class Mutex {
public:
    void lock() { AcquireSRWLockExclusive(&lock_); }
    void unlock() { ReleaseSRWLockExclusive(&lock_); }

private:
    friend class Condition;
    SRWLOCK lock_ = SRWLOCK_INIT;
};

class Condition {
public:
    void wait(Mutex& locked) { SleepConditionVariableSRW(&condition_, &locked.lock_, INFINITE, 0); }
    void wake_all() { WakeAllConditionVariable(&condition_); }

private:
    CONDITION_VARIABLE condition_ = CONDITION_VARIABLE_INIT;
};

class Thread {
public:
    [[nodiscard]] bool start(void (*run)(void* argument), void* argument) {
        run_ = run;
        argument_ = argument;
        handle_ = CreateThread(nullptr, 0, enter, this, 0, nullptr);
        return handle_ != nullptr;
    }
    void join() {
        WaitForSingleObject(handle_, INFINITE);
        CloseHandle(handle_);
    }

private:
    static DWORD WINAPI enter(void* thread) {
        const auto* self = static_cast<Thread*>(thread);
        self->run_(self->argument_);
        return 0;
    }

    void (*run_)(void* argument) = nullptr;
    void* argument_ = nullptr;
    HANDLE handle_ = nullptr;
};

inline std::uint64_t current_thread() {
    return GetCurrentThreadId();
}

inline void give_way() {
    SwitchToThread();
}

} // namespace lks
