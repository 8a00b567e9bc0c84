#include "solver/chain.h"

#include <algorithm>
#include <bit>

#include "fixed/formats.h"
#include "fixed/int128.h"
#include "fixed/reciprocal_sqrt.h"
#include "fixed/vector.h"
#include "kernels/measure_segment.h"
#include "solver/wrapping.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::multiply_shift;
using fixed::multiply_unsigned;
using fixed::Vec3;

constexpr std::int64_t cosine_one = std::int64_t{1} << cosine_fraction_bits;
// κ up to this is stable by itself.
constexpr std::uint64_t stable_stiffness = unit_one / 4;
constexpr std::uint64_t greatest_stiffness = std::uint64_t{1} << 60;
// In every row, so that none is singular between two pins: it yields by 1.5e-11 of a multiplier.
constexpr std::uint64_t least_softness = std::uint64_t{1} << (chain_share_bits - 36);
// From here on a rope bears to be pulled apart by its pins: it is elastic.
constexpr std::uint64_t elastic_softness = std::uint64_t{1} << (chain_share_bits - 20);
// Of factors on rest lengths.
constexpr int rest_bits = 40;
constexpr std::uint64_t rest_one = std::uint64_t{1} << rest_bits;
constexpr std::uint64_t greatest_rest = std::uint64_t{1} << 62;
// How much longer than the distance of its pins a piece of rope is taken to be at least.
constexpr std::uint64_t least_slack = rest_one >> 24;
// What a multiplier may be raised by for the upper half of its product.
constexpr std::int64_t multiplier_room = std::int64_t{1} << (64 - chain_share_bits);
// Where a segment's ends moved against each other by more than 2^-turn_shift of its length, or the second
// pass changed its length by more than 2^-error_shift, the rope is solved again from where it is then.
constexpr int turn_shift = 5;
constexpr int error_shift = 11;
constexpr int most_solves = 8;
// Where a rope folds back by more than 176 degrees there is no "along".
constexpr std::uint32_t least_tangent = direction_one / 1024;

// 2^126 / m where m has its top bit set: 2^62 .. 2^63, with a relative error of 2^-59.
std::uint64_t reciprocal_of(std::uint64_t m) {
    const std::uint64_t y = fixed::reciprocal_mantissa(static_cast<std::uint32_t>(m >> 32));
    // 1 − m·y as a share of 2^93: below 2^63, so that the product's low half has it all.
    const std::int64_t error = static_cast<std::int64_t>(0 - (m >> 1) * y) >> 32;
    return (y << 32) + static_cast<std::uint64_t>((error * static_cast<std::int64_t>(y)) >> 29);
}

// a·b / 2^bits, rounded down; 0 < bits < 64. From the halves by hand: compilers keep those of a shifted
// structure in memory.
std::uint64_t share_of(std::uint64_t a, std::uint64_t b, int bits) {
    const fixed::UInt128 product = multiply_unsigned(a, b);
    return (product.hi << (64 - bits)) + (product.lo >> bits);
}

// The same, where the result has 63 bits at most.
std::int64_t share_of(std::int64_t a, std::int64_t b, int bits) {
    const fixed::Int128 product = fixed::multiply_signed(a, b);
    return static_cast<std::int64_t>((static_cast<std::uint64_t>(product.hi) << (64 - bits)) +
                                     (product.lo >> bits));
}

// Rounded down. In two parts, of which the upper one is whole: cheaper than a product of 128 bits.
std::int64_t unit_share(std::uint32_t unit, std::int64_t value) {
    const std::int64_t upper = fixed::wrapping_multiply(value >> unit_fraction_bits, unit);
    const std::int64_t lower = value & (std::int64_t{unit_one} - 1);
    return wrapping_add(upper, (lower * unit) >> unit_fraction_bits);
}

Vec3 unit_share(std::uint32_t unit, const Vec3& v) {
    return {unit_share(unit, v.x), unit_share(unit, v.y), unit_share(unit, v.z)};
}

