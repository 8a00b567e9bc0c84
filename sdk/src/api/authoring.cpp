// authoring.h: decimal numbers, angles and axes into fixed-point.
#include <lockstitch/authoring.h>

#include "api/authoring_number.h"
#include "fixed/formats.h"
#include "fixed/trigonometry.h"

namespace lks {
namespace {

constexpr std::uint64_t largest_authored_value = 8388607;
constexpr std::uint64_t largest_degrees = 36000;

// |value| <= limit is decided on the exact number, before it is rounded.
bool to_world(double value, std::uint64_t limit, std::int64_t& raw) {
    SignedScaled number;
    if (!decode_double(value, number))
        return false;
    if (number.magnitude > fixed::Scaled::from_u64(limit))
        return false;
    return to_coordinate(value, world_fraction_bits, raw);
}

bool degrees_in_range(lks_fixed degrees) {
    return fixed::magnitude(degrees) <= largest_degrees << world_fraction_bits;
}

// An axis may have any length, so its components are brought to one common exponent: the largest gets 62
// bits, the others lose at most what lies 2^-62 below it.
bool to_axis(const double (&components)[3], fixed::Vec3& axis) {
    SignedScaled number[3];
    std::int32_t top = INT32_MIN;
    for (int i = 0; i < 3; ++i) {
        if (!decode_double(components[i], number[i]))
            return false;
        if (number[i].magnitude.log2_floor() > top)
            top = number[i].magnitude.log2_floor();
    }
    if (top == INT32_MIN)
        return false;
    const auto component = [top](const SignedScaled& n) {
        return fixed::with_sign(n.magnitude.to_fixed(61 - top), n.negative);
    };
    axis = {component(number[0]), component(number[1]), component(number[2])};
    return true;
}

lks_result rotation_about(fixed::Vec3 axis, lks_fixed degrees, lks_rotation* out) {
    fixed::Rotation rotation{};
    if (!fixed::rotation_about_axis(axis, degrees, rotation))
        return LKS_ERROR_INVALID_ARGUMENT;
    *out = {rotation.x, rotation.y, rotation.z, rotation.w};
    return LKS_OK;
}

} // namespace
} // namespace lks

extern "C" {

LKS_API lks_result lks_fixed_from_double(double value, lks_fixed* out) {
    if (out == nullptr)
        return LKS_ERROR_NULL_ARGUMENT;
    return lks::to_world(value, lks::largest_authored_value, *out) ? LKS_OK : LKS_ERROR_INVALID_ARGUMENT;
}

LKS_API lks_result lks_vec3_from_doubles(double x, double y, double z, lks_vec3* out) {
    if (out == nullptr)
        return LKS_ERROR_NULL_ARGUMENT;
    lks_vec3 result{};
    const bool good = lks::to_world(x, lks::largest_authored_value, result.x) &&
                      lks::to_world(y, lks::largest_authored_value, result.y) &&
                      lks::to_world(z, lks::largest_authored_value, result.z);
    if (!good)
        return LKS_ERROR_INVALID_ARGUMENT;
    *out = result;
    return LKS_OK;
}

LKS_API lks_result lks_rotation_from_axis_angle(double axis_x, double axis_y, double axis_z, double degrees,
                                                lks_rotation* out) {
    if (out == nullptr)
        return LKS_ERROR_NULL_ARGUMENT;
    lks::fixed::Vec3 axis{};
    std::int64_t angle = 0;
    if (!lks::to_axis({axis_x, axis_y, axis_z}, axis))
        return LKS_ERROR_INVALID_ARGUMENT;
    if (!lks::to_world(degrees, lks::largest_degrees, angle))
        return LKS_ERROR_INVALID_ARGUMENT;
    return lks::rotation_about(axis, angle, out);
}

LKS_API lks_result lks_rotation_from_axis_angle_fixed(lks_vec3 axis, lks_fixed degrees, lks_rotation* out) {
    if (out == nullptr)
        return LKS_ERROR_NULL_ARGUMENT;
    if (!lks::degrees_in_range(degrees))
        return LKS_ERROR_INVALID_ARGUMENT;
    return lks::rotation_about({axis.x, axis.y, axis.z}, degrees, out);
}

LKS_API lks_result lks_sin_cos(lks_fixed degrees, lks_fixed* sine, lks_fixed* cosine) {
    if (sine == nullptr || cosine == nullptr)
        return LKS_ERROR_NULL_ARGUMENT;
    if (!lks::degrees_in_range(degrees))
        return LKS_ERROR_INVALID_ARGUMENT;
    constexpr int surplus_bits = 62 - lks::world_fraction_bits;
    const lks::fixed::SineCosine result = lks::fixed::sine_cosine(degrees, lks::world_fraction_bits);
    *sine = lks::fixed::shift_right_rounded(result.sine, surplus_bits);
    *cosine = lks::fixed::shift_right_rounded(result.cosine, surplus_bits);
    return LKS_OK;
}

LKS_API lks_transform lks_transform_identity(void) {
    return {{0, 0, 0}, {0, 0, 0, LKS_ROTATION_ONE}};
}

} // extern "C"
