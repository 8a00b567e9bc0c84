#include "state/rigid_image.h"

#include "api/body_checks.h"
#include "api/joint_checks.h"
#include "rigid/body_motion.h"
#include "state/field_io.h"
#include "state/image.h"
#include "state/rigid_fields.h"

namespace lks {
namespace {

constexpr std::size_t shape_size = 8 + 24 + 16 + 16 + 24 + 8;
constexpr std::size_t body_size =
    8 + LKS_MAX_BODY_SHAPES * shape_size + 7 * 8 + 16 + 3 * 24 + 3 * 32 + 2 * 24 + 8;
constexpr std::size_t joint_size = 16 + 2 * 24 + 3 * 16 + 17 * 8 + 5 * 24;
constexpr std::size_t push_size = 8 + 24 + 24;
constexpr std::size_t memory_size = 16 + greatest_point_count * push_size;

// What an image says of one body.
struct BodyRecord {
    lks_body_def def{};
    lks_body_shape shapes[LKS_MAX_BODY_SHAPES]{};
    Body body{};
};

template <typename Io>
void record_fields(Io& io, BodyRecord& record) {
    body_definition_fields(io, record.def, record.shapes);
    body_place_fields(io, record.body);
    body_motion_fields(io, record.body);
}

BodyRecord record_of(const Body& body, const BodyDescription& description) {
    BodyRecord record;
    record.def = define_body(description, record.shapes);
    record.body = body;
    return record;
}

BodyRecord read_record(ByteReader& in) {
    BodyRecord record;
    Reading reading(in);
    record_fields(reading, record);
    record.def.struct_size = sizeof(lks_body_def);
    record.def.shapes = record.shapes;
    record.def.transform.rotation.w = LKS_ROTATION_ONE;
    return record;
}

bool is_unit(const Quaternion& q) {
    constexpr std::int64_t room = turn_one >> 20;
    for (const std::int64_t part : {q.x, q.y, q.z, q.w}) {
        if (!within(part, turn_one + room)) {
            return false;
        }
    }
    const std::int64_t squared =
        multiply_turn(q.x, q.x) + multiply_turn(q.y, q.y) + multiply_turn(q.z, q.z) + multiply_turn(q.w, q.w);
    return within(squared - turn_one, room);
}

bool within(const fixed::Vec3& v, std::int64_t limit) {
    return lks::within(from_vec3(v), limit);
}

// As a saved one is: what a shape has not got is zero, and so are shapes that the body has not got.
bool shapes_are_plain(const BodyRecord& record) {
    for (std::uint32_t i = 0; i < LKS_MAX_BODY_SHAPES; ++i) {
        const lks_body_shape& s = record.shapes[i];
        const bool used = i < record.def.shape_count;
        const bool round = used && s.shape != LKS_SHAPE_BOX;
        const bool capsule = used && s.shape == LKS_SHAPE_CAPSULE;
        const bool box = used && s.shape == LKS_SHAPE_BOX;
        const fixed::Rotation rotation = to_rotation(s.transform.rotation);
        if ((!round && s.radius != 0) || (!capsule && s.half_length != 0) ||
            (!box && !lks::within(s.half_extents, 0)) || s.reserved != 0 ||
            (used ? !(fixed::normalise(rotation) == rotation)
                  : s.shape != 0 || s.density != 0 || !lks::within(s.transform.position, 0) ||
                        !(rotation == fixed::Rotation{0, 0, 0, 0}))) {
            return false;
        }
    }
    return true;
}

bool body_is_valid(const lks_world& world, const BodyRecord& record) {
    const Body& body = record.body;
    // Spins may go beyond the limit by what the middle of a substep differs from its end.
    return check_body_def(world, record.def) == LKS_OK && shapes_are_plain(record) &&
           within(body.position, world_position_limit) &&
           within(body.target_position, world_position_limit) &&
           within(body.rest_position, world_position_limit) && is_unit(body.orientation) &&
           is_unit(body.target_orientation) && is_unit(body.rest_orientation) && body.asleep <= 1 &&
           within(body.velocity, body_speed_limit(world.rate)) &&
           within(body.angular_velocity, 2 * body_spin_limit(world.rate));
}

// The points are from the centres of mass, which lie within 60 m of the frames that the game gave.
bool joint_is_valid(const lks_world& world, const Joint& joint, const Array<std::uint8_t>& kinds) {
    const JointDescription& d = joint.description;
    if (d.body_a >= kinds.size() || d.body_b >= kinds.size() || kinds[d.body_a] == 0 ||
        kinds[d.body_b] == 0) {
        return false;
    }
    const std::int64_t greatest_sum = greatest_push * world.rate.substeps;
    const fixed::Rotation& q = d.motor_target;
    const lks_motor motor{d.motor_torque, d.motor_response, {q.x, q.y, q.z, q.w}};
    return d.body_a != d.body_b && within(d.point_a, LKS_FIXED(124)) && within(d.point_b, LKS_FIXED(124)) &&
           within(joint.push, greatest_push) && within(joint.turn, greatest_push) &&
           within(joint.grip, greatest_push) && joint.swing_push >= 0 && joint.swing_push <= greatest_push &&
           lks::within(joint.twist_push, greatest_push) && within(joint.pushed, greatest_sum) &&
           within(joint.turned, 5 * greatest_sum) && check_joint_ranges(world, define_joint(d)) == LKS_OK &&
           d.swing_limit_z >= -1 && check_motor(world, d.kind, motor) == LKS_OK && fixed::normalise(q) == q;
}

// Between a body and a later one, both there, or a collider.
bool memory_is_valid(const ContactMemory& memory, const Array<std::uint8_t>& kinds) {
    const ContactKey& key = memory.key;
    const auto exists = [&kinds](std::uint32_t body) { return body < kinds.size() && kinds[body] != 0; };
    const bool other_exists = key.other >= other_is_collider
                                  ? (key.other & ~other_is_collider) < LKS_MAX_COLLIDERS
                                  : key.other > key.body_a && exists(key.other);
    bool good = exists(key.body_a) && other_exists &&
                key.shapes < LKS_MAX_BODY_SHAPES * LKS_MAX_BODY_SHAPES && memory.count >= 1 &&
                memory.count <= greatest_point_count;
    for (std::uint32_t i = 0; i < greatest_point_count; ++i) {
        const ContactPush& push = memory.pushes[i];
        const bool nothing = push.feature == 0 && push.normal == 0 && push.across[0] == 0 &&
                             push.across[1] == 0 && within(push.place, 0);
        good = good && (i < memory.count || nothing) && push.reserved == 0 && push.normal >= 0 &&
               push.normal <= greatest_push && lks::within(push.across[0], greatest_push) &&
               lks::within(push.across[1], greatest_push) && within(push.place, LKS_FIXED(128));
    }
    return good;
}

} // namespace

RigidCounts rigid_counts(const RigidScene& scene) {
    return {static_cast<std::uint32_t>(scene.bodies.size()), static_cast<std::uint32_t>(scene.joints.size()),
            static_cast<std::uint32_t>(scene.memories.size())};
}

std::size_t rigid_image_size(const RigidScene& scene) {
    std::size_t size =
        (scene.bodies.size() + scene.joints.size()) * image_slot_size + scene.memories.size() * memory_size;
    for (const Slot& slot : scene.body_slots) {
        size += slot.used ? body_size : 0;
    }
    for (const Slot& slot : scene.joint_slots) {
        size += slot.used ? joint_size : 0;
    }
    return size;
}

void write_rigid(ByteWriter& out, const RigidScene& scene) {
    Writing writing(out);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        out.u32(scene.body_slots[i].generation);
        out.u32(scene.body_slots[i].used ? 1 : 0);
        if (scene.body_slots[i].used) {
            BodyRecord record = record_of(scene.bodies[i], scene.descriptions[i]);
            record_fields(writing, record);
        }
    }
    for (std::size_t i = 0; i < scene.joints.size(); ++i) {
        out.u32(scene.joint_slots[i].generation);
        out.u32(scene.joint_slots[i].used ? 1 : 0);
        if (scene.joint_slots[i].used) {
            Joint joint = scene.joints[i];
            joint_fields(writing, joint);
        }
    }
    for (ContactMemory memory : scene.memories) {
        memory_fields(writing, memory);
    }
}

