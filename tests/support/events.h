// Events of a world, as a game reads them.
#pragma once

#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "support/handles.h"

namespace support {

inline void record(const World& world, std::uint32_t kinds = LKS_ALL_EVENTS, double least = 0,
                   std::uint32_t capacity = 1000) {
    REQUIRE(lks_world_record_events(world, kinds, fixed(least), capacity) == LKS_OK);
}

// Those of the last call that ran ticks.
inline std::vector<lks_event> events_of(const World& world) {
    const lks_event* first = lks_world_events(world);
    return std::vector<lks_event>(first, first + lks_world_event_count(world));
}

// Those of so many ticks.
inline std::vector<lks_event> run(World& world, int ticks) {
    std::vector<lks_event> all;
    for (int i = 0; i < ticks; ++i) {
        world.step();
        const std::vector<lks_event> now = events_of(world);
        all.insert(all.end(), now.begin(), now.end());
    }
    return all;
}

// In every field.
inline bool same(const lks_event& a, const lks_event& b) {
    const auto id = [](const auto& x, const auto& y) {
        return x.index == y.index && x.generation == y.generation;
    };
    return a.kind == b.kind && a.tick == b.tick && id(a.body_a, b.body_a) && id(a.body_b, b.body_b) &&
           id(a.collider, b.collider) && id(a.joint, b.joint) && id(a.attachment, b.attachment) &&
           id(a.object, b.object) && a.strength == b.strength && same(a.point, b.point) &&
           same(a.normal, b.normal);
}

} // namespace support
