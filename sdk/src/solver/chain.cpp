#include "solver/chain.h"

#include <algorithm>
#include <bit>

#include "fixed/formats.h"
#include "fixed/int128.h"
#include "fixed/reciprocal_sqrt.h"
#include "fixed/vector.h"
#include "solver/wrapping.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::multiply_shift;
using fixed::multiply_unsigned;
using fixed::Vec3;

constexpr int cosine_bits = 2 * direction_fraction_bits;
constexpr std::int64_t cosine_one = std::int64_t{1} << cosine_bits;
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
// Where a rope folds back by more than 176 degrees there is no "along".
constexpr std::uint32_t least_tangent = direction_one / 1024;

// 2^126 / m where m has its top bit set: 2^62 .. 2^63, with a relative error of 2^-59.
std::uint64_t reciprocal_of(std::uint64_t m) {
    const std::uint64_t y = fixed::reciprocal_mantissa(static_cast<std::uint32_t>(m >> 32));
    // 1 − m·y as a share of 2^93: below 2^63, so that the product's low half has it all.
    const std::int64_t error = static_cast<std::int64_t>(0 - (m >> 1) * y) >> 32;
    return (y << 32) + static_cast<std::uint64_t>((error * static_cast<std::int64_t>(y)) >> 29);
}

// a·b / 2^bits, rounded down.
std::uint64_t share_of(std::uint64_t a, std::uint64_t b, int bits) {
    return (multiply_unsigned(a, b) >> bits).lo;
}

// The same, where the result has 63 bits at most.
std::int64_t share_of(std::int64_t a, std::int64_t b, int bits) {
    return static_cast<std::int64_t>((fixed::multiply_signed(a, b) >> bits).lo);
}

std::int64_t unit_share(std::uint32_t unit, std::int64_t value) {
    return share_of(value, std::int64_t{unit}, unit_fraction_bits);
}

Vec3 unit_share(std::uint32_t unit, const Vec3& v) {
    return {unit_share(unit, v.x), unit_share(unit, v.y), unit_share(unit, v.z)};
}

// The direction and the length of a segment; false where it has none.
bool measure(const Vec3& d, fixed::NormalisedVector& out) {
    const auto size = [](std::int64_t v) { return static_cast<std::uint64_t>(v ^ (v >> 63)); };
    const int shift = 33 - std::countl_zero(size(d.x) | size(d.y) | size(d.z));
    // From 0.1 µm to 16 m; what is not is rare.
    if (shift < 1 || shift > 29) {
        return fixed::normalise(d, out);
    }
    const auto narrow = [shift](std::int64_t v) { return (v + (std::int64_t{1} << (shift - 1))) >> shift; };
    const std::int64_t x = narrow(d.x);
    const std::int64_t y = narrow(d.y);
    const std::int64_t z = narrow(d.z);
    // From 2^60 to 3·2^62.
    const std::uint64_t squared = static_cast<std::uint64_t>(x * x) + static_cast<std::uint64_t>(y * y) +
                                  static_cast<std::uint64_t>(z * z);
    const int up = std::countl_zero(squared) >> 1;
    const std::uint64_t m = squared << (2 * up);
    const std::uint64_t reciprocal = fixed::reciprocal_sqrt_mantissa(static_cast<std::uint32_t>(m >> 32));
    const auto component = [&](std::int64_t v) {
        return static_cast<std::int32_t>(
            (v * static_cast<std::int64_t>(reciprocal) + (std::int64_t{1} << (31 - up))) >> (32 - up));
    };
    out.direction = {component(x), component(y), component(z)};
    const std::uint64_t root = multiply_unsigned(m, reciprocal << 32).hi;
    out.length =
        static_cast<std::int64_t>((root + (std::uint64_t{1} << (29 + up - shift))) >> (30 + up - shift));
    return true;
}

class ChainSolve {
public:
    ChainSolve(const ChainCoefficients& chain, const FamilyCoefficients& family, const DistanceArrays& arrays,
               ChainWork* work, bool torn)
        : chain_(chain), family_(family), arrays_(arrays), work_(work), torn_(torn),
          softness_(std::max(chain.softness, least_softness)),
          count_(static_cast<std::uint32_t>(chain.segments.size())),
          movement_down_(chain.weight_exponent - chain.multiplier_exponent) {}

    bool run() {
        if (!eliminate()) {
            return false;
        }
        if (substitute()) {
            gather();
            spread();
            keep_across();
        }
        move();
        return true;
    }

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