class ChainSolve {
public:
    ChainSolve(const ChainCoefficients& chain, const FamilyCoefficients& family, const DistanceArrays& arrays,
               const Kernels& kernels, ChainWork* work, bool torn)
        : chain_(chain), family_(family), arrays_(arrays), kernels_(kernels), work_(work), torn_(torn),
          eased_(arrays.multipliers != nullptr && chain.softness != 0),
          softness_(std::max(chain.softness, least_softness)),
          count_(static_cast<std::uint32_t>(chain.segments.size())),
          movement_down_(chain.weight_exponent - chain.multiplier_exponent) {}

    // `again`: after itself, in the same substep.
    bool run(bool again) {
        off_ = false;
        const bool simple = !torn_ && !eased_ && family_.damping_share == 0 && chain_.pinned_count < 2;
        if (!(simple ? eliminate<true>() : eliminate<false>())) {
            return false;
        }
        const bool stiff =
            arrays_.multipliers != nullptr ? substitute<true>(again) : substitute<false>(again);
        if (!stiff) {
            each_movement([&](std::uint32_t i, const Vec3& v) { move(i, v); });
            return true;
        }
        each_movement([&](std::uint32_t i, const Vec3& v) { work_[i].movement = v; });
        gather();
        if (chain_.pinned_count != 0) {
            spread_and_move<true>();
        } else {
            spread_and_move<false>();
        }
        return true;
    }

    // Tensions were implicit, and a segment was left off its length.
    bool is_off() const { return off_; }

private:
    Vec3 position(std::uint32_t index) const {
        const std::uint32_t p = chain_.particles[index].particle;
        return {arrays_.x[p], arrays_.y[p], arrays_.z[p]};
    }
    Vec3 start(std::uint32_t index) const {
        const std::uint32_t p = chain_.particles[index].particle;
        return {arrays_.start_x[p], arrays_.start_y[p], arrays_.start_z[p]};
    }
    // w/R
    std::uint64_t weight(std::uint32_t index) const {
        return chain_.particles[index].weight >> chain_.weight_exponent;
    }

    // Of the row behind the one at hand.
    struct Row {
        std::uint64_t share;      // x
        std::uint64_t sum;        // t + σ
        std::int64_t change;      // its right side
        std::uint64_t far_weight; // of the particle between them
        bool directed;
    };

    // The rows from the far end to the near one. False: a segment is torn. `simple`: neither that nor
    // multipliers, damping or two pins need be looked at.
    template <bool simple>
    bool eliminate() {
        ChainSegments segments;
        Row behind{0, 0, 0, weight(count_), false};
        Direction next{};
        for (std::uint32_t last = count_; last > 0;) {
            segments.count = std::min(last, chain_block);
            const std::uint32_t first = last - segments.count;
            take_points(segments, first);
            segments.directions[0][segments.count] = next.x;
            segments.directions[1][segments.count] = next.y;
            segments.directions[2][segments.count] = next.z;
            kernels_.measure_chain(segments);
            if (!eliminate_rows<simple>(segments, first, behind)) {
                return false;
            }
            next = work_[first].direction;
            last = first;
        }
        work_[0].carried = 0;
        return true;
    }

    void take_points(ChainSegments& segments, std::uint32_t first) const {
        const ChainParticle* const particles = chain_.particles.data() + first;
        const std::int64_t* const x = arrays_.x;
        const std::int64_t* const y = arrays_.y;
        const std::int64_t* const z = arrays_.z;
        const std::uint32_t count = segments.count;
        for (std::uint32_t i = 0; i <= count; ++i) {
            const std::uint32_t p = particles[i].particle;
            segments.points[0][i] = x[p];
            segments.points[1][i] = y[p];
            segments.points[2][i] = z[p];
        }
    }

