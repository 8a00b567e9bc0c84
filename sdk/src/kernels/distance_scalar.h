// One projection in plain integers: the specification of what every kernel computes (solver/distance.h).
//
// Everything here has internal linkage, so that each kernel's file compiles it for its own instruction set
// and none takes another's.
#pragma once

#include <algorithm>
#include <bit>

#include "fixed/formats.h"
#include "fixed/int128.h"
#include "fixed/projection_reciprocal_sqrt.h"
#include "kernels/distance_task.h"
#include "kernels/force_inline.h"
#include "solver/wrapping.h"

namespace lks {
namespace {

inline std::int64_t shift_right_rounded(std::int64_t value, int shift) {
    return wrapping_add(value, std::int64_t{1} << (shift - 1)) >> shift;
}

// The same without the sum, which the longest differences have no room for. Everywhere it would take 3 % more
// time.
inline std::int64_t shift_right_rounded_any(std::int64_t value, int shift) {
    return (value >> shift) + ((value >> (shift - 1)) & 1);
}

// What makes a shift to the right round to the nearest; nothing where there is none.
constexpr std::int64_t rounding_of(int shift) {
    return shift > 0 ? std::int64_t{1} << (shift - 1) : 0;
}

struct Difference {
    std::int64_t x, y, z;
};

// Of two particles.
LKS_FORCE_INLINE Difference difference(const std::int64_t* x, const std::int64_t* y, const std::int64_t* z,
                                       std::ptrdiff_t a, std::ptrdiff_t b) {
    x = as_it_stands(x);
    y = as_it_stands(y);
    z = as_it_stands(z);
    return {wrapping_subtract(x[a], x[b]), wrapping_subtract(y[a], y[b]), wrapping_subtract(z[a], z[b])};
}

// All within [-2^30, 2^30).
inline bool fit_differences(const Difference& d) {
    const auto lifted = [](std::int64_t c) { return wrapping_add(c, direction_one); };
    return static_cast<std::uint64_t>(lifted(d.x) | lifted(d.y) | lifted(d.z)) <
           2 * std::uint64_t{direction_one};
}

// value · 2^left for left in -63 .. 63, wrapping.
inline std::int64_t shift_either_way(std::int64_t value, int left) {
    return left >= 0 ? static_cast<std::int64_t>(static_cast<std::uint64_t>(value) << left)
                     : shift_right_rounded(value, -left);
}

// The difference of two positions in 32-bit units of 2^(shift + extra) coordinate units.
struct NarrowDifference {
    std::int64_t x, y, z; // each from -2^30 to 2^30 - 1
    int extra;
};

// Of a far edge, of which a difference does not fit with `shift`.
inline NarrowDifference narrow_far(const Difference& d, int shift) {
    // One's complement magnitudes: exact enough for a bit count, and defined for every value.
    const std::int64_t largest = (d.x ^ (d.x >> 63)) | (d.y ^ (d.y >> 63)) | (d.z ^ (d.z >> 63));
    // One bit of room for the rounding: |d| < 2^30 afterwards.
    const int extra = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(largest))) - 30 - shift;
    // Below it also where that rounds up: what both ends move together fits into 64 bits.
    const auto narrow = [&](std::int64_t wide) {
        return std::clamp<std::int64_t>(shift_right_rounded_any(wide, shift + extra), 1 - direction_one,
                                        direction_one - 1);
    };
    return {narrow(d.x), narrow(d.y), narrow(d.z), extra};
}

// value / len in Direction format, where 1/len = y·2^(k−62); |value| ≤ 2^31.
inline std::int64_t over_length(std::int64_t value, std::uint32_t y, int k) {
    return shift_right_rounded(value * static_cast<std::int64_t>(y), 32 - k); // 1 .. 32
}

// min(L/len, 2) in Direction format, rounded down.
inline std::int64_t rest_ratio(std::uint32_t rest_mantissa, std::uint32_t y, int shift) {
    constexpr std::uint64_t two = 2 * std::uint64_t{direction_one};
    const std::uint64_t product = std::uint64_t{rest_mantissa} * y;
    const std::uint64_t ratio = shift <= 0 ? two : shift >= 64 ? 0 : product >> shift;
    return static_cast<std::int64_t>(std::min(ratio, two));
}