    // The rows from the far end to the near one. False: a segment is torn.
    bool eliminate() {
        // Of the row behind: its direction, x, t + σ, and its right side.
        Direction next{};
        bool next_directed = false;
        std::uint64_t share = 0;
        std::uint64_t next_sum = 0;
        std::int64_t next_change = 0;
        std::uint64_t far_weight = weight(count_);
        Vec3 far = position(count_);
        for (std::uint32_t j = count_; j-- > 0;) {
            const Vec3 near = position(j);
            fixed::NormalisedVector n{};
            const bool directed = measure(far - near, n);
            if (chain_.pinned_count > 1 && far_weight == 0) {
                taut_ = tautness(j);
            }
            const std::int64_t rest = rest_length(j);
            if (!torn_ && n.length > rest && n.length - rest > chain_.segments[j].slack) {
                return false; // torn
            }
            std::uint64_t behind = far_weight;
            std::int64_t change = directed ? wanted_change(j, rest, n) : 0;
            if (j + 1 < count_) {
                const Turn turn =
                    directed && next_directed ? turn_between(n.direction, next) : Turn{0, cosine_one};
                behind = share_of(share, next_sum + share_of(far_weight, turn.sine_squared, cosine_bits),
                                  chain_share_bits);
                const std::int64_t carried =
                    share_of(turn.cosine, static_cast<std::int64_t>(share), cosine_bits);
                work_[j + 1].carried = carried;
                change = saturating_add(change, share_of(carried, next_change, chain_share_bits));
            }
            const std::uint64_t near_weight = weight(j);
            const std::uint64_t sum = behind + softness_;
            const std::uint64_t diagonal = near_weight + sum;
            std::int64_t own = 0;
            share = 0;
            if (diagonal != 0) {
                const int up = std::countl_zero(diagonal);
                const std::uint64_t reciprocal = reciprocal_of(diagonal << up);
                share = multiply_unsigned(near_weight << up, reciprocal).hi;
                own = directed ? quotient_of(change, reciprocal, up) : 0;
            }
            work_[j].own = own;
            work_[j].direction = n.direction;
            next = n.direction;
            next_directed = directed;
            next_sum = sum;
            next_change = change;
            far_weight = near_weight;
            far = near;
        }
        work_[0].carried = 0;
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
            !measure(position(last + 1) - position(first), pins)) {
            return rest_one;
        }
        const auto apart = static_cast<std::uint64_t>(pins.length >> down);
        const fixed::UInt128 quotient =
            fixed::divide(fixed::UInt128{0, apart} << rest_bits, std::max<std::uint64_t>(length, 1)).quotient;
        const std::uint64_t ratio = std::min(fixed::saturate_to_uint64(quotient), greatest_rest);
        return std::max(rest_one, ratio + least_slack);
    }

    // A change over a diagonal, as a multiplier.
    std::int64_t quotient_of(std::int64_t change, std::uint64_t reciprocal, int up) const {
        const auto factor = static_cast<std::int64_t>(std::min<std::uint64_t>(reciprocal, INT64_MAX));
        const int down = chain_.multiplier_exponent - up;
        return bounded_multiplier(down >= 0 ? fixed::multiply_signed(change, factor).hi >> down
                                            : multiply_shift(change, factor, 64 + down));
    }

    // Of two segments that follow each other, 60 fraction bits. From the difference of their directions:
    // exact where a rope is nearly straight.
    struct Turn {
        std::int64_t cosine;
        std::uint64_t sine_squared;
    };

    static Turn turn_between(const Direction& a, const Direction& b) {
        const std::int64_t x = std::int64_t{a.x} - b.x;
        const std::int64_t y = std::int64_t{a.y} - b.y;
        const std::int64_t z = std::int64_t{a.z} - b.z;
        const std::int64_t versine = std::min((x * x + y * y + z * z) >> 1, 2 * cosine_one);
        const std::uint64_t sine_squared =
            share_of(static_cast<std::uint64_t>(versine),
                     static_cast<std::uint64_t>(2 * cosine_one - versine), cosine_bits);
        return {cosine_one - versine, sine_squared};
    }

    // −c·C − σ·λ − γ'·n·(motion): how much longer the segment is to become. It may double or close, no more,
    // and by no more than particles move in a substep.
    std::int64_t wanted_change(std::uint32_t index, std::int64_t rest,
                               const fixed::NormalisedVector& n) const {
        const ChainSegment& segment = chain_.segments[index];
        const std::int64_t limit =
            torn_ ? std::min(segment.slack / 2, substep_motion_limit) : substep_motion_limit;
        const std::int64_t most = std::min(n.length, limit);
        std::int64_t change = std::clamp(saturating_subtract(rest, n.length), -most, most);
        if (family_.damping_share != 0) {
            const Vec3 motion = (position(index + 1) - start(index + 1)) - (position(index) - start(index));
            const auto bounded = [](std::int64_t v) {
                return std::clamp(v, -coordinate_limit, coordinate_limit);
            };
            const std::int64_t along =
                fixed::dot(n.direction, Vec3{bounded(motion.x), bounded(motion.y), bounded(motion.z)});
            change = unit_share(family_.error_share, change) -
                     unit_share(family_.damping_share, std::clamp(along, -most, most));
        }
        if (arrays_.multipliers != nullptr && chain_.softness != 0) {
            const int up = chain_.multiplier_exponent;
            const std::int64_t greatest = coordinate_limit >> up;
            const std::int64_t eased =
                multiply_shift(static_cast<std::int64_t>(chain_.softness),
                               arrays_.multipliers[segment.constraint], chain_share_bits);
            change -= std::clamp(eased, -greatest, greatest) * (std::int64_t{1} << up);
        }
        return change;
    }

    // Multipliers from the near end to the far one, and how the particles move. Whether any tension is more
    // than a chain stands by itself.
    bool substitute() {
        std::int64_t multiplier = 0;
        Vec3 pushed{};
        std::uint64_t stiff = 0;
        for (std::uint32_t j = 0; j < count_; ++j) {
            ChainWork& w = work_[j];
            multiplier = bounded_multiplier(w.own + share_of(w.carried, multiplier, chain_share_bits));
            const auto along = [multiplier](std::int32_t c) {
                return fixed::multiply_signed(std::int64_t{c} * (std::int64_t{1} << 32), multiplier * 4).hi;
            };
            const Vec3 push{along(w.direction.x), along(w.direction.y), along(w.direction.z)};
            w.stiffness = stiffness(chain_.segments[j], multiplier);
            stiff |= w.stiffness;
            w.movement = movement(chain_.particles[j].weight, pushed - push);
            pushed = push;
        }
        work_[count_].stiffness = 0;
        work_[count_].direction = {};
        work_[count_].movement = movement(chain_.particles[count_].weight, pushed);
        return stiff != 0;
    }

    Vec3 movement(std::uint64_t weight, const Vec3& push) const {
        const auto moved = [&](std::int64_t p) {
            return shift_either_way(fixed::multiply_signed(static_cast<std::int64_t>(weight), p));
        };
        return {moved(push.x), moved(push.y), moved(push.z)};
    }

    // To the nearest coordinate unit, and no more than particles move in a substep.
    std::int64_t shift_either_way(const fixed::Int128& product) const {
        const std::int64_t share = static_cast<std::int64_t>((product >> chain_share_bits).lo) +
                                   static_cast<std::int64_t>((product.lo >> (chain_share_bits - 1)) & 1);
        if (movement_down_ > 0) {
            return std::clamp(fixed::shift_right_rounded(share, movement_down_), -substep_motion_limit,
                              substep_motion_limit);
        }
        const std::int64_t limit = substep_motion_limit >> -movement_down_;
        return std::clamp(share, -limit, limit) * (std::int64_t{1} << -movement_down_);
    }

    // Its products by shares and by directions fit.
    static std::int64_t bounded_multiplier(std::int64_t value) {
        constexpr std::int64_t limit = (std::int64_t{1} << 61) - 1;
        return std::clamp(value, -limit, limit);
    }

    // What κ exceeds the stable one by; adds the change to the multiplier that is carried.
    std::uint64_t stiffness(const ChainSegment& segment, std::int64_t change) const {
        std::int64_t multiplier = change;
        if (arrays_.multipliers != nullptr) {
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

    // What each does with all that is before it.
    void spread() {
        for (std::uint32_t j = 0; j < count_; ++j) {
            if (work_[j].give != 0) {
                Vec3& far = work_[j + 1].gathered;
                far = far + unit_share(work_[j].give, work_[j].gathered - far);
            }
        }
    }

    // Changes the movements by what is across the rope of what was spread.
    void keep_across() {
        Vec3 mean{};
        for (std::uint32_t i = 0; i <= count_; ++i) {
            if (work_[i].stiffness == 0 && (i == 0 || work_[i - 1].stiffness == 0)) {
                continue;
            }
            const Vec3 across = across_rope(i, work_[i].gathered - work_[i].movement);
            work_[i].movement = work_[i].movement + across;
            if (chain_.pinned_count == 0) {
                const auto share = static_cast<std::int64_t>(chain_.particles[i].mass_share);
                mean = mean + Vec3{multiply_shift(share, across.x, 63), multiply_shift(share, across.y, 63),
                                   multiply_shift(share, across.z, 63)};
            }
        }
        if (chain_.pinned_count == 0) {
            for (std::uint32_t i = 0; i <= count_; ++i) {
                work_[i].movement = work_[i].movement - mean;
            }
        }
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

    void move() {
        for (std::uint32_t i = 0; i <= count_; ++i) {
            const std::uint32_t p = chain_.particles[i].particle;
            arrays_.x[p] = wrapping_add(arrays_.x[p], work_[i].movement.x);
            arrays_.y[p] = wrapping_add(arrays_.y[p], work_[i].movement.y);
            arrays_.z[p] = wrapping_add(arrays_.z[p], work_[i].movement.z);
        }
    }

    const ChainCoefficients& chain_;
    const FamilyCoefficients& family_;
    const DistanceArrays& arrays_;
    ChainWork* work_;
    bool torn_;
    std::uint64_t softness_;
    std::uint64_t taut_ = rest_one; // what rest lengths are multiplied by in the piece at hand
    std::uint32_t count_;
    int movement_down_;
};

} // namespace

bool solve_chain(const ChainCoefficients& chain, const FamilyCoefficients& family,
                 const DistanceArrays& arrays, ChainWork* work) {
    return ChainSolve(chain, family, arrays, work, false).run();
}

void mend_chain(const ChainCoefficients& chain, const FamilyCoefficients& family,
                const DistanceArrays& arrays, ChainWork* work) {
    static_cast<void>(ChainSolve(chain, family, arrays, work, true).run());
}

} // namespace lks