    static Direction direction_of(const ChainSegments& segments, std::uint32_t i) {
        return {static_cast<std::int32_t>(segments.directions[0][i]),
                static_cast<std::int32_t>(segments.directions[1][i]),
                static_cast<std::int32_t>(segments.directions[2][i])};
    }

    template <bool simple>
    bool eliminate_rows(const ChainSegments& segments, std::uint32_t first, Row& behind) {
        // All by value: what is written to `work_` can't be thought to change it.
        const int weight_exponent = chain_.weight_exponent;
        const int multiplier_exponent = chain_.multiplier_exponent;
        const std::uint64_t softness = softness_;
        const bool torn = torn_;
        const ChainSegment* const coefficients = chain_.segments.data() + first;
        const ChainParticle* const particles = chain_.particles.data() + first;
        ChainWork* const work = work_ + first;
        Row row = behind;
        bool last = first + segments.count == count_;
        for (std::uint32_t i = segments.count; i-- > 0;) {
            const std::int64_t length = segments.lengths[i];
            const bool directed = length != 0;
            std::int64_t rest = coefficients[i].rest_length;
            if constexpr (!simple) {
                if (chain_.pinned_count > 1 && row.far_weight == 0) {
                    taut_ = tautness(first + i);
                }
                rest = rest_length(first + i);
            }
            // Neither is negative.
            if ((simple || !torn) && length - rest > coefficients[i].slack) {
                return false; // torn
            }
            std::int64_t change = 0;
            if (directed) {
                change = simple ? wanted_length_change(length, rest, substep_motion_limit)
                                : wanted_change(first + i, rest, {direction_of(segments, i), length});
            }
            std::uint64_t sum = row.far_weight + softness;
            if (!last) {
                const Turn turn =
                    directed && row.directed ? turn_by(segments.versines[i]) : Turn{0, cosine_one};
                // x is below one by the least softness: its product's upper half is the whole shift.
                sum = multiply_unsigned(row.share << (64 - chain_share_bits),
                                        row.sum +
                                            share_of(row.far_weight, turn.sine_squared, cosine_fraction_bits))
                          .hi +
                      softness;
                const std::int64_t carried =
                    share_of(turn.cosine, static_cast<std::int64_t>(row.share), cosine_fraction_bits);
                work[i + 1].carried = carried;
                change = fixed::saturating_add(change, share_of(carried, row.change, chain_share_bits));
            }
            last = false;
            const std::uint64_t near_weight = particles[i].weight >> weight_exponent;
            const std::uint64_t diagonal = near_weight + sum;
            const int up = std::countl_zero(diagonal);
            const std::uint64_t reciprocal = reciprocal_of(diagonal << up);
            work[i].own = directed ? quotient_of(change, reciprocal, multiplier_exponent - up) : 0;
            work[i].direction = direction_of(segments, i);
            row = {multiply_unsigned(near_weight << up, reciprocal).hi, sum, change, near_weight, directed};
        }
        behind = row;
        return true;
    }

    std::int64_t rest_length(std::uint32_t index) const {
        const std::int64_t rest = chain_.segments[index].rest_length;
        return taut_ == rest_one ? rest : multiply_shift(rest, static_cast<std::int64_t>(taut_), rest_bits);
    }

    // Of the piece whose last segment this is, between two pins or one and the near end. Pins that are
    // further apart than it is long stretch all its segments alike; there is no solution, and a multiplier
    // without end, otherwise.
    std::uint64_t tautness(std::uint32_t last) const {
        // In units of which the sum of all segments fits.
        constexpr int down = 16;
        std::uint32_t first = last;
        auto length = static_cast<std::uint64_t>(chain_.segments[last].rest_length >> down);
        while (first > 0 && chain_.particles[first].weight != 0) {
            --first;
            length += static_cast<std::uint64_t>(chain_.segments[first].rest_length >> down);
        }
        fixed::NormalisedVector pins{};
        if (chain_.particles[first].weight != 0 || chain_.softness > elastic_softness ||
            !measure_segment(position(last + 1) - position(first), pins)) {
            return rest_one;
        }
        const auto apart = static_cast<std::uint64_t>(pins.length >> down);
        const fixed::UInt128 quotient =
            fixed::divide(fixed::UInt128{0, apart} << rest_bits, std::max<std::uint64_t>(length, 1)).quotient;
        const std::uint64_t ratio = std::min(fixed::saturate_to_uint64(quotient), greatest_rest);
        return std::max(rest_one, ratio + least_slack);
    }

