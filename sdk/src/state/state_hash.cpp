#include "state/state_hash.h"

#include "state/attachment_image.h"
#include "state/field_io.h"
#include "state/rigid_image.h"

namespace lks {
namespace {

// A collider's motion within the next tick is local, its place is not.
void add_collider(Hash& hash, const ColliderState& collider, bool local) {
    Hashing hashing(hash);
    const fixed::Vec3 motion = collider.target_position - collider.position;
    hash.add_u32(collider.shape.kind);
    hash.add_i64(collider.shape.radius);
    hash.add_i64(collider.shape.half_length);
    vector_fields(hashing, collider.shape.half_extents);
    hash.add_i64(collider.static_friction);
    hash.add_i64(collider.dynamic_friction);
    rotation_fields(hashing, collider.rotation);
    rotation_fields(hashing, collider.target_rotation);
    vector_fields(hashing, motion);
    if (!local) {
        vector_fields(hashing, collider.position);
    }
    // A collider that neither throws back nor chooses has the hash that it had before any could.
    if (collider.restitution != 0 || !is_default_filter(collider.filter)) {
        hash.add_i64(collider.restitution);
        hash.add_u32(collider.filter.category);
        hash.add_u32(collider.filter.mask);
        hash.add_u32(static_cast<std::uint32_t>(collider.filter.group));
    }
}

} // namespace

std::uint64_t hash_object(const Object& object, const Kernels& kernels) {
    Hash hash(kernels);
    Hashing hashing(hash);
    hash.add_u64(object.asset().fingerprint);
    hash.add_i64(object.gravity_factor);
    hash.add_i64(object.linear_damping);
    hash.add_u32(object.record_forces ? 1 : 0);
    hash.add_u32(static_cast<std::uint32_t>(object.pins().size()));
    for (const Pin& pin : object.pins()) {
        hash.add_u64(pin.particle);
        vector_fields(hashing, pin.target);
    }
    for (int i = 0; i < axis_count; ++i) {
        hash.add_i64_array(object.axis(i), object.count());
    }
    if (object.record_forces) {
        hash.add_i64_array(object.multipliers.data(), object.multipliers.size());
        hash.add_u32_array(object.recorded_pins.data(), object.recorded_pins.size());
    }
    return hash.finish();
}

std::uint64_t hash_world(const lks_world& world, bool local) {
    Hash hash(*world.kernels);
    Hashing hashing(hash);
    hash.add_u32(world.rate.ticks_per_second);
    hash.add_u32(world.rate.substeps);
    hash.add_u32(world.rate.iterations);
    hash.add_u64(world.tick);
    vector_fields(hashing, world.gravity);
    hash.add_u32(static_cast<std::uint32_t>(world.objects.size()));
    for (const ObjectSlot& slot : world.objects) {
        hash.add_u32(slot.generation);
        hash.add_u32(slot.object != nullptr ? 1 : 0);
        if (slot.object != nullptr) {
            hash.add_u64(hash_object(*slot.object, *world.kernels));
            if (!local) {
                vector_fields(hashing, slot.object->origin);
            }
        }
    }
    hash.add_u32(static_cast<std::uint32_t>(world.colliders.size()));
    for (const ColliderSlot& slot : world.colliders) {
        hash.add_u32(slot.generation);
        hash.add_u32(slot.used ? 1 : 0);
        if (slot.used) {
            add_collider(hash, slot.collider, local);
        }
    }
    hash_rigid(hash, world.rigid, local);
    hash_attachments(hash, world.rigid);
    return hash.finish();
}

} // namespace lks
