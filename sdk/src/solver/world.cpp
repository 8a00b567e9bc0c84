#include "solver/world.h"

#include <algorithm>

#include "collide/second_look.h"
#include "solver/kept_rope.h"
#include "solver/particle_rows.h"

using lks::Coefficients;
using lks::KnownAsset;
using lks::Object;
using lks::Sentence;

lks_world::lks_world(const lks_world_def& def)
    : allocator(def.allocator), log(def.log), before_tick(def.before_tick),
      rate(lks::make_step_rate(def.tick_rate_hz, def.substeps, def.iterations)),
      kernels(lks::find_kernels(static_cast<lks_simd>(def.simd))),
      max_ticks_per_advance(def.max_ticks_per_advance),
      excess_time(static_cast<lks_excess_time>(def.excess_time)),
      keep_previous(def.keep_previous_positions != 0),
      worker_count(def.worker_count), gravity{def.gravity.x, def.gravity.y, def.gravity.z},
      objects(allocator), colliders(allocator), rigid(allocator, kernels->trees), assets(allocator),
      load_staging(allocator), event_log(allocator) {
    for (lks::TickScratch& worker : scratch) {
        worker.candidates.set_allocator(allocator);
        worker.distances.set_allocator(allocator);
        worker.chain.set_allocator(allocator);
        worker.rows.set_allocator(allocator);
        worker.anchors.set_allocator(allocator);
        worker.far_pushed.set_allocator(allocator);
    }
}

lks_world::~lks_world() {
    for (lks::ObjectSlot& slot : objects) {
        destroy_object(slot.object);
    }
    forget_assets(0);
}

lks_result lks_world::fail(lks_result result, const Sentence& sentence) const {
    lks::report(&last_error, result,
                failing_within == nullptr ? sentence : Sentence(*failing_within) << sentence.text());
    if (log.write != nullptr) {
        log.write(log.user, LKS_LOG_ERROR, last_error.message);
    }
    return result;
}

lks_result lks_world::fail_out_of_memory(const char* what) const {
    return fail(LKS_ERROR_OUT_OF_MEMORY, Sentence() << "The allocator has no memory for " << what << ".");
}

Object* lks_world::find_object(lks_object_id id) const {
    if (id.generation == 0 || id.index >= objects.size() || objects[id.index].generation != id.generation) {
        return nullptr;
    }
    return objects[id.index].object;
}

const lks::ColliderState* lks_world::find_collider(lks_collider_id id) const {
    if (!lks::names_used(colliders, id)) {
        return nullptr;
    }
    return &colliders[id.index].collider;
}

lks::ColliderState* lks_world::find_collider(lks_collider_id id) {
    return const_cast<lks::ColliderState*>(static_cast<const lks_world*>(this)->find_collider(id));
}

lks_result lks_world::stale_collider(lks_collider_id id) const {
    return fail(LKS_ERROR_STALE_ID, Sentence() << "There is no collider with index " << id.index
                                               << " and generation " << id.generation << " in this world.");
}

bool lks_world::has_body(lks_body_id id) const {
    return lks::names_used(rigid.body_slots, id);
}

bool lks_world::has_joint(lks_joint_id id) const {
    return lks::names_used(rigid.joint_slots, id);
}

bool lks_world::has_attachment(lks_attachment_id id) const {
    return lks::names_used(rigid.attachment_slots, id);
}

bool lks_world::reserve_colliders(std::size_t count) {
    for (std::uint32_t worker = 0; worker < worker_count; ++worker) {
        if (!scratch[worker].candidates.reserve(count * lks::most_side_by_side)) {
            return false;
        }
    }
    // The slots last: they say how many there is room for.
    return rigid.reserve(rigid.body_room(), count) && colliders.reserve(count);
}

const KnownAsset* lks_world::find_asset(std::uint64_t fingerprint) const {
    for (const KnownAsset& known : assets) {
        if (known.asset->fingerprint == fingerprint) {
            return &known;
        }
    }
    return nullptr;
}

bool lks_world::reserve_scratch(const lks_asset& asset, const Coefficients& coefficients) {
    const lks::ChainCoefficients& chain = coefficients.chain;
    const std::size_t chain_words =
        chain.empty() ? 0 : lks::ChainWork::words(chain.count()) + lks::kept_words(asset);
    for (std::uint32_t worker = 0; worker < worker_count; ++worker) {
        if (!scratch[worker].distances.reserve(asset.batches.size()) ||
            !scratch[worker].rows.reserve(lks::row_words(asset, coefficients)) ||
            !scratch[worker].chain.reserve(chain_words) ||
            !scratch[worker].anchors.reserve(asset.tethers.anchors.size()) ||
            !scratch[worker].far_pushed.reserve(lks::look_words(asset.vertex_count()))) {
            return false;
        }
    }
    return true;
}

const KnownAsset* lks_world::know_asset(const lks_asset& asset) {
    if (const KnownAsset* known = find_asset(asset.fingerprint)) {
        return known;
    }
    if (assets.size() == assets.capacity() && !assets.reserve(std::max<std::size_t>(8, 2 * assets.size()))) {
        return nullptr;
    }
    auto* coefficients = lks::create<Coefficients>(allocator, allocator);
    if (coefficients == nullptr || !coefficients->build(asset, rate) ||
        !reserve_scratch(asset, *coefficients)) {
        lks::destroy(allocator, coefficients);
        return nullptr;
    }
    lks::retain_asset(&asset);
    assets.push_reserved(KnownAsset{&asset, coefficients});
    return &assets[assets.size() - 1];
}

void lks_world::forget_assets(std::size_t count) {
    while (assets.size() > count) {
        const KnownAsset known = assets[assets.size() - 1];
        assets.erase(assets.size() - 1);
        lks::destroy(allocator, known.coefficients);
        lks::release_asset(known.asset);
    }
}

Object* lks_world::make_object(const KnownAsset& known, bool record_forces) const {
    auto* object = lks::create<Object>(allocator, allocator, *known.asset, *known.coefficients);
    // Λ is carried from one iteration to the next where anything is soft or a rope's tension counts, and from
    // one solve of a soft rope to the next in an iteration; otherwise only for its read-out.
    const lks::ChainCoefficients& chain = known.coefficients->chain;
    const bool carried = !known.coefficients->relaxations.empty() ||
                         (!chain.empty() && (rate.iterations > 1 || chain.softness != 0));
    if (object != nullptr && !object->allocate(record_forces, record_forces || carried, keep_previous)) {
        destroy_object(object);
        return nullptr;
    }
    return object;
}

void lks_world::destroy_object(Object* object) const {
    lks::destroy(allocator, object);
}

namespace lks {

void free_object_slot(lks_world& world, std::uint32_t index) {
    forget_attachments(world.rigid, index, true);
    ObjectSlot& slot = world.objects[index];
    world.destroy_object(slot.object);
    slot.object = nullptr;
    slot.generation = next_generation(slot.generation);
}

} // namespace lks
