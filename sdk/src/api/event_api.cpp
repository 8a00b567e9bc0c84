// lockstitch/event.h.
#include <lockstitch/event.h>

#include "api/checks.h"

using namespace lks;

namespace {

bool are_of_same_pair(const ContactKey& p, const ContactKey& q) {
    return p.body_a == q.body_a && p.other == q.other;
}

} // namespace

extern "C" {

lks_result lks_world_record_events(lks_world* world, uint32_t kinds, lks_fixed least_impulse,
                                   uint32_t capacity) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (world->running) {
        return world->fail(LKS_ERROR_INVALID_ARGUMENT,
                           Sentence() << "A tick hook can't change what its own world records.");
    }
    if ((kinds & ~LKS_ALL_EVENTS) != 0) {
        return world->fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "The kinds of events are " << kinds
                                                                  << "; they are sums of bits, up to "
                                                                  << LKS_ALL_EVENTS << ".");
    }
    const Number impulse[] = {{"least_impulse", " N·s", least_impulse, 0, LKS_FIXED(8000000)}};
    if (const lks_result result = check_numbers(*world, impulse); result != LKS_OK) {
        return result;
    }
    if (capacity < 1 || capacity > LKS_MAX_EVENTS) {
        return world->fail(LKS_ERROR_INVALID_ARGUMENT, Sentence()
                                                           << "Room for " << capacity
                                                           << " events is asked for; it must be from 1 to "
                                                           << LKS_MAX_EVENTS << ".");
    }
    EventLog& log = world->event_log;
    if (!log.events.reserve(capacity)) {
        return world->fail_out_of_memory("events");
    }
    log.events.clear();
    log.kinds = kinds;
    log.least_impulse = least_impulse;
    log.capacity = capacity;
    return LKS_OK;
}

const lks_event* lks_world_events(const lks_world* world) {
    return world == nullptr ? nullptr : world->event_log.events.data();
}

uint32_t lks_world_event_count(const lks_world* world) {
    return world == nullptr ? 0 : static_cast<std::uint32_t>(world->event_log.events.size());
}

lks_result lks_world_contacts(const lks_world* world, lks_contact* contacts, uint32_t capacity,
                              uint32_t* count) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (count == nullptr || (contacts == nullptr && capacity > 0)) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT,
                           null_argument("lks_world_contacts", count == nullptr ? "count" : "contacts"));
    }
    // Contacts of the same two follow each other.
    const Array<ContactMemory>& memories = world->rigid.memories;
    std::uint32_t found = 0;
    for (std::size_t i = 0; i < memories.size(); ++found) {
        const ContactKey& key = memories[i].key;
        std::uint32_t shape_pairs = 0;
        for (; i < memories.size() && are_of_same_pair(memories[i].key, key); ++i) {
            ++shape_pairs;
        }
        if (found < capacity) {
            const ContactSides sides = contact_sides(*world, key.body_a, key.other);
            contacts[found] = {sides.body_a, sides.body_b, sides.collider, shape_pairs, 0};
        }
    }
    *count = found;
    return LKS_OK;
}

} // extern "C"
