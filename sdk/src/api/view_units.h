// Units of views: from the formats of the state to floating-point metres.
#pragma once

#include <lockstitch/view.h>

#include <cstdint>

namespace lks {

inline constexpr double world_unit = 1.0 / 1099511627776.0;     // 2^-40
inline constexpr double coordinate_unit = world_unit / 65536.0; // 2^-56

// Q0.32, or 1 for the last tick itself.
inline double view_share(std::uint32_t interpolation) {
    return interpolation == LKS_VIEW_LAST_TICK ? 1.0 : static_cast<double>(interpolation) / 4294967296.0;
}

// Half a unit (5e-13 m) is given up, so that the difference of opposite ends of the world fits into 64 bits.
inline double relative_metres(std::int64_t position, std::int64_t view_origin) {
    return static_cast<double>((position >> 1) - (view_origin >> 1)) * (2.0 * world_unit);
}

} // namespace lks
