// Worlds and assets that give themselves back, and the calls that nearly every test makes.
#pragma once

#include <lockstitch/lockstitch.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "support/numbers.h"

namespace support {

class Asset {
public:
    explicit Asset(const lks_cloth_def& def);
    explicit Asset(const lks_rope_def& def);
    Asset(Asset&& other) noexcept : asset_(other.asset_) { other.asset_ = nullptr; }
    Asset(const Asset&) = delete;
    Asset& operator=(const Asset&) = delete;
    ~Asset() { lks_asset_release(asset_); }

    operator const lks_asset*() const { return asset_; }
    std::uint32_t vertex_count() const { return lks_asset_vertex_count(asset_); }
    std::uint32_t constraint_count() const { return lks_asset_constraint_count(asset_); }
    std::vector<lks_constraint_info> constraints() const;
    std::vector<std::uint32_t> triangles() const;

private:
    lks_asset* asset_ = nullptr;
};

// Bytes aligned to 8, as images want them.
class Image {
public:
    explicit Image(std::size_t size = 0) : words_((size + 7) / 8), size_(size) {}

    void* data() { return words_.data(); }
    const void* data() const { return words_.data(); }
    unsigned char* bytes() { return reinterpret_cast<unsigned char*>(words_.data()); }
    const unsigned char* bytes() const { return reinterpret_cast<const unsigned char*>(words_.data()); }
    std::size_t size() const { return size_; }
    bool operator==(const Image& other) const { return size_ == other.size_ && words_ == other.words_; }

private:
    std::vector<std::uint64_t> words_;
    std::size_t size_;
};

class World {
public:
    World();
    explicit World(const lks_world_def& def);
    World(World&& other) noexcept : world_(other.world_) { other.world_ = nullptr; }
    World& operator=(World&& other) noexcept {
        std::swap(world_, other.world_);
        return *this;
    }
    ~World() { lks_world_destroy(world_); }

    operator lks_world*() const { return world_; }

    lks_object_id add(const Asset& asset, const lks_transform& transform);
    lks_object_id add(const lks_object_def& def);
    lks_collider_id add(const lks_collider_def& def);
    void step(std::uint64_t ticks = 1);

    std::uint64_t hash() const { return lks_world_hash(world_); }
    std::uint64_t local_hash() const { return lks_world_local_hash(world_); }
    std::uint64_t tick() const { return lks_world_tick(world_); }
    std::string message() const { return lks_world_last_error(world_)->message; }
    lks_world_counters counters() const;

    void pin(lks_object_id object, std::uint32_t vertex);
    void set_target(lks_object_id object, std::uint32_t vertex, const lks_vec3& target);

    std::vector<lks_vec3> positions(lks_object_id object) const;
    std::vector<lks_vec3> velocities(lks_object_id object) const;
    std::vector<lks_raw_position> raw_positions(lks_object_id object) const;
    lks_vec3 origin(lks_object_id object) const;
    // Relative to a place in the world, with all 56 fraction bits used.
    std::vector<Vector> positions_from(lks_object_id object, const lks_vec3& place) const;
    double force(lks_object_id object, std::uint32_t constraint) const;

    Image save() const;

private:
    std::uint32_t vertex_count(lks_object_id object) const;

    lks_world* world_ = nullptr;
};

lks_world_def world_def(std::uint32_t tick_rate_hz, std::uint32_t substeps, std::uint32_t iterations = 1);
// The same at 60 Hz, without gravity.
lks_world_def weightless(std::uint32_t substeps, std::uint32_t iterations = 1);
lks_object_def object_def(const Asset& asset, const lks_transform& transform);

// Whether LOCKSTITCH_LONG=1 asks for the long sweeps.
bool long_runs();

} // namespace support
