/* Lockstitch: ragdolls. A tree of bones, each a body with a joint to its parent, described once and put into
 * a world as often as wanted.
 *
 * A description is plain data of the game's; a ragdoll in the world is its bodies and joints, whose ids the
 * game keeps. Everything that bodies and joints can do, they can.
 */
#ifndef LOCKSTITCH_RAGDOLL_H
#define LOCKSTITCH_RAGDOLL_H

#include <lockstitch/joint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LKS_MAX_BONES 256u
#define LKS_NO_PARENT 0xffffffffu

typedef struct lks_bone {
    uint32_t parent;     /* an earlier bone, or LKS_NO_PARENT for the first one, the root */
    uint32_t joint_kind; /* an lks_joint_kind: ball, hinge or fixed; of the root none */
    /* Shapes, mass, surface, filter. Its transform is the bone's in the ragdoll's frame, in the rest pose,
     * position within ±30 m; velocities are ignored. At the ragdoll's scale shapes and mass must be in the
     * ranges of lks_body_def, and the joint's point within ±64 m in both bodies' frames. */
    lks_body_def body;
    lks_transform joint_frame; /* in the ragdoll's frame, in the rest pose, position within ±30 m; its axis is
                                  local y */
    /* How the frame in the bone is turned in that of its parent in the rest pose: limits are around where
     * both are turned alike, which need not be there. A hip that reaches 110 degrees forwards and 10 back
     * rests 50 degrees behind the middle of its cone. */
    lks_rotation joint_rest;
    /* Of the joint, with the units and ranges of lks_joint_def, whatever the scale. */
    lks_fixed swing_limit;   /* degrees; 180: none */
    lks_fixed swing_limit_z; /* degrees; negative: as swing_limit */
    lks_fixed twist_min;     /* degrees */
    lks_fixed twist_max;
    lks_fixed compliance;         /* of the points, m/N */
    lks_fixed damping;            /* of soft points, N·s/m */
    lks_fixed angular_compliance; /* of what hinges and fixed joints hold, rad/(N·m) */
    lks_fixed angular_damping;    /* N·m·s */
    lks_fixed limit_compliance;   /* rad/(N·m) */
    lks_fixed limit_damping;      /* N·m·s */
    lks_fixed friction;           /* N·m; for the same looks at another scale, times its fourth power */
    /* At scale 1. Forces go with the cube of the scale, as weights do, and torques with its fourth power: a
     * figure of any size bears as many times its own weight. */
    lks_fixed break_force;  /* N, 0 .. 8000000: where it bears more the bone comes off; 0: never */
    lks_fixed break_torque; /* N·m, 0 .. 8000000; 0: never */
    lks_fixed motor_torque; /* N·m, 0 .. 1000000: what lks_ragdoll_drive turns it with */
} lks_bone;

typedef struct lks_ragdoll_def {
    uint32_t struct_size; /* set by lks_default_ragdoll_def */
    uint32_t bone_count;  /* 1 .. LKS_MAX_BONES */
    const lks_bone* bones;
    lks_transform transform; /* of the ragdoll's frame in the world; it and all bones within ±8,388,000 m */
    lks_vec3 velocity;       /* of all bones, m/s, each axis within the speed limit */
    lks_fixed scale;         /* of all lengths, 0.05 .. 20; masses go with its cube */
    int32_t group;     /* of all bones' filters; 0: each bone's own. Less than zero: bones don't collide with
                          each other at all, and otherwise all but neighbours do */
    uint32_t reserved; /* 0 */
} lks_ragdoll_def;

/* A root without shapes at the origin, lks_default_body_def for its body, a joint that rests where its frames
 * are turned alike, no limits, friction or muscles, rigid, unbreakable. */
LKS_API lks_bone lks_default_bone(void);
/* No bones yet, at the origin, at rest, scale 1, group 0. */
LKS_API lks_ragdoll_def lks_default_ragdoll_def(void);

/* Adds a body for each bone, and a joint from each bone but the root to its parent (body a). `bodies` has
 * room for bone_count ids, `joints` for bone_count - 1 (null: not wanted). All or nothing. A joint that
 * breaks is told by LKS_EVENT_JOINT_BROKE (lockstitch/event.h); what hung on it falls off, and collides with
 * what it was joined to. */
LKS_API lks_result lks_world_add_ragdoll(lks_world* world, const lks_ragdoll_def* def, lks_body_id* bodies,
                                         lks_joint_id* joints);

