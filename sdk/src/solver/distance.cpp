#include "solver/distance.h"

#include <algorithm>
#include <bit>

#include "fixed/formats.h"
#include "fixed/reciprocal_sqrt.h"
#include "solver/wrapping.h"

namespace lks {
namespace {

inline std::int64_t shift_right_rounded(std::int64_t value, int shift) {
    return wrapping_add(value, std::int64_t{1} << (shift - 1)) >> shift;
}

inline bool fits_32_bits(std::int64_t value) {
    return value == static_cast<std::int32_t>(value);
}

// value · 2^left for left in -63 .. 63, wrapping.
inline std::int64_t shift_either_way(std::int64_t value, int left) {
    return left >= 0 ? static_cast<std::int64_t>(static_cast<std::uint64_t>(value) << left)
                     : shift_right_rounded(value, -left);
}

// What is the same for all constraints of a batch.
struct BatchParameters {
    std::int32_t difference_shift;
    std::int32_t rest_exponent;
    std::int32_t gain_shift;    // Unit × Direction product to gain
    std::int32_t product_shift; // gain × difference product to Coordinate
    std::int32_t impulse_shift; // impulse × share to Coordinate, to the left
    std::uint32_t error_share;
    std::uint32_t damping_share;
};

struct Difference {
    std::int64_t x, y, z;
};

// The difference of two positions in 32-bit units of 2^(shift + extra) coordinate units.
struct NarrowDifference {
    std::int64_t x, y, z; // each within 32 bits, signed
    int extra;
};

inline NarrowDifference narrow(const Difference& d, int shift) {
    NarrowDifference result{shift_right_rounded(d.x, shift), shift_right_rounded(d.y, shift),
                            shift_right_rounded(d.z, shift), 0};
    if (fits_32_bits(result.x) && fits_32_bits(result.y) && fits_32_bits(result.z)) {
        return result;
    }
    // A far edge. One's complement magnitudes: exact enough for a bit count, and defined for every value.
    const std::int64_t largest = (d.x ^ (d.x >> 63)) | (d.y ^ (d.y >> 63)) | (d.z ^ (d.z >> 63));
    // One bit of room for the rounding: |d| < 2^30 afterwards.
    result.extra = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(largest))) - 30 - shift;
    result.x = shift_right_rounded(d.x, shift + result.extra);
    result.y = shift_right_rounded(d.y, shift + result.extra);
    result.z = shift_right_rounded(d.z, shift + result.extra);
    return result;
}

// value / len in Direction format, where 1/len = y·2^(k−62); within ±2^32, far beyond the clamp.
inline std::int64_t over_length(std::int64_t value, std::uint32_t y, int k) {
    constexpr std::int64_t limit = std::int64_t{1} << 32;
    const std::int64_t product = std::clamp(value, -(limit >> 1), limit >> 1) * static_cast<std::int64_t>(y);
    const int shift = 32 - k; // 1 .. 32
    return std::clamp(shift_right_rounded(product, shift), -limit, limit);
}

// min(L/len, 2) in Direction format.
inline std::int64_t rest_ratio(std::uint32_t rest_mantissa, std::uint32_t y, int shift) {
    constexpr std::uint64_t two = std::uint64_t{2} << direction_fraction_bits;
    const std::uint64_t product = std::uint64_t{rest_mantissa} * y;
    if (shift <= 0) {
        return static_cast<std::int64_t>(two);
    }
    if (shift >= 64) {
        return 0;
    }
    const std::uint64_t ratio = (product + (std::uint64_t{1} << (shift - 1))) >> shift;
    return static_cast<std::int64_t>(std::min(ratio, two));
}

inline std::int64_t unit_multiply(std::uint32_t unit, std::int64_t value) {
    return shift_right_rounded(value * static_cast<std::int64_t>(unit), unit_fraction_bits);
}

// impulse · share / 2^31, the product in full.
inline std::int64_t share_of(std::int64_t impulse, std::uint32_t share) {
    static_assert(unit_fraction_bits == 31);
    const std::int64_t factor = share;
    return (impulse >> 31) * factor + (((impulse & INT32_MAX) * factor) >> 31);
}

template <bool equal_shares, bool soft, bool damped, bool multiplier>
class Projection {
public:
    Projection(const lks_asset& asset, const Coefficients& coefficients, const BatchParameters& parameters,
               const DistanceArrays& arrays)
        : rest_mantissas_(asset.rest_mantissas.data()), shares_a_(coefficients.shares_a.data()),
          shares_b_(coefficients.shares_b.data()),
          relaxations_(coefficients.relaxations.empty() ? nullptr : coefficients.relaxations.data()),
          parameters_(parameters), arrays_(arrays) {}

