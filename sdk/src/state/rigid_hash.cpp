#include <cstddef>

#include "state/records.h"
#include "state/rigid_image.h"

namespace lks {
namespace {

// All shapes, used or not: every body adds as much.
void add_definition(Hash& hash, const BodyDefinition& definition) {
    hash.add_u32(definition.kind);
    hash.add_u32(definition.shape_count);
    hash_records(hash, definition.shapes, LKS_MAX_BODY_SHAPES);
    hash_record(hash, definition.settings);
}

void add_state(Hash& hash, const Body& body, bool local) {
    if (!local) {
        hash_record<BodyState>(hash, body);
        return;
    }
    Hashing hashing(hash);
    BodyState state = body;
    fixed::Vec3 motion = body.target_position - body.position;
    fixed::Vec3 rest = body.rest_position - body.position;
    vector_fields(hashing, motion);
    vector_fields(hashing, rest);
    body_motion_fields(hashing, state);
}

// Limits that are not soft don't count: a joint has the hash that it had before there were any.
void add_description(Hash& hash, const JointDescription& description) {
    if (!(description.limits == SoftLimits{})) {
        hash_record(hash, description);
    } else if constexpr (host_is_little_endian) {
        hash.add_bytes(&description, offsetof(JointDescription, limits));
    } else {
        Hashing hashing(hash);
        JointDescription copy = description;
        joint_fields(hashing, copy);
    }
}

} // namespace

void hash_rigid(Hash& hash, const RigidScene& scene, bool local) {
    // A world without bodies has the hash that it had before there were any.
    if (scene.body_slots.empty()) {
        return;
    }
    hash.add_u32(static_cast<std::uint32_t>(scene.bodies.size()));
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        hash.add_u32(scene.body_slots[i].generation);
        hash.add_u32(scene.body_slots[i].used ? 1 : 0);
        if (scene.body_slots[i].used) {
            add_definition(hash, scene.definitions[i]);
            add_state(hash, scene.bodies[i], local);
        }
    }
    hash.add_u32(static_cast<std::uint32_t>(scene.joints.size()));
    for (std::size_t i = 0; i < scene.joints.size(); ++i) {
        hash.add_u32(scene.joint_slots[i].generation);
        hash.add_u32(scene.joint_slots[i].used ? 1 : 0);
        if (scene.joint_slots[i].used) {
            add_description(hash, scene.joints[i].description);
            hash_record<JointState>(hash, scene.joints[i]);
        }
    }
    hash.add_u32(static_cast<std::uint32_t>(scene.memories.size()));
    hash_records(hash, scene.memories.data(), scene.memories.size());
}

} // namespace lks
