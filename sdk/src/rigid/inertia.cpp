#include "rigid/inertia.h"

#include <lockstitch/body.h>

#include <algorithm>

#include "fixed/world_times.h"
#include "rigid/quaternion.h"

namespace lks {
namespace {

using fixed::Scaled;

// A symmetric matrix in Turn format.
struct WideMatrix {
    std::int64_t xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
};

// π to 64 bits.
Scaled pi() {
    return Scaled::from_fixed(14488038916154245685u, 62);
}

Scaled volume(const BodyShape& shape) {
    const Scaled r = world_value(shape.radius);
    const Scaled ball = pi() * r * r * r * Scaled::ratio(4, 3);
    switch (shape.kind) {
    case LKS_SHAPE_SPHERE:
        return ball;
    case LKS_SHAPE_CAPSULE:
        return ball + pi() * r * r * world_value(shape.half_length) * Scaled::from_u64(2);
    default:
        return world_value(shape.half_extents.x) * world_value(shape.half_extents.y) *
               world_value(shape.half_extents.z) * Scaled::from_u64(8);
    }
}

// World to units of 2^scale m in Turn format; |value| below a unit.
std::int64_t to_units(std::int64_t value, int scale) {
    const int shift = turn_fraction_bits - world_fraction_bits - scale; // 13 .. 31
    return fixed::wrapping_multiply(value, std::int64_t{1} << shift);
}

std::int64_t square(std::int64_t a) {
    return multiply_turn(a, a);
}

struct Diagonal {
    std::int64_t x, y, z;
};

// Of one kilogram about the shape's own axes.
Diagonal own_inertia(const BodyShape& shape, int scale) {
    const std::int64_t r = to_units(shape.radius, scale);
    switch (shape.kind) {
    case LKS_SHAPE_SPHERE: {
        const std::int64_t all = square(r) / 5 * 2;
        return {all, all, all};
    }
    case LKS_SHAPE_CAPSULE: {
        const std::int64_t h = to_units(shape.half_length, scale);
        // Shares of the mass: 3h for the cylinder to 2r for the two half balls.
        const std::int64_t whole = 3 * (h >> 4) + 2 * (r >> 4);
        const std::int64_t cylinder = fixed::multiply_divide(3 * (h >> 4), turn_one, whole);
        const std::int64_t ends = turn_one - cylinder;
        const std::int64_t ball = square(r) / 5 * 2;
        const std::int64_t along = multiply_turn(cylinder, square(r) / 2) + multiply_turn(ends, ball);
        const std::int64_t across = multiply_turn(cylinder, square(r) / 4 + square(h) / 3) +
                                    multiply_turn(ends, ball + square(h) + multiply_turn(h, r) / 4 * 3);
        return {across, along, across};
    }
    default: {
        const std::int64_t x = square(to_units(shape.half_extents.x, scale)) / 3;
        const std::int64_t y = square(to_units(shape.half_extents.y, scale)) / 3;
        const std::int64_t z = square(to_units(shape.half_extents.z, scale)) / 3;
        return {y + z, z + x, x + y};
    }
    }
}

// share · (R·diag·Rᵀ + |d|²·1 − d·dᵀ)
void add_shape(WideMatrix& sum, const BodyShape& shape, const fixed::Vec3& offset, std::int64_t share,
               int scale) {
    const Diagonal own = own_inertia(shape, scale);
    const fixed::Matrix3 r = fixed::to_matrix(shape.rotation);
    const std::int64_t d[3] = {to_units(offset.x, scale), to_units(offset.y, scale),
                               to_units(offset.z, scale)};
    const std::int64_t distance = square(d[0]) + square(d[1]) + square(d[2]);
    const auto entry = [&](int i, int j) {
        const auto term = [&](int k, std::int64_t value) {
            return multiply_turn(std::int64_t{r.m[i][k]} * r.m[j][k], value);
        };
        const std::int64_t turned = term(0, own.x) + term(1, own.y) + term(2, own.z);
        return multiply_turn(share, turned - multiply_turn(d[i], d[j]) + (i == j ? distance : 0));
    };
    sum.xx += entry(0, 0);
    sum.xy += entry(0, 1);
    sum.xz += entry(0, 2);
    sum.yy += entry(1, 1);
    sum.yz += entry(1, 2);
    sum.zz += entry(2, 2);
}

WideMatrix cofactors(const WideMatrix& m) {
    const auto minor = [](std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
        return multiply_turn(a, b) - multiply_turn(c, d);
    };
    return {minor(m.yy, m.zz, m.yz, m.yz), minor(m.xz, m.yz, m.xy, m.zz), minor(m.xy, m.yz, m.xz, m.yy),
            minor(m.xx, m.zz, m.xz, m.xz), minor(m.xy, m.xz, m.xx, m.yz), minor(m.xx, m.yy, m.xy, m.xy)};
}

std::int64_t determinant(const WideMatrix& m, const WideMatrix& cofactor) {
    return multiply_turn(m.xx, cofactor.xx) + multiply_turn(m.xy, cofactor.xy) +
           multiply_turn(m.xz, cofactor.xz);
}

// The product of the two greater principal inertias is at most a quarter of the trace squared, so this is at
// least determinant / that. Nothing turns more easily about one axis than 4096 times as easily as about all
// three together: such a rod would only spin numbers.
void thicken(WideMatrix& m) {
    // A heavy ball with a light one far away is a point in the unit that reaches them both. It turns as one
    // of a 256th of the unit: less would leave nothing of the determinant.
    constexpr std::int64_t point = turn_one >> 16;
    if (m.xx + m.yy + m.zz < 4 * point) {
        m.xx += point;
        m.yy += point;
        m.zz += point;
    }
    const std::int64_t trace = m.xx + m.yy + m.zz;
    const std::int64_t least = trace >> 12;
    const std::int64_t bound = multiply_turn(square(trace), least) / 4;
    if (determinant(m, cofactors(m)) < bound) {
        m.xx += least;
        m.yy += least;
        m.zz += least;
    }
}

std::int64_t greatest_entry(const WideMatrix& m) {
    return std::max({m.xx, m.yy, m.zz});
}

SymmetricMatrix narrowed(const WideMatrix& m) {
    const auto part = [](std::int64_t c) {
        return static_cast<std::int32_t>(fixed::shift_right_rounded(c, turn_fraction_bits - 30));
    };
    return {part(m.xx), part(m.xy), part(m.xz), part(m.yy), part(m.yz), part(m.zz)};
}

void invert_wide(const WideMatrix& m, MassProperties& out) {
    const WideMatrix cofactor = cofactors(m);
    const std::int64_t whole = std::max<std::int64_t>(determinant(m, cofactor), 2);
    // The greatest entry comes to below one half: 2^(shift + 60) · cofactor / whole < 2^59.
    int shift = 0;
    while ((greatest_entry(cofactor) >> shift) >= whole / 2) {
        ++shift;
    }
    const auto entry = [&](std::int64_t c) { return fixed::multiply_divide(c, turn_one >> shift, whole); };
    out.inverse_shift = shift;
    out.inverse_inertia = narrowed({entry(cofactor.xx), entry(cofactor.xy), entry(cofactor.xz),
                                    entry(cofactor.yy), entry(cofactor.yz), entry(cofactor.zz)});
}

// The least scale in which all shapes lie within half a unit of the centre.
std::int32_t scale_for(const BodyShape* shapes, std::uint32_t count, const fixed::Vec3& centre) {
    std::int64_t reach = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto distance = static_cast<std::int64_t>(fixed::length(shapes[i].position - centre));
        reach = std::max(reach, distance + bounding_radius(shapes[i]));
    }
    std::int32_t scale = -11;
    while (reach > (std::int64_t{1} << (world_fraction_bits + scale - 1))) {
        ++scale;
    }
    return scale;
}

} // namespace