    void operator()(std::uint32_t constraint, std::uint32_t a, std::uint32_t b) const {
        const Difference wide{wrapping_subtract(arrays_.x[a], arrays_.x[b]),
                              wrapping_subtract(arrays_.y[a], arrays_.y[b]),
                              wrapping_subtract(arrays_.z[a], arrays_.z[b])};
        const NarrowDifference d = narrow(wide, parameters_.difference_shift);
        const std::uint64_t u = static_cast<std::uint64_t>(d.x * d.x) +
                                static_cast<std::uint64_t>(d.y * d.y) + static_cast<std::uint64_t>(d.z * d.z);
        if (u == 0) {
            return;
        }
        const fixed::ReciprocalLength reciprocal = fixed::reciprocal_length(u);
        const std::uint32_t y = reciprocal.mantissa;
        const int k = reciprocal.shift;

        std::int64_t f =
            rest_ratio(rest_mantissas_[constraint], y, 32 + parameters_.rest_exponent + d.extra - k) -
            direction_one;
        const int scale = parameters_.difference_shift + d.extra;
        if constexpr (soft) {
            f = soft_correction(f, constraint, a, b, d, y, k, scale);
        }
        if constexpr (multiplier) {
            arrays_.multipliers[constraint] =
                wrapping_add(arrays_.multipliers[constraint], length_of(f, u, y, k, scale));
        }
        apply(constraint, a, b, d, f);
    }

private:
    // f in Direction format from the relative error g = L/len − 1.
    std::int64_t soft_correction(std::int64_t g, std::uint32_t constraint, std::uint32_t a, std::uint32_t b,
                                 const NarrowDifference& d, std::uint32_t y, int k, int scale) const {
        std::int64_t f = unit_multiply(parameters_.error_share, g);
        if constexpr (multiplier) {
            if (relaxations_ != nullptr) {
                const std::int64_t length = std::clamp<std::int64_t>(
                    shift_right_rounded(arrays_.multipliers[constraint], scale), -INT32_MAX, INT32_MAX);
                f -= over_length(unit_multiply(relaxations_[constraint], length), y, k);
            }
        }
        if constexpr (damped) {
            const std::int64_t motion = over_length(normal_motion(a, b, d, y, k, scale), y, k);
            f -= unit_multiply(parameters_.damping_share,
                               std::clamp<std::int64_t>(motion, -INT32_MAX, INT32_MAX));
        }
        return std::clamp<std::int64_t>(f, -direction_one, direction_one);
    }

    // n·(Δx_a − Δx_b) since the start of the substep, in difference units.
    std::int64_t normal_motion(std::uint32_t a, std::uint32_t b, const NarrowDifference& d, std::uint32_t y,
                               int k, int scale) const {
        constexpr std::int64_t limit = std::int64_t{1} << 29; // keeps the dot product within 64 bits
        const auto motion = [&](const std::int64_t* now, const std::int64_t* start) {
            const std::int64_t difference =
                wrapping_subtract(wrapping_subtract(now[a], start[a]), wrapping_subtract(now[b], start[b]));
            return std::clamp(shift_right_rounded(difference, scale), -limit, limit);
        };
        const std::int64_t dot = d.x * motion(arrays_.x, arrays_.start_x) +
                                 d.y * motion(arrays_.y, arrays_.start_y) +
                                 d.z * motion(arrays_.z, arrays_.start_z);
        // |dot| ≤ len·|motion| with len < 2^(32−k): the shift leaves at most 31 bits, and y brings 31 more.
        return shift_right_rounded(shift_right_rounded(dot, 32 - k) * static_cast<std::int64_t>(y), 30);
    }

    // f·len in Coordinate format.
    static std::int64_t length_of(std::int64_t f, std::uint64_t u, std::uint32_t y, int k, int scale) {
        const std::uint64_t m = (u << (2 * k)) >> 32;               // Q2.30 in [1, 4)
        const auto root = static_cast<std::int64_t>((m * y) >> 31); // √m in Q1.30
        return shift_either_way(f * root, scale - k - 29);
    }

    void apply(std::uint32_t constraint, std::uint32_t a, std::uint32_t b, const NarrowDifference& d,
               std::int64_t f) const {
        if (equal_shares || shares_a_[constraint] == shares_b_[constraint]) {
            move_alike(shares_a_[constraint], a, b, d, f);
        } else {
            move_by_share(shares_a_[constraint], shares_b_[constraint], a, b, d, f);
        }
    }

    // Both ends by the same rounded correction: linear momentum is kept to the bit.
    void move_alike(std::uint32_t share, std::uint32_t a, std::uint32_t b, const NarrowDifference& d,
                    std::int64_t f) const {
        const std::int64_t gain =
            shift_right_rounded(static_cast<std::int64_t>(share) * f, parameters_.gain_shift);
        const int left = d.extra - parameters_.product_shift;
        const auto move = [&](std::int64_t* x, std::int64_t difference) {
            const std::int64_t correction =
                left == 0 ? difference * gain : shift_either_way(difference * gain, left);
            x[a] = wrapping_add(x[a], correction);
            x[b] = wrapping_subtract(x[b], correction);
        };
        move(arrays_.x, d.x);
        move(arrays_.y, d.y);
        move(arrays_.z, d.z);
    }

