#include "state/attachment_image.h"

#include <algorithm>
#include <tuple>

#include "api/attachment_checks.h"
#include "rigid/coupling.h"
#include "rigid/rope_loads.h"
#include "state/field_io.h"
#include "state/image.h"
#include "state/rigid_fields.h"

namespace lks {
namespace {

constexpr std::size_t attachment_size = 24 + 2 * 24 + 3 * 8;

bool has_particle(const lks_world& world, std::uint32_t object, std::uint32_t particle) {
    const Array<Object*>& staged = world.load_staging;
    return object < staged.size() && staged[object] != nullptr && particle < staged[object]->count();
}

// What a definition has not got is zero.
bool is_valid(const lks_world& world, const Attachment& attachment) {
    const AttachmentDescription& d = attachment.description;
    const Array<Loaded>& bodies = world.rigid.loaded_bodies;
    const bool to_body = d.kind == LKS_ATTACHMENT_TO_BODY;
    const bool other =
        to_body ? d.other < bodies.size() && bodies[d.other] != Loaded::nothing && d.other_particle == 0
                : has_particle(world, d.other, d.other_particle) &&
                      (d.other != d.object || d.other_particle != d.particle) && within(d.point, 0);
    const std::int64_t greatest_sum = greatest_push * world.rate.substeps;
    return d.kind <= LKS_ATTACHMENT_TO_VERTEX && has_particle(world, d.object, d.particle) && other &&
           d.reserved == 0 && within(d.point, LKS_FIXED(124)) && within(attachment.pushed, greatest_sum) &&
           check_attachment_ranges(world, d.compliance, d.damping, d.break_force) == LKS_OK;
}

// Of those that could contradict each other: together what one body holds of one particle, the same points in
// a row. `reserved` has the index.
bool is_before(const AttachmentDescription& a, const AttachmentDescription& b) {
    const auto key = [](const AttachmentDescription& d) {
        return std::tie(d.object, d.particle, d.other, d.point.x, d.point.y, d.point.z, d.reserved);
    };
    return key(a) < key(b);
}

bool find_contradiction(Array<AttachmentDescription>& rigid, std::uint32_t& index) {
    std::sort(rigid.begin(), rigid.end(), is_before);
    for (std::size_t i = 1; i < rigid.size(); ++i) {
        if (rigid[i].contradicts(rigid[i - 1])) {
            index = std::max(rigid[i].reserved, rigid[i - 1].reserved);
            return true;
        }
    }
    return false;
}

} // namespace

std::size_t attachments_image_size(const RigidScene& scene) {
    std::size_t size = scene.attachments.size() * image_slot_size;
    for (const Slot& slot : scene.attachment_slots) {
        size += slot.used ? attachment_size : 0;
    }
    return size;
}

void write_attachments(ByteWriter& out, const RigidScene& scene) {
    Writing writing(out);
    for (std::size_t i = 0; i < scene.attachments.size(); ++i) {
        out.u32(scene.attachment_slots[i].generation);
        out.u32(scene.attachment_slots[i].used ? 1 : 0);
        if (scene.attachment_slots[i].used) {
            Attachment attachment = scene.attachments[i];
            attachment_fields(writing, attachment);
        }
    }
}

bool check_attachments(ByteReader& in, std::uint32_t count, lks_world& world, std::uint32_t& index) {
    Reading reading(in);
    Array<AttachmentDescription>& rigid = world.rigid.loaded_attachments;
    rigid.clear();
    for (index = 0; index < count && in.complete(); ++index) {
        const std::uint32_t generation = in.u32();
        const std::uint32_t used = in.u32();
        Attachment attachment{};
        if (used == 1) {
            attachment_fields(reading, attachment);
        }
        if (generation == 0 || used > 1 || (used == 1 && !is_valid(world, attachment))) {
            return false;
        }
        AttachmentDescription& d = attachment.description;
        if (used == 1 && d.kind == LKS_ATTACHMENT_TO_BODY && d.is_rigid()) {
            d.reserved = index;
            rigid.push_reserved(d);
        }
    }
    return in.complete() && !find_contradiction(rigid, index);
}

bool reserve_for_attachments(ByteReader& in, std::uint32_t count, const lks_world& world) {
    Reading reading(in);
    for (std::uint32_t i = 0; i < count; ++i) {
        static_cast<void>(in.u32()); // generation
        if (in.u32() == 0) {
            continue;
        }
        Attachment attachment{};
        attachment_fields(reading, attachment);
        Object& object = *world.load_staging[attachment.description.object];
        if (may_load_rope(attachment.description, object) && !object.reserve_coefficients()) {
            return false;
        }
    }
    return true;
}

void read_attachments(ByteReader& in, std::uint32_t count, lks_world& world) {
    Reading reading(in);
    RigidScene& scene = world.rigid;
    scene.attachment_slots.clear();
    scene.attachments.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t generation = in.u32();
        const bool used = in.u32() != 0;
        scene.attachment_slots.push_reserved(Slot{generation, used});
        Attachment attachment{};
        if (used) {
            attachment_fields(reading, attachment);
            attachment.constants =
                make_attachment_constants(attachment.description, sides_of(world, attachment), world.rate);
        }
        scene.attachments.push_reserved(attachment);
    }
}

void hash_attachments(Hash& hash, const RigidScene& scene) {
    // A world without them has the hash that it had before there were any.
    if (scene.attachments.empty()) {
        return;
    }
    Hashing hashing(hash);
    hash.add_u32(static_cast<std::uint32_t>(scene.attachments.size()));
    for (std::size_t i = 0; i < scene.attachments.size(); ++i) {
        hash.add_u32(scene.attachment_slots[i].generation);
        hash.add_u32(scene.attachment_slots[i].used ? 1 : 0);
        if (scene.attachment_slots[i].used) {
            Attachment attachment = scene.attachments[i];
            attachment_fields(hashing, attachment);
        }
    }
}

} // namespace lks
