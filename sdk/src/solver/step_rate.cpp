#include "solver/step_rate.h"

#include <algorithm>

#include "fixed/formats.h"

namespace lks {
namespace {

constexpr std::int64_t speed_limit_metres_per_second = 1000;
constexpr std::int64_t recovery_metres_per_second = 3;

// a·b / (2^shift · divisor), nearest, ties away from zero; saturates at ±INT64_MAX.
std::int64_t multiply_shift_divide(std::int64_t a, std::int64_t b, int shift, std::uint64_t divisor) {
    const bool negative = (a < 0) != (b < 0);
    fixed::UInt128 product = fixed::multiply_unsigned(fixed::magnitude(a), fixed::magnitude(b));
    // The quotient's doubled value decides the rounding, so the shift keeps one bit back: exact, as nothing
    // is lost that a later step could see but "more than half".
    const fixed::UInt128 doubled = fixed::divide(product << 1, divisor).quotient >> shift;
    const fixed::UInt128 one{0, 1};
    const std::uint64_t size = fixed::saturate_to_uint64((doubled + one) >> 1);
    return fixed::with_sign(std::min<std::uint64_t>(size, INT64_MAX), negative);
}

} // namespace

StepRate make_step_rate(std::uint32_t ticks_per_second, std::uint32_t substeps, std::uint32_t iterations) {
    StepRate rate;
    rate.ticks_per_second = ticks_per_second;
    rate.substeps = substeps;
    rate.iterations = iterations;
    rate.substeps_per_second = std::uint64_t{ticks_per_second} * substeps;
    rate.motion_limit =
        std::min(substep_motion_limit,
                 motion_from_velocity(rate, speed_limit_metres_per_second << world_fraction_bits));
    rate.greatest_recovery = motion_from_velocity(rate, recovery_metres_per_second << world_fraction_bits);
    return rate;
}

std::int64_t motion_from_velocity(const StepRate& rate, std::int64_t velocity) {
    return multiply_shift_divide(velocity, std::int64_t{1} << coordinate_from_world_shift, 0,
                                 rate.substeps_per_second);
}

std::int64_t velocity_from_motion(const StepRate& rate, std::int64_t motion) {
    return multiply_shift_divide(motion, static_cast<std::int64_t>(rate.substeps_per_second),
                                 coordinate_from_world_shift, 1);
}

std::int64_t motion_from_acceleration(const StepRate& rate, std::int64_t acceleration, std::int64_t factor) {
    // World times World has 80 fraction bits; the result has 56.
    return multiply_shift_divide(acceleration, factor, 2 * world_fraction_bits - coordinate_fraction_bits,
                                 rate.substeps_per_second * rate.substeps_per_second);
}

std::int64_t motion_from_impulse(const StepRate& rate, std::int64_t impulse,
                                 const fixed::Scaled& inverse_mass) {
    const fixed::Scaled motion = fixed::Scaled::from_fixed(fixed::magnitude(impulse), world_fraction_bits) *
                                 inverse_mass / rate.inverse_h();
    const std::int64_t result = motion.to_i64_fixed(coordinate_fraction_bits);
    return impulse < 0 ? -result : result;
}

std::uint32_t kept_share(const StepRate& rate, std::int64_t damping) {
    const std::int64_t lost =
        multiply_shift_divide(damping, 1, world_fraction_bits - unit_fraction_bits, rate.substeps_per_second);
    return lost >= static_cast<std::int64_t>(unit_one) ? 0u : unit_one - static_cast<std::uint32_t>(lost);
}

} // namespace lks
