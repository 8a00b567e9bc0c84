#include "rigid/tick_spin.h"

#include "fixed/arc_tangent.h"
#include "rigid/body_motion.h"

namespace lks {
namespace {

// tan(angle)/angle (World; up to 63°, to 10^-7 of it), by the continued fraction of the tangent.
std::int64_t tangent_over_angle(std::int64_t angle) {
    const std::int64_t square = fixed::multiply_shift(angle, angle, world_fraction_bits);
    std::int64_t level = 11 * world_one;
    for (int odd = 9; odd > 0; odd -= 2) {
        level = odd * world_one - fixed::multiply_divide(square, world_one, level);
    }
    return fixed::multiply_divide(world_one, world_one, level);
}

// n times the half turn of one of n alike substeps, over the half turn of them all: World, of |half| (Turn).
std::int64_t in_substeps(std::uint64_t half, std::int64_t n) {
    constexpr int bits = 28;
    const std::int64_t angle = fixed::angle_of(static_cast<std::int64_t>(half >> (turn_fraction_bits - bits)),
                                               std::int64_t{1} << bits);
    return fixed::multiply_divide(tangent_over_angle(angle / n), world_one, tangent_over_angle(angle));
}

} // namespace

fixed::Vec3 tick_spin(const Quaternion& from, const Quaternion& to, const StepRate& rate) {
    // Half turns, Turn to radians, World. A body turns by twice the arc tangent of its half turn in a
    // substep.
    const fixed::Vec3 half = half_turn_between(from, to);
    const std::int64_t factor = in_substeps(fixed::length(half), rate.substeps);
    const auto spin = [&](std::int64_t c) {
        const std::int64_t once = c >> (turn_fraction_bits - world_fraction_bits - 1);
        return fixed::multiply_shift(fixed::multiply_shift(once, factor, world_fraction_bits),
                                     rate.ticks_per_second, 0);
    };
    return {spin(half.x), spin(half.y), spin(half.z)};
}

} // namespace lks
