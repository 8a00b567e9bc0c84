#include "rigid/figure_momentum.h"

#include <algorithm>

#include "collide/saturation.h"
#include "rigid/figures.h"
#include "rigid/free_spin.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::Int128;
using fixed::UInt128;
using fixed::Vec3;

constexpr int sum_fraction_bits = 2 * world_fraction_bits;
constexpr int share_fraction_bits = 30;
constexpr int energy_fraction_bits = 64;

Sum3 exact_share(const Vec3& v, std::int64_t share) {
    return {fixed::multiply_signed(v.x, share), fixed::multiply_signed(v.y, share),
            fixed::multiply_signed(v.z, share)};
}

Vec3 share_of(const Vec3& v, std::int64_t share) {
    const auto part = [share](std::int64_t c) {
        return fixed::multiply_shift(c, share, share_fraction_bits);
    };
    return {part(v.x), part(v.y), part(v.z)};
}

Sum3 cross(const Vec3& a, const Vec3& b) {
    const auto m = [](std::int64_t c, std::int64_t d) { return fixed::multiply_signed(c, d); };
    return {m(a.y, b.z) - m(a.z, b.y), m(a.z, b.x) - m(a.x, b.z), m(a.x, b.y) - m(a.y, b.x)};
}

Int128 dot_product(const Vec3& a, const Vec3& b) {
    return fixed::multiply_signed(a.x, b.x) + fixed::multiply_signed(a.y, b.y) +
           fixed::multiply_signed(a.z, b.z);
}

// By a power of two.
Int128 scaled(const Int128& value, int power) {
    return power >= 0 ? value << std::min(power, 100) : value >> std::min(-power, 127);
}

int bits_of(const Int128& value) {
    return 128 - fixed::leading_zeros(fixed::abs(value));
}

std::int64_t quotient(const Int128& sum, std::uint64_t by) {
    const auto whole = static_cast<std::int64_t>(
        std::min<std::uint64_t>(fixed::divide(fixed::abs(sum), by).quotient.lo, INT64_MAX));
    return sum.hi < 0 ? -whole : whole;
}

Vec3 mean(const Sum3& sum, std::uint64_t masses) {
    return {quotient(sum.x, masses), quotient(sum.y, masses), quotient(sum.z, masses)};
}

// By the substeps of a second.
Vec3 times_rate(const Vec3& v, const MotionRate& rate) {
    const auto part = [&rate](std::int64_t c) {
        return fixed::multiply_shift(c, rate.substeps_per_second, 0);
    };
    return {part(v.x), part(v.y), part(v.z)};
}

// a / b · 2^power; b > 2^63.
std::int64_t quotient(const Int128& a, const Int128& b, int power) {
    const UInt128 magnitude = fixed::abs(a);
    if (magnitude == UInt128{0, 0}) {
        return 0;
    }
    const int up = fixed::leading_zeros(magnitude);
    const int down = bits_of(b) - 64;
    const UInt128 whole = fixed::divide(magnitude << up, (fixed::abs(b) >> down).lo).quotient;
    const int right = up + down - power;
    std::uint64_t part = 0;
    if (right <= 127) {
        part = right < 0 ? UINT64_MAX : fixed::saturate_to_uint64(whole >> right);
    }
    const auto result = static_cast<std::int64_t>(std::min<std::uint64_t>(part, INT64_MAX));
    return a.hi < 0 ? -result : result;
}

// I·ω in world axes, World, of a kilogram in its unit of length.
Vec3 own_momentum(const MassProperties& properties, const Body& body) {
    const Vec3 spin = fixed::rotate_transposed(body.rotation, body.angular_velocity);
    return fixed::rotate(body.rotation, multiply(properties.inertia, spin));
}

Sum3 spin_momentum(const Vec3& own, const MassProperties& properties, std::int64_t share) {
    const Sum3 sum = exact_share(own, share);
    const int up = sum_fraction_bits - world_fraction_bits - share_fraction_bits + 2 * properties.scale;
    return {scaled(sum.x, up), scaled(sum.y, up), scaled(sum.z, up)};
}

// A square of 80 fraction bits by a mass.
Int128 weighed(const Int128& square, std::int64_t share) {
    constexpr int down = sum_fraction_bits + share_fraction_bits - energy_fraction_bits;
    return fixed::multiply_signed(fixed::saturate_to_int64(square >> down), share);
}

// Of entries of an inertia; and how much thinner than its greatest one may be.
constexpr int entry_bits = 30;
constexpr int thinnest = 22;

// A momentum of 40 bits, in units of 2^down.
struct ShortMomentum {
    explicit ShortMomentum(const Sum3& sum)
        : down(std::max({bits_of(sum.x), bits_of(sum.y), bits_of(sum.z), 40}) - 40), x(part(sum.x)),
          y(part(sum.y)), z(part(sum.z)) {}

