#include "rigid/contact_memory.h"

#include <algorithm>

#include "fixed/formats.h"
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
        const Scaled scaled =
            Scaled::from_fixed(static_cast<std::uint64_t>(push), world_fraction_bits) * dynamic / now;
        push = std::min(scaled.to_i64_fixed(world_fraction_bits), greatest_push);
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