    // Each end by its share of the impulse d·f in full: gains rounded apart would push the whole object.
    void move_by_share(std::uint32_t share_a, std::uint32_t share_b, std::uint32_t a, std::uint32_t b,
                       const NarrowDifference& d, std::int64_t f) const {
        const int left = parameters_.impulse_shift + d.extra;
        const auto move = [&](std::int64_t* x, std::int64_t difference) {
            const std::int64_t impulse = difference * f;
            x[a] = wrapping_add(x[a], shift_either_way(share_of(impulse, share_a), left));
            x[b] = wrapping_subtract(x[b], shift_either_way(share_of(impulse, share_b), left));
        };
        move(arrays_.x, d.x);
        move(arrays_.y, d.y);
        move(arrays_.z, d.z);
    }

    const std::uint32_t* rest_mantissas_;
    const std::uint32_t* shares_a_;
    const std::uint32_t* shares_b_;
    const std::uint32_t* relaxations_;
    BatchParameters parameters_;
    DistanceArrays arrays_;
};

BatchParameters batch_parameters(const Batch& batch, const BatchCoefficients& batch_coefficients,
                                 const FamilyCoefficients& family) {
    BatchParameters parameters{};
    parameters.difference_shift = batch.difference_shift;
    parameters.rest_exponent = batch.rest_exponent;
    parameters.error_share = family.error_share;
    parameters.damping_share = family.damping_share;
    // A gain of difference_shift bits makes the product a coordinate as it stands. Where a shift is needed
    // anyway, it has 30 bits.
    const bool plain = batch_coefficients.share_exponent == 0;
    const int gain_bits = plain ? batch.difference_shift : direction_fraction_bits;
    parameters.gain_shift = unit_fraction_bits + direction_fraction_bits - gain_bits;
    parameters.product_shift = gain_bits - batch.difference_shift + batch_coefficients.share_exponent;
    parameters.impulse_shift =
        batch.difference_shift - direction_fraction_bits - batch_coefficients.share_exponent;
    return parameters;
}

// The first of a batch's runs that reaches beyond `first`.
std::uint32_t find_run(const lks_asset& asset, const Batch& batch, std::uint32_t first) {
    const Run* runs = asset.runs.data();
    const Run* found =
        std::upper_bound(runs + batch.first_run, runs + batch.first_run + batch.run_count, first,
                         [](std::uint32_t i, const Run& run) { return i < run.first + run.count; });
    return static_cast<std::uint32_t>(found - runs);
}

template <bool equal_shares, bool soft, bool damped, bool multiplier>
void project_batch(const lks_asset& asset, const Coefficients& coefficients, std::uint32_t batch_index,
                   ConstraintRange range, const DistanceArrays& arrays) {
    const Batch& batch = asset.batches[batch_index];
    const BatchParameters parameters =
        batch_parameters(batch, coefficients.batches[batch_index], coefficients.families[batch.family]);
    const Projection<equal_shares, soft, damped, multiplier> project(asset, coefficients, parameters, arrays);
    const std::uint32_t last_run = batch.first_run + batch.run_count;
    for (std::uint32_t r = find_run(asset, batch, range.first); r < last_run; ++r) {
        const Run run = asset.runs[r];
        if (run.first >= range.last) {
            return;
        }
        const std::uint32_t first = std::max(run.first, range.first);
        const std::uint32_t last = std::min(run.first + run.count, range.last);
        for (std::uint32_t i = first; i < last; ++i) {
            project(i, run.a + (i - run.first), run.b + (i - run.first));
        }
    }
    for (std::uint32_t i = std::max(batch.first_single, range.first); i < range.last; ++i) {
        project(i, asset.constraints[i].a, asset.constraints[i].b);
    }
}

template <bool equal_shares, bool multiplier>
void project_family(const lks_asset& asset, const Coefficients& coefficients, std::uint32_t batch,
                    ConstraintRange range, const DistanceArrays& arrays) {
    const FamilyCoefficients& family = coefficients.families[asset.batches[batch].family];
    if (!family.soft) {
        project_batch<equal_shares, false, false, multiplier>(asset, coefficients, batch, range, arrays);
    } else if (family.damping_share == 0) {
        project_batch<equal_shares, true, false, multiplier>(asset, coefficients, batch, range, arrays);
    } else {
        project_batch<equal_shares, true, true, multiplier>(asset, coefficients, batch, range, arrays);
    }
}

} // namespace

void project_distances(const lks_asset& asset, const Coefficients& coefficients, std::uint32_t batch,
                       ConstraintRange range, const DistanceArrays& arrays) {
    const bool equal_shares = coefficients.batches[batch].equal_shares;
    if (arrays.multipliers == nullptr) {
        equal_shares ? project_family<true, false>(asset, coefficients, batch, range, arrays)
                     : project_family<false, false>(asset, coefficients, batch, range, arrays);
    } else {
        equal_shares ? project_family<true, true>(asset, coefficients, batch, range, arrays)
                     : project_family<false, true>(asset, coefficients, batch, range, arrays);
    }
}

} // namespace lks
