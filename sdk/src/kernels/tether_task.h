// Which of up to 64 particles may be further from an anchor than their tether to it is long: most are not.
// Plain data, as distance_task.h.
//
// Distances are taken from the upper 32 bits (2^-24 m) of differences, and lengths as two units shorter, so
// that an answer "no" is certain wherever a particle can be; who gets a "yes" is looked at closely.
#pragma once

#include <cstdint>

namespace lks {

struct TetherTask {
    const std::int64_t* positions[3];
    std::int64_t anchor[3];
    const std::uint32_t* lengths; // by particle, 24 fraction bits, at least 3
};

} // namespace lks
