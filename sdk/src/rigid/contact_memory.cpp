#include "rigid/contact_memory.h"

#include <algorithm>

#include "fixed/world_times.h"
#include "rigid/make_body.h"
#include "rigid/push_limits.h"

namespace lks {
namespace {

using fixed::Scaled;

// of(index of a body)
template <typename Of>
Scaled greater_of(std::uint32_t body_a, std::uint32_t other, const Of& of) {
    const Scaled a = of(body_a);
    return other < other_is_collider ? std::max(a, of(other)) : a;
}

// Its pushes will count in another mass.
void forget(const RigidScene& scene, ContactMemory& memory) {
    memory.forgotten = 1;
    const Scaled now = greater_inverse_mass(scene, memory.key.body_a, memory.key.other);
    const Scaled dynamic = greater_dynamic_inverse_mass(scene, memory.key.body_a, memory.key.other);
    if (now == dynamic || now.is_zero()) {
        return;
    }
    for (std::uint32_t i = 0; i < memory.count; ++i) {
        std::int64_t& push = memory.pushes[i].normal;
        push = std::min(times(push, dynamic / now), greatest_push);
    }
}

} // namespace

Scaled greater_inverse_mass(const RigidScene& scene, std::uint32_t body_a, std::uint32_t other) {
    return greater_of(body_a, other, [&scene](std::uint32_t i) { return inverse_mass(scene.bodies[i]); });
}

Scaled greater_dynamic_inverse_mass(const RigidScene& scene, std::uint32_t body_a, std::uint32_t other) {
    return greater_of(body_a, other,
                      [&scene](std::uint32_t i) { return dynamic_inverse_mass(scene.descriptions[i]); });
}

bool is_with_sleeper(const RigidScene& scene, const ContactKey& key) {
    return scene.bodies[key.body_a].asleep != 0 ||
           (key.other < other_is_collider && scene.bodies[key.other].asleep != 0);
}

Scaled wall_ratio(const RigidScene& scene, const ContactKey& key) {
    const Scaled own = greater_of(key.body_a, key.other, [&scene](std::uint32_t i) {
        return scene.bodies[i].asleep == 0 ? inverse_mass(scene.bodies[i]) : Scaled{};
    });
    return own.is_zero() ? Scaled::from_u64(1) : greater_inverse_mass(scene, key.body_a, key.other) / own;
}

void scale_pushes(std::span<ContactPush> pushes, const Scaled& ratio) {
    for (ContactPush& push : pushes) {
        for (std::int64_t* part : {&push.normal, &push.across[0], &push.across[1]}) {
            *part = std::clamp(times(*part, ratio), -greatest_push, greatest_push);
        }
    }
}

void forget_contacts(RigidScene& scene, std::uint32_t body) {
    for (ContactMemory& memory : scene.memories) {
        if (memory.forgotten == 0 && (memory.key.body_a == body || memory.key.other == body)) {
            forget(scene, memory);
        }
    }
}

void drop_contacts(RigidScene& scene, std::uint32_t other) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < scene.memories.size(); ++i) {
        if (scene.memories[i].key.body_a != other && scene.memories[i].key.other != other) {
            scene.memories[kept++] = scene.memories[i];
        }
    }
    static_cast<void>(scene.memories.resize(kept)); // never grows
}

} // namespace lks
