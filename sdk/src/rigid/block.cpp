#include "rigid/block.h"

#include <algorithm>

#include "fixed/world_times.h"
#include "rigid/body_motion.h"

namespace lks {

using fixed::Scaled;
using fixed::Vec3;

BlockInverse invert_block(const std::int64_t (&k)[6]) {
    constexpr std::int64_t unit = std::int64_t{1} << 28;
    const std::int64_t greatest = std::max({k[0], k[3], k[5]});
    int down = 0;
    while (greatest >> down >= 2 * unit) {
        ++down;
    }
    std::int64_t m[6]; // in units of 2^28, the greatest of the diagonal from 1 to 2
    for (int i = 0; i < 6; ++i) {
        m[i] = k[i] >> down;
    }
    const auto minor = [](std::int64_t p, std::int64_t q, std::int64_t r, std::int64_t t) {
        return (p * q - r * t) >> 28;
    };
    std::int64_t cofactors[6] = {minor(m[3], m[5], m[4], m[4]), minor(m[2], m[4], m[1], m[5]),
                                 minor(m[1], m[4], m[2], m[3]), minor(m[0], m[5], m[2], m[2]),
                                 minor(m[1], m[2], m[0], m[4]), minor(m[0], m[3], m[1], m[1])};
    std::int64_t whole = (m[0] * cofactors[0] + m[1] * cofactors[1] + m[2] * cofactors[2]) >> 28;
    if (whole < unit >> 14) {
        whole = m[0] + m[3] + m[5];
        for (int i = 0; i < 6; ++i) {
            cofactors[i] = i == 0 || i == 3 || i == 5 ? unit : 0;
        }
    }
    std::int64_t entries[6]; // 30 fraction bits, of units
    std::int64_t size = 0;
    for (int i = 0; i < 6; ++i) {
        entries[i] = (cofactors[i] * (std::int64_t{1} << 30)) / whole;
        size = std::max(size, entries[i] < 0 ? -entries[i] : entries[i]);
    }
    int narrowed = 0;
    while (size >> narrowed >= std::int64_t{1} << 29) {
        ++narrowed;
    }
    const auto part = [&](int i) { return static_cast<std::int32_t>(entries[i] >> narrowed); };
    // K is m · 2^(down − 30), and m in units is m · 2^-28.
    return {{part(0), part(1), part(2), part(3), part(4), part(5)}, narrowed + 2 - down};
}

Vec3 solve(const BlockInverse& inverse, const Vec3& error) {
    const Vec3 v = multiply(inverse.matrix, error);
    const int shift = inverse.shift;
    const auto part = [shift](std::int64_t c) {
        return shift >= 0 ? fixed::wrapping_multiply(c, std::int64_t{1} << shift)
                          : fixed::shift_right_rounded(c, -shift);
    };
    return {part(v.x), part(v.y), part(v.z)};
}

std::int64_t softness_of(const Scaled& value) {
    return std::min(value.to_i64_fixed(30), greatest_softness);
}

std::int64_t greatest_sum(std::int64_t limit, const Scaled& push_of_one, const StepRate& rate) {
    if (limit == 0) {
        return 0;
    }
    const Scaled sum = world_value(limit) * push_of_one * Scaled::from_u64(rate.substeps);
    return std::max<std::int64_t>(sum.to_i64_fixed(world_fraction_bits), 1);
}

Softness make_softness(std::int64_t compliance, std::int64_t damping, const Scaled& greater_inverse_mass,
                       const StepRate& rate) {
    const Scaled one = Scaled::from_u64(1);
    const Scaled inverse_h = rate.inverse_h();
    const Scaled stretched = one + world_value(compliance) * world_value(damping) * inverse_h; // 1 + γ
    Softness s;
    s.error_share = static_cast<std::int32_t>((one / stretched).to_i64_fixed(30));
    s.motion_share = direction_one - s.error_share;
    s.softness =
        softness_of(world_value(compliance) * inverse_h * inverse_h / greater_inverse_mass / stretched);
    return s;
}

std::int64_t soften(std::int64_t softness, std::int64_t error, std::int64_t push) {
    return std::clamp(fixed::saturating_add(error, fixed::multiply_shift(push, softness, 30)), -greatest_left,
                      greatest_left);
}

std::int64_t soften(const Softness& s, std::int64_t error, std::int64_t motion, std::int64_t push) {
    const std::int64_t shares = fixed::saturating_add(fixed::scale_component(s.error_share, error),
                                                      fixed::scale_component(s.motion_share, motion));
    return soften(s.softness, shares, push);
}

Vec3 soften(const Softness& s, const Vec3& error, const Vec3& motion, const Vec3& push) {
    return {soften(s, error.x, motion.x, push.x), soften(s, error.y, motion.y, push.y),
            soften(s, error.z, motion.z, push.z)};
}

// Of p = left/(W + α̃) with W of one at least W·p is the motion.
std::int64_t greatest_step_of(const Softness& s) {
    return soften(s.softness, greatest_step, greatest_step);
}

Vec3 left_of(const Softness& s, const Vec3& error, const Vec3& motion, const Vec3& push) {
    const bool soft = s.softness != 0;
    Vec3 left = soft ? soften(s, error, motion, push) : error;
    clamp_vector(left, soft ? greatest_step_of(s) : greatest_step);
    return left;
}

bool exceeds(const Vec3& sum, std::int64_t greatest_sum) {
    return greatest_sum != 0 && fixed::length(sum) > static_cast<std::uint64_t>(greatest_sum);
}

Scaled force_of_push(const StepRate& rate, const Scaled& greater_inverse_mass) {
    return rate.inverse_h() * rate.inverse_h() / greater_inverse_mass / Scaled::from_u64(rate.substeps);
}

Vec3 next_push(const BlockInverse& inverse, const Softness& softness, const Vec3& error, const Vec3& motion,
               const Vec3& push) {
    Vec3 next = push - solve(inverse, left_of(softness, error, motion, push));
    clamp_vector(next, greatest_push);
    return next;
}

} // namespace lks