inline std::int64_t unit_multiply(std::uint32_t unit, std::int64_t value) {
    return shift_right_rounded(value * static_cast<std::int64_t>(unit), unit_fraction_bits);
}

// Half a unit of f, less by what motions that are rounded down add to it on the average. What neither is too
// long nor moves stays where it is.
constexpr std::int64_t damped_rounding(std::uint32_t damping_share) {
    return (std::int64_t{1} << (unit_fraction_bits - 1)) - (damping_share >> 1);
}

// d·(d − start)/u in Direction format, within ±1, rounded down: by how much of its length an edge has grown
// since it was `start`. u = |d|² is below 2^62, and 1/|d| = y·2^(k−62).
LKS_FORCE_INLINE std::int64_t relative_growth(const NarrowDifference& d, const Difference& start,
                                              std::uint64_t u, std::uint32_t y, int k) {
    const auto squared = static_cast<std::int64_t>(u);
    std::int64_t along = d.x * start.x + d.y * start.y + d.z * start.z;
    if (static_cast<std::uint64_t>(along) > 2 * u) [[unlikely]] {
        along = along < 0 ? 0 : 2 * squared;
    }
    const std::int64_t dot = squared - along;
    // u is m·2^(62 − 2k) with m in [1, 4), and y² is 1/m. Below 2^62.
    const std::int64_t aligned = shift_right_rounded(dot * (std::int64_t{1} << (2 * k - 2)), 32);
    const auto reciprocal = static_cast<std::int64_t>(std::uint64_t{y} * y >> 32);
    return (aligned * reciprocal) >> 28;
}

// movement·part to the nearest, for a part in [0, 1] in Direction format.
LKS_FORCE_INLINE std::int64_t part_of(std::int64_t movement, std::uint32_t part) {
    const std::int64_t low = (movement & (direction_one - 1)) * static_cast<std::int64_t>(part);
    return wrapping_add(wrapping_multiply(movement >> direction_fraction_bits, part),
                        shift_right_rounded(low, direction_fraction_bits));
}

template <bool soft, bool damped, bool multiplier>
class Projection {
public:
    explicit Projection(const DistanceTask& task)
        : rest_mantissas_(task.rest_mantissas), shares_(task.shares), parts_b_(task.parts_b),
          relaxations_(task.relaxations), parameters_(task.parameters),
          difference_rounding_(rounding_of(task.parameters.difference_shift)),
          gain_rounding_(rounding_of(task.parameters.gain_shift)),
          product_rounding_(rounding_of(task.parameters.product_shift)),
          damped_rounding_(damped_rounding(task.parameters.damping_share)), arrays_(task.arrays) {}

    LKS_FORCE_INLINE void operator()(std::uint32_t constraint, std::ptrdiff_t a, std::ptrdiff_t b) const {
        const Difference near = narrow_near(difference(a, b));
        if (fit_differences(near)) {
            project<false>(constraint, a, b, NarrowDifference{near.x, near.y, near.z, 0});
        } else {
            project_far(constraint, a, b);
        }
    }

private:
    LKS_FORCE_INLINE Difference difference(std::ptrdiff_t a, std::ptrdiff_t b) const {
        return lks::difference(arrays_.x, arrays_.y, arrays_.z, a, b);
    }
    // In units; what is far does not fit afterwards either.
    LKS_FORCE_INLINE Difference narrow_near(const Difference& wide) const {
        const auto narrow = [&](std::int64_t d) {
            return wrapping_add(d, difference_rounding_) >> parameters_.difference_shift;
        };
        return {narrow(wide.x), narrow(wide.y), narrow(wide.z)};
    }

    // By itself, so that what nearly all edges take has no shifts that it doesn't need.
    LKS_NEVER_INLINE void project_far(std::uint32_t constraint, std::ptrdiff_t a, std::ptrdiff_t b) const {
        project<true>(constraint, a, b, narrow_far(difference(a, b), parameters_.difference_shift));
    }