    Int128 sum_of(std::int64_t a, std::int64_t b, std::int64_t c) const {
        return fixed::multiply_signed(a, x) + fixed::multiply_signed(b, y) + fixed::multiply_signed(c, z);
    }

    int down;
    std::int64_t x, y, z;

private:
    std::int64_t part(const Int128& sum) const { return static_cast<std::int64_t>((sum >> down).lo); }
};

// use(index, body, mass in that of the heaviest one)
template <typename Use>
void for_each_body(const RigidScene& scene, const FigureRange& figure, const Use& use) {
    for_each_part(scene, figure, Part::body,
                  [&](std::uint32_t i) { use(i, scene.bodies[i], scene.figure_masses[i]); });
}

} // namespace

void FigureInertia::add_point(const Vec3& lever, std::int64_t share) {
    const Vec3 weighted = share_of(lever, share);
    const auto m = [](std::int64_t a, std::int64_t b) { return fixed::multiply_signed(a, b); };
    const Int128 x = m(lever.x, weighted.x);
    const Int128 y = m(lever.y, weighted.y);
    const Int128 z = m(lever.z, weighted.z);
    xx_ = xx_ + y + z;
    yy_ = yy_ + x + z;
    zz_ = zz_ + x + y;
    xy_ = xy_ - m(lever.x, weighted.y);
    xz_ = xz_ - m(lever.x, weighted.z);
    yz_ = yz_ - m(lever.y, weighted.z);
}

void FigureInertia::add_body(const SymmetricMatrix& inertia, std::int64_t share, int scale) {
    const int up = sum_fraction_bits - 2 * share_fraction_bits + 2 * scale;
    const auto add = [&](Int128& sum, std::int32_t part) {
        sum = sum + scaled(fixed::multiply_signed(part, share), up);
    };
    add(xx_, inertia.xx);
    add(xy_, inertia.xy);
    add(xz_, inertia.xz);
    add(yy_, inertia.yy);
    add(yz_, inertia.yz);
    add(zz_, inertia.zz);
}

bool FigureInertia::find_entries(Entries& entries) const {
    const int down = std::max({bits_of(xx_), bits_of(yy_), bits_of(zz_)}) - entry_bits;
    const auto part = [down](const Int128& entry) { return static_cast<std::int64_t>((entry >> down).lo); };
    if (down >= 0) {
        entries = {part(xx_), part(xy_), part(xz_), part(yy_), part(yz_), part(zz_), down};
    }
    return down >= 0;
}

Vec3 FigureInertia::spin_of(const Sum3& momentum) const {
    Entries i;
    if (!find_entries(i)) {
        return {0, 0, 0};
    }
    const Entries adjugate{i.yy * i.zz - i.yz * i.yz,
                           i.xz * i.yz - i.xy * i.zz,
                           i.xy * i.yz - i.xz * i.yy,
                           i.xx * i.zz - i.xz * i.xz,
                           i.xy * i.xz - i.xx * i.yz,
                           i.xx * i.yy - i.xy * i.xy,
                           0};
    const Int128 determinant = fixed::multiply_signed(adjugate.xx, i.xx) +
                               fixed::multiply_signed(adjugate.xy, i.xy) +
                               fixed::multiply_signed(adjugate.xz, i.xz);
    if (determinant.hi <= 0 || bits_of(determinant) < 3 * entry_bits - thinnest) {
        return {0, 0, 0};
    }
    const ShortMomentum l(momentum);
    const auto row = [&](std::int64_t a, std::int64_t b, std::int64_t c) {
        return quotient(l.sum_of(a, b, c), determinant, l.down - i.down + world_fraction_bits);
    };
    return {row(adjugate.xx, adjugate.xy, adjugate.xz), row(adjugate.xy, adjugate.yy, adjugate.yz),
            row(adjugate.xz, adjugate.yz, adjugate.zz)};
}

Vec3 FigureInertia::spin_about(const Direction& axis, const Sum3& momentum) const {
    Entries i;
    if (!find_entries(i)) {
        return {0, 0, 0};
    }
    const auto along = [&axis](std::int64_t x, std::int64_t y, std::int64_t z) {
        return axis.x * x + axis.y * y + axis.z * z;
    };
    constexpr int bits = direction_fraction_bits;
    const std::int64_t moment = along(along(i.xx, i.xy, i.xz) >> bits, along(i.xy, i.yy, i.yz) >> bits,
                                      along(i.xz, i.yz, i.zz) >> bits);
    if (moment >> (entry_bits + bits - thinnest) <= 0) {
        return {0, 0, 0};
    }
    constexpr int up = 32;
    const ShortMomentum l(momentum);
    return fixed::scale(axis, quotient(l.sum_of(axis.x, axis.y, axis.z),
                                       Int128{0, static_cast<std::uint64_t>(moment)} << up,
                                       l.down - i.down + world_fraction_bits + up));
}

