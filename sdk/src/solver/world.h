// The world behind the C API: settings, objects, colliders, known assets, the clock.
#pragma once

#include <lockstitch/collider.h>
#include <lockstitch/object.h>
#include <lockstitch/state.h>
#include <lockstitch/world.h>

#include <cstdint>

#include "api/report.h"
#include "collide/collider_motion.h"
#include "kernels/kernels.h"
#include "memory/array.h"
#include "rigid/events.h"
#include "rigid/rigid_scene.h"
#include "solver/object.h"
#include "solver/slot.h"
#include "solver/step_rate.h"
#include "solver/tick_scratch.h"
#include "threads/helpers.h"

namespace lks {

// A place for an object. The generation is that of the present or the next occupant, and never 0.
struct ObjectSlot {
    Object* object; // null: free
    std::uint32_t generation;
};

struct ColliderSlot {
    ColliderState collider;
    std::uint32_t generation;
    bool used;
};

// An asset that the world knows, with its coefficients at the world's substep length.
struct KnownAsset {
    const lks_asset* asset;
    Coefficients* coefficients;
};

// Real time that is due, in units of 1/(tick rate · 10⁹) s. No part of the state.
struct Clock {
    std::int64_t due = 0;
};

} // namespace lks

// The opaque type of the C API.
struct lks_world {
    explicit lks_world(const lks_world_def& def);
    ~lks_world();
    lks_world(const lks_world&) = delete;
    lks_world& operator=(const lks_world&) = delete;

    // Settings: never change.
    lks_allocator allocator;
    lks_log log;
    lks_tick_hook before_tick;
    lks::StepRate rate;
    const lks::Kernels* kernels;
    std::uint32_t max_ticks_per_advance;
    lks_excess_time excess_time;
    bool keep_previous;
    std::uint32_t worker_count;

    // State.
    std::uint64_t tick = 0;
    lks::fixed::Vec3 gravity{}; // World, m/s²
    lks::Array<lks::ObjectSlot> objects;
    lks::Array<lks::ColliderSlot> colliders;
    lks::RigidScene rigid;

    // Derived, or none of the simulation's business.
    lks::Array<lks::KnownAsset> assets;
    lks::Array<lks::Object*> load_staging;     // scratch of a load: one a slot
    lks::TickScratch scratch[LKS_MAX_WORKERS]; // by worker
    lks::Helpers helpers;
    lks::Clock clock;
    lks_world_counters counters{};
    lks::EventLog event_log;
    bool running = false; // inside a tick's hook
    mutable lks_error last_error{};
    // What stands before the sentence of whatever fails meanwhile; null: nothing.
    mutable const lks::Sentence* failing_within = nullptr;

    // Keeps the sentence and hands it to the log.
    lks_result fail(lks_result result, const lks::Sentence& sentence) const;
    lks_result fail_out_of_memory(const char* what) const;

    lks::Object* find_object(lks_object_id id) const;
    lks::ColliderState* find_collider(lks_collider_id id);
    const lks::ColliderState* find_collider(lks_collider_id id) const;
    bool has_body(lks_body_id id) const;
    bool has_joint(lks_joint_id id) const;
    bool has_attachment(lks_attachment_id id) const;
    lks_result stale_collider(lks_collider_id id) const;

    const lks::KnownAsset* find_asset(std::uint64_t fingerprint) const;
    // Room for so many colliders, in every worker's scratch too. False: no memory.
    [[nodiscard]] bool reserve_colliders(std::size_t count);
    // Every worker's, for objects of such an asset. False: no memory.
    [[nodiscard]] bool reserve_scratch(const lks_asset& asset, const lks::Coefficients& coefficients);
    // The asset among the known ones, added if it is new. Null: no memory.
    const lks::KnownAsset* know_asset(const lks_asset& asset);
    // Those known last, until `count` are left.
    void forget_assets(std::size_t count);
    // A new, empty object of a known asset. Null: no memory.
    lks::Object* make_object(const lks::KnownAsset& known, bool record_forces) const;
    void destroy_object(lks::Object* object) const;
};

namespace lks {

// Frees the slot and makes its old id stale.
void free_object_slot(lks_world& world, std::uint32_t index);

} // namespace lks
