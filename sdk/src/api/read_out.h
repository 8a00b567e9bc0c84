// Forces from pushes.
#pragma once

#include <lockstitch/base.h>

#include <algorithm>

#include "fixed/formats.h"
#include "fixed/scaled.h"
#include "fixed/vector.h"

namespace lks {

// value · factor with its sign, saturating.
inline lks_vec3 times(const fixed::Vec3& v, const fixed::Scaled& factor) {
    const auto part = [&](std::int64_t c) {
        const fixed::Scaled size =
            fixed::Scaled::from_fixed(fixed::magnitude(c), world_fraction_bits) * factor;
        const std::int64_t value = std::min(size.to_i64_fixed(world_fraction_bits), LKS_FIXED(8388607));
        return c < 0 ? -value : value;
    };
    return {part(v.x), part(v.y), part(v.z)};
}

} // namespace lks
