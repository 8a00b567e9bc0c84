// Wind on a cloth, as a game would write it: a force on every triangle along its normal, in integers.
#pragma once

#include <lockstitch/lockstitch.h>

#include <cstdint>
#include <vector>

namespace lks_demo {

// Blows along +x with gusts, and swings sideways in waves that travel with it: what makes a flag flutter.
class Wind {
public:
    Wind() = default;
    // `pressure` is the impulse in N·s that a square metre of cloth takes in one second for each m/s of the
    // air's speed relative to it, along its normal.
    Wind(lks_fixed pressure, const lks_asset* asset);

    // The impulses of one tick. Places are measured from `origin`.
    lks_result blow(lks_world* world, lks_object_id object, lks_fixed seconds, lks_vec3 origin);

private:
    lks_vec3 air_at(lks_vec3 place, lks_fixed seconds) const;
    void push_triangle(const std::uint32_t* corners, lks_fixed seconds, lks_vec3 origin,
                       std::int64_t tick_rate);

    lks_fixed pressure_ = 0;
    std::vector<std::uint32_t> triangles_;
    std::vector<lks_vec3> positions_;
    std::vector<lks_vec3> velocities_;
    std::vector<lks_vec3> impulses_;
};

} // namespace lks_demo
