#include "rigid/free_spin.h"

#include <algorithm>
#include <bit>

#include "rigid/energy_factor.h"
#include "rigid/pair.h"

namespace lks {
namespace {

using fixed::Vec3;

// One factor in Turn format, the other and the result in any.
Vec3 cross_turn(const Vec3& a, const Vec3& b) {
    const auto m = multiply_turn;
    return {m(a.y, b.z) - m(a.z, b.y), m(a.z, b.x) - m(a.x, b.z), m(a.x, b.y) - m(a.y, b.x)};
}

std::int64_t greatest(const Vec3& v) {
    return static_cast<std::int64_t>(fixed::greatest_magnitude(v));
}

// I⁻¹(IΩ × hΩ/2), in body axes. One of the two Ω has as many more bits as there is room for: of a slender
// body about its axis, or a slow one, next to nothing would be left in 2^-40.
Vec3 gyroscopic_change(const BodyDescription& body, const Vec3& spin, const MotionRate& rate) {
    const int up = std::max(std::countl_zero(fixed::greatest_magnitude(spin)) - 6, 0);
    const std::int64_t lift = std::int64_t{1} << up;
    const Vec3 lifted{spin.x * lift, spin.y * lift, spin.z * lift};
    const Vec3 torque = cross_turn(multiply(body.properties.inertia, lifted), to_half_turn(spin, rate));
    const Vec3 change = multiply(body.properties.inverse_inertia, torque);
    const int shift = body.properties.inverse_shift - up;
    return {shifted(change.x, shift), shifted(change.y, shift), shifted(change.z, shift)};
}

bool is_great(const Vec3& change, const Vec3& spin) {
    return greatest(change) > greatest(spin) >> 2;
}

constexpr int jacobian_fraction_bits = 18;

// By rows.
struct WideMatrix3 {
    std::int64_t m[3][3];
};

// How Ω − I⁻¹(IΩ × hΩ/2) changes with Ω.
WideMatrix3 jacobian(const BodyDescription& body, const Vec3& spin, const MotionRate& rate) {
    const SymmetricMatrix& inertia = body.properties.inertia;
    const Vec3 half_turn = to_half_turn(spin, rate);
    const Vec3 momentum = multiply(inertia, half_turn);
    const int up = body.properties.inverse_shift + jacobian_fraction_bits - turn_fraction_bits;
    WideMatrix3 out{};
    for (int k = 0; k < 3; ++k) {
        const Vec3 unit{k == 0 ? turn_one : 0, k == 1 ? turn_one : 0, k == 2 ? turn_one : 0};
        const Vec3 torque = cross_turn(multiply(inertia, unit), half_turn) + cross_turn(momentum, unit);
        const Vec3 change = multiply(body.properties.inverse_inertia, torque);
        const std::int64_t column[3] = {change.x, change.y, change.z};
        for (int i = 0; i < 3; ++i) {
            const std::int64_t one = i == k ? std::int64_t{1} << jacobian_fraction_bits : 0;
            // Bodies' are below four.
            const std::int64_t most = std::int64_t{1} << (jacobian_fraction_bits + 3);
            out.m[i][k] = std::clamp(one - shifted(column[i], up), -most, most);
        }
    }
    return out;
}

// j⁻¹·v; none where j is nearly singular.
Vec3 solved(const WideMatrix3& j, const Vec3& v) {
    WideMatrix3 adjugate{};
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            const int a = (i + 1) % 3, b = (i + 2) % 3, c = (k + 1) % 3, d = (k + 2) % 3;
            adjugate.m[k][i] = j.m[a][c] * j.m[b][d] - j.m[a][d] * j.m[b][c];
        }
    }
    // 54 fraction bits, of which 20 go: what is left is below 2^46.
    std::int64_t determinant = 0;
    for (int k = 0; k < 3; ++k) {
        determinant += fixed::multiply_shift(j.m[0][k], adjugate.m[k][0], 20);
    }
    if (determinant < std::int64_t{1} << 24) {
        return {0, 0, 0};
    }
    const auto row = [&](int i) {
        const auto part = [&](int k, std::int64_t c) {
            const std::int64_t entry = fixed::multiply_divide(
                adjugate.m[i][k], std::int64_t{1} << (3 * jacobian_fraction_bits - 20), determinant);
            return fixed::multiply_shift(entry, c, 2 * jacobian_fraction_bits);
        };
        return part(0, v.x) + part(1, v.y) + part(2, v.z);
    };
    return {row(0), row(1), row(2)};
}

// Newton's method, from what has been found so far. Up to twice the spin limit, with any inertia, it needs
// six steps at most.
Vec3 change_by_newton(const BodyDescription& body, const Vec3& spin, Vec3 change, const MotionRate& rate,
                      std::int64_t enough) {
    constexpr int most_steps = 16;
    const std::int64_t furthest = 4 * rate.spin_limit;
    for (int i = 0; i < most_steps; ++i) {
        const Vec3 middle = spin + change;
        const Vec3 off = gyroscopic_change(body, middle, rate) - change;
        if (greatest(off) <= enough) {
            return change;
        }
        change = change + solved(jacobian(body, middle, rate), off);
        if (greatest(change) > furthest) {
            break;
        }
    }
    // Half of the spin, and what that adds at the end, have less energy.
    return {-(spin.x >> 1), -(spin.y >> 1), -(spin.z >> 1)};
}

