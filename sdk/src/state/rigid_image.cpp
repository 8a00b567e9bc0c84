#include "state/rigid_image.h"

#include <cstddef>
#include <cstring>

#include "memory/prefetch.h"
#include "rigid/make_body.h"
#include "state/image.h"
#include "state/records.h"
#include "state/rigid_checks.h"

namespace lks {
namespace {

std::size_t body_size(const BodyDefinition& definition) {
    return 8 + sizeof(BodySettings) + definition.shape_count * sizeof(lks_body_shape) + sizeof(BodyState);
}
// How far ahead definitions are asked for, and how much of them: a tenth of a load.
constexpr std::size_t prefetched = 4;
constexpr std::size_t prefetched_size = 8 + sizeof(BodySettings) + sizeof(lks_body_shape);
constexpr std::size_t joint_size = sizeof(JointDescription) + sizeof(JointState);
std::size_t contact_size(const ContactMemory& memory) {
    return offsetof(ContactMemory, pushes) + memory.count * sizeof(ContactPush);
}

void write_slot(ByteWriter& out, const Slot& slot) {
    out.u32(slot.generation);
    out.u32(slot.used ? 1 : 0);
}

// A body where it stands in an image.
struct BodyPlace {
    std::uint32_t kind;
    std::uint32_t shape_count;
    const unsigned char* settings;
    const unsigned char* shapes;
    const unsigned char* state;
};

// Nothing of it can be looked at where the image has ended, or it says that it has too many shapes.
bool find_body(ByteReader& in, BodyPlace& body) {
    body.kind = in.u32();
    body.shape_count = in.u32();
    if (body.shape_count > LKS_MAX_BODY_SHAPES) {
        return false;
    }
    body.settings = in.block(sizeof(BodySettings));
    body.shapes = in.block(body.shape_count * sizeof(lks_body_shape));
    body.state = in.block(sizeof(BodyState));
    return in.complete();
}

bool is_defined_as(const BodyPlace& body, const BodyDefinition& own) {
    return body.kind == own.kind && body.shape_count == own.shape_count &&
           same_records(body.settings, &own.settings, 1) &&
           same_records(body.shapes, own.shapes, own.shape_count);
}

BodyDefinition read_definition(const BodyPlace& body) {
    BodyDefinition definition{};
    definition.kind = body.kind;
    definition.shape_count = body.shape_count;
    read_record(body.settings, definition.settings);
    read_records(body.shapes, definition.shapes, body.shape_count);
    return definition;
}

JointDescription read_description(const unsigned char* at) {
    JointDescription description{};
    read_record(at, description);
    return description;
}

class RigidLoader {
public:
    RigidLoader(ByteReader& in, RigidScene& scene) : in_(in), scene_(scene) {}

    bool check_body(std::uint32_t index, const RigidChecks& checks) {
        bool used = false;
        if (!read_slot(used)) {
            return false;
        }
        scene_.loaded_bodies.push_reserved(Loaded::nothing);
        BodyPlace body{};
        if (!used) {
            return true;
        }
        if (index + prefetched < scene_.definitions.size()) {
            prefetch(&scene_.definitions[index + prefetched], prefetched_size);
        }
        if (!find_body(in_, body) || !checks.body(body.state, body.kind)) {
            return false;
        }
        const bool same = has(scene_.body_slots, index) && is_defined_as(body, scene_.definitions[index]);
        scene_.loaded_bodies[index] = same ? Loaded::same : Loaded::other;
        return same || checks.definition(read_definition(body));
    }

