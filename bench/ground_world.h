// A world with a plane to stand on, and what stands there.
#pragma once

#include <lockstitch/lockstitch.h>

#include "demand.h"

namespace lks_bench {

class GroundWorld {
public:
    explicit GroundWorld(std::uint32_t substeps) {
        lks_world_def def = lks_default_world_def();
        def.substeps = substeps;
        lks_error error{};
        def.error = &error;
        demand(lks_world_create(&def, &world_), "a world", error.message);
        lks_collider_def ground = lks_default_collider_def();
        ground.shape = LKS_SHAPE_PLANE;
        add(ground);
    }
    ~GroundWorld() { lks_world_destroy(world_); }
    GroundWorld(const GroundWorld&) = delete;
    GroundWorld& operator=(const GroundWorld&) = delete;

    void add(const lks_collider_def& def) {
        lks_collider_id id{};
        demand(lks_world_add_collider(world_, &def, &id), "a collider", message());
    }
    void add(const lks_body_def& def) {
        lks_body_id id{};
        demand(lks_world_add_body(world_, &def, &id), "a body", message());
    }
    // Humanoids of 15 bodies, two metres apart in rows of ten.
    void add_humanoids(int count, bool never_sleep) {
        lks_bone bones[LKS_HUMANOID_BONES];
        lks_body_shape shapes[LKS_HUMANOID_BONES];
        demand(lks_humanoid(bones, shapes), "a humanoid", "");
        for (lks_bone& bone : bones) {
            bone.body.never_sleeps = never_sleep ? 1 : 0;
        }
        lks_ragdoll_def def = lks_default_ragdoll_def();
        def.bones = bones;
        def.bone_count = LKS_HUMANOID_BONES;
        for (int i = 0; i < count; ++i) {
            def.transform.position = {LKS_FIXED(2 * (i % 10)), LKS_FIXED_RATIO(1, 100),
                                      LKS_FIXED(2 * (i / 10))};
            lks_body_id bodies[LKS_HUMANOID_BONES];
            demand(lks_world_add_ragdoll(world_, &def, bodies, nullptr), "a humanoid", message());
        }
    }

    void tick() const { lks_world_step(world_); }
    lks_world* get() const { return world_; }

private:
    const char* message() const { return lks_world_last_error(world_)->message; }

    lks_world* world_ = nullptr;
};

} // namespace lks_bench
