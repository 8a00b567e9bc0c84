/* Lockstitch: assets. Immutable topology and material, built once and shared by any number of objects and
 * worlds.
 *
 * An asset is described in doubles, since it comes from a level file or a tool; they are taken apart bit by
 * bit and everything is built in integers, so the same description gives the same asset everywhere. Its
 * fingerprint is a hash of what was built: compare it between machines when in doubt.
 */
#ifndef LOCKSTITCH_ASSET_H
#define LOCKSTITCH_ASSET_H

#include <lockstitch/fixed.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lks_asset lks_asset;

/* Limits of one asset. */
#define LKS_MAX_VERTICES 4194304u
#define LKS_MAX_TRIANGLES 8388608u
#define LKS_MAX_ASSET_COORDINATE 60.0 /* metres from the asset's origin, on each axis */

/* The material of one family of distance constraints (XPBD eq. 26). Families are swept in the order stretch,
 * shear, bend, but what is damped more (compliance · damping) before what is damped less: damping far beyond
 * critical then takes energy out beside threads that don't give, too. */
typedef struct lks_distance_material {
    double compliance; /* m/N, the inverse of stiffness; 0 is inextensible; 0 or 1e-15 .. 1e6 */
    double damping; /* N·s/m along the constraint (Rayleigh β); 0 or 1e-9 .. 1e9. No effect where compliance
                       is 0 */
    uint32_t enabled;  /* 0: this family is not built, and costs nothing */
    uint32_t reserved; /* 0 */
} lks_distance_material;

typedef enum lks_constraint_family {
    LKS_CONSTRAINT_STRETCH = 0,
    LKS_CONSTRAINT_SHEAR = 1,
    LKS_CONSTRAINT_BEND = 2
} lks_constraint_family;

/* Tethers hold every vertex of a cloth within reach of its anchors: the vertices that the game is going to
 * pin (Kim, Chentanez, Müller-Fischer, "Long Range Attachments", 2012). Few sweeps don't carry the load of a
 * fine cloth to its pins, which shows as stretch; tethers do so in one step. At 20 × 1 they leave a seventh
 * of the worst stretch of a 64 × 64 cloth that hangs from two corners, for a sixth more time
 * (docs/accuracy.md).
 *
 * A tether pulls its vertex back to where the cloth itself would let it go: along the shortest way over the
 * constraints, each as long as the weight of the whole cloth (9.81 m/s²) would stretch it. It never pushes,
 * and does nothing to what is slack. It acts while its anchor is pinned, and only then: pins may be set,
 * moved, torn off and set again at any time, and where two of them are moved further apart than the cloth
 * between them is long, their tethers give way in proportion. A pinned vertex that is no anchor holds as
 * without tethers; so does what hangs by an attachment.
 *
 * A tether's force is part of no constraint's: next to anchors lks_object_constraint_force tells what the
 * constraints still bear, a tenth of the load in a cloth that hangs by two corners. Don't take breaking loads
 * from there. Under more than its own weight (a heavy thing that hangs on it, strong gravity) a cloth with
 * compliance is held shorter than it would be without tethers; one without compliance is not. */
#define LKS_MAX_TETHER_ANCHORS 256u
#define LKS_MAX_TETHERS_PER_VERTEX 4u

/* A cloth: from a grid (columns and rows ≥ 2) or from an indexed triangle mesh (vertex_count > 0).
 *
 * Grid: vertices on the local x-y plane, centred; vertex (column, row) has index row * columns + column; row
 * 0 is at the top (+y), column 0 at the left (-x); the front is +z. Stretch along rows and columns, shear
 * along both diagonals, bend between vertices two apart in a row or column.
 *
 * Mesh: stretch along the edges; an edge that is the longest side of both its triangles counts as the
 * diagonal of a quad: it and the pair of vertices opposite to it are shear. The opposite pairs of all other
 * inner edges are bend. Where shear is disabled there are no diagonals: all edges are stretch and all
 * opposite pairs bend. Of two constraints between the same two vertices the first is kept. An edge of three
 * or more triangles (non-manifold) joins its first triangle's opposite vertex with each other one's. Refused:
 * a vertex in no triangle, zero-length edges, triangles without area (twice the area below 1e-9 of the
 * longest side squared), the same triangle twice (in whatever winding); of grids, too, constraints longer
 * than 100 m.
 */
