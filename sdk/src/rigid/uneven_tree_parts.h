// What the solver of rigid/uneven_tree.h keeps of a joint.
#pragma once

#include "fixed/vector.h"

namespace lks {

// value / pivot = value · mantissa / 2^shift.
struct FineInverse {
    std::int64_t mantissa; // 2^61 .. 2^62; 0: nothing is left to be pushed
    std::int32_t shift;
};

struct UnevenJoint {
    // W_p L_pᵀ, 40 fraction bits: what a push along each axis does to the parent.
    fixed::Vec3 column_shift[3];
    fixed::Vec3 column_turn[3];
    // D = L·diag·Lᵀ.
    std::int64_t l21;
    std::int64_t l31;
    std::int64_t l32;
    FineInverse pivots[3];
};

} // namespace lks
