#include "threads/platform.h"

#if !defined(_WIN32) && (!defined(__EMSCRIPTEN__) || defined(__EMSCRIPTEN_PTHREADS__))

#include <pthread.h>
#include <sched.h>

#include <cstdlib>
#include <new>

namespace lks {

// Taken from the C library, not from the game's allocator: it is gone before the world is.
struct Workers::State {
    struct Thread {
        State* state;
        std::uint32_t index;
        pthread_t handle;
    };

    pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
    pthread_cond_t woken = PTHREAD_COND_INITIALIZER;
    pthread_cond_t rested = PTHREAD_COND_INITIALIZER;
    void (*work)(void* context, std::uint32_t index) = nullptr;
    void* context = nullptr;
    std::uint64_t round = 0; // of waking
    std::uint32_t busy = 0;
    std::uint32_t count = 0;
    bool stopping = false;
    Thread threads[64];

    static void* run(void* argument) {
        const auto* thread = static_cast<Thread*>(argument);
        State& state = *thread->state;
        std::uint64_t seen = 0;
        pthread_mutex_lock(&state.mutex);
        for (;;) {
            while (state.round == seen && !state.stopping) {
                pthread_cond_wait(&state.woken, &state.mutex);
            }
            if (state.stopping) {
                break;
            }
            seen = state.round;
            pthread_mutex_unlock(&state.mutex);
            state.work(state.context, thread->index);
            pthread_mutex_lock(&state.mutex);
            if (--state.busy == 0) {
                pthread_cond_signal(&state.rested);
            }
        }
        pthread_mutex_unlock(&state.mutex);
        return nullptr;
    }
};

std::uint64_t current_thread() {
    return (std::uint64_t)pthread_self(); // a number here, a pointer there
}

void give_way() {
    sched_yield();
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
        if (pthread_create(&thread.handle, nullptr, State::run, &thread) != 0) {
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
    pthread_mutex_lock(&state_->mutex);
    ++state_->round;
    state_->busy = state_->count;
    pthread_cond_broadcast(&state_->woken);
    pthread_mutex_unlock(&state_->mutex);
}

void Workers::wait() {
    if (state_ == nullptr) {
        return;
    }
    pthread_mutex_lock(&state_->mutex);
    while (state_->busy != 0) {
        pthread_cond_wait(&state_->rested, &state_->mutex);
    }
    pthread_mutex_unlock(&state_->mutex);
}

void Workers::stop() {
    if (state_ == nullptr) {
        return;
    }
    pthread_mutex_lock(&state_->mutex);
    state_->stopping = true;
    pthread_cond_broadcast(&state_->woken);
    pthread_mutex_unlock(&state_->mutex);
    for (std::uint32_t i = 0; i < state_->count; ++i) {
        pthread_join(state_->threads[i].handle, nullptr);
    }
    pthread_mutex_destroy(&state_->mutex);
    pthread_cond_destroy(&state_->woken);
    pthread_cond_destroy(&state_->rested);
    std::free(state_);
    state_ = nullptr;
}

} // namespace lks

#endif
