/* Lockstitch: the world, and its time. */
#ifndef LOCKSTITCH_WORLD_H
#define LOCKSTITCH_WORLD_H

#include <lockstitch/fixed.h>
#include <lockstitch/simd.h>
#include <lockstitch/tasks.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lks_world lks_world;

/* What lks_world_advance does with time beyond max_ticks_per_advance. */
typedef enum lks_excess_time {
    LKS_EXCESS_TIME_DROP = 0, /* whole ticks beyond the cap are dropped and counted: the game slows down */
    LKS_EXCESS_TIME_KEEP = 1  /* they stay due and run in later calls: the game catches up */
} lks_excess_time;

/* Called before each tick, by lks_world_step and lks_world_advance alike: the place to apply this tick's
 * inputs, so that they meet the same tick whatever the frame rate. `tick` is the number of ticks done so far.
 * It may use the world freely, but for lks_world_step, lks_world_advance, lks_world_load,
 * lks_world_record_events and lks_world_destroy, which are refused there. */
typedef struct lks_tick_hook {
    void (*call)(void* user, lks_world* world, uint64_t tick); /* null: none */
    void* user;
} lks_tick_hook;

typedef struct lks_world_def {
    uint32_t struct_size;  /* set by lks_default_world_def */
    uint32_t tick_rate_hz; /* ticks a second, 1 .. 10000 */
    uint32_t substeps;     /* a tick, 1 .. 1000; tick_rate_hz * substeps ≤ 1000000 */
    uint32_t iterations;   /* a substep, 1 .. 1000; small steps beat iterations (Macklin et al. 2019) */
    lks_vec3 gravity;      /* m/s², each axis within ±1000 */
    uint32_t max_ticks_per_advance;   /* 1 .. 10000 */
    uint32_t excess_time;             /* an lks_excess_time */
    uint32_t keep_previous_positions; /* 1: interpolated views work (24 bytes a particle); 0: they show the
                                         last tick */
    uint32_t simd;                    /* an lks_simd; one that is not available here is refused */
    uint32_t worker_count; /* threads at work in a tick, the caller's included, 1 .. LKS_MAX_WORKERS */
    uint32_t reserved;     /* 0 */
    lks_task_system tasks; /* null functions: with more than one worker, the world's own threads */
    lks_tick_hook before_tick;
    lks_allocator allocator;
    lks_log log;
    lks_error* error; /* null, or receives the sentence when lks_world_create fails */
} lks_world_def;

/* Ids of objects, bodies, joints and the rest belong to the world that gave them: another one may have given
 * the same numbers, and then takes them for its own. */

/* 60 Hz, 20 substeps of 1 iteration, gravity -9.81 m/s² on y, at most 8 ticks a call, the rest dropped. */
LKS_API lks_world_def lks_default_world_def(void);
/* LKS_ERROR_STRUCT_SIZE comes without a sentence: where `error` lies in such a definition is unknown. */
LKS_API lks_result lks_world_create(const lks_world_def* def, lks_world** world);
LKS_API void lks_world_destroy(lks_world* world); /* null is allowed */

/* The last failed call on this world; result is LKS_OK while none has failed. Never null but for a null
 * world. */
LKS_API const lks_error* lks_world_last_error(const lks_world* world);

/* Exactly one tick, by the calling thread and up to worker_count - 1 others; small worlds wake nobody. Where
 * there are no threads (WebAssembly without them) the caller does it all. Allocates nothing.
 *
 * What a tick may take at most follows from what is in the world and not from what happens there. Add up
 *
 *     A · substeps · particles
 *     B · substeps · iterations · (constraints + particles · what their object is near)
 *     C · substeps · (iterations + rounds) · (bodies + joints + attachments + contacts)
 *     D · (objects + bodies + colliders), once
 *
 * with A to D as measured on the machine (`lockstitch bench`, docs/performance.md). All of these numbers are
 * the game's but for three, which have ends of their own:
 *   near      colliders and bodies; of objects and bodies at most 64 + 8 · (objects + bodies) pairs
 *   contacts  64 + 16 · bodies of up to four points, found among 64 + 32 · bodies near pairs; bodies count as
 *             many as there ever were at once, and what is beyond is left out (lost_contacts)
 *   rounds    a fixed number, and up to 16 more for figures that go on into what stops them, that are held
 *             at a bone, or whose light bodies hold heavy ones: there each may solve their joints up to 24
 *             times, as a rule once or twice
 * Bodies that sleep cost next to nothing, but all may wake at once: a bound counts them as awake. A rope that
 * is solved at once counts as a few sweeps, and where it is torn as up to eight times as many.
 *
 * Capacities do not bound the search for near pairs: where everything is in one place each body and collider
 * is compared with each other one. */
LKS_API lks_result lks_world_step(lks_world* world);

/* Runs the ticks that have become due after elapsed_ns (0 .. 10^14) more nanoseconds. Time is counted in
 * units of 1 / (tick_rate_hz · 10^9) s, so nothing drifts. ticks_run may be null. The clock (what is due, and
 * the interpolation) belongs to the view: it is no part of the state, its hash or its images. Where so much
 * is due already (LKS_EXCESS_TIME_KEEP) that it would overflow: LKS_ERROR_LIMIT. */
LKS_API lks_result lks_world_advance(lks_world* world, int64_t elapsed_ns, uint32_t* ticks_run);

/* How far the clock is past the last tick, as a fraction of a tick in Q0.32; just below one where
 * ticks are still due (LKS_EXCESS_TIME_KEEP). For drawing only. */
LKS_API uint32_t lks_world_interpolation(const lks_world* world);

/* The lks_simd in use, never LKS_SIMD_AUTO; no part of the state. LKS_SIMD_AUTO for null. */
LKS_API lks_simd lks_world_simd(const lks_world* world);

/* Ticks since the world was created (part of the state); 0 for null. */
LKS_API uint64_t lks_world_tick(const lks_world* world);

/* The settings that the world was created with; 0 for null. */
LKS_API uint32_t lks_world_tick_rate(const lks_world* world);
LKS_API uint32_t lks_world_substeps(const lks_world* world);
LKS_API uint32_t lks_world_iterations(const lks_world* world);

/* m/s², each axis within ±1000, else LKS_ERROR_INVALID_ARGUMENT. A change wakes all bodies. */
LKS_API lks_result lks_world_set_gravity(lks_world* world, lks_vec3 gravity);
/* The present one, m/s². */
LKS_API lks_result lks_world_gravity(const lks_world* world, lks_vec3* gravity);

/* What was clamped since creation, never silently. No part of the state. */
typedef struct lks_world_counters {
    uint64_t position_clamps; /* a particle's axis left its object's range of ±64 m */
    uint64_t speed_clamps;    /* a particle's axis, or a body, was faster than its limit */
    uint64_t target_clamps;   /* a pin's target lay outside its object's range */
    uint64_t world_edge_hits; /* an object's origin could not follow it, or a body's axis went no further, at
                                 ±8,388 km */
    uint64_t dropped_ticks;   /* by LKS_EXCESS_TIME_DROP */
    uint64_t lost_contacts;   /* pairs, near or touching, beyond the room of a tick (lks_world_step) */
    uint64_t lost_events;     /* more than lks_world_record_events has room for */
} lks_world_counters;

/* As they are now. */
LKS_API lks_result lks_world_get_counters(const lks_world* world, lks_world_counters* counters);

/* The speed limit of each axis in m/s: the lower of 1000 m/s and 16 m a substep. */
LKS_API lks_fixed lks_world_speed_limit(const lks_world* world);

#ifdef __cplusplus
}
#endif
#endif
