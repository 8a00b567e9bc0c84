#include "solver/tethers.h"

#include <algorithm>
#include <bit>

#include "asset/build.h"
#include "kernels/distance_scalar.h"
#include "kernels/tether_scalar.h"

namespace lks {
namespace {

// 24 fraction bits: 256 times a tether's length at most.
constexpr int scale_bits = 24;
constexpr std::uint32_t tether_scale_one = std::uint32_t{1} << scale_bits;

// Two pins that are further apart than the cloth between them is long stretch it all alike: else the tether
// that comes last would get its length, and what is missing would open next to the other pin.
void give_way(const Array<TetherPair>& pairs, TetherAnchor* anchors) {
    for (const TetherPair& pair : pairs) {
        TetherAnchor& a = anchors[pair.a];
        TetherAnchor& b = anchors[pair.b];
        if (!a.active || !b.active) {
            continue;
        }
        // In units of a tether's length; a pair's is below 2^32.
        const std::uint64_t square = squared_distance(a.position, b.position).hi;
        if (square < pair.length * pair.length) {
            continue;
        }
        const std::uint64_t apart = std::uint64_t{fixed::square_root(square)} + 1;
        const std::uint64_t scale = (apart << scale_bits) / pair.length + 1;
        const auto bounded = static_cast<std::uint32_t>(std::min<std::uint64_t>(scale, UINT32_MAX));
        a.scale = std::max(a.scale, bounded);
        b.scale = std::max(b.scale, bounded);
    }
}

class Holding {
public:
    Holding(Object& object, const TetherAnchor* anchors, const Kernels& kernels)
        : object_(object), tethers_(object.asset().tethers), anchors_(anchors), kernels_(kernels),
          pinned_(object.pinned()), damping_(object.coefficients().tethers) {}

    // Particles of one group, those whose bits are set.
    void hold(std::uint32_t group, std::uint64_t wanted) {
        for (std::uint32_t i = tethers_.first_parts[group]; i < tethers_.first_parts[group + 1]; ++i) {
            const TetherPart& part = tethers_.parts[i];
            if (anchors_[part.anchor].active && (part.members & wanted) != 0) {
                hold(part, group * tether_group, part.members & wanted);
            }
        }
    }

private:
    // Fewer are faster asked after one by one.
    static constexpr int worth_a_kernel = 8;

    void hold(const TetherPart& part, std::uint32_t first, std::uint64_t members) {
        const TetherAnchor& anchor = anchors_[part.anchor];
        const std::uint32_t* lengths = tethers_.lengths.data() + std::size_t{part.row} * object_.count();
        if (std::popcount(members) >= worth_a_kernel) {
            const Coordinates& at = anchor.position;
            const TetherTask task{
                {object_.axis(0), object_.axis(1), object_.axis(2)}, {at.x, at.y, at.z}, lengths};
            // Of no particle before or behind them: another thread may be moving it.
            const auto before = static_cast<std::uint32_t>(std::countr_zero(members));
            const auto count = static_cast<std::uint32_t>(std::bit_width(members)) - before;
            members &= kernels_.beyond_tether(task, first + before, count) << before;
        }
        for (; members != 0; members &= members - 1) {
            const std::uint32_t particle = first + static_cast<std::uint32_t>(std::countr_zero(members));
            const Difference d = difference(particle, anchor.position);
            if (may_be_beyond(d.x, d.y, d.z, lengths[particle]) && !pinned_.contains(particle)) {
                pull(particle, d, lengths[particle], anchor);
            }
        }
    }

    Difference difference(std::uint32_t particle, const Coordinates& anchor) const {
        return {wrapping_subtract(object_.axis(0)[particle], anchor.x),
                wrapping_subtract(object_.axis(1)[particle], anchor.y),
                wrapping_subtract(object_.axis(2)[particle], anchor.z)};
    }

