/* One inextensible cloth of a kilogram, released horizontally, hanging from two corners: the cloth of
 * tests/accuracy/stability.cpp, for JavaScript to build, step and look at. */
#include <emscripten/emscripten.h>
#include <lockstitch/lockstitch.h>
#include <stdlib.h>

typedef struct hanging_cloth {
    lks_world* world;
    lks_asset* asset;
    lks_object_id object;
    lks_vec3* positions;
} hanging_cloth;

static lks_asset* create_asset(uint32_t side, double width) {
    const lks_distance_material inextensible = {0, 0, 1, 0};
    lks_asset* asset = NULL;
    lks_cloth_def def = lks_default_cloth_def();
    def.columns = side;
    def.rows = side;
    def.width = width;
    def.height = width;
    def.area_density = 0;
    def.stretch = inextensible;
    def.shear = inextensible;
    def.bend = inextensible;
    def.particle_radius = 0;

    const uint32_t count = side * side;
    double* masses = malloc(count * sizeof(double));
    if (masses == NULL)
        return NULL;
    for (uint32_t i = 0; i < count; ++i)
        masses[i] = 1.0 / count;
    def.vertex_masses = masses;
    lks_asset_create_cloth(&def, &asset);
    free(masses);
    return asset;
}

static int hang(hanging_cloth* cloth, uint32_t side) {
    lks_object_def def = lks_default_object_def();
    def.asset = cloth->asset;
    return lks_rotation_from_axis_angle(1, 0, 0, 90, &def.transform.rotation) == LKS_OK &&
           lks_world_add_object(cloth->world, &def, &cloth->object) == LKS_OK &&
           lks_object_pin(cloth->world, cloth->object, 0) == LKS_OK &&
           lks_object_pin(cloth->world, cloth->object, side - 1) == LKS_OK;
}

EMSCRIPTEN_KEEPALIVE void cloth_destroy(hanging_cloth* cloth) {
    lks_world_destroy(cloth->world);
    lks_asset_release(cloth->asset);
    free(cloth->positions);
    free(cloth);
}

/* Null when it failed. Steps are of 1/60 s. */
EMSCRIPTEN_KEEPALIVE hanging_cloth* cloth_create(uint32_t side, double width, uint32_t substeps,
                                                 uint32_t iterations) {
    lks_world_def def = lks_default_world_def();
    hanging_cloth* cloth = calloc(1, sizeof(hanging_cloth));
    if (cloth == NULL)
        return NULL;
    def.substeps = substeps;
    def.iterations = iterations;
    cloth->asset = create_asset(side, width);
    cloth->positions = malloc((size_t)side * side * sizeof(lks_vec3));
    if (cloth->asset == NULL || cloth->positions == NULL || lks_world_create(&def, &cloth->world) != LKS_OK ||
        !hang(cloth, side)) {
        cloth_destroy(cloth);
        return NULL;
    }
    return cloth;
}

EMSCRIPTEN_KEEPALIVE void cloth_step(hanging_cloth* cloth) {
    lks_world_step(cloth->world);
}

EMSCRIPTEN_KEEPALIVE uint32_t cloth_constraint_count(const hanging_cloth* cloth) {
    return lks_asset_constraint_count(cloth->asset);
}

/* Two vertices a constraint. */
EMSCRIPTEN_KEEPALIVE void cloth_edges(const hanging_cloth* cloth, uint32_t* vertices) {
    const uint32_t count = lks_asset_constraint_count(cloth->asset);
    for (uint32_t i = 0; i < count; ++i) {
        lks_constraint_info info;
        lks_asset_constraint(cloth->asset, i, &info);
        vertices[2 * i] = info.vertex_a;
        vertices[2 * i + 1] = info.vertex_b;
    }
}

/* x, y, z a vertex, metres. */
EMSCRIPTEN_KEEPALIVE void cloth_positions(const hanging_cloth* cloth, double* coordinates) {
    const uint32_t count = lks_asset_vertex_count(cloth->asset);
    lks_object_positions(cloth->world, cloth->object, 0, count, cloth->positions);
    for (uint32_t i = 0; i < count; ++i) {
        coordinates[3 * i] = lks_fixed_to_double(cloth->positions[i].x);
        coordinates[3 * i + 1] = lks_fixed_to_double(cloth->positions[i].y);
        coordinates[3 * i + 2] = lks_fixed_to_double(cloth->positions[i].z);
    }
}

/* Of the whole state, in two halves: JavaScript's numbers have 53 bits. */
EMSCRIPTEN_KEEPALIVE uint32_t cloth_hash_low(const hanging_cloth* cloth) {
    return (uint32_t)lks_world_hash(cloth->world);
}
EMSCRIPTEN_KEEPALIVE uint32_t cloth_hash_high(const hanging_cloth* cloth) {
    return (uint32_t)(lks_world_hash(cloth->world) >> 32);
}
