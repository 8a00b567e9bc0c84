// The number formats of the solver, each with its name. docs/numbers.md has the same table with ranges and
// edges.
#pragma once

#include <cstdint>

namespace lks {

// World: lks_fixed. Metres, m/s, N·s and plain factors at the API; object origins.
inline constexpr int world_fraction_bits = 40;
inline constexpr std::int64_t world_one = std::int64_t{1} << world_fraction_bits;

// Coordinate: a particle relative to its object's origin, metres. Velocities are differences of coordinates,
// in metres a substep, in the same unit: exact.
inline constexpr int coordinate_fraction_bits = 56;
inline constexpr int coordinate_from_world_shift = coordinate_fraction_bits - world_fraction_bits;
// Exact; the value must be within ±128 m.
constexpr std::int64_t coordinate_from_world(std::int64_t value) {
    return value * (std::int64_t{1} << coordinate_from_world_shift);
}
// Rounded down.
constexpr std::int64_t world_from_coordinate(std::int64_t value) {
    return value >> coordinate_from_world_shift;
}
inline constexpr std::int64_t coordinate_one = std::int64_t{1} << coordinate_fraction_bits;
// Particles live within ±64 m of their object's origin: the difference of any two then fits into 64 bits.
inline constexpr std::int64_t coordinate_limit = (std::int64_t{1} << 62) - 1;
// 16 m: no particle moves further along an axis in one substep.
inline constexpr std::int64_t substep_motion_limit = std::int64_t{1} << 60;

// Unit: coefficients in [0, 1] (c, r, γ', s of docs/numbers.md), unsigned, 1.0 = 2^31.
inline constexpr int unit_fraction_bits = 31;
inline constexpr std::uint32_t unit_one = std::uint32_t{1} << unit_fraction_bits;

// Direction and gain: components of unit vectors and rotations, and a projection's relative correction in
// [-1, 1].
inline constexpr int direction_fraction_bits = 30;
inline constexpr std::int32_t direction_one = std::int32_t{1} << direction_fraction_bits;
// Exact.
constexpr std::int64_t world_from_direction(std::int32_t component) {
    return component * (std::int64_t{1} << (world_fraction_bits - direction_fraction_bits));
}

// World positions of origins and colliders stay within ±8,388,000 m.
inline constexpr std::int64_t world_position_limit = std::int64_t{8388000} << world_fraction_bits;

// Friction coefficients: unsigned, 18 fraction bits. The product of collider and asset is at most 100 · 100;
// whatever would not fit below 2^14 is clamped there.
inline constexpr int friction_fraction_bits = 18;

} // namespace lks
