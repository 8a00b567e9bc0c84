/* Lockstitch: joints between rigid bodies.
 *
 * A joint has a frame in each of its two bodies. Its axis is the frames' local y, as a capsule's is; both
 * frames fall together where the joint is at rest. Angles are degrees.
 *
 *   ball      the points stay together; the axes swing apart by at most swing_limit (a cone), and b is
 *             twisted against a about its axis from twist_min to twist_max (near 180 degrees of swing, where
 *             a twist means nothing, its limits give way)
 *   hinge     the points and the axes stay together; b turns against a from twist_min to twist_max
 *   fixed     nothing moves
 *   distance  the points stay from distance_min to distance_max apart. A joint without compliance that is
 *             made, or whose body is put, beyond these brings them back without giving speed, by up to half a
 *             metre a substep, and what that takes is no load: a joint that is given a shorter distance_max
 *             each tick (lks_joint_set_limits) is a winch, which lifts with the weight of what hangs on it;
 *             what it lifts has no speed of its own from that
 *
 * Joints are not checked against each other: what two of them hold at places apart comes to rest at one of
 * them, or between.
 *
 * Method: extended position based dynamics (Müller et al. 2020); the points are brought together by a solve
 * in all three directions at once.
 */
#ifndef LOCKSTITCH_JOINT_H
#define LOCKSTITCH_JOINT_H

#include <lockstitch/body.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lks_joint_id {
    uint32_t index;
    uint32_t generation; /* 0 is no joint */
} lks_joint_id;

#define LKS_MAX_JOINTS 65536u

typedef enum lks_joint_kind {
    LKS_JOINT_BALL = 0,
    LKS_JOINT_HINGE = 1,
    LKS_JOINT_FIXED = 2,
    LKS_JOINT_DISTANCE = 3
} lks_joint_kind;

typedef struct lks_joint_def {
    uint32_t struct_size; /* set by lks_default_joint_def */
    uint32_t kind;        /* an lks_joint_kind */
    lks_body_id body_a;   /* two different bodies; while both are kinematic the joint rests */
    lks_body_id body_b;
    lks_transform frame_a;   /* in a's frame; positions within ±64 m */
    lks_transform frame_b;   /* in b's frame */
    uint32_t bodies_collide; /* 0: the two bodies don't collide with each other while the joint exists */
    uint32_t reserved;       /* 0 */
    lks_fixed swing_limit;   /* degrees, 0 .. 180; 180: none */
    lks_fixed swing_limit_z; /* degrees, 0 .. 180, where the cone is an ellipse: swing_limit towards the
                                frames' local x, this towards local z, and what is less than 0.05 counts as
                                that; negative: as swing_limit */
    lks_fixed twist_min;     /* degrees, -180 .. twist_max; -180 and 180: none */
    lks_fixed twist_max;     /* degrees, twist_min .. 180 */
    lks_fixed distance_min;  /* metres, 0 .. distance_max */
    lks_fixed distance_max;  /* metres, distance_min .. 64 */
    /* Of mass m (the lighter of the two bodies) and n substeps a second, what is softer than 2^30 / (m · n²)
     * is as soft as that; angles likewise, with a moment of inertia. */
    lks_fixed compliance; /* of the points, m/N, 0 .. 1000 */
    lks_fixed damping;    /* of soft points, N·s/m, 0 .. 1000000 */
    lks_fixed
        angular_compliance;     /* of what hinges and fixed joints hold, rad/(N·m), 0 .. 1000; of no other */
    lks_fixed angular_damping;  /* N·m·s: resists turning by its speed, 0 .. 1000000 */
    lks_fixed limit_compliance; /* of swing and twist beyond their limits, rad/(N·m), 0 .. 1000; 0: rigid,
                                   exceeded by a few degrees at most where substeps suffice */
    lks_fixed limit_damping;    /* of soft limits, N·m·s: resists going further beyond by its speed,
                                   0 .. 1000000 */
    lks_fixed friction;         /* N·m that resist turning, 0 .. 1000000 */
    /* Where the mean of a tick exceeds them, the joint is removed at its end, with an event; 0: never. */
    lks_fixed break_force;  /* N at the points, 0 .. 8000000 */
    lks_fixed break_torque; /* N·m, 0 .. 8000000 */
} lks_joint_def;

/* Turns b's frame against a's towards a target, as fast as its torque allows and no faster than to leave 1/e
 * of the way after `response`. It holds against any load that its torque can bear.
 *
 * It does not push against rigid limits. Where they don't let it to its target it goes to what is next to
 * that within them: a swing ends at the edge of its cone or ellipse, a twist at the nearer end of its range;
 * when limits change it goes on. Where the shortest way leads out of them it goes along them, and may get no
 * further. Into soft limits (limit_compliance) it pushes with its torque. */
