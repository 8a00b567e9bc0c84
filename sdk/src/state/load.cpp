// Loading an image in two passes over the same bytes: the first checks every value and makes the objects that
// the world has not got, the second cannot fail.
#include <algorithm>

#include "api/collider_checks.h"
#include "api/object_checks.h"
#include "state/attachment_image.h"
#include "state/collider_fields.h"
#include "state/image.h"
#include "state/rigid_image.h"

namespace lks {
namespace {

ImageHeader read_header(ByteReader& in) {
    ImageHeader header{};
    header.magic = in.u64();
    header.version = in.u32();
    header.solver_version = in.u32();
    header.size = in.u64();
    header.checksum = in.u64();
    header.ticks_per_second = in.u32();
    header.substeps = in.u32();
    header.iterations = in.u32();
    header.reserved = in.u32();
    header.object_slots = in.u32();
    header.collider_slots = in.u32();
    header.body_slots = in.u32();
    header.joint_slots = in.u32();
    header.contact_count = in.u32();
    header.attachment_slots = in.u32();
    header.tick = in.u64();
    Reading reading(in);
    vector_fields(reading, header.gravity);
    return header;
}

ImageObject read_object(ByteReader& in) {
    ImageObject object{};
    object.fingerprint = in.u64();
    object.vertex_count = in.u32();
    object.record_forces = in.u32();
    object.pin_count = in.u32();
    object.constraint_count = in.u32();
    object.recorded_pin_count = in.u64();
    object.gravity_factor = in.i64();
    object.linear_damping = in.i64();
    Reading reading(in);
    vector_fields(reading, object.origin);
    return object;
}

Pin read_pin(ByteReader& in) {
    Pin pin{};
    pin.particle = static_cast<std::uint32_t>(std::min<std::uint64_t>(in.u64(), UINT32_MAX));
    Reading reading(in);
    vector_fields(reading, pin.target);
    return pin;
}

ColliderState read_collider(ByteReader& in) {
    ColliderState collider{};
    Reading reading(in);
    collider_fields(reading, collider);
    return collider;
}

lks_result corrupt(const lks_world& world, const Sentence& what) {
    return world.fail(LKS_ERROR_CORRUPT_IMAGE, what);
}

lks_result foreign(const lks_world& world, const char* what, std::uint64_t image, std::uint64_t own) {
    return world.fail(LKS_ERROR_FOREIGN_IMAGE, Sentence() << "The image's " << what << " is " << image
                                                          << ", this world's is " << own << ".");
}

// Everything that can be said of an image from its first bytes.
lks_result check_header(const lks_world& world, const ImageHeader& header, const unsigned char* memory,
                        std::size_t size) {
    if (size < image_header_size) {
        return corrupt(world, Sentence() << "The image has " << static_cast<std::uint64_t>(size)
                                         << " bytes, fewer than its header.");
    }
    if (header.magic != image_magic) {
        return corrupt(
            world, (Sentence() << "This is no image of a world: it begins with ").hexadecimal(header.magic)
                       << ".");
    }
    if (header.version != image_version) {
        return foreign(world, "format version", header.version, image_version);
    }
    if (header.solver_version != LKS_SOLVER_VERSION) {
        return foreign(world, "solver version", header.solver_version, LKS_SOLVER_VERSION);
    }
    if (header.size != size) {
        return corrupt(world, Sentence() << "The image says that it has " << header.size << " bytes, but "
                                         << static_cast<std::uint64_t>(size) << " were given.");
    }
    const std::uint64_t found =
        Checksum(*world.kernels).finish(memory + image_checked_from, size - image_checked_from);
    if (found != header.checksum) {
        return corrupt(world,
                       ((Sentence() << "The image's checksum is ").hexadecimal(found) << " instead of ")
                               .hexadecimal(header.checksum)
                           << ".");
    }
    if (header.ticks_per_second != world.rate.ticks_per_second) {
        return foreign(world, "tick rate", header.ticks_per_second, world.rate.ticks_per_second);
    }
    if (header.substeps != world.rate.substeps) {
        return foreign(world, "number of substeps", header.substeps, world.rate.substeps);
    }
    if (header.iterations != world.rate.iterations) {
        return foreign(world, "number of iterations", header.iterations, world.rate.iterations);
    }
    if (header.reserved != 0 || header.attachment_slots > LKS_MAX_ATTACHMENTS ||
        header.body_slots > LKS_MAX_BODIES || header.joint_slots > LKS_MAX_JOINTS ||
        header.contact_count > contact_capacity(header.body_slots) || header.object_slots > LKS_MAX_OBJECTS ||
        header.collider_slots > LKS_MAX_COLLIDERS || !within(header.gravity, LKS_FIXED(1000))) {
        return corrupt(world, Sentence() << "A value in the image's header is out of range.");
    }
    return LKS_OK;
}

class Loader {
public:
    Loader(lks_world& world, const ImageHeader& header) : world_(world), header_(header) {}