typedef struct lks_cloth_def {
    uint32_t struct_size;      /* set by lks_default_cloth_def */
    uint32_t columns;          /* grid: 2 .. 4096 */
    uint32_t rows;             /* grid: 2 .. 4096; columns · rows at most LKS_MAX_VERTICES */
    uint32_t vertex_count;     /* mesh: 3 .. LKS_MAX_VERTICES */
    uint32_t triangle_count;   /* mesh: 1 .. LKS_MAX_TRIANGLES */
    uint32_t reserved;         /* 0 */
    double width;              /* grid: metres along x, above 0 and at most 120 */
    double height;             /* grid: metres along y, above 0 and at most 120 */
    const double* vertices;    /* mesh: vertex_count × (x, y, z), metres; read during the call only */
    const uint32_t* triangles; /* mesh: triangle_count × 3 vertex indices, counter-clockwise from the front */
    /* Exactly one of these three is given; the others are 0 or null. Each vertex must come to 1e-8 .. 1e6 kg.
     */
    double mass;                 /* kg, spread by area; 1e-15 .. 1e13 */
    double area_density;         /* kg/m², 1e-15 .. 1e13 */
    const double* vertex_masses; /* kg, one a vertex */
    lks_distance_material stretch;
    lks_distance_material shear;
    lks_distance_material bend;
    const uint32_t*
        tether_anchors; /* vertices, each once; null where there are none; read during the call only */
    uint32_t tether_anchor_count; /* 0: no tethers; at most LKS_MAX_TETHER_ANCHORS */
    uint32_t tethers_per_vertex;  /* to that many of the nearest anchors: 1 .. LKS_MAX_TETHERS_PER_VERTEX */
    double particle_radius;       /* metres, 0 .. 1: the distance kept from colliders */
    double friction;              /* factor on the collider's friction, 0 .. 100 */
    lks_allocator allocator;
    lks_error* error; /* null, or receives the sentence when the call fails */
} lks_cloth_def;

/* Grid 2×2 m of 21×21 vertices, 0.3 kg/m², inextensible stretch, shear 1e-7, bend 1e-5 m/N; no tether
 * anchors, two tethers a vertex. */
LKS_API lks_cloth_def lks_default_cloth_def(void);
/* LKS_ERROR_STRUCT_SIZE comes without a sentence: where `error` lies in such a definition is unknown. */
LKS_API lks_result lks_asset_create_cloth(const lks_cloth_def* def, lks_asset** asset);

/* How the stretch of a rope is solved.
 *
 * Swept: one segment after the other, as in cloth. Cheap; the more stretched the finer the rope and the
 * heavier what hangs on it: 2 · g · h² · load / (mass of a point · length of a segment · iterations) at rest,
 * h being a substep, and a few times that in a swing. Direct: all segments at once, exactly, whatever the
 * masses (XPBD eq. 16 and 26), at several times the cost. Automatic: each world chooses, by its own substeps
 * and iterations. Direct where mass of the rope > 400 / m · iterations / (1200 / s · h)² · lightest point ·
 * length of its segment and the rope has 2 to LKS_MAX_DIRECT_SEGMENTS segments (sweeps then leave more than
 * about 1 %; at 60 Hz × 20 × 1 the limit is 400 / m), else swept. What else hangs on a rope, by attachments,
 * is not known to it: choose direct where that is heavy. docs/ropes.md has cost and error of both. */
typedef enum lks_rope_solver {
    LKS_ROPE_AUTOMATIC = 0,
    LKS_ROPE_SWEPT = 1,
    LKS_ROPE_DIRECT = 2
} lks_rope_solver;

#define LKS_MAX_DIRECT_SEGMENTS 16384u