    bool check_joint(std::uint32_t index, const RigidChecks& checks) {
        bool used = false;
        if (!read_slot(used)) {
            return false;
        }
        scene_.loaded_joints.push_reserved(Loaded::nothing);
        if (!used) {
            return true;
        }
        const unsigned char* description_at = in_.block(sizeof(JointDescription));
        const unsigned char* state_at = in_.block(sizeof(JointState));
        if (!in_.complete()) {
            return false;
        }
        const bool known = has(scene_.joint_slots, index);
        const auto& target = known ? scene_.joints[index].motor_target : fixed::identity_rotation();
        const std::uint32_t a = read_u32(description_at + offsetof(JointDescription, body_a));
        const std::uint32_t b = read_u32(description_at + offsetof(JointDescription, body_b));
        const Array<Loaded>& bodies = scene_.loaded_bodies;
        if (!checks.joint(state_at, target) || !RigidChecks::joined(a, b, bodies)) {
            return false;
        }
        const bool same = known && same_records(description_at, &scene_.joints[index].description, 1);
        // What follows from it follows from the bodies' masses, too.
        const bool same_bodies = bodies[a] == Loaded::same && bodies[b] == Loaded::same;
        scene_.loaded_joints[index] = same && same_bodies ? Loaded::same : Loaded::other;
        return same || checks.description(read_description(description_at));
    }

    // It is read at once, into what only a tick needs.
    bool check_contact(const RigidChecks& checks, std::uint32_t index, std::uint32_t colliders) {
        ContactMemory* memories = scene_.next_memories.data();
        ContactMemory& memory = memories[index];
        Reading reading(in_);
        contact_fields(reading, memory);
        if (!RigidChecks::contact(memory, scene_.loaded_bodies, colliders)) {
            return false;
        }
        const std::uint32_t count = memory.count;
        const unsigned char* pushes = in_.block(count * sizeof(ContactPush));
        if (pushes == nullptr || !checks.pushes(pushes, count)) {
            return false;
        }
        if (index > 0 && !(memories[index - 1].key < memory.key)) {
            return false;
        }
        read_records(pushes, memory.pushes, count);
        std::memset(memory.pushes + count, 0, (greatest_point_count - count) * sizeof(ContactPush));
        return true;
    }

    void take_body(std::uint32_t index) {
        Slot& slot = scene_.body_slots[index];
        if (scene_.loaded_bodies[index] == Loaded::nothing && slot.used) {
            scene_.bodies[index] = Body{};
            scene_.definitions[index] = BodyDefinition{};
            scene_.descriptions[index] = BodyDescription{};
        }
        take_slot(slot);
        BodyPlace place{};
        if (!slot.used || !find_body(in_, place)) {
            return;
        }
        Body& body = scene_.bodies[index];
        if (scene_.loaded_bodies[index] == Loaded::other) {
            scene_.definitions[index] = read_definition(place);
            scene_.descriptions[index] = describe_body(scene_.definitions[index]);
            body = Body{};
            apply_description(body, scene_.descriptions[index]);
        }
        read_record<BodyState>(place.state, body);
        body.follow_orientation();
        body.known_asleep = body.asleep != 0;
        body.struck = 0;
        body.touched = false;
        // There is no tick before for the view to start from.
        body.previous_position = body.position;
        body.previous_rotation = narrow(body.orientation);
    }

    // True: the joints are others than before.
    bool take_joint(std::uint32_t index, const StepRate& rate) {
        Slot& slot = scene_.joint_slots[index];
        Joint& joint = scene_.joints[index];
        const Loaded loaded = scene_.loaded_joints[index];
        const bool other = loaded == Loaded::other || (loaded == Loaded::nothing && slot.used);
        if (other) {
            joint = Joint{};
        }
        take_slot(slot);
        if (!slot.used) {
            return other;
        }
        const unsigned char* description_at = in_.block(sizeof(JointDescription));
        if (other) {
            joint.description = read_description(description_at);
            const JointDescription& d = joint.description;
            joint.constants = make_joint_constants(d, scene_.bodies[d.body_a], scene_.bodies[d.body_b], rate);
        }
        read_record<JointState>(in_.block(sizeof(JointState)), joint);
        return other;
    }

private:
    static bool has(const Array<Slot>& slots, std::uint32_t index) {
        return index < slots.size() && slots[index].used;
    }

    bool read_slot(bool& used) {
        const std::uint32_t generation = in_.u32();
        const std::uint32_t flag = in_.u32();
        used = flag == 1;
        return generation != 0 && flag <= 1;
    }

    void take_slot(Slot& slot) {
        slot.generation = in_.u32();
        slot.used = in_.u32() != 0;
    }