    // Checks everything, and stages one object for each used slot: the one that is there if it fits, else a
    // new one.
    lks_result check(ByteReader in) {
        if (least_size() > in.left()) {
            return wrong_size();
        }
        if (!reserve()) {
            return world_.fail_out_of_memory("an image's objects");
        }
        world_.load_staging.clear();
        for (std::uint32_t i = 0; i < header_.object_slots; ++i) {
            world_.load_staging.push_reserved(nullptr);
            if (const lks_result result = check_object_slot(in, i); result != LKS_OK) {
                return result;
            }
        }
        for (std::uint32_t i = 0; i < header_.collider_slots; ++i) {
            const std::uint32_t generation = in.u32();
            const std::uint32_t used = in.u32();
            bool good = generation != 0 && used <= 1;
            if (good && used == 1) {
                good = collider_is_valid(read_collider(in));
            }
            if (!good) {
                return corrupt(world_,
                               Sentence() << "A value of collider " << i << " in the image is out of range.");
            }
        }
        const char* what = "";
        std::uint32_t index = 0;
        if (!check_rigid(in, counts(), world_, what, index)) {
            return corrupt(world_, Sentence() << "A value of " << what << " " << index
                                              << " in the image is out of range.");
        }
        ByteReader attachments = in;
        if (!check_attachments(in, header_.attachment_slots, world_, index)) {
            return corrupt(world_, Sentence() << "A value of attachment " << index
                                              << " in the image is out of range, or it holds a vertex that "
                                                 "another one holds at another point of the same body.");
        }
        if (!in.complete() || in.left() != 0) {
            return wrong_size();
        }
        if (!reserve_for_attachments(attachments, header_.attachment_slots, world_)) {
            return world_.fail_out_of_memory("an image's attachments");
        }
        return LKS_OK;
    }

    // Gives up what check() made.
    void abandon() {
        for (std::size_t i = 0; i < world_.load_staging.size(); ++i) {
            if (!is_present(i, world_.load_staging[i])) {
                world_.destroy_object(world_.load_staging[i]);
            }
        }
        world_.load_staging.clear();
    }

    void commit(ByteReader in) {
        world_.event_log.events.clear();
        world_.tick = header_.tick;
        world_.gravity = header_.gravity;
        commit_objects(in);
        world_.colliders.clear();
        for (std::uint32_t i = 0; i < header_.collider_slots; ++i) {
            ColliderSlot slot{};
            slot.generation = in.u32();
            slot.used = in.u32() != 0;
            if (slot.used) {
                slot.collider = read_collider(in);
                // There is no tick before for the view to start from.
                slot.collider.previous_position = slot.collider.position;
                slot.collider.previous_rotation = slot.collider.rotation;
            }
            world_.colliders.push_reserved(slot);
        }
        read_rigid(in, counts(), world_.rate, world_.rigid);
        read_attachments(in, header_.attachment_slots, world_);
    }

private:
    lks_result wrong_size() const {
        return corrupt(world_, Sentence() << "The image's parts do not add up to its size.");
    }

    // A slot has a generation and whether it is used, a contact its key and count. What says that it has more
    // of them than there are bytes is not given memory for them.
    std::uint64_t least_size() const {
        const std::uint64_t slots = std::uint64_t{header_.object_slots} + header_.collider_slots +
                                    header_.body_slots + header_.joint_slots + header_.attachment_slots;
        return 8 * slots + 16 * std::uint64_t{header_.contact_count};
    }

    bool reserve() {
        return world_.load_staging.reserve(header_.object_slots) &&
               world_.rigid.reserve_objects(header_.object_slots) &&
               world_.rigid.reserve_attachments(header_.attachment_slots) &&
               world_.objects.reserve(header_.object_slots) &&
               world_.reserve_colliders(header_.collider_slots) &&
               world_.rigid.reserve(header_.body_slots, world_.colliders.capacity()) &&
               world_.rigid.reserve_joints(header_.joint_slots);
    }

    RigidCounts counts() const {
        return {header_.body_slots, header_.joint_slots, header_.contact_count, header_.collider_slots};
    }

    bool is_present(std::size_t slot, const Object* object) const {
        return slot < world_.objects.size() && world_.objects[slot].object == object;
    }

    lks_result check_object_slot(ByteReader& in, std::uint32_t slot) {
        const std::uint32_t generation = in.u32();
        const std::uint32_t used = in.u32();
        if (generation == 0 || used > 1) {
            return corrupt(world_, Sentence() << "Object slot " << slot << " of the image is out of range.");
        }
        if (used == 0) {
            return LKS_OK;
        }
        const ImageObject image = read_object(in);
        const KnownAsset* known = world_.find_asset(image.fingerprint);
        if (known == nullptr) {
            return in.complete()
                       ? world_.fail(LKS_ERROR_FOREIGN_IMAGE,
                                     (Sentence() << "Object " << slot << " of the image needs the asset ")
                                             .hexadecimal(image.fingerprint)
                                         << ", which this world does not know.")
                       : corrupt(world_, Sentence() << "The image ends inside object " << slot << ".");
        }
        if (!object_is_valid(image, *known->asset) || !pins_are_valid(in, image) ||
            !in.skip_i64(std::size_t{6} * image.vertex_count + image.constraint_count) ||
            !recorded_pins_are_valid(in, image)) {
            return corrupt(world_, Sentence()
                                       << "A value of object " << slot << " in the image is out of range.");
        }
        Object* object = stage(slot, *known, image);
        if (object == nullptr ||
            !object->reserve_pins(
                std::max(image.pin_count, static_cast<std::uint32_t>(image.recorded_pin_count)))) {
            return world_.fail_out_of_memory("an image's objects");
        }
        return LKS_OK;
    }

