/* Lockstitch: rigid bodies.
 *
 * A body is made of one to eight shapes with densities; mass, centre of mass and inertia follow from them. It
 * is moved by forces, contacts and joints (dynamic), or goes where the game says (kinematic). Everything is
 * fixed-point. Where in the world bodies are changes no bit of how they move.
 *
 * Method: extended position based dynamics (Müller et al. 2020) in substeps; a body's spin follows the
 * implicit midpoint rule with Cayley's map, which keeps angular momentum and energy.
 */
#ifndef LOCKSTITCH_BODY_H
#define LOCKSTITCH_BODY_H

#include <lockstitch/collider.h>
#include <lockstitch/filter.h>
#include <lockstitch/world.h>

#ifdef __cplusplus
extern "C" {
#endif

/* By value; generation 0 is no body. */
typedef struct lks_body_id {
    uint32_t index;
    uint32_t generation;
} lks_body_id;

#define LKS_MAX_BODIES 65536u
#define LKS_MAX_BODY_SHAPES 8u

typedef enum lks_body_kind {
    LKS_BODY_DYNAMIC = 0,  /* has a mass, and is moved by what acts on it */
    LKS_BODY_KINEMATIC = 1 /* infinitely heavy; moves by lks_body_move_to only */
} lks_body_kind;

typedef struct lks_body_shape {
    uint32_t shape;          /* an lks_shape_kind: sphere, capsule or box */
    uint32_t reserved;       /* 0 */
    lks_transform transform; /* of the shape in the body's frame; position within ±30 m */
    lks_fixed radius;        /* metres, 0.001 .. 30 */
    lks_fixed half_length;   /* metres, 0 .. 30, of a capsule's axis along local y, without the caps */
    lks_vec3 half_extents;   /* metres, 0.001 .. 30 each */
    lks_fixed density;       /* kg/m³, 0.001 .. 100000 */
} lks_body_shape;

typedef struct lks_body_def {
    uint32_t struct_size;      /* set by lks_default_body_def */
    uint32_t kind;             /* an lks_body_kind; of a kinematic body velocities are ignored */
    lks_transform transform;   /* of the body's frame; its centre of mass within ±8,388,000 m */
    lks_vec3 velocity;         /* of the centre of mass, m/s, each axis within the speed limit */
    lks_vec3 angular_velocity; /* rad/s in world axes, each axis within the spin limit */
    const lks_body_shape* shapes;
    uint32_t shape_count;       /* 1 .. LKS_MAX_BODY_SHAPES */
    uint32_t never_sleeps;      /* 1: it, and what it has to do with, stay awake */
    lks_fixed mass;             /* kg, 0.000001 .. 1000000; 0: as the densities say */
    lks_fixed gravity_factor;   /* on the world's gravity, -100 .. 100 */
    lks_fixed linear_damping;   /* 1/s, 0 .. 1000 */
    lks_fixed angular_damping;  /* 1/s, 0 .. 1000 */
    lks_fixed static_friction;  /* 0 .. 100; of two surfaces the geometric mean counts */
    lks_fixed dynamic_friction; /* of what slides, 0 .. static_friction */
    lks_fixed restitution;      /* 0 .. 1: the share of the normal speed that an impact gives back; of two
                                   surfaces the greater counts */
    lks_filter filter;          /* against bodies, colliders and particles */
} lks_body_def;

/* Dynamic, at the origin, no shapes yet, friction 0.5 and 0.4, no restitution, category 1, mask of all. */
LKS_API lks_body_def lks_default_body_def(void);
/* A sphere of 0.5 m and 1000 kg/m³. */
LKS_API lks_body_shape lks_default_body_shape(void);

/* Takes the lowest free index. Bodies are solved in the order of their indices: the order in which bodies
 * that meet are added is part of the simulation. */
LKS_API lks_result lks_world_add_body(lks_world* world, const lks_body_def* def, lks_body_id* body);
/* Joints and attachments on it are removed with it. */
LKS_API lks_result lks_world_remove_body(lks_world* world, lks_body_id body);
/* 1 while the body exists. */
LKS_API uint32_t lks_world_has_body(const lks_world* world, lks_body_id body);
/* How many there are; 0 for null. */
LKS_API uint32_t lks_world_body_count(const lks_world* world);
/* The n-th body in index order, 0 ≤ n < body count, else LKS_ERROR_INVALID_ARGUMENT. Looks at all up to it.
 */
LKS_API lks_result lks_world_body_at(const lks_world* world, uint32_t n, lks_body_id* body);

/* The speed limit of each axis of an angular velocity in rad/s: the lower of 1000 and one a substep. */
LKS_API lks_fixed lks_world_spin_limit(const lks_world* world);

/* Of the body's frame. The position is exact; the rotation is rounded to 2^-30. */
LKS_API lks_result lks_body_transform(const lks_world* world, lks_body_id body, lks_transform* transform);
/* Puts it there at once; its velocity stays. Who touched it or is jointed to it wakes, and whom a kinematic
 * one touches there. Cloth and ropes that are attached to it stay behind: lks_object_teleport. */
LKS_API lks_result lks_body_set_transform(lks_world* world, lks_body_id body, lks_transform transform);
/* m/s of the centre of mass, and rad/s, in world axes. Either may be null. What tumbles freely may spin
 * faster than the limit, up to 7/4 of it. */
LKS_API lks_result lks_body_velocity(const lks_world* world, lks_body_id body, lks_vec3* velocity,
                                     lks_vec3* angular_velocity);
/* Each axis within the speed limit and the spin limit. Wakes it. LKS_ERROR_UNSUPPORTED if it is kinematic. */
LKS_API lks_result lks_body_set_velocity(lks_world* world, lks_body_id body, lks_vec3 velocity,
                                         lks_vec3 angular_velocity);
/* N·s, each axis within ±8,388,607, at a point of the world within ±64 m of the centre of mass on each axis.
 * A kinematic body takes none: the call succeeds and changes nothing. Beyond the limits the speeds are
 * clamped. */
LKS_API lks_result lks_body_apply_impulse(lks_world* world, lks_body_id body, lks_vec3 impulse,
                                          lks_vec3 point);
/* N·m·s in world axes, each within ±8,388,607: turns it and moves it not. Everything else as above. */
LKS_API lks_result lks_body_apply_angular_impulse(lks_world* world, lks_body_id body, lks_vec3 impulse);
/* Where a kinematic body is to be at the end of the next tick; it gets there evenly over the substeps (a turn
 * of 90° within 10 %, of 10° within 0.1 %) and rests there until the next call. At most 100 m and 90° a
 * tick. LKS_ERROR_UNSUPPORTED for a dynamic body. */
LKS_API lks_result lks_body_move_to(lks_world* world, lks_body_id body, lks_transform target);

/* An lks_body_kind. What becomes dynamic keeps the velocity that it was moved with in the last tick, within
 * the speed limit and the spin limit; what becomes kinematic rests where it is until it is moved. Joints and
 * attachments stay. */
LKS_API lks_result lks_body_set_kind(lks_world* world, lks_body_id body, uint32_t kind);
/* LKS_BODY_DYNAMIC for a stale id. */
LKS_API uint32_t lks_body_get_kind(const lks_world* world, lks_body_id body);

/* What a body was added with may be changed while it exists: of either kind, with the ranges and sentences of
 * lks_body_def, from the next tick on. It is state: images have it, hashes cover it, and a load brings back
 * what was saved. A change wakes the body with its island, so that what was held up by the old value falls;
 * one of its surface or its filter wakes who touches it, too, also where it is kinematic. What is the same as
 * before changes nothing and wakes nobody. A stale id is LKS_ERROR_STALE_ID, what is out of range
 * LKS_ERROR_INVALID_ARGUMENT. */

/* On the world's gravity, -100 .. 100. Of a kinematic body it counts, as damping does, once it is dynamic. */
LKS_API lks_result lks_body_set_gravity_factor(lks_world* world, lks_body_id body, lks_fixed factor);
LKS_API lks_result lks_body_gravity_factor(const lks_world* world, lks_body_id body, lks_fixed* factor);
/* 1/s, 0 .. 1000 each. */
LKS_API lks_result lks_body_set_damping(lks_world* world, lks_body_id body, lks_fixed linear,
                                        lks_fixed angular);
/* Either may be null. */
LKS_API lks_result lks_body_damping(const lks_world* world, lks_body_id body, lks_fixed* linear,
                                    lks_fixed* angular);
/* Of all its shapes: static friction 0 .. 100, dynamic friction 0 .. static_friction, restitution 0 .. 1. */
LKS_API lks_result lks_body_set_surface(lks_world* world, lks_body_id body, lks_fixed static_friction,
                                        lks_fixed dynamic_friction, lks_fixed restitution);
/* Any may be null. */
LKS_API lks_result lks_body_surface(const lks_world* world, lks_body_id body, lks_fixed* static_friction,
                                    lks_fixed* dynamic_friction, lks_fixed* restitution);
/* Of all its shapes; every value is a good one. Contacts that may not be any more end with the next tick and
 * LKS_EVENT_CONTACT_END; what may touch now, and overlaps already, parts as what is added there does. A
 * kinematic body wakes whom it touches by the new filter. Joints and attachments stay. */
LKS_API lks_result lks_body_set_filter(lks_world* world, lks_body_id body, lks_filter filter);
LKS_API lks_result lks_body_filter(const lks_world* world, lks_body_id body, lks_filter* filter);
/* 1: it, and what it has to do with, stay awake; 0: they may sleep once they have rested. */
LKS_API lks_result lks_body_set_never_sleeps(lks_world* world, lks_body_id body, uint32_t never_sleeps);
/* 0 for a stale id. */
LKS_API uint32_t lks_body_never_sleeps(const lks_world* world, lks_body_id body);

/* Sleep. What has been slower than 10 cm/s, or within a centimetre and two degrees of one place, for half a
 * second, with all that it touches and is jointed to, is taken out of the simulation: a sleeping pile costs
 * next to nothing; what accelerates steadily by 5 cm/s² and more, as on a slope, is not. Where nothing
 * touches it that takes two seconds, and where something overlaps by more than 1.5 mm two seconds on the
 * average. It wakes, with all these, when something awake or kinematic comes to touch or push it, when
 * particles strike it or a cloth or rope leaves it altogether, when the game does something to it, and when
 * what it touches or is jointed to is removed, put elsewhere or gets another kind, or what it touches another
 * surface or filter. Adding, placing or removing a collider wakes all whose filters meet its own, adding or
 * placing a kinematic body those that it touches, gravity everybody. What comes to lie beside it, or softly
 * on it, does not.
 * 1 while the body is awake; 0 for a kinematic body and a stale id. */
LKS_API uint32_t lks_body_is_awake(const lks_world* world, lks_body_id body);
/* With its island, from the next tick on. */
LKS_API lks_result lks_body_wake(lks_world* world, lks_body_id body);
/* How many bodies are awake; kinematic ones don't count. 0 for null. */
LKS_API uint32_t lks_world_awake_body_count(const lks_world* world);
/* Pairs of shapes, bodies' and colliders', that pushed each other at the end of the last tick, or did when
 * they fell asleep. Particles don't count. Whose they are: lks_world_contacts (lockstitch/event.h). */
LKS_API uint32_t lks_world_contact_count(const lks_world* world);

/* kg; 0 for a kinematic body, and at most what an lks_fixed holds, 8388608, of one that its densities make
 * heavier. */
LKS_API lks_result lks_body_mass(const lks_world* world, lks_body_id body, lks_fixed* mass);
/* In the body's frame, metres. */
LKS_API lks_result lks_body_centre_of_mass(const lks_world* world, lks_body_id body, lks_vec3* centre);
/* Joules of all dynamic bodies: ½mv² + ½ωIω. Saturates at 8,388,607. */
LKS_API lks_result lks_world_kinetic_energy(const lks_world* world, lks_fixed* energy);

#ifdef __cplusplus
}
#endif
#endif