typedef struct lks_motor {
    lks_fixed max_torque; /* N·m, 0 .. 1000000; 0: off */
    lks_fixed response;   /* seconds, 0 .. 100; at least eight substeps */
    lks_rotation target;  /* of b's frame in a's; of a hinge its turn about the axis counts, and it goes there
                             within its limits; of a ball joint by the shortest way */
} lks_motor;

/* The limits of a joint that exists: as in lks_joint_def, which says what they mean. */
typedef struct lks_limits {
    lks_fixed swing_limit;
    lks_fixed swing_limit_z;
    lks_fixed twist_min;
    lks_fixed twist_max;
    lks_fixed distance_min;
    lks_fixed distance_max;
} lks_limits;

/* A ball joint without limits, at the origins of both bodies, which don't collide. */
LKS_API lks_joint_def lks_default_joint_def(void);

/* Takes the lowest free index; joints are solved in the order of their indices, before contacts. Both bodies
 * are left where they are: what is apart is brought together from the next tick on. */
LKS_API lks_result lks_world_add_joint(lks_world* world, const lks_joint_def* def, lks_joint_id* joint);
/* Wakes both bodies. LKS_ERROR_STALE_ID where it is gone: removed, broken, or with one of its bodies. */
LKS_API lks_result lks_world_remove_joint(lks_world* world, lks_joint_id joint);
/* 1 while the joint exists. */
LKS_API uint32_t lks_world_has_joint(const lks_world* world, lks_joint_id joint);
/* How many there are; 0 for null. */
LKS_API uint32_t lks_world_joint_count(const lks_world* world);
/* The n-th joint in index order, 0 ≤ n < joint count, else LKS_ERROR_INVALID_ARGUMENT. Looks at all up to it.
 */
LKS_API lks_result lks_world_joint_at(const lks_world* world, uint32_t n, lks_joint_id* joint);
/* Which bodies it joins. Either may be null. */
LKS_API lks_result lks_joint_bodies(const lks_world* world, lks_joint_id joint, lks_body_id* body_a,
                                    lks_body_id* body_b);

/* How far the two points are from where the joint allows them, metres. Saturates at 8,388,608. */
LKS_API lks_result lks_joint_error(const lks_world* world, lks_joint_id joint, lks_fixed* error);
/* Degrees: how far the axes are apart, 0 .. 180, and how far b is twisted against a, -180 .. 180. Either may
 * be null. */
LKS_API lks_result lks_joint_angles(const lks_world* world, lks_joint_id joint, lks_fixed* swing,
                                    lks_fixed* twist);
/* The swing as swing_limit and swing_limit_z bound it: how far b's axis has swung towards local x, and z, of
 * a's frame. Degrees, -180 .. 180; their squares add up to the swing's. At 180 all of it is towards x. Either
 * may be null. */
LKS_API lks_result lks_joint_swing(const lks_world* world, lks_joint_id joint, lks_fixed* x, lks_fixed* z);
/* What the joint does to body b, in world axes: newtons at the points, and newton metres; the mean over the
 * last tick in which it was awake. a gets the opposite. Saturates at ±8,388,607. Either may be null. */
LKS_API lks_result lks_joint_load(const lks_world* world, lks_joint_id joint, lks_vec3* force,
                                  lks_vec3* torque);

/* In the ranges of lks_joint_def. What is beyond new limits is brought back as what was put beyond them:
 * without giving speed, and that is no load. So a distance joint whose distance_max gets shorter each tick is
 * a winch, and a hinge whose limits close comes back as fast as a few ticks allow. Nothing is hit on the way:
 * a door that closes by 8 degrees a tick pushes aside what stands in it, by 16 and more it passes through.
 * Limits that differ from the present ones wake both bodies. */
LKS_API lks_result lks_joint_set_limits(lks_world* world, lks_joint_id joint, const lks_limits* limits);
/* The present ones, degrees and metres; swing_limit_z is negative where it is as swing_limit. */
LKS_API lks_result lks_joint_limits(const lks_world* world, lks_joint_id joint, lks_limits* limits);

/* Of a ball joint or a hinge; on others LKS_ERROR_UNSUPPORTED, unless it is off. While it is on the joint's
 * friction is not. A motor that differs from the present one wakes both bodies, unless neither turns anything
 * (max_torque 0). */
LKS_API lks_result lks_joint_set_motor(lks_world* world, lks_joint_id joint, const lks_motor* motor);
/* The present one, N·m and seconds, its target normalised; off (max_torque 0) until one is set. */
LKS_API lks_result lks_joint_motor(const lks_world* world, lks_joint_id joint, lks_motor* motor);

#ifdef __cplusplus
}
#endif
#endif
