// Between the SDK's integers and the metres in which tests think.
#pragma once

#include <lockstitch/lockstitch.h>

#include <cmath>
#include <cstdint>

#include "support/random.h"

namespace support {

struct Vector {
    double x = 0, y = 0, z = 0;

    Vector operator+(const Vector& other) const { return {x + other.x, y + other.y, z + other.z}; }
    Vector operator-(const Vector& other) const { return {x - other.x, y - other.y, z - other.z}; }
    Vector operator*(double factor) const { return {x * factor, y * factor, z * factor}; }
    double dot(const Vector& other) const { return x * other.x + y * other.y + z * other.z; }
    double length() const { return std::sqrt(dot(*this)); }
};

// Fails the test where the value is refused.
lks_fixed fixed(double value);
lks_vec3 fixed(double x, double y, double z);

inline double metres(lks_fixed value) {
    return std::ldexp(static_cast<double>(value), -LKS_FIXED_FRACTION_BITS);
}

// First b, then a.
inline lks_rotation product(const lks_rotation& a, const lks_rotation& b) {
    const auto sum = [](std::int64_t p, std::int64_t q, std::int64_t r, std::int64_t s) {
        return static_cast<std::int32_t>((p + q + r + s) / LKS_ROTATION_ONE);
    };
    const auto m = [](std::int64_t p, std::int64_t q) { return p * q; };
    return {sum(m(a.w, b.x), m(a.x, b.w), m(a.y, b.z), -m(a.z, b.y)),
            sum(m(a.w, b.y), m(a.y, b.w), m(a.z, b.x), -m(a.x, b.z)),
            sum(m(a.w, b.z), m(a.z, b.w), m(a.x, b.y), -m(a.y, b.x)),
            sum(m(a.w, b.w), -m(a.x, b.x), -m(a.y, b.y), -m(a.z, b.z))};
}
inline Vector metres(const lks_vec3& value) {
    return {metres(value.x), metres(value.y), metres(value.z)};
}

inline constexpr int raw_fraction_bits = 56;
inline double raw_metres(std::int64_t value) {
    return std::ldexp(static_cast<double>(value), -raw_fraction_bits);
}

inline lks_vec3 operator+(const lks_vec3& a, const lks_vec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline lks_vec3 operator-(const lks_vec3& a, const lks_vec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

inline bool same(const lks_vec3& a, const lks_vec3& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

lks_transform at(double x, double y, double z);
lks_transform at(const lks_vec3& position);
lks_transform turned(const lks_transform& transform, double axis_x, double axis_y, double axis_z,
                     double degrees);

} // namespace support
