// lockstitch/event.h.
#include <lockstitch/event.h>

#include "api/checks.h"

using namespace lks;

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

} // extern "C"
