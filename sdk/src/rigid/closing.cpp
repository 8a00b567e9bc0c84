#include "rigid/closing.h"

#include <algorithm>

#include "collide/saturation.h"
#include "rigid/contact_points.h"
#include "rigid/contact_search.h"
#include "rigid/ways.h"

namespace lks {
namespace {

using fixed::Vec3;

// What a body's speed does not say of its way in this tick: beyond the limit of speeds where it is kinematic,
// and what it falls in a long tick.
Vec3 more_way(const lks_world& world, const Body& body, std::uint32_t index) {
    if (!body.is_dynamic()) {
        return saturating_subtract(way_in_tick(body, world.rate),
                                   way_in(body.velocity, world.rate.ticks_per_second));
    }
    const Vec3 fall = body.is_awake() ? fall_in_tick(world.rigid.ticks[index], world.rate) : Vec3{0, 0, 0};
    return sum_of_magnitudes(fall) > near_distance ? fall : Vec3{0, 0, 0};
}

} // namespace

PairClosing::PairClosing(const lks_world& world, const ContactKey& key, const Manifold& manifold)
    : rate_(world.rate), manifold_(manifold), a_(world.rigid.bodies[key.body_a]),
      b_(other_body(world.rigid, key.other)) {
    const Vec3 more = saturating_subtract(more_way(world, b_, key.other), more_way(world, a_, key.body_a));
    more_ = -fixed::dot(manifold.normal, more);
}

std::int64_t PairClosing::at(const ManifoldPoint& point) const {
    const Vec3 between = saturating_subtract(b_.position, a_.position);
    const Levers levers{point.core_a, saturating_subtract(point.core_b, between)};
    return fixed::saturating_add(
        per_tick(closing_speed(manifold_.normal, levers, {a_.speeds(), b_.speeds()}), rate_), more_);
}

Closing PairClosing::greatest() const {
    Closing greatest{INT64_MIN, 0};
    for (std::uint32_t i = 0; i < manifold_.count; ++i) {
        const ManifoldPoint& point = manifold_.points[i];
        const std::int64_t speed = at(point);
        const std::int64_t way =
            fixed::saturating_subtract(speed, std::max<std::int64_t>(point.separation, 0));
        greatest = way > greatest.way ? Closing{way, speed} : greatest;
    }
    return greatest;
}

std::int64_t least_gap(const Manifold& manifold) {
    std::int64_t gap = LKS_FIXED(64);
    for (std::uint32_t i = 0; i < manifold.count; ++i) {
        gap = std::min(gap, manifold.points[i].separation);
    }
    return std::max<std::int64_t>(gap, 0);
}

} // namespace lks
