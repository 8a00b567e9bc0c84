/* A first game, in plain C99 and outside the tree: hang a cloth, pull at it, save, go on, load, go on again.
 * It prints the hash after 60 ticks and after 90; every other client in this folder plays the same and must
 * print the same. */
#include <lockstitch/lockstitch.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

static int failed(lks_result result, const char* what) {
    if (result == LKS_OK) {
        return 0;
    }
    fprintf(stderr, "%s: %s\n", what, lks_result_text(result));
    return 1;
}

static int run(lks_world* world, int ticks) {
    for (int i = 0; i < ticks; ++i) {
        if (failed(lks_world_step(world), "step")) {
            return 1;
        }
    }
    return 0;
}

static int print_state(const lks_world* world) {
    return printf("tick %" PRIu64 " state %016" PRIx64 "\n", lks_world_tick(world), lks_world_hash(world)) <
           0;
}

/* What a body was added with is changed, read and listed from C as well. 1: it is not. */
static int change_body(void) {
    lks_world_def world_def = lks_default_world_def();
    lks_world* world = NULL;
    lks_body_shape shape = lks_default_body_shape();
    lks_body_def def = lks_default_body_def();
    lks_collider_def ground = lks_default_collider_def();
    lks_collider_id ground_id;
    lks_body_id body;
    const lks_filter ghost = {2, 0, -1};
    lks_fixed values[6] = {0, 0, 0, 0, 0, 0};
    lks_filter filter = {0, 0, 0};
    lks_contact contact = {{0, 0}, {0, 0}, {0, 0}, 0, 0};
    uint32_t before = 9;
    uint32_t after = 9;
    ground.shape = LKS_SHAPE_PLANE;
    def.shapes = &shape;
    def.shape_count = 1;
    def.transform.position.y = shape.radius;
    const int refused =
        failed(lks_world_create(&world_def, &world), "world") ||
        failed(lks_world_add_collider(world, &ground, &ground_id), "ground") ||
        failed(lks_world_add_body(world, &def, &body), "body") || run(world, 2) ||
        failed(lks_world_contacts(world, &contact, 1, &before), "contacts") ||
        failed(lks_body_set_gravity_factor(world, body, LKS_FIXED(2)), "gravity factor") ||
        failed(lks_body_set_damping(world, body, LKS_FIXED(3), LKS_FIXED(4)), "damping") ||
        failed(lks_body_set_surface(world, body, LKS_FIXED(6), LKS_FIXED(5), LKS_FIXED_ONE), "surface") ||
        failed(lks_body_set_filter(world, body, ghost), "filter") ||
        failed(lks_body_set_never_sleeps(world, body, 1), "never_sleeps") || run(world, 1) ||
        failed(lks_world_contacts(world, NULL, 0, &after), "contacts") ||
        failed(lks_body_gravity_factor(world, body, &values[0]), "gravity factor") ||
        failed(lks_body_damping(world, body, &values[1], &values[2]), "damping") ||
        failed(lks_body_surface(world, body, &values[3], &values[4], &values[5]), "surface") ||
        failed(lks_body_filter(world, body, &filter), "filter");
    const int wrong = refused || before != 1 || contact.body_a.index != body.index ||
                      contact.collider.generation != ground_id.generation || contact.shape_pairs != 1 ||
                      after != 0 || values[0] != LKS_FIXED(2) || values[1] != LKS_FIXED(3) ||
                      values[2] != LKS_FIXED(4) || values[3] != LKS_FIXED(6) || values[4] != LKS_FIXED(5) ||
                      values[5] != LKS_FIXED_ONE || filter.category != 2 || filter.mask != 0 ||
                      filter.group != -1 || lks_body_never_sleeps(world, body) != 1;
    lks_world_destroy(world);
    return wrong;
}

int main(void) {
    if (lks_version() != LKS_VERSION_MAJOR * 10000 + LKS_VERSION_MINOR * 100 + LKS_VERSION_PATCH) {
        fputs("The headers and the library are of different versions.\n", stderr);
        return 1;
    }

    lks_error error;
    lks_world_def world_def = lks_default_world_def();
    world_def.error = &error;
    lks_world* world = NULL;
    lks_cloth_def cloth_def = lks_default_cloth_def();
    cloth_def.columns = 9;
    cloth_def.rows = 7;
    lks_asset* cloth = NULL;
    if (failed(lks_world_create(&world_def, &world), "world") ||
        failed(lks_asset_create_cloth(&cloth_def, &cloth), "cloth")) {
        return 1;
    }

    lks_object_def object_def = lks_default_object_def();
    object_def.asset = cloth;
    lks_object_id id;
    const lks_vec3 pull = {LKS_FIXED_RATIO(1, 4), 0, LKS_FIXED_RATIO(1, 2)};
    if (failed(lks_world_add_object(world, &object_def, &id), "add") ||
        failed(lks_object_pin(world, id, 0), "pin") ||
        failed(lks_object_pin(world, id, cloth_def.columns - 1), "pin") ||
        failed(lks_object_apply_impulse(world, id, 40, pull), "impulse") || run(world, 60) ||
        print_state(world)) {
        return 1;
    }

    size_t size = 0;
    if (failed(lks_world_save_size(world, &size), "save size")) {
        return 1;
    }
    void* image = malloc(size);
    const uint64_t saved = lks_world_hash(world);
    if (image == NULL || failed(lks_world_save(world, image, size, NULL), "save") || run(world, 30) ||
        print_state(world)) {
        return 1;
    }

    /* Back to tick 60 and on again: the same bits. */
    const uint64_t first = lks_world_hash(world);
    if (failed(lks_world_load(world, image, size), "load")) {
        return 1;
    }
    const uint64_t loaded = lks_world_hash(world);
    if (run(world, 30)) {
        return 1;
    }
    if (loaded != saved || lks_world_hash(world) != first || first == saved) {
        fputs("The world went another way after loading.\n", stderr);
        return 1;
    }

    /* What is refused is refused across the ABI too. */
    if (lks_world_step(NULL) != LKS_ERROR_NULL_ARGUMENT ||
        lks_world_load(world, image, size - 8) != LKS_ERROR_CORRUPT_IMAGE || lks_world_hash(world) != first) {
        fputs("A bad call was not refused.\n", stderr);
        return 1;
    }
    if (change_body()) {
        fputs("A body is not as it was changed to.\n", stderr);
        return 1;
    }

    free(image);
    lks_world_destroy(world);
    lks_asset_release(cloth);
    return 0;
}