bool check_rigid(ByteReader& in, const RigidCounts& counts, lks_world& world, const char*& what,
                 std::uint32_t& index) {
    Reading reading(in);
    what = "body";
    Array<std::uint8_t>& kinds = world.rigid.loaded_kinds;
    kinds.clear();
    for (index = 0; index < counts.bodies && in.complete(); ++index) {
        const std::uint32_t generation = in.u32();
        const std::uint32_t used = in.u32();
        if (generation == 0 || used > 1) {
            return false;
        }
        kinds.push_reserved(0);
        if (used == 1) {
            const BodyRecord record = read_record(in);
            if (!body_is_valid(world, record)) {
                return false;
            }
            kinds[index] = static_cast<std::uint8_t>(1 + record.def.kind);
        }
    }
    what = "joint";
    for (index = 0; index < counts.joints && in.complete(); ++index) {
        const std::uint32_t generation = in.u32();
        const std::uint32_t used = in.u32();
        Joint joint{};
        if (used == 1) {
            joint_fields(reading, joint);
        }
        if (generation == 0 || used > 1 || (used == 1 && !joint_is_valid(world, joint, kinds))) {
            return false;
        }
    }
    what = "contact";
    ContactKey last{};
    for (index = 0; index < counts.memories && in.complete(); ++index) {
        ContactMemory memory{};
        memory_fields(reading, memory);
        if (!memory_is_valid(memory, kinds) || (index > 0 && !(last < memory.key))) {
            return false;
        }
        last = memory.key;
    }
    return in.complete();
}

