// Rays and distances against everything in a world (lockstitch/query.h).
#pragma once

#include <lockstitch/query.h>

#include "solver/world.h"

namespace lks {

// The first `capacity` hits in their order, and how many there were.
class HitList {
public:
    // `nearest_first`: by distance, else by what is hit.
    HitList(lks_hit* hits, std::uint32_t capacity, bool nearest_first)
        : hits_(hits), capacity_(capacity), nearest_first_(nearest_first) {}

    void add(const lks_hit& hit);
    // Behind the last: puts them in their order. How many there were.
    std::uint32_t finish();

private:
    bool before(const lks_hit& a, const lks_hit& b) const;

    lks_hit* hits_;
    std::uint32_t capacity_;
    bool nearest_first_;
    std::uint32_t count_ = 0;
};

// Checked arguments.
void cast_ball(const lks_world& world, const lks_query& query, const fixed::Vec3& from, const fixed::Vec3& to,
               HitList& hits);
void find_within(const lks_world& world, const lks_query& query, const fixed::Vec3& centre, HitList& hits);

} // namespace lks