    template <bool far>
    LKS_FORCE_INLINE void project(std::uint32_t constraint, std::ptrdiff_t a, std::ptrdiff_t b,
                                  const NarrowDifference& d) const {
        const std::uint64_t u = static_cast<std::uint64_t>(d.x * d.x) +
                                static_cast<std::uint64_t>(d.y * d.y) + static_cast<std::uint64_t>(d.z * d.z);
        if (u == 0) {
            return;
        }
        const fixed::ReciprocalLength reciprocal = fixed::projection_reciprocal_length(u);
        const std::uint32_t y = reciprocal.mantissa;
        const int k = reciprocal.shift;

        std::int64_t f =
            rest_ratio(rest_mantissas_[constraint], y, 32 + parameters_.rest_exponent + d.extra - k) -
            direction_one;
        const int scale = parameters_.difference_shift + d.extra;
        if constexpr (soft) {
            f = soft_correction(f, constraint, a, b, d, u, y, k, scale);
        }
        if constexpr (multiplier) {
            std::int64_t& sum = arrays_.multipliers[constraint];
            const std::int64_t more = length_of(f, u, y, k, scale);
            // Where it relaxes, a group whose sum could leave its range does not stay in lanes.
            sum =
                soft && relaxations_ != nullptr ? fixed::saturating_add(sum, more) : wrapping_add(sum, more);
        }
        apply<far>(constraint, a, b, d, f);
    }

    // f in Direction format from the relative error g = L/len − 1.
    std::int64_t soft_correction(std::int64_t g, std::uint32_t constraint, std::ptrdiff_t a, std::ptrdiff_t b,
                                 const NarrowDifference& d, std::uint64_t u, std::uint32_t y, int k,
                                 int scale) const {
        std::int64_t f = g;
        if constexpr (damped) {
            const std::int64_t motion = relative_growth(d, start_difference(a, b, d.extra), u, y, k);
            f = (static_cast<std::int64_t>(parameters_.error_share) * g -
                 static_cast<std::int64_t>(parameters_.damping_share) * motion + damped_rounding_) >>
                unit_fraction_bits;
        }
        if constexpr (multiplier) {
            if (relaxations_ != nullptr) {
                f = std::clamp<std::int64_t>(f - relaxation(constraint, y, k, scale), -direction_one,
                                             direction_one);
            }
        }
        // Without the relaxation |f| ≤ 1, but for some units of rounding: both shares come to one at most.
        return f;
    }

    // r·Λ/len in Direction format; beyond ±4 it may be anything that is as far.
    std::int64_t relaxation(std::uint32_t constraint, std::uint32_t y, int k, int scale) const {
        const std::int64_t length = shift_right_rounded_any(arrays_.multipliers[constraint], scale);
        if (length < -INT32_MAX || length > INT32_MAX) [[unlikely]] {
            return far_relaxation(relaxations_[constraint], length, y, k);
        }
        return over_length(unit_multiply(relaxations_[constraint], length), y, k);
    }

    // Of multipliers many times as long as their edge, which yields by little in a substep: the uppermost
    // ones of a fine cloth have such in long substeps.
    LKS_NEVER_INLINE static std::int64_t far_relaxation(std::uint32_t unit, std::int64_t length,
                                                        std::uint32_t y, int k) {
        constexpr std::int64_t most = 4 * std::int64_t{direction_one};
        const std::int64_t share = fixed::multiply_shift(length, unit, unit_fraction_bits);
        return std::clamp(fixed::multiply_shift(share, y, 32 - k), -most, most);
    }

    // In units of 2^(difference_shift + extra), within ±2^30.
    LKS_FORCE_INLINE Difference start_difference(std::ptrdiff_t a, std::ptrdiff_t b, int extra) const {
        const Difference wide = lks::difference(arrays_.start_x, arrays_.start_y, arrays_.start_z, a, b);
        const Difference near = narrow_near(wide);
        return extra == 0 && fit_differences(near) ? near : far_start_difference(a, b, extra);
    }