    // x += d·f, f = L/|d| − 1, where that is negative: the distance constraint's projection with all of the
    // mass at one end.
    void pull(std::uint32_t particle, const Difference& wide, std::uint32_t length,
              const TetherAnchor& anchor) {
        if (anchor.scale != tether_scale_one) {
            const std::uint64_t scaled = (std::uint64_t{length} * anchor.scale) >> scale_bits;
            length = static_cast<std::uint32_t>(std::min<std::uint64_t>(scaled + 1, no_tether));
        }
        if (fit_differences(wide) || length == no_tether) {
            return; // nearer than any tether is long
        }
        const NarrowDifference d = narrow_far(wide, 0);
        const std::uint64_t u = static_cast<std::uint64_t>(d.x * d.x) +
                                static_cast<std::uint64_t>(d.y * d.y) + static_cast<std::uint64_t>(d.z * d.z);
        const fixed::ReciprocalLength reciprocal = fixed::projection_reciprocal_length(u);
        std::int64_t f = rest_ratio(length, reciprocal.mantissa, d.extra - reciprocal.shift) - direction_one;
        if (f >= 0) {
            return;
        }
        if (damping_.damping_share != 0) {
            f = damped(f, relative_growth(d, start_difference(particle, anchor.start, d.extra), u,
                                          reciprocal.mantissa, reciprocal.shift));
        }
        const auto move = [&](std::int64_t* x, std::int64_t difference) {
            x[particle] = wrapping_add(x[particle],
                                       shift_either_way(difference * f, d.extra - direction_fraction_bits));
        };
        move(object_.axis(0), d.x);
        move(object_.axis(1), d.y);
        move(object_.axis(2), d.z);
    }

    // A tether stands for constraints that are damped: XPBD eq. 26, but that it is not moved further than to
    // its end. Undamped ones would be to the damping of the constraints a motion that neighbours have to
    // share.
    std::int64_t damped(std::int64_t f, std::int64_t growth) const {
        const auto error_share = static_cast<std::int64_t>(damping_.error_share);
        const auto damping_share = static_cast<std::int64_t>(damping_.damping_share);
        const std::int64_t wanted = error_share * f - damping_share * std::max<std::int64_t>(growth, 0);
        return std::max(f, shift_right_rounded(wanted, unit_fraction_bits));
    }

    // In units of 2^extra, within ±1.5·2^30: what d's products with it have room for beside u, and so much
    // that only what has moved by a third of its length is clamped.
    Difference start_difference(std::uint32_t particle, const Coordinates& anchor, int extra) const {
        constexpr std::int64_t most = std::int64_t{3} << 29;
        const auto narrow = [&](int axis, std::int64_t from) {
            const std::int64_t apart = wrapping_subtract(object_.start_axis(axis)[particle], from);
            return std::clamp(shift_right_rounded_any(apart, extra), -most, most);
        };
        return {narrow(0, anchor.x), narrow(1, anchor.y), narrow(2, anchor.z)};
    }

    Object& object_;
    const Tethers& tethers_;
    const TetherAnchor* anchors_;
    const Kernels& kernels_;
    PinnedParticles pinned_;
    const FamilyCoefficients& damping_;
};

} // namespace

bool place_tether_anchors(const Object& object, TetherAnchor* anchors) {
    const Tethers& tethers = object.asset().tethers;
    bool any = false;
    for (std::size_t i = 0; i < tethers.anchors.size(); ++i) {
        const std::uint32_t particle = tethers.anchors[i];
        const bool active = object.pinned().contains(particle);
        anchors[i] = {object.position(particle), object.start(particle), active, tether_scale_one};
        any = any || active;
    }
    if (any) {
        give_way(tethers.pairs, anchors);
    }
    return any;
}

void hold_by_tethers(Object& object, const TetherAnchor* anchors, const Kernels& kernels, std::uint32_t first,
                     std::uint32_t count) {
    Holding holding(object, anchors, kernels);
    const std::uint32_t end = first + count;
    while (first < end) {
        const std::uint32_t group = first / tether_group;
        const std::uint32_t stop = std::min(end, (group + 1) * tether_group);
        const std::uint64_t all = ~std::uint64_t{0} >> (tether_group - (stop - first));
        holding.hold(group, all << first % tether_group);
        first = stop;
    }
}

} // namespace lks
