// Which of up to 64 particles a collider may touch: the question that most particles leave with. Plain data,
// as distance_task.h.
//
// Coordinates are compared by their upper 32 bits (2^-24 m), rounded down, so that an answer "no" is certain
// and nothing can overflow; who gets a "yes" is looked at closely. So the answers need not be the same on all
// instruction sets, but what follows from them is.
#pragma once

#include <cstdint>

namespace lks {

struct BoxTask {
    const std::int64_t* positions[3];
    const std::int64_t* starts[3];
    // Upper 32 bits of the least and greatest coordinates at which there can be a contact.
    std::int32_t low[3];
    std::int32_t high[3];
};

struct PlaneTask {
    const std::int64_t* positions[3];
    std::int32_t normal[3]; // Direction
    // Above it when normal · (upper 32 bits of the position) is at least this.
    std::int64_t level;
};

} // namespace lks