    // By itself, as project_far.
    LKS_NEVER_INLINE Difference far_start_difference(std::ptrdiff_t a, std::ptrdiff_t b, int extra) const {
        const Difference wide = lks::difference(arrays_.start_x, arrays_.start_y, arrays_.start_z, a, b);
        const auto narrow = [&](std::int64_t difference) {
            return std::clamp<std::int64_t>(
                shift_right_rounded_any(difference, parameters_.difference_shift + extra), -direction_one,
                direction_one - 1);
        };
        return {narrow(wide.x), narrow(wide.y), narrow(wide.z)};
    }

    // f·len in Coordinate format, rounded down; of edges of 128 m and more it saturates.
    static std::int64_t length_of(std::int64_t f, std::uint64_t u, std::uint32_t y, int k, int scale) {
        const std::uint64_t m = (u << (2 * k)) >> 32; // Q2.30 in [1, 4)
        // √m in Q1.30. Just below m = 4 it may come to 2^31 or one more, for which 32-bit lanes have no room.
        const auto root = static_cast<std::int64_t>(std::min<std::uint64_t>((m * y) >> 31, INT32_MAX));
        const int right = 30 + k - scale;
        const std::int64_t twice = 2 * f * root;
        return right >= 0 ? twice >> right : fixed::multiply_shift(twice, std::int64_t{1} << -right, 0);
    }

    template <bool far>
    LKS_FORCE_INLINE void apply(std::uint32_t constraint, std::ptrdiff_t a, std::ptrdiff_t b,
                                const NarrowDifference& d, std::int64_t f) const {
        const std::uint32_t part = parts_b_[constraint];
        if (part == half_part) {
            move<far, true>(soft ? gain(constraint, f) : half_gain(f), part, a, b, d);
        } else {
            move<far, false>(gain(constraint, f), part, a, b, d);
        }
    }

    LKS_FORCE_INLINE std::int64_t gain(std::uint32_t constraint, std::int64_t f) const {
        return (static_cast<std::int64_t>(shares_[constraint]) * f + gain_rounding_) >>
               parameters_.gain_shift;
    }
    // The same for a share of a half, which is that of all that is stiff and moves alike.
    LKS_FORCE_INLINE std::int64_t half_gain(std::int64_t f) const {
        return (f + (gain_rounding_ >> half_share_bits)) >> (parameters_.gain_shift - half_share_bits);
    }

    // Of each end where both move alike, of both together elsewhere.
    template <bool far>
    LKS_FORCE_INLINE std::int64_t movement(std::int64_t difference, std::int64_t gain, int extra) const {
        const std::int64_t product = difference * gain;
        if constexpr (far) {
            const int left = extra - parameters_.product_shift;
            return left == 0 ? product : shift_either_way(product, left);
        } else if constexpr (soft) {
            return wrapping_add(product, product_rounding_) >> parameters_.product_shift;
        } else {
            return product;
        }
    }

    // `alike`: both ends by the same rounded correction, so that linear momentum is kept to the bit.
    // Otherwise b by its part of both movements, and a by what is left of them.
    template <bool far, bool alike>
    LKS_FORCE_INLINE void move(std::int64_t gain, std::uint32_t part, std::ptrdiff_t a, std::ptrdiff_t b,
                               const NarrowDifference& d) const {
        const auto move_axis = [&](std::int64_t* axis, std::int64_t difference) {
            const std::int64_t moves = movement<far>(difference, gain, d.extra);
            const std::int64_t of_b = alike ? moves : part_of(moves, part);
            const std::int64_t of_a = alike ? moves : wrapping_subtract(moves, of_b);
            std::int64_t* x = as_it_stands(axis);
            x[a] = wrapping_add(x[a], of_a);
            x[b] = wrapping_subtract(x[b], of_b);
        };
        move_axis(arrays_.x, d.x);
        move_axis(arrays_.y, d.y);
        move_axis(arrays_.z, d.z);
    }

    const std::uint32_t* rest_mantissas_;
    const std::uint32_t* shares_;
    const std::uint32_t* parts_b_;
    const std::uint32_t* relaxations_;
    DistanceParameters parameters_;
    std::int64_t difference_rounding_;
    std::int64_t gain_rounding_;
    std::int64_t product_rounding_;
    std::int64_t damped_rounding_;
    DistanceArrays arrays_;
};

} // namespace
} // namespace lks
