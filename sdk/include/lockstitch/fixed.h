/* Lockstitch: the numbers that cross the API while a game runs.
 *
 * Everything is an integer. One format serves positions (metres), velocities (m/s), accelerations (m/s²),
 * impulses (N·s), lengths and plain factors: lks_fixed, 40 fraction bits, ±8,388,607 with steps of 9.1e-13.
 * Each field states its own, narrower range.
 */
#ifndef LOCKSTITCH_FIXED_H
#define LOCKSTITCH_FIXED_H

#include <lockstitch/base.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef int64_t lks_fixed; /* Q24.40 */

#define LKS_FIXED_FRACTION_BITS 40
#define LKS_FIXED_ONE ((lks_fixed)1 << LKS_FIXED_FRACTION_BITS)

/* An integer; what is none, as 0.5, does not compile. */
#define LKS_INTEGER(n) ((lks_fixed)(n) + 0 * (lks_fixed)sizeof((n)&0))
/* Whole metres (or m/s, or anything); n from -8388607 to 8388607. */
#define LKS_FIXED(n) (LKS_INTEGER(n) * LKS_FIXED_ONE)
/* n / d in integers, rounded towards zero; n * 2^40 must fit into 64 bits: LKS_FIXED_RATIO(5, 100) is 5 cm.
 */
#define LKS_FIXED_RATIO(n, d) (LKS_INTEGER(n) * LKS_FIXED_ONE / LKS_INTEGER(d))

typedef struct lks_vec3 {
    lks_fixed x, y, z;
} lks_vec3;

/* A unit quaternion in Q2.30: 1.0 is 1 << 30. Any quaternion whose length is within 1e-4 of one is accepted
 * and normalised; others are refused. */
typedef struct lks_rotation {
    int32_t x, y, z, w;
} lks_rotation;

#define LKS_ROTATION_ONE ((int32_t)1 << 30)

typedef struct lks_transform {
    lks_vec3 position;     /* metres, in the world */
    lks_rotation rotation; /* local to world */
} lks_transform;

#ifdef __cplusplus
}
#endif
#endif