FigureMomentum::FigureMomentum(const RigidScene& scene, const FigureRange& figure)
    : scene_(scene), figure_(figure), position_(figure.motion.pivot), velocity_{0, 0, 0} {
    if (figure.motion.has_pivot) {
        return;
    }
    const Body& first = scene.bodies[name_of(scene, figure)];
    Sum3 position, velocity;
    std::uint64_t masses = 0;
    for_each_body(scene, figure, [&](std::uint32_t, const Body& body, std::int64_t share) {
        position = position + exact_share(saturating_subtract(body.position, first.position), share);
        velocity = velocity + exact_share(body.velocity - first.velocity, share);
        masses += static_cast<std::uint64_t>(share);
    });
    position_ = saturating_add(first.position, mean(position, masses));
    velocity_ = saturating_add(first.velocity, mean(velocity, masses));
}

Sum3 FigureMomentum::momentum() const {
    Sum3 sum;
    for_each_body(scene_, figure_, [&](std::uint32_t i, const Body& body, std::int64_t share) {
        const MassProperties& properties = scene_.descriptions[i].properties;
        const Vec3 lever = saturating_subtract(body.position, position_);
        sum = sum + cross(share_of(lever, share), body.velocity - velocity_) +
              spin_momentum(own_momentum(properties, body), properties, share);
    });
    return sum;
}

FigureInertia FigureMomentum::inertia() const {
    FigureInertia inertia;
    for_each_body(scene_, figure_, [&](std::uint32_t i, const Body& body, std::int64_t share) {
        const MassProperties& properties = scene_.descriptions[i].properties;
        inertia.add_point(saturating_subtract(body.position, position_), share);
        inertia.add_body(rotated(properties.inertia, body.rotation), share, properties.scale);
    });
    return inertia;
}

Int128 FigureMomentum::energy() const {
    Int128 sum{0, 0};
    for_each_body(scene_, figure_, [&](std::uint32_t i, const Body& body, std::int64_t share) {
        const MassProperties& properties = scene_.descriptions[i].properties;
        const Vec3 velocity = body.velocity - velocity_;
        const Int128 spin = dot_product(own_momentum(properties, body), body.angular_velocity);
        sum = sum + weighed(dot_product(velocity, velocity), share) +
              scaled(weighed(spin, share), 2 * properties.scale);
    });
    return sum;
}

Int128 energy_of_turning(const Sum3& momentum, const Vec3& spin) {
    const auto l = [](const Int128& part) { return fixed::saturate_to_int64(part >> world_fraction_bits); };
    return dot_product({l(momentum.x), l(momentum.y), l(momentum.z)}, spin) >>
           (sum_fraction_bits - energy_fraction_bits);
}

// Where a body has been moved by d it is n·d faster:
//
//     Σ m·(r × v − (r − d) × (v − n·d)) = Σ m·d × (v − n·d − n·r)
//
// with r from the pivot, or, as Σ m·d = 0, from anywhere.
Sum3 lost_momentum(const RigidScene& scene, const FigureRange& figure, const MotionRate& rate) {
    const Vec3& origin =
        figure.motion.has_pivot ? figure.motion.pivot : scene.bodies[name_of(scene, figure)].position;
    Sum3 lost;
    for_each_body(scene, figure, [&](std::uint32_t i, const Body& body, std::int64_t share) {
        const Vec3 moved = saturating_subtract(body.position, body.predicted_position);
        const Vec3 lever = saturating_subtract(body.position, origin);
        lost = lost +
               cross(body.velocity - times_rate(saturating_add(moved, lever), rate), share_of(moved, share));
        if (!(body.orientation == body.predicted_orientation)) {
            const BodyDescription& description = scene.descriptions[i];
            lost = lost + spin_momentum(predicted_own_momentum(body, description, rate) -
                                            own_momentum(description.properties, body),
                                        description.properties, share);
        }
    });
    return lost;
}

// With g what a substep of gravity has made a velocity v, predicted, v² was 2·g·v − g² less.
Int128 work_of_gravity(const RigidScene& scene, const FigureRange& figure, const MotionRate& rate) {
    Int128 sum{0, 0};
    Sum3 moved, pull;
    std::uint64_t masses = 0;
    const auto work = [](const Vec3& gravity, const Vec3& predicted) {
        return dot_product(gravity, predicted - gravity + predicted);
    };
    for_each_body(scene, figure, [&](std::uint32_t i, const Body& body, std::int64_t share) {
        const Vec3 moved_by = saturating_subtract(body.position, body.predicted_position);
        const Vec3 predicted = saturating_subtract(body.velocity, times_rate(moved_by, rate));
        const Vec3& gravity = scene.ticks[i].gravity_step;
        sum = sum + weighed(work(gravity, predicted), share);
        moved = moved + exact_share(predicted, share);
        pull = pull + exact_share(gravity, share);
        masses += static_cast<std::uint64_t>(share);
    });
    return sum - weighed(work(mean(pull, masses), mean(moved, masses)), static_cast<std::int64_t>(masses));
}

} // namespace lks
