#include "support/numbers.h"

#include <doctest/doctest.h>

namespace support {

lks_fixed fixed(double value) {
    lks_fixed result = 0;
    REQUIRE(lks_fixed_from_double(value, &result) == LKS_OK);
    return result;
}

lks_vec3 fixed(double x, double y, double z) {
    lks_vec3 result{};
    REQUIRE(lks_vec3_from_doubles(x, y, z, &result) == LKS_OK);
    return result;
}

lks_transform at(double x, double y, double z) {
    return at(fixed(x, y, z));
}

lks_transform at(const lks_vec3& position) {
    lks_transform transform = lks_transform_identity();
    transform.position = position;
    return transform;
}

lks_transform turned(const lks_transform& transform, double axis_x, double axis_y, double axis_z,
                     double degrees) {
    lks_transform result = transform;
    REQUIRE(lks_rotation_from_axis_angle(axis_x, axis_y, axis_z, degrees, &result.rotation) == LKS_OK);
    return result;
}

} // namespace support