/* A rope: from a length (straight along local +x from the origin, `segments` equal parts) or from a polyline
 * (point_count > 0; one segment between each two points). Bend constraints join points two apart. Refused:
 * neighbouring points in the same place, constraints longer than 100 m. */
typedef struct lks_rope_def {
    uint32_t struct_size; /* set by lks_default_rope_def */
    uint32_t segments;    /* 1 .. 1048575 */
    uint32_t point_count; /* polyline: 2 .. 1048576 */
    uint32_t solver;      /* an lks_rope_solver; direct needs stretch to be enabled */
    double length;        /* metres, above 0 and at most 60 */
    const double* points; /* polyline: point_count × (x, y, z), metres; read during the call only */
    /* Exactly one of these three is given; the others are 0 or null. Each point must come to 1e-8 .. 1e6 kg.
     */
    double mass;                 /* kg, spread by length; 1e-15 .. 1e13 */
    double linear_density;       /* kg/m, 1e-15 .. 1e13 */
    const double* vertex_masses; /* kg, one a point */
    lks_distance_material stretch;
    lks_distance_material bend; /* of a rope of one segment: none */
    double particle_radius;     /* metres, 0 .. 1 */
    double friction;            /* factor on the collider's friction, 0 .. 100 */
    lks_allocator allocator;
    lks_error* error;
} lks_rope_def;

/* 5 m in 50 segments, 0.2 kg/m, inextensible, bend 1e-4 m/N, radius 1 cm. */
LKS_API lks_rope_def lks_default_rope_def(void);
/* LKS_ERROR_STRUCT_SIZE comes without a sentence, too. */
LKS_API lks_result lks_asset_create_rope(const lks_rope_def* def, lks_asset** asset);

/* Gives up the caller's hold. Worlds that know the asset keep it alive. Null is allowed. */
LKS_API void lks_asset_release(lks_asset* asset);

/* 0 for null, as all of these. The fingerprint covers everything that can influence a
 * simulation, and the triangles. */
LKS_API uint64_t lks_asset_fingerprint(const lks_asset* asset);
LKS_API uint32_t lks_asset_vertex_count(const lks_asset* asset);     /* a rope's points */
LKS_API uint32_t lks_asset_constraint_count(const lks_asset* asset); /* of all families, without tethers */
LKS_API uint32_t lks_asset_colour_count(const lks_asset* asset);     /* batches, of all families */
LKS_API uint32_t lks_asset_triangle_count(const lks_asset* asset);   /* 0 for a rope */

/* Writes triangle_count × 3 indices in the caller's vertex numbering and order; a grid has two triangles a
 * cell. A rope has none, and needs no buffer. Where index_capacity is less: LKS_ERROR_BUFFER_TOO_SMALL,
 * without a sentence. */
LKS_API lks_result lks_asset_triangles(const lks_asset* asset, uint32_t* indices, size_t index_capacity);

/* One distance constraint, in the canonical order in which the solver visits them. */
typedef struct lks_constraint_info {
    uint32_t vertex_a, vertex_b; /* caller's numbering */
    uint32_t family;             /* an lks_constraint_family */
    uint32_t colour;
    lks_fixed rest_length; /* metres, rounded to 2^-40 */
} lks_constraint_info;

/* Constraint 0 .. constraint count - 1, else LKS_ERROR_INVALID_ARGUMENT, without a sentence. */
LKS_API lks_result lks_asset_constraint(const lks_asset* asset, uint32_t constraint,
                                        lks_constraint_info* info);

/* What holds a vertex within reach of an anchor. */
typedef struct lks_tether {
    uint32_t anchor; /* a vertex */
    uint32_t reserved;
    lks_fixed length; /* metres, to 2^-24, rounded up */
} lks_tether;

/* Writes the tethers of a vertex, in ascending order of anchors, and returns how many it has; 0 for null and
 * for what is no vertex. An anchor has none to itself. */
LKS_API uint32_t lks_asset_vertex_tethers(const lks_asset* asset, uint32_t vertex,
                                          lks_tether tethers[LKS_MAX_TETHERS_PER_VERTEX]);

#ifdef __cplusplus
}
#endif
#endif
