// How a body spins by itself: the spin of the middle of a substep, which turns it, and that at its end.
//
// Ω_mid = Ω + I⁻¹(IΩ_mid × hΩ_mid/2) in body axes, and Cayley's map of hΩ_mid, keep angular momentum and
// energy (Austin, Krishnaprasad, Wang 1993), however far it turns in a substep.
#pragma once

#include "rigid/body_motion.h"

namespace lks {

// A free spin may take any way that begins with the spins that may be given: its length is within 7/4 of the
// spin limit, √3 and a little.
bool shorten_free_spin(fixed::Vec3& spin, const MotionRate& rate);
inline bool limit_free_spin(fixed::Vec3& spin, const MotionRate& rate) {
    const auto within = [&](std::int64_t c) { return c <= rate.spin_limit && c >= -rate.spin_limit; };
    return !(within(spin.x) && within(spin.y) && within(spin.z)) && shorten_free_spin(spin, rate);
}

// A milliradian a second changes nothing in an hour; what is round spins evenly.
bool spins_evenly(const BodyDescription& description, const fixed::Vec3& spin);

// From the spin at the start of a substep that of its middle, in world axes.
fixed::Vec3 middle_spin(const Body& body, const BodyDescription& description, const MotionRate& rate);

// From that of the middle, where nothing has moved the body in the substep; `rotation` is that of its end.
fixed::Vec3 free_spin_at_end(const fixed::Vec3& middle, const fixed::Matrix3& rotation,
                             const BodyDescription& description, const MotionRate& rate);

// Of a body that was moved. Where much is added it is no more energy than the way to the predicted middle
// has taken.
fixed::Vec3 moved_spin_at_end(const Body& body, const BodyDescription& description, const MotionRate& rate);

// I·ω at the end of a substep if nothing has moved the body from where it was predicted: in world axes,
// World, of a kilogram in its unit of length. By the midpoint rule IΩ_mid + IΩ_mid × hΩ_mid/2.
fixed::Vec3 predicted_own_momentum(const Body& body, const BodyDescription& description,
                                   const MotionRate& rate);

} // namespace lks