    // A change over a diagonal, as a multiplier.
    static std::int64_t quotient_of(std::int64_t change, std::uint64_t reciprocal, int down) {
        // 2^63 at most.
        const auto factor = static_cast<std::int64_t>(reciprocal - (reciprocal >> 63));
        return bounded_multiplier(down >= 0 ? fixed::multiply_signed(change, factor).hi >> down
                                            : multiply_shift(change, factor, 64 + down));
    }

    // Between two segments that follow each other, 60 fraction bits.
    struct Turn {
        std::int64_t cosine;
        std::uint64_t sine_squared;
    };

    static Turn turn_by(std::int64_t versine) {
        return {cosine_one - versine,
                share_of(static_cast<std::uint64_t>(versine),
                         static_cast<std::uint64_t>(2 * cosine_one - versine), cosine_fraction_bits)};
    }

    // It may double or close, no more, and by no more than the limit.
    static std::int64_t wanted_length_change(std::int64_t length, std::int64_t rest, std::int64_t limit) {
        const std::int64_t change = rest - length;
        if (change <= length && length <= limit) {
            return change; // it is not below −length
        }
        const std::int64_t most = std::min(length, limit);
        return std::clamp(change, -most, most);
    }

    // −c·C − σ·λ − γ'·n·(motion): how much longer the segment is to become, by no more than particles move in
    // a substep.
    std::int64_t wanted_change(std::uint32_t index, std::int64_t rest,
                               const fixed::NormalisedVector& n) const {
        const ChainSegment& segment = chain_.segments[index];
        const std::int64_t limit =
            torn_ ? std::min(segment.slack / 2, substep_motion_limit) : substep_motion_limit;
        std::int64_t change = wanted_length_change(n.length, rest, limit);
        if (family_.damping_share != 0) {
            const Vec3 motion = (position(index + 1) - start(index + 1)) - (position(index) - start(index));
            const auto bounded = [](std::int64_t v) {
                return std::clamp(v, -coordinate_limit, coordinate_limit);
            };
            const std::int64_t most = std::min(n.length, limit);
            const std::int64_t along =
                fixed::dot(n.direction, Vec3{bounded(motion.x), bounded(motion.y), bounded(motion.z)});
            change = unit_share(family_.error_share, change) -
                     unit_share(family_.damping_share, std::clamp(along, -most, most));
        }
        if (eased_) {
            const int up = chain_.multiplier_exponent;
            const std::int64_t greatest = coordinate_limit >> up;
            const std::int64_t eased =
                multiply_shift(static_cast<std::int64_t>(chain_.softness),
                               arrays_.multipliers[segment.constraint], chain_share_bits);
            change -= std::clamp(eased, -greatest, greatest) * (std::int64_t{1} << up);
        }
        return change;
    }

    // Multipliers from the near end to the far one. Whether any tension is more than a chain stands by
    // itself.
    template <bool carried>
    bool substitute(bool again) {
        const std::uint32_t count = count_;
        const ChainSegment* const segments = chain_.segments.data();
        ChainWork* const work = work_;
        std::int64_t multiplier = 0;
        std::uint64_t stiff = 0;
        for (std::uint32_t j = 0; j < count; ++j) {
            ChainWork& w = work[j];
            multiplier = bounded_multiplier(
                w.own + fixed::multiply_signed(w.carried, multiplier * multiplier_room).hi);
            w.own = multiplier;
            w.tension =
                carried || !again ? multiplier : bounded_multiplier(saturating_add(w.tension, multiplier));
            w.stiffness = stiffness<carried>(segments[j], w.tension);
            stiff |= w.stiffness;
        }
        work[count].give = 0;
        work[count].stiffness = 0;
        work[count].direction = {};
        return stiff != 0;
    }

