// Takes down what happens in a tick (lockstitch/event.h). Nothing here is state.
#pragma once

#include <lockstitch/event.h>

#include "memory/array.h"
#include "rigid/rigid_scene.h"

struct lks_world;

namespace lks {

struct EventLog {
    explicit EventLog(const lks_allocator& allocator) : events(allocator) {}

    bool wants(lks_event_kind kind) const { return (kinds & LKS_EVENT_BIT(kind)) != 0; }
    bool wants_particles() const { return wants(LKS_EVENT_PARTICLES_PUSHED); }
    bool wants_contacts() const {
        constexpr std::uint32_t contacts =
            LKS_EVENT_BIT(LKS_EVENT_CONTACT_BEGIN) | LKS_EVENT_BIT(LKS_EVENT_CONTACT_END) |
            LKS_EVENT_BIT(LKS_EVENT_CONTACT_HIT) | LKS_EVENT_BIT(LKS_EVENT_CONTACT_LOADED) |
            LKS_EVENT_BIT(LKS_EVENT_CONTACT_UNLOADED);
        return (kinds & contacts) != 0;
    }

    std::uint32_t kinds = 0;
    std::int64_t least_impulse = 0; // World, N·s
    std::uint32_t capacity = 0;
    Array<lks_event> events;
};

// Of a contact: the body, and the other body or the collider. Generation 0: none.
struct ContactSides {
    lks_body_id body_a;
    lks_body_id body_b;
    lks_collider_id collider;
};
ContactSides contact_sides(const lks_world& world, std::uint32_t body_a, std::uint32_t other);

// At the end of a tick, before the new memories take the place of the old ones.
void record_contacts(lks_world& world);
void record_particles(lks_world& world);
// Before it is freed.
void record_break(lks_world& world, const Joint& joint, std::uint32_t index);
void record_break(lks_world& world, const Attachment& attachment, std::uint32_t index);
// Last: who sleeps and who is awake since the tick before.
void record_sleep(lks_world& world);

} // namespace lks
