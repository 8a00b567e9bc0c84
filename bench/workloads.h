// What is measured: worlds of cloths and ropes, in motion, through the public API.
#pragma once

#include <lockstitch/lockstitch.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lks_bench {

enum class Shape { cloth, mesh, rope };

struct Workload {
    std::string name;
    std::string title;
    Shape shape = Shape::cloth;
    std::uint32_t objects = 1;
    std::uint32_t side = 64;     // vertices along a cloth's or a mesh's edge, or particles of a rope
    double compliance = 0;       // m/N
    double damping = 0;          // N·s/m
    bool masses_by_area = false; // of a cloth or a mesh; otherwise all are equal
    bool colliders = false;      // which it falls on from where it lies level
    std::uint32_t substeps = 20;
    std::uint32_t iterations = 1;
    std::uint32_t warm_ticks = 20; // before anything is measured, so that it hangs and swings
};

// What workloads with colliders fall on, in tenths of a metre.
struct Ball {
    int x, y, z, radius;
};
inline constexpr Ball balls[] = {{0, -5, -2, 4}, {10, -5, -2, 4}};
// From one object to the next, the same along x.
inline constexpr int object_distance = 1;

// Cloths from 1,000 to 1,000,000 constraints, for growth, come after those that are measured by default.
const std::vector<Workload>& workloads();
const std::vector<Workload>& growth_workloads();
// Of both lists; null: there is none of this name.
const Workload* find_workload(const std::string& name);

// What a workload's objects are made of. Exits with a sentence where the library refuses.
class WorkloadAsset {
public:
    explicit WorkloadAsset(const Workload& workload, const lks_allocator& allocator = {});
    ~WorkloadAsset();
    WorkloadAsset(const WorkloadAsset&) = delete;
    WorkloadAsset& operator=(const WorkloadAsset&) = delete;

    lks_asset* get() const { return asset_; }
    const std::vector<std::uint32_t>& pinned() const { return pinned_; } // vertices

private:
    lks_asset* asset_ = nullptr;
    std::vector<std::uint32_t> pinned_;
};

class BenchWorld {
public:
    BenchWorld(const Workload& workload, lks_simd simd, std::uint32_t workers = 1,
               const lks_allocator& allocator = {});
    ~BenchWorld();
    BenchWorld(const BenchWorld&) = delete;
    BenchWorld& operator=(const BenchWorld&) = delete;

    lks_world* world() const { return world_; }
    const lks_asset& asset() const { return *asset_.get(); }
    std::uint64_t constraints() const; // of all objects

private:
    WorkloadAsset asset_;
    lks_world* world_ = nullptr;
};

} // namespace lks_bench
