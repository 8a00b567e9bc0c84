#pragma once

#include <pthread.h>
#include <sched.h>

#include <cstdint>

namespace lks {

inline constexpr bool has_threads = true;

class Mutex {
public:
    ~Mutex() { pthread_mutex_destroy(&mutex_); }
    void lock() { pthread_mutex_lock(&mutex_); }
    void unlock() { pthread_mutex_unlock(&mutex_); }

private:
    friend class Condition;
    pthread_mutex_t mutex_ = PTHREAD_MUTEX_INITIALIZER;
};

class Condition {
public:
    ~Condition() { pthread_cond_destroy(&condition_); }
    void wait(Mutex& locked) { pthread_cond_wait(&condition_, &locked.mutex_); }
    void wake_all() { pthread_cond_broadcast(&condition_); }

private:
    pthread_cond_t condition_ = PTHREAD_COND_INITIALIZER;
};

class Thread {
public:
    [[nodiscard]] bool start(void (*run)(void* argument), void* argument) {
        run_ = run;
        argument_ = argument;
        return pthread_create(&handle_, nullptr, enter, this) == 0;
    }
    void join() { pthread_join(handle_, nullptr); }

private:
    static void* enter(void* thread) {
        const auto* self = static_cast<Thread*>(thread);
        self->run_(self->argument_);
        return nullptr;
    }

    void (*run_)(void* argument) = nullptr;
    void* argument_ = nullptr;
    pthread_t handle_{};
};

// Of the calling thread, unlike any other's.
inline std::uint64_t current_thread() {
    return (std::uint64_t)pthread_self(); // a number here, a pointer there
}

// Lets others run.
inline void give_way() {
    sched_yield();
}

} // namespace lks