    static bool recorded_pins_are_valid(ByteReader& in, const ImageObject& image) {
        std::uint64_t next = 0; // the least that may follow: they ascend
        for (std::uint64_t i = 0; i < image.recorded_pin_count; ++i) {
            const std::uint64_t particle = in.u64();
            if (particle < next || particle >= image.vertex_count) {
                return false;
            }
            next = particle + 1;
        }
        return in.complete();
    }

    static bool object_is_valid(const ImageObject& image, const lks_asset& asset) {
        return image.vertex_count == asset.vertex_count() && image.record_forces <= 1 &&
               image.constraint_count == (image.record_forces != 0 ? asset.constraint_count() : 0) &&
               image.pin_count <= image.vertex_count &&
               image.recorded_pin_count <= (image.record_forces != 0 ? image.vertex_count : 0) &&
               gravity_factor_is_valid(image.gravity_factor) &&
               linear_damping_is_valid(image.linear_damping) && within(image.origin, world_position_limit);
    }

    static bool pins_are_valid(ByteReader& in, const ImageObject& image) {
        std::int64_t last = -1;
        for (std::uint32_t i = 0; i < image.pin_count; ++i) {
            const Pin pin = read_pin(in);
            if (std::int64_t{pin.particle} <= last || pin.particle >= image.vertex_count ||
                !within(fixed::Vec3{pin.target.x, pin.target.y, pin.target.z}, coordinate_limit)) {
                return false;
            }
            last = pin.particle;
        }
        return in.complete();
    }

    Object* stage(std::uint32_t slot, const KnownAsset& known, const ImageObject& image) {
        Object* present = slot < world_.objects.size() ? world_.objects[slot].object : nullptr;
        const bool fits = present != nullptr && &present->asset() == known.asset &&
                          present->record_forces == (image.record_forces != 0);
        Object* object = fits ? present : world_.make_object(known, image.record_forces != 0);
        world_.load_staging[slot] = object;
        return object;
    }

    void commit_objects(ByteReader& in) {
        for (std::size_t i = 0; i < world_.objects.size(); ++i) {
            const bool stays = i < header_.object_slots && world_.load_staging[i] == world_.objects[i].object;
            if (!stays) {
                world_.destroy_object(world_.objects[i].object);
            }
        }
        world_.objects.clear();
        for (std::uint32_t i = 0; i < header_.object_slots; ++i) {
            const std::uint32_t generation = in.u32();
            const bool used = in.u32() != 0;
            world_.objects.push_reserved(ObjectSlot{world_.load_staging[i], generation});
            if (used) {
                commit_object(in, *world_.load_staging[i]);
            }
        }
        world_.load_staging.clear();
    }

    void commit_object(ByteReader& in, Object& object) {
        const ImageObject image = read_object(in);
        object.gravity_factor = image.gravity_factor;
        object.linear_damping = image.linear_damping;
        object.origin = image.origin;
        object.replace_pins(world_.rate, image.pin_count, [&in] { return read_pin(in); });
        // The last one first: the checksum has just read it.
        for (int i = axis_count; i-- > 0;) {
            ByteReader axis = in;
            static_cast<void>(axis.skip_i64(static_cast<std::size_t>(i) * object.count()));
            axis.i64_array(object.axis(i), object.count());
        }
        static_cast<void>(in.skip_i64(std::size_t{axis_count} * object.count()));
        if (object.record_forces) {
            in.i64_array(object.multipliers.data(), object.multipliers.size());
            object.recorded_pins.clear();
            for (std::uint64_t i = 0; i < image.recorded_pin_count; ++i) {
                object.recorded_pins.push_reserved(static_cast<std::uint32_t>(in.u64()));
            }
        }
        // There is no tick before for the view to start from.
        object.keep_previous();
    }

    lks_world& world_;
    const ImageHeader& header_;
};

} // namespace

lks_result load_image(lks_world& world, const unsigned char* memory, std::size_t size) {
    ByteReader in(memory, size);
    const ImageHeader header = read_header(in);
    if (const lks_result result = check_header(world, header, memory, size); result != LKS_OK) {
        return result;
    }
    Loader loader(world, header);
    if (const lks_result result = loader.check(in); result != LKS_OK) {
        loader.abandon();
        return result;
    }
    loader.commit(in);
    return LKS_OK;
}

} // namespace lks