void read_rigid(ByteReader& in, const RigidCounts& counts, const StepRate& rate, RigidScene& scene) {
    Reading reading(in);
    scene.body_slots.clear();
    scene.bodies.clear();
    scene.descriptions.clear();
    for (std::uint32_t i = 0; i < counts.bodies; ++i) {
        const std::uint32_t generation = in.u32();
        const bool used = in.u32() != 0;
        scene.body_slots.push_reserved(Slot{generation, used});
        Body body{};
        BodyDescription description{};
        if (used) {
            const BodyRecord record = read_record(in);
            description = describe_body(record.def);
            body = record.body;
            apply_description(body, description);
            body.follow_orientation();
            body.known_asleep = body.asleep != 0;
            // There is no tick before for the view to start from.
            body.previous_position = body.position;
            body.previous_rotation = narrow(body.orientation);
        }
        scene.bodies.push_reserved(body);
        scene.descriptions.push_reserved(description);
    }
    scene.joint_slots.clear();
    scene.joints.clear();
    for (std::uint32_t i = 0; i < counts.joints; ++i) {
        const std::uint32_t generation = in.u32();
        const bool used = in.u32() != 0;
        scene.joint_slots.push_reserved(Slot{generation, used});
        Joint joint{};
        if (used) {
            joint_fields(reading, joint);
            const JointDescription& d = joint.description;
            joint.constants = make_joint_constants(d, scene.bodies[d.body_a], scene.bodies[d.body_b], rate);
        }
        scene.joints.push_reserved(joint);
    }
    scene.memories.clear();
    for (std::uint32_t i = 0; i < counts.memories; ++i) {
        ContactMemory memory{};
        memory_fields(reading, memory);
        scene.memories.push_reserved(memory);
    }
    scene.follow_joints();
}

void hash_rigid(Hash& hash, const RigidScene& scene, bool local) {
    // A world without bodies has the hash that it had before there were any.
    if (scene.body_slots.empty()) {
        return;
    }
    Hashing hashing(hash);
    hash.add_u32(static_cast<std::uint32_t>(scene.bodies.size()));
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        hash.add_u32(scene.body_slots[i].generation);
        hash.add_u32(scene.body_slots[i].used ? 1 : 0);
        if (scene.body_slots[i].used) {
            BodyRecord record = record_of(scene.bodies[i], scene.descriptions[i]);
            Body& body = record.body;
            body_definition_fields(hashing, record.def, record.shapes);
            if (local) {
                fixed::Vec3 motion = body.target_position - body.position;
                fixed::Vec3 rest = body.rest_position - body.position;
                vector_fields(hashing, motion);
                vector_fields(hashing, rest);
            } else {
                body_place_fields(hashing, body);
            }
            body_motion_fields(hashing, body);
        }
    }
    hash.add_u32(static_cast<std::uint32_t>(scene.joints.size()));
    for (std::size_t i = 0; i < scene.joints.size(); ++i) {
        hash.add_u32(scene.joint_slots[i].generation);
        hash.add_u32(scene.joint_slots[i].used ? 1 : 0);
        if (scene.joint_slots[i].used) {
            Joint joint = scene.joints[i];
            joint_fields(hashing, joint);
        }
    }
    hash.add_u32(static_cast<std::uint32_t>(scene.memories.size()));
    for (ContactMemory memory : scene.memories) {
        memory_fields(hashing, memory);
    }
}

} // namespace lks
