/* Lockstitch: colliders. Static or kinematic shapes that bodies and particles cannot enter.
 *
 * A particle is kept particle_radius away from every collider. Particles at up to 100 m/s do not pass through
 * a 5 cm plate or a 10 cm ball: a fast particle is traced along its way through the substep (sphere tracing
 * of the exact distance), in the collider's own moving frame. Friction is Coulomb's, static and dynamic. What
 * is inside already, since a collider was put there or another one leaves no room, gets out at 3 m/s.
 * Colliders push one after the other, once an iteration. Who is pushed by more than a millimetre meets all of
 * them again, where these move alike and do not turn: in a groove between two plates of 5 cm that are 10° or
 * more apart nothing passes at up to 100 m/s, at any number of substeps tried. In a narrower one what sinks
 * by less a substep may, and where plates close on it the last push wins.
 * Bodies (lockstitch/body.h) meet colliders as they meet each other. Restitution is for bodies alone:
 * particles do not bounce.
 */
#ifndef LOCKSTITCH_COLLIDER_H
#define LOCKSTITCH_COLLIDER_H

#include <lockstitch/filter.h>
#include <lockstitch/world.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lks_collider_id {
    uint32_t index;
    uint32_t generation; /* 0 is no collider */
} lks_collider_id;

#define LKS_MAX_COLLIDERS 4096u

typedef enum lks_shape_kind {
    LKS_SHAPE_PLANE = 0,   /* solid below the local plane y = 0; endless */
    LKS_SHAPE_SPHERE = 1,  /* radius */
    LKS_SHAPE_CAPSULE = 2, /* radius, and half_length of its axis along local y, without the caps */
    LKS_SHAPE_BOX = 3      /* half_extents */
} lks_shape_kind;

typedef struct lks_collider_def {
    uint32_t struct_size;       /* set by lks_default_collider_def */
    uint32_t shape;             /* an lks_shape_kind */
    lks_transform transform;    /* position within ±8,388,000 m */
    lks_fixed radius;           /* metres, 0.001 .. 30 */
    lks_fixed half_length;      /* metres, 0 .. 30 */
    lks_vec3 half_extents;      /* metres, 0.001 .. 30 each */
    lks_fixed static_friction;  /* 0 .. 100 */
    lks_fixed dynamic_friction; /* 0 .. static_friction */
    lks_fixed restitution;      /* 0 .. 1: the share of the normal speed that an impact gives back; of two
                                   surfaces the greater counts; none to particles */
    lks_filter filter;          /* against bodies and particles */
} lks_collider_def;

/* A static sphere of 0.5 m, friction 0.5 and 0.4, no restitution, category 1, mask of all. */
LKS_API lks_collider_def lks_default_collider_def(void);

/* Takes the lowest free index. Where a particle touches several colliders at once they act in index order, so
 * the order of adding such colliders is part of the simulation. */
LKS_API lks_result lks_world_add_collider(lks_world* world, const lks_collider_def* def,
                                          lks_collider_id* collider);
/* Wakes the bodies whose filters meet its own. LKS_ERROR_STALE_ID where it was removed already. */
LKS_API lks_result lks_world_remove_collider(lks_world* world, lks_collider_id collider);
/* 1 while the collider exists. */
LKS_API uint32_t lks_world_has_collider(const lks_world* world, lks_collider_id collider);
/* How many there are; 0 for null. */
LKS_API uint32_t lks_world_collider_count(const lks_world* world);
/* The n-th collider in index order, 0 ≤ n < collider count, else LKS_ERROR_INVALID_ARGUMENT. Looks at all up
 * to it. */
LKS_API lks_result lks_world_collider_at(const lks_world* world, uint32_t n, lks_collider_id* collider);

/* Kinematic motion: where the collider is to be at the end of the next tick; it gets there evenly over the
 * substeps and then rests there until the next call. It pushes and drags what it touches. At most 100 m and
 * 90° a tick: further is refused (use lks_collider_set_transform). Beyond 60 m a substep it may jump over
 * particles, and what a plane rises by beyond 32 m a substep leaves them below it, to come up later. Of
 * sleeping bodies it wakes those that it touches, and whose filters meet its own. */
LKS_API lks_result lks_collider_move_to(lks_world* world, lks_collider_id collider, lks_transform target);
/* Puts it there at once, without a motion. Where any point of it goes further than two centimetres, what
 * touched it meets it anew, from whichever side it is on then. */
LKS_API lks_result lks_collider_set_transform(lks_world* world, lks_collider_id collider,
                                              lks_transform transform);
/* Where it is, metres in the world: a target of lks_collider_move_to is reached by the next tick. */
LKS_API lks_result lks_collider_transform(const lks_world* world, lks_collider_id collider,
                                          lks_transform* transform);

#ifdef __cplusplus
}
#endif
#endif
