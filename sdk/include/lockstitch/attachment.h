/* Lockstitch: attachments. A vertex of a cloth or a rope is held at a point of a body, or at another vertex:
 * a rope's end in a hand, a cape on shoulders, two ropes tied together. Both sides pull each other.
 *
 * What is attached goes through each substep together with what it is attached to: cloth or rope first, then
 * attachments in the order of their indices, joints and contacts, and attachments again. A body that an
 * attachment holds does not fall asleep. An attached vertex does not collide with its body. A rigid one to
 * what can't move is refused where a pin, or another one, holds the vertex there already; a body that becomes
 * kinematic is not asked, and of two that hold one vertex then only one may.
 *
 * What hangs rigidly on a rope that is solved at once (LKS_ROPE_DIRECT, or chosen so by the world) stays on
 * it up to 1,000 times the mass of the rope with one substep at 60 Hz, and 20,000 times with four. On ropes
 * that are swept, on cloth and between ropes a body falls off that weighs too much: in a substep it parts
 * from its vertex by what it falls times its mass over the vertex's.
 *
 * A pinned vertex holds a figure as a joint to what stands does, and leads it: solved together with its
 * joints, up to three vertices a body and twelve a figure; what else holds it is solved by itself.
 *
 * Method: extended position based dynamics (Macklin et al. 2016, eq. 26), in all three directions at once.
 */
#ifndef LOCKSTITCH_ATTACHMENT_H
#define LOCKSTITCH_ATTACHMENT_H

#include <lockstitch/body.h>
#include <lockstitch/object.h>

#ifdef __cplusplus
extern "C" {
#endif

/* By value; generation 0 is no attachment. */
typedef struct lks_attachment_id {
    uint32_t index;
    uint32_t generation;
} lks_attachment_id;

#define LKS_MAX_ATTACHMENTS 65536u

typedef enum lks_attachment_kind {
    LKS_ATTACHMENT_TO_BODY = 0,  /* to `point` of `body` */
    LKS_ATTACHMENT_TO_VERTEX = 1 /* to `other_vertex` of `other_object` */
} lks_attachment_kind;

typedef struct lks_attachment_def {
    uint32_t struct_size; /* set by lks_default_attachment_def */
    uint32_t kind;        /* an lks_attachment_kind */
    lks_object_id object;
    lks_body_id body;
    lks_object_id other_object;
    uint32_t vertex;
    uint32_t other_vertex;
    lks_vec3 point;       /* in the body's frame, metres, within ±64 m */
    lks_fixed compliance; /* m/N, 0 .. 1000; at most 2^30 / (m · n²) counts, m being the mass of the lighter
                             side and n the substeps a second */
    lks_fixed damping;    /* where it is soft, N·s/m, 0 .. 1000000 */
    lks_fixed break_force; /* N, the mean of a tick: beyond it the attachment is removed, with an event;
                              0 .. 8000000; 0: never */
} lks_attachment_def;

/* To a body, rigid, never breaks. */
LKS_API lks_attachment_def lks_default_attachment_def(void);

/* Takes the lowest free index. Everything is left where it is: what is apart is pulled together from the next
 * tick on, a rigid one by two metres a second where the other side can move, and at once where it can't.
 * Pinned vertices and kinematic bodies pull, but are not pulled; where neither side can move (yet) it is
 * refused, and so is holding a vertex at two things that can't move, or at two points of one body, if neither
 * attachment has a compliance or a break force. */
LKS_API lks_result lks_world_add_attachment(lks_world* world, const lks_attachment_def* def,
                                            lks_attachment_id* attachment);
/* Goes by itself with either side. */
LKS_API lks_result lks_world_remove_attachment(lks_world* world, lks_attachment_id attachment);
/* 1 while the attachment exists. */
LKS_API uint32_t lks_world_has_attachment(const lks_world* world, lks_attachment_id attachment);
/* How many there are; 0 for null. */
LKS_API uint32_t lks_world_attachment_count(const lks_world* world);
/* The n-th attachment in index order, 0 ≤ n < attachment count, else LKS_ERROR_INVALID_ARGUMENT. Looks at all
 * up to it. */
LKS_API lks_result lks_world_attachment_at(const lks_world* world, uint32_t n, lks_attachment_id* attachment);

/* How far the two sides are apart, metres. Saturates at 8,388,608. */
LKS_API lks_result lks_attachment_error(const lks_world* world, lks_attachment_id attachment,
                                        lks_fixed* error);
/* What it does to the body, or the other vertex, in world axes, newtons: the mean over the last tick.
 * Saturates at ±8,388,607. */
LKS_API lks_result lks_attachment_force(const lks_world* world, lks_attachment_id attachment,
                                        lks_vec3* force);

#ifdef __cplusplus
}
#endif
#endif
