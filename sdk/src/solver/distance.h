// The distance constraint C = |x_a − x_b| − L (XPBD eq. 18 and 26): one pass over batches or a part of one.
//
// Positions are read as 32-bit differences, everything in between is 32 bits wide, and the correction is
// added to the positions as a product in full (docs/numbers.md):
//
// clang-format off
//     d = (x_a − x_b) >> (s + e)           31 bits, rounded; s is the batch's, e > 0 for far edges only
//     u = d·d,  y = 1/√u                   fixed/projection_reciprocal_sqrt.h
//     f = c·(min(L·y, 2) − 1) − r·Λ·y − γ'·d·(d − d_start)·y²       within [−1, 1]
//     x_a += d·(s·f),  x_b −= d·(s·f)      where both ends have the same share s
//     q = d·((s_a + s_b)·f),  q_b = q·ρ,  x_a += q − q_b,  x_b −= q_b       ρ = s_b/(s_a + s_b), elsewhere
// clang-format on
//
// So momentum is kept to the bit between equal masses, and to about 2^-31 of each correction otherwise: what
// q was rounded to is shared out whole. The clamp is part of the method: one projection may double an edge or
// close it, no more. An edge of length zero has no direction and is left as it is. kernels/distance_scalar.h
// is the specification to the bit. What one constraint does depends on its own two particles only.
#pragma once

#include <cstdint>

#include "asset/asset.h"
#include "kernels/kernels.h"
#include "solver/coefficients.h"

namespace lks {

// What kernels have to know for one pass over an object's constraints.
struct DistanceWork {
    void set_allocator(const lks_allocator& allocator);
    // Room for an asset of so many batches. False: no memory.
    [[nodiscard]] bool reserve(std::size_t batches);

    Array<BatchPart> parts;    // by batch
    Array<DistanceTask> tasks; // as many batches of one family together as can be, in order
};

// Made once a tick: what a kernel reads was then stored long ago, and does not hold it up. There must be
// room.
void prepare_distances(const lks_asset& asset, const Coefficients& coefficients, const DistanceArrays& arrays,
                       bool in_rows, DistanceWork& work);
// The first batch of one of its tasks.
inline std::uint32_t first_batch(const DistanceTask& task, const DistanceWork& work) {
    return static_cast<std::uint32_t>(task.parts - work.parts.data());
}
// Some constraints of a batch.
BatchPart part_of_batch(const BatchPart& whole, const lks_asset& asset, std::uint32_t batch,
                        ConstraintRange range);

} // namespace lks
