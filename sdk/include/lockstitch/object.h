/* Lockstitch: objects (a cloth or a rope in a world), and the game's hands on them.
 *
 * Vertices are numbered as in the asset's description. All values are fixed-point. An object's particles are
 * kept relative to its own origin, which follows it in whole metres: where in the world it is changes no bit
 * of how it moves.
 */
#ifndef LOCKSTITCH_OBJECT_H
#define LOCKSTITCH_OBJECT_H

#include <lockstitch/asset.h>
#include <lockstitch/world.h>

#ifdef __cplusplus
extern "C" {
#endif

/* By value; generation 0 is no object. */
typedef struct lks_object_id {
    uint32_t index;
    uint32_t generation;
} lks_object_id;

#define LKS_MAX_OBJECTS 65536u

typedef struct lks_object_def {
    uint32_t struct_size;   /* set by lks_default_object_def */
    uint32_t record_forces; /* 1: keeps each constraint's multiplier, so that its force can be asked for */
    const lks_asset* asset;
    lks_transform transform;  /* of the asset's origin; position within ±8,388,000 m */
    lks_vec3 velocity;        /* m/s, of every particle; each axis within the speed limit */
    lks_fixed gravity_factor; /* on the world's gravity, -100 .. 100 */
    lks_fixed linear_damping; /* 1/s, 0 .. 1000: velocity decays by this share a second (air) */
} lks_object_def;

/* No asset yet, at the origin, at rest, gravity factor 1, no damping, forces not recorded. */
LKS_API lks_object_def lks_default_object_def(void);

/* Takes the lowest free index. The order in which objects are added decides their indices and thereby the
 * world's hash; it does not influence how any of them moves, nor the hash of any one object. */
LKS_API lks_result lks_world_add_object(lks_world* world, const lks_object_def* def, lks_object_id* object);
/* Bodies that sleep on it wake. Attachments to it are removed with it. */
LKS_API lks_result lks_world_remove_object(lks_world* world, lks_object_id object);

/* 1 while the object exists. */
LKS_API uint32_t lks_world_has_object(const lks_world* world, lks_object_id object);
/* How many there are; 0 for null. */
LKS_API uint32_t lks_world_object_count(const lks_world* world);
/* The n-th object in index order, 0 ≤ n < object count, else LKS_ERROR_INVALID_ARGUMENT. */
LKS_API lks_result lks_world_object_at(const lks_world* world, uint32_t n, lks_object_id* object);

/* The asset that it is made of: of several with the same fingerprint the one that the world was given first,
 * which need not be the definition's. Null for a stale id. */
LKS_API const lks_asset* lks_object_asset(const lks_world* world, lks_object_id object);
/* Where the object's local frame is now. */
LKS_API lks_result lks_object_origin(const lks_world* world, lks_object_id object, lks_vec3* origin);

/* On the world's gravity, -100 .. 100, else LKS_ERROR_INVALID_ARGUMENT. */
LKS_API lks_result lks_object_set_gravity_factor(lks_world* world, lks_object_id object, lks_fixed factor);
/* 1/s, 0 .. 1000, else LKS_ERROR_INVALID_ARGUMENT: velocity decays by this share a second (air). */
LKS_API lks_result lks_object_set_linear_damping(lks_world* world, lks_object_id object, lks_fixed damping);

/* Positions in the world, metres, rounded to the nearest unit, half up. `count` vertices from `first`. */
LKS_API lks_result lks_object_positions(const lks_world* world, lks_object_id object, uint32_t first,
                                        uint32_t count, lks_vec3* positions);
/* The solver's own coordinates: 56 fraction bits, relative to the origin. For golden states and tests. */
typedef struct lks_raw_position {
    int64_t x, y, z;
} lks_raw_position;
LKS_API lks_result lks_object_raw_positions(const lks_world* world, lks_object_id object, uint32_t first,
                                            uint32_t count, lks_raw_position* positions);

/* m/s, rounded to the nearest unit. */
LKS_API lks_result lks_object_velocities(const lks_world* world, lks_object_id object, uint32_t first,
                                         uint32_t count, lks_vec3* velocities);
/* Each axis within the speed limit. A pinned vertex is refused: its pin decides. */
LKS_API lks_result lks_object_set_velocity(lks_world* world, lks_object_id object, uint32_t vertex,
                                           lks_vec3 velocity);
/* N·s. Impulses on one vertex add up in any order to the same bits while the speed limit is not reached;
 * beyond it the speed is clamped and counted. A pinned vertex takes no impulse: the call succeeds and changes
 * nothing. */
LKS_API lks_result lks_object_apply_impulse(lks_world* world, lks_object_id object, uint32_t vertex,
                                            lks_vec3 impulse);
/* The same impulse per kilogram for every free vertex: a change of velocity, m/s, each axis within the speed
 * limit. */
LKS_API lks_result lks_object_add_velocity(lks_world* world, lks_object_id object, lks_vec3 velocity);

/* Elsewhere at once. Nothing is hit on the way and no speed comes of it: the next tick begins there, and
 * views show it there. Bodies that sleep on the object, or where it comes to, wake. Attachments stay, and
 * what they are apart afterwards comes together as after lks_world_add_attachment. */

/* Carries the object along as if it were fixed to a frame that was at `from` and is at `to`: a cape with the
 * chest of its wearer, before and after lks_body_set_transform or lks_ragdoll_set_pose. Pin targets go with
 * it, and velocities turn with it. Both positions are within ±8,388,000 m; refused where the object's origin
 * would not be, or, where it turns, a vertex not within ±64 m of the object's middle on each axis.
 *
 * Where both rotations are the same, no raw position and no velocity changes a bit, and the origin goes by
 * exactly to - from: the object moves as one that was made there. Where they differ each coordinate is
 * rounded once, by half a unit of 2^-56 m, and besides within 2^-60 of its distance from the object's middle;
 * all of them alike within 2^-60 of the middle's distance from `from`. Quarter and half turns about the
 * world's axes are exact. A pin's target that leaves its range by a turn is clamped and counted. */
LKS_API lks_result lks_object_teleport(lks_world* world, lks_object_id object, const lks_transform* from,
                                       const lks_transform* to);
/* Puts `count` vertices from `first` to places in the world, metres, each axis within ±8,388,000 m, exactly;
 * a pin goes with its vertex. Velocities stay. Refused where the object, with the vertices that stay, would
 * be longer than 120 m on an axis. Lay many vertices by one call: each one looks at the whole object. */
LKS_API lks_result lks_object_set_positions(lks_world* world, lks_object_id object, uint32_t first,
                                            uint32_t count, const lks_vec3* positions);

/* Pins. A pinned vertex has infinite mass and goes from where it is to its target during each tick, in equal
 * parts a substep. Pinning puts the target at the present place; pinning a pinned vertex changes nothing. A
 * target stays until it is changed. Unpinning leaves the vertex with the velocity it had; a vertex that is
 * not pinned can neither be unpinned nor be given a target, and one that an attachment without compliance or
 * break force holds at a kinematic body or a pinned vertex can't be pinned. */
LKS_API lks_result lks_object_pin(lks_world* world, lks_object_id object, uint32_t vertex);
LKS_API lks_result lks_object_unpin(lks_world* world, lks_object_id object, uint32_t vertex);
/* Where the vertex is to be at the end of the next tick, in the world, metres, each axis within ±8,388,000 m.
 * What is not within ±64 m of the object's origin is clamped to that and counted (target_clamps). */
LKS_API lks_result lks_object_set_pin_target(lks_world* world, lks_object_id object, uint32_t vertex,
                                             lks_vec3 target);
/* How many vertices are pinned; 0 for a stale id. */
LKS_API uint32_t lks_object_pin_count(const lks_world* world, lks_object_id object);
/* 1 while the vertex is pinned; 0 for a stale id and for what is no vertex. */
LKS_API uint32_t lks_object_is_pinned(const lks_world* world, lks_object_id object, uint32_t vertex);

/* The force of one constraint in newtons at the end of the last tick (λ/h², the mean over its last substep),
 * whatever was pinned or unpinned since: positive pulls the ends together (tension), negative pushes them
 * apart. Needs record_forces. Saturates at ±8,388,607 N. */
LKS_API lks_result lks_object_constraint_force(const lks_world* world, lks_object_id object,
                                               uint32_t constraint, lks_fixed* force);

#ifdef __cplusplus
}
#endif
#endif
