// Task systems as games might have them, for worlds with workers.
#pragma once

#include <lockstitch/lockstitch.h>

#include <chrono>
#include <cstdint>
#include <thread>

#include "support/numbers.h"

namespace support {

// What a game's task system might do with a task.
enum class Temper { at_once, late, threads };

// Runs tasks at once on the caller, only when they are waited for, or each on a thread of its own after a nap
// of random length.
class TaskSystem {
public:
    explicit TaskSystem(Temper temper, std::uint64_t seed = 5) : temper_(temper), random_(seed) {}

    lks_task_system interface() { return {this, enqueue, finish}; }
    std::uint64_t tasks() const { return tasks_; }
    bool all_awaited() const { return awaited_ == (temper_ == Temper::at_once ? 0 : tasks_); }

private:
    struct Pending {
        lks_task task;
        void* context;
        std::thread thread;
    };

    static void* enqueue(void* user, lks_task task, void* context) {
        auto* self = static_cast<TaskSystem*>(user);
        ++self->tasks_;
        if (self->temper_ == Temper::at_once) {
            task(context);
            return nullptr;
        }
        auto* pending = new Pending{task, context, {}};
        if (self->temper_ == Temper::threads) {
            const auto nap = std::chrono::microseconds(self->random_.between(0, 400));
            pending->thread = std::thread([=] {
                std::this_thread::sleep_for(nap);
                task(context);
            });
        }
        return pending;
    }

    static void finish(void* user, void* handle) {
        ++static_cast<TaskSystem*>(user)->awaited_;
        auto* pending = static_cast<Pending*>(handle);
        if (pending->thread.joinable()) {
            pending->thread.join();
        } else {
            pending->task(pending->context);
        }
        delete pending;
    }

    Temper temper_;
    Random random_;
    std::uint64_t tasks_ = 0;
    std::uint64_t awaited_ = 0;
};

} // namespace support
