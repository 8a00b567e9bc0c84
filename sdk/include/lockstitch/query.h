/* Lockstitch: queries. What a ray or a moving ball hits, what lies within a distance, and what is nearest:
 * colliders, bodies and the particles of cloths and ropes, where they are at the end of the last tick.
 *
 * Everything is fixed-point and in a canonical order: the same world gives the same answer everywhere.
 * Queries only read: any number of threads may ask a world that nobody changes. But a refused one writes the
 * world's last error and calls its log, so only queries that are not refused may run side by side. The work
 * is linear in what the world holds.
 *
 * Method: the exact distance to each convex shape; a ray goes from tangent plane to tangent plane, which is
 * Newton's method on the distance along it.
 */
#ifndef LOCKSTITCH_QUERY_H
#define LOCKSTITCH_QUERY_H

#include <lockstitch/body.h>
#include <lockstitch/object.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum lks_hit_kind {
    LKS_HIT_COLLIDER = 0,
    LKS_HIT_BODY = 1,
    LKS_HIT_PARTICLE = 2 /* a ball of its asset's particle_radius */
} lks_hit_kind;

#define LKS_HIT_BIT(kind) (1u << (kind))
#define LKS_ALL_HITS 7u

typedef struct lks_hit {
    uint32_t kind;            /* an lks_hit_kind */
    uint32_t part;            /* a body's shape, an object's vertex; 0 of a collider */
    lks_collider_id collider; /* generation 0: none, and so on */
    lks_body_id body;
    lks_object_id object;
    lks_fixed distance; /* metres: along the way of a cast; else to the surface, negative inside, down to
                           -8,384 km */
    lks_vec3 point;     /* of the surface, in the world, or as far towards it as a coordinate goes */
    lks_vec3 normal;    /* outwards, of length one */
} lks_hit;

typedef struct lks_query {
    uint32_t struct_size; /* set by lks_default_query */
    uint32_t kinds;       /* made of LKS_HIT_BITs */
    uint32_t mask;        /* bodies and colliders with none of these categories are left out */
    uint32_t reserved;    /* 0 */
    lks_body_id ignored;  /* a body that is left out, too; generation 0: none */
    lks_fixed radius;     /* metres, 0 .. 30: of the ball that is cast, or how far to look */
} lks_query;

/* Everything, radius 0. */
LKS_API lks_query lks_default_query(void);

/* What a ball of the query's radius (0: a ray) hits on its straight way, one hit a shape, the nearest first;
 * on a tie colliders before bodies before particles, then by index. What it is in at the beginning is hit at
 * distance 0. Ends within ±8,388,000 m and 4,000 m of each other on each axis. `count` is how many there are,
 * of which the first `capacity` are written; `hits` may be null where that is 0. */
LKS_API lks_result lks_world_cast(const lks_world* world, const lks_query* query, lks_vec3 from, lks_vec3 to,
                                  lks_hit* hits, uint32_t capacity, uint32_t* count);
/* What lies within the query's radius of a point (within ±8,388,000 m on each axis): colliders, bodies,
 * particles, each by index. */
LKS_API lks_result lks_world_overlap(const lks_world* world, const lks_query* query, lks_vec3 centre,
                                     lks_hit* hits, uint32_t capacity, uint32_t* count);
/* The nearest of them; the point has the same range. `found` is 0 where there is none. */
LKS_API lks_result lks_world_closest(const lks_world* world, const lks_query* query, lks_vec3 point,
                                     lks_hit* hit, uint32_t* found);

#ifdef __cplusplus
}
#endif
#endif