    ByteReader& in_;
    RigidScene& scene_;
};

// Within reserved memory; new ones are zero.
template <typename T>
void resize(Array<T>& array, std::size_t size) {
    static_cast<void>(array.resize(size));
}

} // namespace

RigidCounts rigid_counts(const lks_world& world) {
    const RigidScene& scene = world.rigid;
    return {static_cast<std::uint32_t>(scene.bodies.size()), static_cast<std::uint32_t>(scene.joints.size()),
            static_cast<std::uint32_t>(scene.memories.size()),
            static_cast<std::uint32_t>(world.colliders.size())};
}

std::size_t rigid_image_size(const RigidScene& scene) {
    std::size_t size = (scene.bodies.size() + scene.joints.size()) * image_slot_size;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        size += scene.body_slots[i].used ? body_size(scene.definitions[i]) : 0;
    }
    for (const Slot& slot : scene.joint_slots) {
        size += slot.used ? joint_size : 0;
    }
    for (const ContactMemory& memory : scene.memories) {
        size += contact_size(memory);
    }
    return size;
}

void write_rigid(ByteWriter& out, const RigidScene& scene) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        write_slot(out, scene.body_slots[i]);
        if (scene.body_slots[i].used) {
            const BodyDefinition& definition = scene.definitions[i];
            out.u32(definition.kind);
            out.u32(definition.shape_count);
            write_record(out, definition.settings);
            write_records(out, definition.shapes, definition.shape_count);
            write_record<BodyState>(out, scene.bodies[i]);
        }
    }
    for (std::size_t i = 0; i < scene.joints.size(); ++i) {
        write_slot(out, scene.joint_slots[i]);
        if (scene.joint_slots[i].used) {
            write_record(out, scene.joints[i].description);
            write_record<JointState>(out, scene.joints[i]);
        }
    }
    Writing writing(out);
    for (const ContactMemory& memory : scene.memories) {
        contact_fields(writing, memory);
        write_records(out, memory.pushes, memory.count);
    }
}

bool check_rigid(ByteReader& in, const RigidCounts& counts, lks_world& world, const char*& what,
                 std::uint32_t& index) {
    RigidScene& scene = world.rigid;
    RigidLoader loader(in, scene);
    const RigidChecks checks(world);
    what = "body";
    scene.loaded_bodies.clear();
    for (index = 0; index < counts.bodies; ++index) {
        if (!loader.check_body(index, checks)) {
            return false;
        }
    }
    what = "joint";
    scene.loaded_joints.clear();
    for (index = 0; index < counts.joints; ++index) {
        if (!loader.check_joint(index, checks)) {
            return false;
        }
    }
    what = "contact";
    index = 0;
    // There is room for them, but where there is no body and none of them is good.
    if (!scene.next_memories.resize(counts.memories)) {
        return false;
    }
    for (index = 0; index < counts.memories; ++index) {
        if (!loader.check_contact(checks, index, counts.colliders)) {
            return false;
        }
    }
    return in.complete();
}

void read_rigid(ByteReader& in, const RigidCounts& counts, const StepRate& rate, RigidScene& scene) {
    RigidLoader loader(in, scene);
    resize(scene.body_slots, counts.bodies);
    resize(scene.bodies, counts.bodies);
    resize(scene.definitions, counts.bodies);
    resize(scene.descriptions, counts.bodies);
    for (std::uint32_t i = 0; i < counts.bodies; ++i) {
        loader.take_body(i);
    }
    bool others = scene.joints.size() != counts.joints;
    resize(scene.joint_slots, counts.joints);
    resize(scene.joints, counts.joints);
    for (std::uint32_t i = 0; i < counts.joints; ++i) {
        others = loader.take_joint(i, rate) || others;
    }
    // A joint whose bodies are others is another one, too.
    if (others) {
        scene.joints_changed();
    }
    scene.memories.swap(scene.next_memories);
    for (const ContactMemory& memory : scene.memories) {
        static_cast<void>(in.block(contact_size(memory)));
    }
}

} // namespace lks
