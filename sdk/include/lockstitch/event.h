/* Lockstitch: events. What happened to bodies, joints and attachments, for sounds, sparks and game rules.
 *
 * Events are no part of the state and change nothing of it: a world that records them has the same bits as
 * one that does not, and a world that was rolled back gives the same ones again (but for who woke between
 * the tick and the save). They come in a canonical order: by tick, within it contacts by their bodies'
 * indices, then particles on bodies by the indices of object and body, broken joints, broken attachments, and
 * sleep. Of a contact's two sides one is dynamic: kinematic bodies and colliders do not touch each other, so
 * that who is moved as a kinematic body presses no plate but a dynamic one.
 */
#ifndef LOCKSTITCH_EVENT_H
#define LOCKSTITCH_EVENT_H

#include <lockstitch/attachment.h>
#include <lockstitch/joint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum lks_event_kind {
    /* They touched in this tick, and not at the end of the one before. Every touch begins and ends, however
     * soft it is, also where the game puts one of the two elsewhere, makes it kinematic or gives it
     * another filter; what is removed ends without an event. */
    LKS_EVENT_CONTACT_BEGIN = 0,
    LKS_EVENT_CONTACT_END = 1,
    LKS_EVENT_JOINT_BROKE = 2, /* its id is stale now */
    LKS_EVENT_ATTACHMENT_BROKE = 3,
    LKS_EVENT_FELL_ASLEEP = 4,
    LKS_EVENT_WOKE = 5,
    /* The particles of an object pushed a body in this tick, or were held back by it, with least_impulse or
     * more: one event an object, body and tick for as long as that goes on. What lies on a body at rest
     * pushes with its weight times a tick. */
    LKS_EVENT_PARTICLES_PUSHED = 6,
    /* A contact's impulse in a tick reached least_impulse, and had not in the tick before: something fell on
     * it, was thrown at what it lies on already, or leant on it more and more. Each impact is told once,
     * whole, even where it begins in the last substep of one tick and goes on in the next. What pushes with
     * least_impulse a tick all the time (lies there with that weight times a tick) is told when it begins to,
     * and no more while it does, not even when something strikes it: choose a threshold above the weights. */
    LKS_EVENT_CONTACT_HIT = 7,
    /* At the end of this tick they press each other with least_impulse a tick or more, and did not at the end
     * of the one before; and the reverse, also where they part. For what a pressure plate asks: who stands on
     * it with that weight. An impact that is over within a tick tells neither; what is removed is unloaded
     * without an event. */
    LKS_EVENT_CONTACT_LOADED = 8,
    LKS_EVENT_CONTACT_UNLOADED = 9
} lks_event_kind;

/* For lks_world_record_events: one bit a kind. */
#define LKS_EVENT_BIT(kind) (1u << (kind))
#define LKS_ALL_EVENTS 0x3ffu
#define LKS_MAX_EVENTS 1048576u

typedef struct lks_event {
    uint32_t kind; /* an lks_event_kind */
    uint32_t reserved;
    uint64_t tick;      /* in which it happened */
    lks_body_id body_a; /* the body; of a contact the one with the lower index, of a joint its body_a;
                           generation 0: none */
    lks_body_id body_b; /* a contact's other body, a joint's body_b; generation 0: none, or a collider */
    lks_collider_id collider; /* what body_a touches; generation 0: none */
    lks_joint_id joint;       /* that broke */
    lks_attachment_id attachment;
    lks_object_id object; /* whose particles pushed body_a; generation 0: none */
    lks_fixed strength; /* a contact's impulse along its normals, N·s: of this tick, and, where an impact has
                           begun in it, what it takes to stop the two if nobody else touched them; loaded and
                           unloaded: that of a tick which pushes as its last substep; of
                           particles the sum of the sizes of theirs, with friction; what broke a joint or an
                           attachment, N or N·m; saturates at 8,388,607 */
    lks_vec3 point;  /* where, in the world, metres. Of a contact, half way between the two surfaces, where it
                        gave most in this tick, to what they move in a substep: the middle of the points that
                        push, weighed by their pushes. Of particles, that of them which pushed most. Of a
                        joint, its point of body_b; of an attachment, its vertex. 0 where nothing pushed in
                        this tick, as for most of what ends, and for sleep */
    lks_vec3 normal; /* of a contact or particles, out of body_a there, of length one; else 0 */
} lks_event;

/* From now on; refused in a tick hook. `kinds` is made of LKS_EVENT_BITs, 0: none. `least_impulse` (N·s, 0 ..
 * 8000000) is the threshold of LKS_EVENT_CONTACT_HIT, _LOADED and _UNLOADED and of
 * LKS_EVENT_PARTICLES_PUSHED; with 0 every contact that begins is a hit, and every one that touches is
 * loaded. At most `capacity` (1 .. LKS_MAX_EVENTS) are kept of a call that runs ticks; the rest is counted
 * (lost_events). */
LKS_API lks_result lks_world_record_events(lks_world* world, uint32_t kinds, lks_fixed least_impulse,
                                           uint32_t capacity);
/* Of the ticks that the last lks_world_step or lks_world_advance ran. Valid until the next one, until a load
 * (after which there are none: lks_world_contacts), and until lks_world_record_events. Never null where the
 * count is not 0. */
LKS_API const lks_event* lks_world_events(const lks_world* world);
/* How many these are; 0 for null. */
LKS_API uint32_t lks_world_event_count(const lks_world* world);

/* Two that touch, as contacts' events have them. */
typedef struct lks_contact {
    lks_body_id body_a;       /* the body; of two the one with the lower index */
    lks_body_id body_b;       /* the other body; generation 0: a collider */
    lks_collider_id collider; /* what body_a touches; generation 0: a body */
    uint32_t shape_pairs;     /* how many pairs of their shapes push each other */
    uint32_t reserved;        /* 0 */
} lks_contact;

/* Who touches whom: whose LKS_EVENT_CONTACT_BEGIN came and whose LKS_EVENT_CONTACT_END did not, whether or
 * not events were recorded, less what was removed. What the game has just put elsewhere, or excluded by a
 * filter, is listed until the next tick ends it. The list is state, events are not: those of the ticks before
 * a load are not told again, and whoever joins late by an image, or begins to record, has from this list the
 * set that he would have kept from them. One entry two, in the order in which a tick tells begins; their
 * shape_pairs added up are lks_world_contact_count (lockstitch/body.h). `count` is how many there are, of
 * which the first `capacity` are written; `contacts` may be null where that is 0. Reads only. */
LKS_API lks_result lks_world_contacts(const lks_world* world, lks_contact* contacts, uint32_t capacity,
                                      uint32_t* count);

#ifdef __cplusplus
}
#endif
#endif