    // How the particles move by the multipliers.
    template <typename Use>
    void each_movement(const Use& use) const {
        const std::uint32_t count = count_;
        const ChainParticle* const particles = chain_.particles.data();
        const ChainWork* const work = work_;
        const int down = movement_down_;
        Vec3 pushed{};
        for (std::uint32_t j = 0; j < count; ++j) {
            const std::int64_t multiplier = work[j].own * multiplier_room;
            const auto along = [multiplier](std::int32_t c) {
                return fixed::multiply_signed(std::int64_t{c} * (std::int64_t{1} << 32), multiplier).hi;
            };
            const Direction& n = work[j].direction;
            const Vec3 push{along(n.x), along(n.y), along(n.z)};
            use(j, movement(particles[j].weight, pushed - push, down));
            pushed = push;
        }
        use(count, movement(particles[count].weight, pushed, down));
    }

    // To the nearest coordinate unit, and no more than particles move in a substep.
    static Vec3 movement(std::uint64_t weight, const Vec3& push, int down) {
        const auto share = [weight](std::int64_t p) {
            const fixed::Int128 product = fixed::multiply_signed(static_cast<std::int64_t>(weight), p);
            return static_cast<std::int64_t>(
                (static_cast<std::uint64_t>(product.hi) << (64 - chain_share_bits)) +
                (((product.lo >> (chain_share_bits - 1)) + 1) >> 1));
        };
        const Vec3 shares{share(push.x), share(push.y), share(push.z)};
        if (down > 0) {
            const auto moved = [down](std::int64_t s) {
                return std::clamp(fixed::shift_right_rounded(s, down), -substep_motion_limit,
                                  substep_motion_limit);
            };
            return {moved(shares.x), moved(shares.y), moved(shares.z)};
        }
        const std::int64_t limit = substep_motion_limit >> -down;
        const std::int64_t unit = std::int64_t{1} << -down;
        if (within(shares, limit)) {
            return {shares.x * unit, shares.y * unit, shares.z * unit};
        }
        const auto moved = [limit, unit](std::int64_t s) { return std::clamp(s, -limit, limit) * unit; };
        return {moved(shares.x), moved(shares.y), moved(shares.z)};
    }

    // Rarely not: one comparison that is foretold is cheaper than two and two choices.
    static bool within(std::int64_t value, std::int64_t limit) {
        return static_cast<std::uint64_t>(value) + static_cast<std::uint64_t>(limit) <=
               2 * static_cast<std::uint64_t>(limit);
    }

    static bool within(const Vec3& v, std::int64_t limit) {
        return within(v.x, limit) && within(v.y, limit) && within(v.z, limit);
    }

    // Its products by shares and by directions fit.
    static std::int64_t bounded_multiplier(std::int64_t value) {
        constexpr std::int64_t limit = (std::int64_t{1} << 61) - 1;
        return within(value, limit) ? value : std::clamp(value, -limit, limit);
    }

    // What κ exceeds the stable one by; adds the change to the multiplier that is carried.
    template <bool carried>
    std::uint64_t stiffness(const ChainSegment& segment, std::int64_t change) const {
        std::int64_t multiplier = change;
        if constexpr (carried) {
            std::int64_t& sum = arrays_.multipliers[segment.constraint];
            sum = bounded_multiplier(saturating_add(sum, change));
            multiplier = sum;
        }
        const std::uint64_t high =
            multiply_unsigned(fixed::magnitude(multiplier), segment.stiffness_mantissa).hi;
        const int down = segment.stiffness_shift;
        const std::uint64_t kappa = down >= 0                              ? high >> down
                                    : high > (greatest_stiffness >> -down) ? greatest_stiffness
                                                                           : high << -down;
        return kappa <= stable_stiffness ? 0 : std::min(kappa, greatest_stiffness) - stable_stiffness;
    }

