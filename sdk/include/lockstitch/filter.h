/* Lockstitch: filters. Who collides with whom: bodies, colliders, and the particles of cloths and ropes. */
#ifndef LOCKSTITCH_FILTER_H
#define LOCKSTITCH_FILTER_H

#include <lockstitch/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Two of them collide where each one's category is in the other's mask; two of the same group > 0 always do,
 * two of the same group < 0 never. Categories may be made of several bits, of which one has to be in the
 * mask. Every value is a good one. */
typedef struct lks_filter {
    uint32_t category;
    uint32_t mask;
    int32_t group;
} lks_filter;

/* The category of all particles of cloths and ropes; their mask is everything, and they have no group. What
 * has a mask that lacks it is not touched by them. */
#define LKS_CATEGORY_PARTICLES 0x80000000u

#ifdef __cplusplus
}
#endif
#endif
