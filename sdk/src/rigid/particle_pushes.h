// What the particles of one object push on one body in a tick, for events.
#pragma once

#include <cstdint>

#include "fixed/vector.h"

namespace lks {

struct ParticlePushes {
    std::int64_t impulse;    // World N·s, of all together
    std::int64_t most;       // of one particle in one substep
    fixed::Vec3 place;       // World: where that was put
    fixed::Direction normal; // out of the body, there
};

} // namespace lks
