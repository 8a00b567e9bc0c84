// What a ragdoll's scale makes of its bones' numbers.
#pragma once

#include <lockstitch/fixed.h>

#include "fixed/int128.h"

namespace lks {

// value · scale^power: lengths 1, masses and forces 3, torques 4.
inline lks_fixed scaled(lks_fixed value, lks_fixed scale, int power = 1) {
    for (int i = 0; i < power; ++i) {
        value = fixed::multiply_divide(value, scale, LKS_FIXED_ONE);
    }
    return value;
}

} // namespace lks
