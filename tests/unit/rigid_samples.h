// Random places and turns of bodies.
#pragma once

#include "fixed_samples.h"
#include "rigid/quaternion.h"

namespace lks::test {

inline fixed::Vec3 any_vector(Random& random, int width) {
    return {random.any_signed(width), random.any_signed(width), random.any_signed(width)};
}

inline Quaternion any_orientation(Random& random) {
    const auto part = [&] { return static_cast<std::int32_t>(random.any_signed(30)); };
    return widen(fixed::normalise(fixed::Rotation{part(), part(), part(), part() | 1}));
}

} // namespace lks::test
