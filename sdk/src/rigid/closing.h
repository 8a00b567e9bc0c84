// How far two that may touch come closer in a tick.
#pragma once

#include "collide/manifold.h"
#include "rigid/contact.h"
#include "rigid/strikes.h"
#include "solver/world.h"

namespace lks {

// Along the normal of their manifold, by what they are doing where the tick begins.
class PairClosing {
public:
    PairClosing(const lks_world& world, const ContactKey& key, const Manifold& manifold);

    // There: what topples comes by its spin.
    std::int64_t at(const ManifoldPoint& point) const;
    // Of the point where that is more than the gap by the most; of at least one.
    Closing greatest() const;

private:
    const StepRate& rate_;
    const Manifold& manifold_;
    const Body& a_;
    const Body& b_;
    std::int64_t more_; // than their speeds say
};

// Zero where they overlap; of no points any.
std::int64_t least_gap(const Manifold& manifold);

} // namespace lks