/* Poses: where bones are in the world, an array of `count` transforms in the order of `bodies`, none of which
 * is there twice. Each call does all of it or nothing; what it refuses names the bone. */

/* For skinning. */
LKS_API lks_result lks_ragdoll_pose(const lks_world* world, const lks_body_id* bodies, uint32_t count,
                                    lks_transform* pose);
/* Puts bones there at once. `before` is the pose one tick earlier, from which dynamic bones get their
 * velocities, clamped to the limits; null: they keep those they have. What they wear: lks_object_teleport. */
LKS_API lks_result lks_ragdoll_set_pose(lks_world* world, const lks_body_id* bodies, uint32_t count,
                                        const lks_transform* pose, const lks_transform* before);
/* Kinematic bones: where they are to be at the end of the next tick, as lks_body_move_to has it. More than
 * LKS_MAX_BONES are LKS_ERROR_LIMIT. */
LKS_API lks_result lks_ragdoll_move_to(lks_world* world, const lks_body_id* bodies, uint32_t count,
                                       const lks_transform* pose);
/* From animation to ragdoll, and back: lks_body_set_kind of all. */
LKS_API lks_result lks_ragdoll_set_kind(lks_world* world, const lks_body_id* bodies, uint32_t count,
                                        uint32_t kind);
/* Powered: the motors of all joints turn the bones against each other as the pose has them (where it is in
 * the world does not matter), or as near to it as rigid limits let them (lks_motor), with `strength` (0 ..
 * 100) times their bones' motor_torque, which goes with the fourth power of the scale, 1,000,000 N·m at most;
 * 0: limp. `response` is that of lks_motor, 0 .. 100 s. `joints` and `pose` are those of
 * lks_world_add_ragdoll; joints of generation 0, such as a game sets it to where one broke, are left out.
 * Fixed joints have no motors. */
LKS_API lks_result lks_ragdoll_drive(lks_world* world, const lks_ragdoll_def* def, const lks_joint_id* joints,
                                     const lks_transform* pose, lks_fixed strength, lks_fixed response);

/* A human of 1.8 m and 78 kg, standing on the plane y = 0 and facing +z, arms hanging: 15 bones with limits
 * of a human's joints. */
#define LKS_HUMANOID_BONES 15u
typedef enum lks_humanoid_bone {
    LKS_HUMANOID_PELVIS = 0,
    LKS_HUMANOID_CHEST = 1,
    LKS_HUMANOID_HEAD = 2,
    LKS_HUMANOID_UPPER_ARM_LEFT = 3,
    LKS_HUMANOID_LOWER_ARM_LEFT = 4,
    LKS_HUMANOID_HAND_LEFT = 5,
    LKS_HUMANOID_UPPER_ARM_RIGHT = 6,
    LKS_HUMANOID_LOWER_ARM_RIGHT = 7,
    LKS_HUMANOID_HAND_RIGHT = 8,
    LKS_HUMANOID_UPPER_LEG_LEFT = 9,
    LKS_HUMANOID_LOWER_LEG_LEFT = 10,
    LKS_HUMANOID_FOOT_LEFT = 11,
    LKS_HUMANOID_UPPER_LEG_RIGHT = 12,
    LKS_HUMANOID_LOWER_LEG_RIGHT = 13,
    LKS_HUMANOID_FOOT_RIGHT = 14
} lks_humanoid_bone;

/* Their shapes too: the bones point into `shapes`. The muscles (motor_torque) are those of a strong one. */
LKS_API lks_result lks_humanoid(lks_bone bones[LKS_HUMANOID_BONES],
                                lks_body_shape shapes[LKS_HUMANOID_BONES]);

/* A spider of 1.1 m from foot to foot and 12 kg, standing on the plane y = 0 and facing +z: a thorax, an
 * abdomen, and eight legs of a thigh and a shin, left front, left back, ... right front, right back. */
#define LKS_SPIDER_LEGS 8u
#define LKS_SPIDER_BONES 18u
enum {
    LKS_SPIDER_THORAX = 0,
    LKS_SPIDER_ABDOMEN = 1,
    LKS_SPIDER_FIRST_LEG = 2 /* thigh of leg n: 2 + 2 n, its shin: 3 + 2 n */
};

/* Their shapes and muscles too, as lks_humanoid has it. */
LKS_API lks_result lks_spider(lks_bone bones[LKS_SPIDER_BONES], lks_body_shape shapes[LKS_SPIDER_BONES]);

#ifdef __cplusplus
}
#endif
#endif
