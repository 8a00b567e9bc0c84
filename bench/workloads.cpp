#include "workloads.h"

#include <cstdio>
#include <cstdlib>

namespace lks_bench {
namespace {

void demand(lks_result result, const char* what, const char* message) {
    if (result != LKS_OK) {
        std::fprintf(stderr, "lockstitch-bench: %s: %s\n", what, message);
        std::exit(1);
    }
}

lks_asset* make_asset(const Workload& workload) {
    const lks_distance_material material{workload.compliance, workload.damping, 1, 0};
    lks_error error{};
    lks_asset* asset = nullptr;
    // Equal masses, as in most cloth.
    const std::vector<double> masses(std::size_t{workload.side} * (workload.rope ? 1 : workload.side), 0.001);
    if (workload.rope) {
        lks_rope_def def = lks_default_rope_def();
        def.length = 2;
        def.segments = workload.side - 1;
        def.linear_density = 0;
        def.vertex_masses = masses.data();
        def.stretch = material;
        def.bend = {0, 0, 0, 0};
        def.error = &error;
        demand(lks_asset_create_rope(&def, &asset), "a rope", error.message);
    } else {
        lks_cloth_def def = lks_default_cloth_def();
        def.columns = workload.side;
        def.rows = workload.side;
        def.area_density = 0;
        def.vertex_masses = masses.data();
        def.stretch = material;
        def.shear = material;
        def.bend = material;
        def.error = &error;
        demand(lks_asset_create_cloth(&def, &asset), "a cloth", error.message);
    }
    return asset;
}

void add_colliders(lks_world* world) {
    for (int i = 0; i < 2; ++i) {
        lks_collider_def def = lks_default_collider_def();
        def.radius = LKS_FIXED_RATIO(4, 10);
        def.transform.position = {i * LKS_FIXED(1), LKS_FIXED(-1), LKS_FIXED_RATIO(1, 2)};
        lks_collider_id id{};
        demand(lks_world_add_collider(world, &def, &id), "a collider", lks_world_last_error(world)->message);
    }
}

} // namespace

const std::vector<Workload>& workloads() {
    static const std::vector<Workload> all = [] {
        std::vector<Workload> list;
        const auto add = [&](Workload workload) { list.push_back(std::move(workload)); };
        add({"cloth_64", "64 x 64 vertices, 20 x 1", 1, false, 64, 0, 0, false, 20, 1});
        add({"cloth_64_1x20", "64 x 64 vertices, 1 x 20", 1, false, 64, 0, 0, false, 1, 20});
        add({"cloth_64_5x4", "64 x 64 vertices, 5 x 4", 1, false, 64, 0, 0, false, 5, 4});
        add({"cloth_64_soft", "64 x 64 vertices, 1e-5 m/N", 1, false, 64, 1e-5, 0, false, 20, 1});
        add({"cloth_64_damped", "64 x 64 vertices, 1e-5 m/N, 10 N s/m", 1, false, 64, 1e-5, 10, false, 20,
             1});
        add({"cloth_64_colliders", "64 x 64 vertices over two spheres", 1, false, 64, 0, 0, true, 20, 1});
        add({"cloth_50", "50 x 50 vertices, no multiple of four", 1, false, 50, 0, 0, false, 20, 1});
        add({"cloth_256", "256 x 256 vertices, 20 x 1", 1, false, 256, 0, 0, false, 20, 1});
        add({"ropes_200", "200 ropes of 100 particles", 200, true, 100, 0, 0, false, 20, 1});
        add({"ropes_1000", "1,000 ropes of 20 particles", 1000, true, 20, 0, 0, false, 20, 1});
        return list;
    }();
    return all;
}

BenchWorld::BenchWorld(const Workload& workload, lks_simd simd, std::uint32_t workers)
    : asset_(make_asset(workload)) {
    lks_error error{};
    lks_world_def def = lks_default_world_def();
    def.substeps = workload.substeps;
    def.iterations = workload.iterations;
    def.simd = static_cast<std::uint32_t>(simd);
    def.worker_count = workers;
    def.error = &error;
    demand(lks_world_create(&def, &world_), "a world", error.message);
    for (std::uint32_t i = 0; i < workload.objects; ++i) {
        lks_object_def object_def = lks_default_object_def();
        object_def.asset = asset_;
        object_def.transform.position.x = static_cast<lks_fixed>(i) * LKS_FIXED_RATIO(1, 10);
        lks_object_id object{};
        demand(lks_world_add_object(world_, &object_def, &object), "an object",
               lks_world_last_error(world_)->message);
        lks_object_pin(world_, object, 0);
        if (!workload.rope) {
            lks_object_pin(world_, object, workload.side - 1);
        }
    }
    if (workload.colliders) {
        add_colliders(world_);
    }
    for (int tick = 0; tick < 20; ++tick) {
        lks_world_step(world_);
    }
}

BenchWorld::~BenchWorld() {
    lks_world_destroy(world_);
    lks_asset_release(asset_);
}

std::uint64_t BenchWorld::constraints() const {
    return std::uint64_t{lks_asset_constraint_count(asset_)} * lks_world_object_count(world_);
}

} // namespace lks_bench
