// Forces from pushes.
#pragma once

#include <lockstitch/fixed.h>

#include <algorithm>

#include "fixed/vector.h"
#include "fixed/world_times.h"

namespace lks {

// value · factor with its sign, saturating.
inline lks_vec3 times(const fixed::Vec3& v, const fixed::Scaled& factor) {
    const auto part = [&](std::int64_t c) {
        return std::clamp(times(c, factor), -LKS_FIXED(8388607), LKS_FIXED(8388607));
    };
    return {part(v.x), part(v.y), part(v.z)};
}

} // namespace lks
