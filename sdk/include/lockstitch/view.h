/* Lockstitch: views. Floats for drawing, read from the state, never written back.
 *
 * These are the only functions that give floating-point values. Do not feed them back into the simulation.
 */
#ifndef LOCKSTITCH_VIEW_H
#define LOCKSTITCH_VIEW_H

#include <lockstitch/body.h>
#include <lockstitch/collider.h>
#include <lockstitch/object.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lks_vertex_view {
    uint32_t struct_size;   /* set by lks_default_vertex_view */
    uint32_t interpolation; /* Q0.32 from the tick before the last (0) to the last (~1);
                               lks_world_interpolation, or LKS_VIEW_LAST_TICK for the last tick itself */
    lks_vec3 view_origin;   /* floats are relative to this point of the world, each axis within ±8,388,607 m,
                               else LKS_ERROR_INVALID_ARGUMENT: give the camera's, far from the origin */
    float* positions;       /* x, y, z of the first vertex; null: none */
    size_t position_stride; /* bytes from one vertex to the next, ≥ 12 and a multiple of 4 */
    float* normals;         /* unit normals, area-weighted; cloth only; null: none */
    size_t normal_stride;   /* bytes, ≥ 12 and a multiple of 4 */
    size_t vertex_capacity; /* vertices that fit into the buffers; at least the asset's vertex count */
} lks_vertex_view;

#define LKS_VIEW_LAST_TICK 0xffffffffu

/* The last tick, seen from the world's origin; no buffers yet, strides of 12 bytes. */
LKS_API lks_vertex_view lks_default_vertex_view(void);

/* Writes all vertices in the caller's numbering. Buffers are aligned to 4 bytes. */
LKS_API lks_result lks_object_write_vertices(const lks_world* world, lks_object_id object,
                                             const lks_vertex_view* view);

/* A collider as it is to be drawn: a column-major 4×4 matrix, local to (world - view_origin), interpolated
 * like vertices. The rotation is interpolated too. The view's origin is within ±8,388,607 m on each axis,
 * else LKS_ERROR_INVALID_ARGUMENT. */
LKS_API lks_result lks_collider_write_matrix(const lks_world* world, lks_collider_id collider,
                                             uint32_t interpolation, lks_vec3 view_origin, float matrix[16]);

/* The same for a body's frame, with the same range of the view's origin. */
LKS_API lks_result lks_body_write_matrix(const lks_world* world, lks_body_id body, uint32_t interpolation,
                                         lks_vec3 view_origin, float matrix[16]);

/* To the nearest double. */
LKS_API double lks_fixed_to_double(lks_fixed value);

#ifdef __cplusplus
}
#endif
#endif
