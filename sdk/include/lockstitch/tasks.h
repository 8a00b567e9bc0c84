/* Lockstitch: the game's task system, for worlds that use several threads.
 *
 * No result depends on the number of workers, on their timing, or on whether tasks run at all before they are
 * waited for: the thread that steps the world can do all the work by itself.
 */
#ifndef LOCKSTITCH_TASKS_H
#define LOCKSTITCH_TASKS_H

#include <lockstitch/base.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LKS_MAX_WORKERS 64u

/* Lends the thread that calls it to the world until the tick ends. */
typedef void (*lks_task)(void* context);

typedef struct lks_task_system {
    void* user;
    /* Runs task(context) once, on any thread, now or later. Returns what finish takes; null if it has run.
     * Called by the thread that steps the world, at most worker_count - 1 times a tick. */
    void* (*enqueue)(void* user, lks_task task, void* context);
    /* Returns when that task has run; may run it itself, or other tasks meanwhile. */
    void (*finish)(void* user, void* handle);
} lks_task_system;

#ifdef __cplusplus
}
#endif
#endif
