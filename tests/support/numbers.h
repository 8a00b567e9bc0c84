// Between the SDK's integers and the metres in which tests think.
#pragma once

#include <lockstitch/lockstitch.h>

#include <cmath>
#include <cstdint>

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

// A fixed sequence (splitmix64), so that a failing test fails again.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

    // low ≤ value ≤ high; high - low must be below 2^63.
    std::int64_t between(std::int64_t low, std::int64_t high) {
        const auto span = static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low) + 1;
        return static_cast<std::int64_t>(static_cast<std::uint64_t>(low) + next() % span);
    }

private:
    std::uint64_t state_;
};

} // namespace support
