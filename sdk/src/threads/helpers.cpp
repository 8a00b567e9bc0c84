#include "threads/helpers.h"

namespace lks {

bool Helpers::start(std::uint32_t count, const lks_task_system& tasks) {
    count_ = count;
    tasks_ = tasks;
    for (std::uint32_t i = 0; i < count; ++i) {
        enqueued_[i] = {this, i + 1, nullptr};
    }
    return count == 0 || tasks.enqueue != nullptr || workers_.start(count, help_by_index, this);
}

void Helpers::begin() {
    team_.open();
    if (tasks_.enqueue == nullptr) {
        workers_.wake();
        return;
    }
    for (std::uint32_t i = 0; i < count_; ++i) {
        enqueued_[i].handle = tasks_.enqueue(tasks_.user, help, &enqueued_[i]);
    }
}

void Helpers::end() {
    team_.close();
    if (tasks_.enqueue == nullptr) {
        workers_.wait();
        return;
    }
    for (std::uint32_t i = 0; i < count_; ++i) {
        if (enqueued_[i].handle != nullptr) {
            tasks_.finish(tasks_.user, enqueued_[i].handle);
        }
    }
}

void Helpers::help(void* task) {
    const auto* own = static_cast<Task*>(task);
    own->helpers->team_.help(own->worker);
}

void Helpers::help_by_index(void* helpers, std::uint32_t index) {
    static_cast<Helpers*>(helpers)->team_.help(index + 1);
}

} // namespace lks
