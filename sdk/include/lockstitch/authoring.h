/* Lockstitch: from decimal numbers to fixed-point, for levels, tools and set-up.
 *
 * The conversions take a double apart bit by bit with integer operations and round to the nearest unit
 * (ties away from zero), so a literal such as 9.81 gives the same bits everywhere. Do not feed them
 * values that your game *computed* in floating point: those may differ between two machines, and then
 * so will the simulation. Results of lks_fixed arithmetic are safe. Calls that fail leave no sentence.
 */
#ifndef LOCKSTITCH_AUTHORING_H
#define LOCKSTITCH_AUTHORING_H

#include <lockstitch/fixed.h>

#ifdef __cplusplus
extern "C" {
#endif

/* NaN, infinities and |value| > 8388607: LKS_ERROR_INVALID_ARGUMENT, and *out is unchanged. */
LKS_API lks_result lks_fixed_from_double(double value, lks_fixed* out);

/* All three or none. */
LKS_API lks_result lks_vec3_from_doubles(double x, double y, double z, lks_vec3* out);

/* A rotation of `degrees` about an axis of any length > 0, by the right-hand rule. |degrees| ≤ 36000. Error
 * of each component: at most 2 units of 2^-30. Integers throughout, the axis is normalised too. */
LKS_API lks_result lks_rotation_from_axis_angle(double axis_x, double axis_y, double axis_z, double degrees,
                                                lks_rotation* out);

/* The same from fixed-point values, for use while a game runs. The axis has any length > 0. */
LKS_API lks_result lks_rotation_from_axis_angle_fixed(lks_vec3 axis, lks_fixed degrees, lks_rotation* out);

/* sine and cosine of an angle in degrees, |degrees| ≤ 36000; the nearest unit but for a share of 2^-19. */
LKS_API lks_result lks_sin_cos(lks_fixed degrees, lks_fixed* sine, lks_fixed* cosine);

/* No rotation at the world's origin. */
LKS_API lks_transform lks_transform_identity(void);

#ifdef __cplusplus
}
#endif
#endif
