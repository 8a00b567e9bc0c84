#include "state/attachment_image.h"
#include "state/collider_fields.h"
#include "state/image.h"
#include "state/rigid_image.h"

namespace lks {
namespace {

std::size_t object_size(const Object& object) {
    return image_object_size + object.pins().size() * image_pin_size +
           axis_count * std::size_t{object.count()} * sizeof(std::int64_t) +
           (object.record_forces ? object.multipliers.bytes() : 0) +
           object.recorded_pins.size() * sizeof(std::uint64_t);
}

void write_object(ByteWriter& out, const Object& object) {
    Writing writing(out);
    out.u64(object.asset().fingerprint);
    out.u32(object.count());
    out.u32(object.record_forces ? 1 : 0);
    out.u32(static_cast<std::uint32_t>(object.pins().size()));
    out.u32(object.record_forces ? static_cast<std::uint32_t>(object.multipliers.size()) : 0);
    out.u64(object.recorded_pins.size());
    out.i64(object.gravity_factor);
    out.i64(object.linear_damping);
    vector_fields(writing, object.origin);
    for (const Pin& pin : object.pins()) {
        out.u64(pin.particle);
        vector_fields(writing, pin.target);
    }
    for (int i = 0; i < axis_count; ++i) {
        out.i64_array(object.axis(i), object.count());
    }
    if (object.record_forces) {
        out.i64_array(object.multipliers.data(), object.multipliers.size());
        for (const std::uint32_t particle : object.recorded_pins) {
            out.u64(particle);
        }
    }
}

} // namespace

std::size_t image_size(const lks_world& world) {
    std::size_t size = image_header_size + (world.objects.size() + world.colliders.size()) * image_slot_size;
    for (const ObjectSlot& slot : world.objects) {
        size += slot.object != nullptr ? object_size(*slot.object) : 0;
    }
    for (const ColliderSlot& slot : world.colliders) {
        size += slot.used ? image_collider_size : 0;
    }
    return size + rigid_image_size(world.rigid) + attachments_image_size(world.rigid);
}

void write_image(const lks_world& world, unsigned char* memory) {
    const std::size_t size = image_size(world);
    Checksum checksum(*world.kernels);
    ByteWriter out(memory + image_checked_from, checksum);
    Writing writing(out);
    out.u32(world.rate.ticks_per_second);
    out.u32(world.rate.substeps);
    out.u32(world.rate.iterations);
    out.u32(0);
    out.u32(static_cast<std::uint32_t>(world.objects.size()));
    out.u32(static_cast<std::uint32_t>(world.colliders.size()));
    const RigidCounts counts = rigid_counts(world);
    out.u32(counts.bodies);
    out.u32(counts.joints);
    out.u32(counts.memories);
    out.u32(static_cast<std::uint32_t>(world.rigid.attachments.size()));
    out.u64(world.tick);
    vector_fields(writing, world.gravity);
    for (const ObjectSlot& slot : world.objects) {
        out.u32(slot.generation);
        out.u32(slot.object != nullptr ? 1 : 0);
        if (slot.object != nullptr) {
            write_object(out, *slot.object);
        }
    }
    for (const ColliderSlot& slot : world.colliders) {
        out.u32(slot.generation);
        out.u32(slot.used ? 1 : 0);
        if (slot.used) {
            collider_fields(writing, slot.collider);
        }
    }
    write_rigid(out, world.rigid);
    write_attachments(out, world.rigid);
    ByteWriter front(memory);
    front.u64(image_magic);
    front.u32(image_version);
    front.u32(LKS_SOLVER_VERSION);
    front.u64(size);
    front.u64(out.checksum());
}

} // namespace lks