    // The top 32 bits of a number.
    struct Mantissa {
        std::uint64_t value;
        int up;
    };
    static Mantissa mantissa_of(std::uint64_t v) {
        const int up = std::countl_zero(v);
        return {(v << up) >> 32, up};
    }

    struct Shares {
        std::uint32_t far;  // far / (1 + far)
        std::uint32_t near; // near / (1 + near + far)
    };

    // Both by one reciprocal, of the product of what they are divided by.
    static Shares shares_of(std::uint64_t near, std::uint64_t far) {
        const Mantissa a = mantissa_of(unit_one + far);
        const Mantissa b = mantissa_of(unit_one + near + far);
        const Mantissa both = mantissa_of(a.value * b.value);
        const std::uint64_t reciprocal = fixed::reciprocal_mantissa(static_cast<std::uint32_t>(both.value));
        // a·b / 2^(32 − up) times it is 2^62: 1/a is b·reciprocal, and the other way round.
        const auto share = [&](std::uint64_t v, const Mantissa& own, const Mantissa& other) {
            const std::uint64_t inverse =
                (other.value * reciprocal >> (31 - both.up)); // 2^63 / own, 31 .. 32 bits
            return static_cast<std::uint32_t>(
                std::min<std::uint64_t>(((v << own.up) >> 32) * inverse >> 32, unit_one));
        };
        return {share(far, a, b), share(near, b, a)};
    }

    // The mean of what a particle and all behind it would do, from the far end to the near one.
    void gather() {
        work_[count_].gathered = work_[count_].movement;
        std::uint32_t lightness = unit_one; // of a particle with what is behind, of its own inverse mass
        for (std::uint32_t j = count_; j-- > 0;) {
            ChainWork& w = work_[j];
            if (w.stiffness == 0) {
                w.give = 0;
                w.gathered = w.movement;
                lightness = unit_one;
                continue;
            }
            const ChainSegment& segment = chain_.segments[j];
            const std::uint64_t near = share_of(w.stiffness, segment.near_share, unit_fraction_bits);
            const std::uint64_t far = share_of(share_of(w.stiffness, segment.far_share, unit_fraction_bits),
                                               lightness, unit_fraction_bits);
            const Shares shares = shares_of(near, far);
            w.give = shares.far;
            w.gathered = w.movement + unit_share(shares.near, work_[j + 1].gathered - w.movement);
            lightness = unit_one - shares.near;
        }
    }

    // What each does with all that is before it; of the change, what is across the rope. Without pins the
    // mean of the changes is taken off again.
    template <bool pinned>
    void spread_and_move() {
        Vec3 mean{};
        Vec3 near{};
        Vec3 near_movement{};
        Vec3 near_across{};
        bool off = false;
        std::uint32_t give = 0; // of the segment before
        bool stiff_before = false;
        for (std::uint32_t i = 0; i <= count_; ++i) {
            ChainWork& w = work_[i];
            Vec3 here = w.gathered;
            if (give != 0) {
                here = here + unit_share(give, near - here);
            }
            const bool stiff = w.stiffness != 0;
            Vec3 movement = w.movement;
            Vec3 across{};
            if (stiff || stiff_before) {
                across = across_rope(i, here - movement);
                movement = movement + across;
                if constexpr (!pinned) {
                    const auto share = static_cast<std::int64_t>(chain_.particles[i].mass_share);
                    mean =
                        mean + Vec3{multiply_shift(share, across.x, 63), multiply_shift(share, across.y, 63),
                                    multiply_shift(share, across.z, 63)};
                }
            }
            if constexpr (pinned) {
                move(i, movement);
            } else {
                w.movement = movement;
            }
            if (i > 0) {
                off |= is_left_off(i - 1, movement - near_movement, across - near_across);
            }
            near_movement = movement;
            near_across = across;
            near = here;
            give = w.give;
            stiff_before = stiff;
        }
        if constexpr (!pinned) {
            for (std::uint32_t i = 0; i <= count_; ++i) {
                move(i, work_[i].movement - mean);
            }
        }
        off_ = off;
    }

