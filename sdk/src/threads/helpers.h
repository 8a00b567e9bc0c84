// Who helps a world through a tick: its own workers, or tasks of the game's.
#pragma once

#include <lockstitch/tasks.h>

#include "threads/team.h"
#include "threads/workers.h"

namespace lks {

class Helpers {
public:
    // `count` of them, workers 1 to count. False: no thread, or no memory for it.
    [[nodiscard]] bool start(std::uint32_t count, const lks_task_system& tasks);

    // Calls them, and sends them away again; in between there are stages.
    void begin();
    void end();
    Team& team() { return team_; }

private:
    struct Task {
        Helpers* helpers;
        std::uint32_t worker;
        void* handle;
    };

    static void help(void* task);
    static void help_by_index(void* helpers, std::uint32_t index);

    Team team_;
    Workers workers_;
    lks_task_system tasks_{};
    std::uint32_t count_ = 0;
    Task enqueued_[LKS_MAX_WORKERS] = {};
};

} // namespace lks
