// Lengths of ready-made ragdolls.
#pragma once

#include <lockstitch/fixed.h>

#include <cstdint>

namespace lks {

constexpr lks_fixed millimetres(std::int64_t n) {
    return LKS_FIXED_RATIO(n, 1000);
}

} // namespace lks