    // By how its ends moved against each other, and by what of that the second pass changed.
    bool is_left_off(std::uint32_t index, const Vec3& apart, const Vec3& changed) const {
        const std::int64_t rest = chain_.segments[index].rest_length;
        if (!within(apart, rest >> turn_shift)) {
            return true;
        }
        const std::int64_t limit = rest >> error_shift;
        if (within(changed, limit >> 1)) {
            return false; // in any direction
        }
        const Direction& n = work_[index].direction;
        return !within(direction_share(n.x, changed.x) + direction_share(n.y, changed.y) +
                           direction_share(n.z, changed.z),
                       limit);
    }

    Vec3 across_rope(std::uint32_t index, const Vec3& v) const {
        const Direction a = index == 0 ? Direction{} : work_[index - 1].direction;
        const Direction b = index == count_ ? Direction{} : work_[index].direction;
        const std::int64_t x = (std::int64_t{a.x} + b.x) >> 1;
        const std::int64_t y = (std::int64_t{a.y} + b.y) >> 1;
        const std::int64_t z = (std::int64_t{a.z} + b.z) >> 1;
        const auto squared = static_cast<std::uint32_t>((x * x + y * y + z * z) >> direction_fraction_bits);
        if (squared < least_tangent) {
            return v;
        }
        const int up = std::countl_zero(squared);
        const std::int64_t reciprocal = fixed::reciprocal_mantissa(squared << up);
        const std::int64_t along =
            direction_share(x, v.x) + direction_share(y, v.y) + direction_share(z, v.z);
        const auto rest = [&](std::int64_t c, std::int64_t from) {
            return from - direction_share(c * reciprocal >> (32 - up), along);
        };
        return {rest(x, v.x), rest(y, v.y), rest(z, v.z)};
    }

    static std::int64_t direction_share(std::int64_t direction, std::int64_t value) {
        return share_of(direction, value, direction_fraction_bits);
    }

    void move(std::uint32_t index, const Vec3& v) const {
        const std::uint32_t p = chain_.particles[index].particle;
        arrays_.x[p] = wrapping_add(arrays_.x[p], v.x);
        arrays_.y[p] = wrapping_add(arrays_.y[p], v.y);
        arrays_.z[p] = wrapping_add(arrays_.z[p], v.z);
    }

    const ChainCoefficients& chain_;
    const FamilyCoefficients& family_;
    DistanceArrays arrays_;
    const Kernels& kernels_;
    ChainWork* work_;
    bool torn_;
    bool eased_; // multipliers so far count
    bool off_ = false;
    std::uint64_t softness_;
    std::uint64_t taut_ = rest_one; // what rest lengths are multiplied by in the piece at hand
    std::uint32_t count_;
    int movement_down_;
};

} // namespace

bool solve_chain(const ChainCoefficients& chain, const FamilyCoefficients& family,
                 const DistanceArrays& arrays, const Kernels& kernels, ChainWork* work) {
    ChainSolve solve(chain, family, arrays, kernels, work, false);
    if (!solve.run(false)) {
        return false;
    }
    for (int solved = 1; solved < most_solves && solve.is_off() && solve.run(true); ++solved) {}
    return true;
}

void mend_chain(const ChainCoefficients& chain, const FamilyCoefficients& family,
                const DistanceArrays& arrays, const Kernels& kernels, ChainWork* work) {
    static_cast<void>(ChainSolve(chain, family, arrays, kernels, work, true).run(false));
}

} // namespace lks
