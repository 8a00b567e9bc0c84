// What is measured: worlds of cloths and ropes, in motion, through the public API.
#pragma once

#include <lockstitch/lockstitch.h>

#include <cstdint>
#include <string>
#include <vector>

namespace lks_bench {

struct Workload {
    std::string name;
    std::string title;
    std::uint32_t objects = 1;
    bool rope = false;
    std::uint32_t side = 64; // vertices along a cloth's edge, or particles of a rope
    double compliance = 0;   // m/N
    double damping = 0;      // N·s/m
    bool colliders = false;
    std::uint32_t substeps = 20;
    std::uint32_t iterations = 1;
};

const std::vector<Workload>& workloads();

// A world with the workload in it, a third of a second old. Exits with a sentence where the library refuses.
class BenchWorld {
public:
    BenchWorld(const Workload& workload, lks_simd simd, std::uint32_t workers = 1);
    ~BenchWorld();
    BenchWorld(const BenchWorld&) = delete;
    BenchWorld& operator=(const BenchWorld&) = delete;

    lks_world* world() const { return world_; }
    std::uint64_t constraints() const; // of all objects

private:
    lks_world* world_ = nullptr;
    lks_asset* asset_ = nullptr;
};

} // namespace lks_bench
