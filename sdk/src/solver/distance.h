// The distance constraint C = |x_a − x_b| − L (XPBD eq. 18 and 26): one pass over a batch or a part of it.
//
// Positions are read as 32-bit differences, everything in between is 32 bits wide, and the correction is
// added to the positions as a product in full (docs/numbers.md):
//
// clang-format off
//     d = (x_a − x_b) >> (s + e)           32 bits, rounded; s is the batch's, e > 0 for far edges only
//     u = d·d,  y = 1/√u                   31 bits
//     f = c·(min(L·y, 2) − 1) − r·Λ·y − γ'·d·(Δx_a − Δx_b)·y²       clamped to [−1, 1]
//     x_a += d·(s_a·f),  x_b −= d·(s_b·f)  where s_a = s_b: the same product at both ends
//     x_a += (d·f)·s_a,  x_b −= (d·f)·s_b  where they differ: 32×32×32 bits
// clang-format on
//
// So momentum is kept to the bit between equal masses, and to about 2^-31 of each correction otherwise. The
// clamp is part of the method: one projection may double an edge or close it, no more. An edge of length zero
// has no direction and is left as it is. What one constraint does depends on its own two particles only.
#pragma once

#include <cstdint>

#include "asset/asset.h"
#include "solver/coefficients.h"

namespace lks {

struct DistanceArrays {
    std::int64_t* x;
    std::int64_t* y;
    std::int64_t* z;
    // At the start of the substep; read only where there is damping.
    const std::int64_t* start_x;
    const std::int64_t* start_y;
    const std::int64_t* start_z;
    // Λ by constraint in Coordinate format; null where nobody needs it.
    std::int64_t* multipliers;
};

// Constraints of one batch, which may be taken in any order and by any thread.
struct ConstraintRange {
    std::uint32_t first;
    std::uint32_t last; // one behind
};

void project_distances(const lks_asset& asset, const Coefficients& coefficients, std::uint32_t batch,
                       ConstraintRange range, const DistanceArrays& arrays);

} // namespace lks
