// Places for objects, colliders, bodies and joints, which ids name by index and generation.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lks {

// The generation is that of the present or the next occupant, and never 0.
struct Slot {
    std::uint32_t generation;
    bool used;
};

constexpr std::uint32_t next_generation(std::uint32_t generation) {
    return generation == UINT32_MAX ? 1 : generation + 1;
}

// Makes the ids of the present occupant stale.
inline void free_slot(Slot& slot) {
    slot.used = false;
    slot.generation = next_generation(slot.generation);
}

// The lowest index whose slot is free, or one behind the last.
template <typename Slots, typename IsFree>
std::uint32_t first_free(const Slots& slots, const IsFree& is_free) {
    std::uint32_t index = 0;
    while (index < slots.size() && !is_free(slots[index])) {
        ++index;
    }
    return index;
}

template <typename Slots>
std::uint32_t first_free(const Slots& slots) {
    return first_free(slots, [](const auto& slot) { return !slot.used; });
}

// Room for what is added where there is none left: as much again, so that many cost no more than their
// number.
constexpr std::size_t grown_room(std::size_t count) {
    return count < 8 ? 16 : 2 * count;
}

template <typename Slots>
std::uint32_t count_used(const Slots& slots) {
    std::uint32_t count = 0;
    for (const auto& slot : slots) {
        count += slot.used ? 1u : 0u;
    }
    return count;
}

// The index of the n-th that counts, or how many slots there are; and how many that count come before it.
template <typename Slots, typename Counts>
std::uint32_t find_nth(const Slots& slots, std::uint32_t n, std::uint32_t& before, const Counts& counts) {
    before = 0;
    std::uint32_t index = 0;
    while (index < slots.size() && (!counts(slots[index]) || before != n)) {
        before += counts(slots[index]) ? 1u : 0u;
        ++index;
    }
    return index;
}

// Whether an id is of the slot's present occupant.
template <typename Slots, typename Id>
bool names_used(const Slots& slots, const Id& id) {
    return id.generation != 0 && id.index < slots.size() && slots[id.index].used &&
           slots[id.index].generation == id.generation;
}

} // namespace lks