// Ω_mid − Ω in body axes, by iterating on Ω_mid; by Newton's method where that takes too long.
Vec3 change_to_middle(const BodyDescription& body, const Vec3& spin, const MotionRate& rate) {
    constexpr int most_iterations = 10;
    constexpr int early = 3; // what is not within 2^-12 by then is not settled after ten
    // Nothing is left of it after an hour's substeps.
    const std::int64_t enough = (greatest(spin) >> 36) + 2;
    Vec3 change{0, 0, 0};
    for (int i = 0; i < most_iterations; ++i) {
        const Vec3 middle = spin + change;
        const Vec3 next = gyroscopic_change(body, middle, rate);
        const std::int64_t off = greatest(next - change);
        if (is_great(next, middle) || (i >= early && off > greatest(spin) >> 12)) {
            break;
        }
        change = next;
        if (off <= enough) {
            return change;
        }
    }
    return change_by_newton(body, spin, change, rate, enough);
}

fixed::Int128 energy_of(const Vec3& spin, const MassProperties& properties) {
    const Vec3 momentum = multiply(properties.inertia, spin);
    return fixed::multiply_signed(spin.x, momentum.x) + fixed::multiply_signed(spin.y, momentum.y) +
           fixed::multiply_signed(spin.z, momentum.z);
}

// Of what is left 2^-33 is lost, more than all roundings could add.
Vec3 joined(const Vec3& middle, const fixed::Matrix3& rotation, const Vec3& change) {
    return middle + fixed::rotate(rotation, change) - Vec3{middle.x >> 33, middle.y >> 33, middle.z >> 33};
}

} // namespace

bool shorten_free_spin(Vec3& spin, const MotionRate& rate) {
    const std::int64_t most = rate.spin_limit / 4 * 7;
    const auto length = static_cast<std::int64_t>(fixed::length(spin));
    if (length <= most) {
        return false;
    }
    const auto part = [&](std::int64_t c) { return fixed::multiply_divide(c, most, length + 1); };
    spin = {part(spin.x), part(spin.y), part(spin.z)};
    return true;
}

bool spins_evenly(const BodyDescription& description, const Vec3& spin) {
    return description.properties.round || greatest(spin) < std::int64_t{1} << (world_fraction_bits - 10);
}

Vec3 middle_spin(const Body& body, const BodyDescription& description, const MotionRate& rate) {
    const Vec3 spin = fixed::rotate_transposed(body.rotation, body.angular_velocity);
    return body.angular_velocity + fixed::rotate(body.rotation, change_to_middle(description, spin, rate));
}

Vec3 free_spin_at_end(const Vec3& middle, const fixed::Matrix3& rotation, const BodyDescription& description,
                      const MotionRate& rate) {
    if (spins_evenly(description, middle)) {
        return middle;
    }
    const Vec3 own = fixed::rotate_transposed(rotation, middle);
    return joined(middle, rotation, gyroscopic_change(description, own, rate));
}

Vec3 moved_spin_at_end(const Body& body, const BodyDescription& description, const MotionRate& rate) {
    const Vec3& middle = body.angular_velocity;
    if (spins_evenly(description, middle)) {
        return middle;
    }
    const Vec3 own = fixed::rotate_transposed(body.rotation, middle);
    Vec3 change = gyroscopic_change(description, own, rate);
    if (is_great(change, own)) {
        const fixed::Matrix3 rotation = fixed::to_matrix(narrow(body.predicted_orientation));
        const Vec3 predicted = fixed::rotate_transposed(rotation, body.predicted_spin);
        const fixed::Int128 allowed =
            energy_of(gyroscopic_change(description, predicted, rate), description.properties);
        const fixed::Int128 energy = energy_of(change, description.properties);
        if (energy > allowed) {
            const std::int64_t factor = energy_factor(allowed, energy);
            const auto part = [factor](std::int64_t c) {
                return fixed::multiply_shift(c, factor, factor_fraction_bits);
            };
            change = {part(change.x), part(change.y), part(change.z)};
        }
    }
    return joined(middle, body.rotation, change);
}

Vec3 predicted_own_momentum(const Body& body, const BodyDescription& description, const MotionRate& rate) {
    const fixed::Matrix3 rotation = fixed::to_matrix(narrow(body.predicted_orientation));
    const Vec3 spin = fixed::rotate_transposed(rotation, body.predicted_spin);
    const Vec3 middle = multiply(description.properties.inertia, spin);
    const bool constant = spins_evenly(description, body.predicted_spin);
    const Vec3 end = constant ? middle : middle + cross_turn(middle, to_half_turn(spin, rate));
    return fixed::rotate(rotation, end);
}

} // namespace lks