std::int64_t bounding_radius(const BodyShape& shape) {
    if (shape.kind == LKS_SHAPE_BOX) {
        return static_cast<std::int64_t>(fixed::length(shape.half_extents)) + 1;
    }
    return shape.radius + (shape.kind == LKS_SHAPE_CAPSULE ? shape.half_length : 0);
}

MassProperties mass_properties(const BodyShape* shapes, std::uint32_t count) {
    MassProperties out{};
    Scaled masses[LKS_MAX_BODY_SHAPES];
    for (std::uint32_t i = 0; i < count; ++i) {
        masses[i] = volume(shapes[i]) * world_value(shapes[i].density);
        out.mass = out.mass + masses[i];
    }
    std::int64_t shares[LKS_MAX_BODY_SHAPES];
    for (std::uint32_t i = 0; i < count; ++i) {
        shares[i] = (masses[i] / out.mass).to_i64_fixed(turn_fraction_bits);
        const auto part = [&](std::int64_t c) {
            return fixed::multiply_shift(c, shares[i], turn_fraction_bits);
        };
        const fixed::Vec3& p = shapes[i].position;
        out.centre = out.centre + fixed::Vec3{part(p.x), part(p.y), part(p.z)};
    }
    out.scale = scale_for(shapes, count, out.centre);
    WideMatrix inertia;
    for (std::uint32_t i = 0; i < count; ++i) {
        add_shape(inertia, shapes[i], shapes[i].position - out.centre, shares[i], out.scale);
    }
    thicken(inertia);
    invert_wide(inertia, out);
    out.inertia = narrowed(inertia);
    const SymmetricMatrix& m = out.inertia;
    out.round = m.xy == 0 && m.xz == 0 && m.yz == 0 && m.xx == m.yy && m.yy == m.zz;
    return out;
}

SymmetricMatrix rotated(const SymmetricMatrix& m, const fixed::Matrix3& rotation) {
    using fixed::Direction;
    const Direction columns[3] = {{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}};
    const auto row = [&](int i) { return Direction{rotation.m[i][0], rotation.m[i][1], rotation.m[i][2]}; };
    Direction half[3]; // R·m
    for (int i = 0; i < 3; ++i) {
        half[i] = {fixed::dot(row(i), columns[0]), fixed::dot(row(i), columns[1]),
                   fixed::dot(row(i), columns[2])};
    }
    const auto entry = [&](int i, int j) { return fixed::dot(half[i], row(j)); };
    return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
}

} // namespace lks
