#include "api/object_checks.h"

namespace lks {
namespace {

constexpr lks_fixed greatest_gravity_factor = LKS_FIXED(100);
constexpr lks_fixed greatest_linear_damping = LKS_FIXED(1000);

} // namespace

bool gravity_factor_is_valid(lks_fixed factor) {
    return within(factor, greatest_gravity_factor);
}

bool linear_damping_is_valid(lks_fixed damping) {
    return damping >= 0 && damping <= greatest_linear_damping;
}

lks_result check_gravity_factor(const lks_world& world, lks_fixed factor) {
    if (gravity_factor_is_valid(factor)) {
        return LKS_OK;
    }
    return world.fail(
        LKS_ERROR_INVALID_ARGUMENT,
        out_of_range("gravity factor", factor, "", -greatest_gravity_factor, greatest_gravity_factor));
}

lks_result check_linear_damping(const lks_world& world, lks_fixed damping) {
    if (linear_damping_is_valid(damping)) {
        return LKS_OK;
    }
    return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                      out_of_range("linear damping", damping, " 1/s", 0, greatest_linear_damping));
}

} // namespace lks
