#include "workloads.h"

#include "demand.h"
#include "mesh_shape.h"

namespace lks_bench {
namespace {

void add_colliders(lks_world* world) {
    const auto tenths = [](int count) { return LKS_FIXED_RATIO(count, 10); };
    for (const Ball& ball : balls) {
        lks_collider_def def = lks_default_collider_def();
        def.radius = tenths(ball.radius);
        def.transform.position = {tenths(ball.x), tenths(ball.y), tenths(ball.z)};
        lks_collider_id id{};
        demand(lks_world_add_collider(world, &def, &id), "a collider", lks_world_last_error(world)->message);
    }
}

// And with as many passes in fewer substeps, and over colliders.
void add_with_variations(const Workload& workload, std::vector<Workload>& all) {
    all.push_back(workload);
    for (const std::uint32_t substeps : {1u, 5u}) {
        Workload& fewer = all.emplace_back(workload);
        fewer.substeps = substeps;
        fewer.iterations = 20 / substeps;
        const std::string count = std::to_string(fewer.substeps);
        const std::string iterations = std::to_string(fewer.iterations);
        fewer.name += "_" + count + "x" + iterations;
        fewer.title += ", " + count + " × " + iterations;
    }
    Workload& over = all.emplace_back(workload);
    over.name += "_colliders";
    over.title += " over two spheres";
    over.colliders = true;
}

std::vector<Workload> make_workloads() {
    std::vector<Workload> all;
    add_with_variations({.name = "cloth_64", .title = "64 × 64 vertices"}, all);
    const std::vector<Workload> special = {
        {.name = "cloth_64_soft", .title = "64 × 64 vertices, 1e-5 m/N", .compliance = 1e-5},
        {.name = "cloth_64_damped",
         .title = "64 × 64 vertices, 1e-5 m/N, 10 N·s/m",
         .compliance = 1e-5,
         .damping = 10},
        {.name = "cloth_64_area", .title = "64 × 64 vertices, masses by area", .masses_by_area = true},
        {.name = "cloth_50", .title = "50 × 50 vertices, no multiple of four", .side = 50},
    };
    all.insert(all.end(), special.begin(), special.end());
    const Workload others[] = {
        {.name = "cloth_256", .title = "256 × 256 vertices", .side = 256},
        {.name = "mesh_10k", .title = "irregular mesh of 10,082 triangles", .shape = Shape::mesh, .side = 72},
        {.name = "ropes_200",
         .title = "200 ropes of 100 particles",
         .shape = Shape::rope,
         .objects = 200,
         .side = 100},
        {.name = "ropes_1000",
         .title = "1,000 ropes of 20 particles",
         .shape = Shape::rope,
         .objects = 1000,
         .side = 20},
    };
    for (const Workload& workload : others) {
        add_with_variations(workload, all);
        if (workload.shape == Shape::mesh) {
            Workload& by_area = all.emplace_back(workload);
            by_area.name += "_area";
            by_area.title += ", masses by area";
            by_area.masses_by_area = true;
        }
    }
    return all;
}

} // namespace

const std::vector<Workload>& workloads() {
    static const std::vector<Workload> all = make_workloads();
    return all;
}

const std::vector<Workload>& growth_workloads() {
    static const std::vector<Workload> all = {
        {.name = "growth_1k", .title = "14 × 14 vertices", .side = 14, .warm_ticks = 5},
        {.name = "growth_3k", .title = "24 × 24 vertices", .side = 24, .warm_ticks = 5},
        {.name = "growth_10k", .title = "42 × 42 vertices", .side = 42, .warm_ticks = 5},
        {.name = "growth_30k", .title = "72 × 72 vertices", .side = 72, .warm_ticks = 5},
        {.name = "growth_100k", .title = "130 × 130 vertices", .side = 130, .warm_ticks = 5},
        {.name = "growth_300k", .title = "224 × 224 vertices", .side = 224, .warm_ticks = 5},
        {.name = "growth_1m", .title = "410 × 410 vertices", .side = 410, .warm_ticks = 5},
    };
    return all;
}

const Workload* find_workload(const std::string& name) {
    for (const std::vector<Workload>* list : {&workloads(), &growth_workloads()}) {
        for (const Workload& workload : *list) {
            if (workload.name == name) {
                return &workload;
            }
        }
    }
    return nullptr;
}

WorkloadAsset::WorkloadAsset(const Workload& workload, const lks_allocator& allocator) {
    const lks_distance_material material{workload.compliance, workload.damping, 1, 0};
    lks_error error{};
    const std::uint32_t side = workload.side;
    const std::vector<double> masses(std::size_t{side} * (workload.shape == Shape::rope ? 1 : side), 0.001);
    if (workload.shape == Shape::rope) {
        lks_rope_def def = lks_default_rope_def();
        def.solver = LKS_ROPE_SWEPT; // projections are what is measured
        def.length = 2;
        def.segments = side - 1;
        def.linear_density = 0;
        def.vertex_masses = masses.data();
        def.stretch = material;
        def.bend = {0, 0, 0, 0};
        def.particle_radius = 0;
        def.allocator = allocator;
        def.error = &error;
        demand(lks_asset_create_rope(&def, &asset_), "a rope", error.message);
        pinned_ = {0};
        return;
    }
    lks_cloth_def def = lks_default_cloth_def();
    def.columns = side;
    def.rows = side;
    pinned_ = {0, side - 1};
    MeshShape mesh;
    if (workload.shape == Shape::mesh) {
        mesh = make_mesh(side);
        def.columns = 0;
        def.rows = 0;
        def.width = 0;
        def.height = 0;
        def.vertices = mesh.vertices.data();
        def.vertex_count = static_cast<std::uint32_t>(mesh.vertices.size() / 3);
        def.triangles = mesh.triangles.data();
        def.triangle_count = static_cast<std::uint32_t>(mesh.triangles.size() / 3);
        pinned_ = {mesh.corners[0], mesh.corners[1]};
    }
    if (!workload.masses_by_area) {
        def.area_density = 0;
        def.vertex_masses = masses.data();
    }
    def.stretch = material;
    def.shear = workload.shape == Shape::mesh ? lks_distance_material{} : material;
    def.bend = material;
    def.particle_radius = 0; // the peers' particles are points
    def.allocator = allocator;
    def.error = &error;
    demand(lks_asset_create_cloth(&def, &asset_), "a cloth", error.message);
}

WorkloadAsset::~WorkloadAsset() {
    lks_asset_release(asset_);
}

BenchWorld::BenchWorld(const Workload& workload, lks_simd simd, std::uint32_t workers,
                       const lks_allocator& allocator)
    : asset_(workload, allocator) {
    lks_error error{};
    lks_world_def def = lks_default_world_def();
    def.substeps = workload.substeps;
    def.iterations = workload.iterations;
    def.simd = static_cast<std::uint32_t>(simd);
    def.worker_count = workers;
    def.allocator = allocator;
    def.error = &error;
    demand(lks_world_create(&def, &world_), "a world", error.message);
    for (std::uint32_t i = 0; i < workload.objects; ++i) {
        lks_object_def object_def = lks_default_object_def();
        object_def.asset = asset_.get();
        object_def.transform.position.x = static_cast<lks_fixed>(i) * LKS_FIXED_RATIO(object_distance, 10);
        if (workload.colliders) {
            demand(lks_rotation_from_axis_angle(1, 0, 0, 90, &object_def.transform.rotation), "a rotation",
                   "it is refused");
        }
        lks_object_id object{};
        demand(lks_world_add_object(world_, &object_def, &object), "an object",
               lks_world_last_error(world_)->message);
        for (const std::uint32_t vertex : asset_.pinned()) {
            demand(lks_object_pin(world_, object, vertex), "a pin", lks_world_last_error(world_)->message);
        }
    }
    if (workload.colliders) {
        add_colliders(world_);
    }
    for (std::uint32_t tick = 0; tick < workload.warm_ticks; ++tick) {
        lks_world_step(world_);
    }
}

BenchWorld::~BenchWorld() {
    lks_world_destroy(world_);
}

std::uint64_t BenchWorld::constraints() const {
    return std::uint64_t{lks_asset_constraint_count(asset_.get())} * lks_world_object_count(world_);
}

} // namespace lks_bench
