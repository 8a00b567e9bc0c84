// Points of contacts L::half at a time: what rigid/contact.cpp, contact_rows.cpp and contact_sweep.cpp do
// with one, to the bit. What follows each other in a body, a contact or a point is read by four numbers, and
// turned into lanes.
#pragma once

#include <cstddef>

#include "kernels/contact_point_task.h"
#include "kernels/leave_lanes.h"
#include "kernels/mantissa_lanes.h"
#include "kernels/vector_lanes.h"
#include "rigid/contact.h"

namespace lks {
namespace {

template <typename L>
class ContactPointLanes : VectorLanes<L> {
    using V = VectorLanes<L>;
    using R = typename L::Register;
    using typename V::Halves;
    using typename V::Vector;
    using V::add, V::subtract, V::halves, V::dot_30, V::dot, V::scale, V::multiply_narrow;

public:
    // What both bodies and the contact say.
    LKS_FORCE_INLINE ContactPointLanes(const ContactPointTask& task, std::uint32_t first)
        : points_(task.points + first), first_(first), a_(task.a + first), b_(task.b + first),
          between_(subtract(b_.position(), a_.position())) {
        const Contact* const* const contacts = task.contacts + first;
        R columns[4];
        load<&Contact::shares>(contacts, 0, columns);
        shares_ = columns[0];
        radius_a_ = columns[1];
        radius_b_ = columns[2];
        load<&Contact::directions>(contacts, 0, columns);
        directions_[0] = {columns[0], upper(columns[0]), columns[1]};
        directions_[1] = {upper(columns[1]), columns[2], upper(columns[2])};
        R last[4];
        load<&Contact::directions>(contacts, 32, last);
        directions_[2] = {columns[3], upper(columns[3]), last[0]};
        load<&ContactPoint::core_a>(points_, 0, columns);
        load<&ContactPoint::core_a>(points_, 32, last);
        const Vector core_a{columns[0], columns[1], columns[2]};
        core_b_ = {columns[3], last[0], last[1]};
        far_ = L::bit_or(L::bit_or(V::template not_within<58>(core_a), V::template not_within<58>(core_b_)),
                         V::template not_within<60>(between_));
        from_cores_ = {a_.rotate(core_a), b_.rotate(core_b_)};
    }

    LKS_FORCE_INLINE std::uint32_t begin() const {
        const Levers levers = surfaces();
        const Vector material_a = a_.rotate_transposed(levers.a);
        const Vector material_b = b_.rotate_transposed(levers.b);
        const Vector start = distance_now(material_a, material_b);
        const Vector core_start = subtract(add(between_, from_cores_.b), from_cores_.a);
        const R separation = dot(directions_[normal_row], subtract(add(between_, levers.b), levers.a));
        store<&ContactPoint::core_a>(32, {core_b_.y, core_b_.z, separation, L::set(0)});
        store<&ContactPoint::material_a>(0, {material_a.x, material_a.y, material_a.z, material_b.x});
        store<&ContactPoint::material_a>(32, {material_b.y, material_b.z, start.x, start.y});
        store<&ContactPoint::material_a>(64, {start.z, core_start.x, core_start.y, core_start.z});
        return left(far_);
    }

    LKS_FORCE_INLINE std::uint32_t make_rows(WideRows& rows) const {
        const Starts starts = load_starts();
        const R short_by = L::subtract(gap_of(starts), L::set(near_point));
        rows.near |= L::sign_bits(short_by) << first_;
        const Levers levers = surfaces();
        put(rows.lever_a, levers.a);
        put(rows.lever_b, levers.b);
        R weights[3] = {L::set(0), L::set(0), L::set(0)};
        R far = far_;
        const Side a = make_side(a_, L::bit_and(shares_, L::set(0xffffffff)), levers.a, weights, far);
        const Side b = make_side(b_, upper(shares_), levers.b, weights, far);
        store<&ContactPoint::rows>(0, {a.pairs[0], a.pairs[1], a.pairs[2], a.pairs[3]});
        store<&ContactPoint::rows>(32, {a.pairs[4], a.pairs[5], a.pairs[6], a.pairs[7]});
        store<&ContactPoint::rows>(64, {a.pairs[8], a.pairs[9], b.pairs[0], b.pairs[1]});
        store<&ContactPoint::rows>(96, {b.pairs[2], b.pairs[3], b.pairs[4], b.pairs[5]});
        store<&ContactPoint::rows>(128, {b.pairs[6], b.pairs[7], b.pairs[8], b.pairs[9]});
        store<&ContactPoint::rows>(
            160, {invert(weights[0], far), invert(weights[1], far), invert(weights[2], far), starts.allowed});
        return left(far);
    }

    LKS_FORCE_INLINE std::uint32_t measure() const {
        const Starts starts = load_starts();
        const Vector slid = subtract(distance_now(starts.material_a, starts.material_b), starts.surfaces);
        store<&ContactPoint::allowed>(
            0, {starts.allowed, gap_of(starts), dot(directions_[1], slid), dot(directions_[2], slid)});
        return left(far_);
    }

private:
    using Row = R[4];

    // Lane by lane: four numbers from so many bytes behind the beginning of a member on.
    template <auto member, typename T>
    LKS_FORCE_INLINE static void load(T* const* from, std::size_t bytes, Row& columns) {
        L::load_rows(
            [&](std::uint32_t i) {
                return reinterpret_cast<const unsigned char*>(&(from[i]->*member)) + bytes;
            },
            columns);
    }
    template <auto member>
    LKS_FORCE_INLINE void store(std::size_t bytes, const Row& columns) const {
        L::store_rows(
            [&](std::uint32_t i) { return reinterpret_cast<unsigned char*>(&(points_[i]->*member)) + bytes; },
            columns);
    }
    LKS_FORCE_INLINE void put(std::int64_t (&to)[3][point_lanes], const Vector& v) const {
        L::store(to[0] + first_, v.x);
        L::store(to[1] + first_, v.y);
        L::store(to[2] + first_, v.z);
    }

    // Of two numbers of 32 bits: of the low one only the low half counts anyway.
    LKS_FORCE_INLINE static R upper(R pair) { return L::template shift_right<32>(pair); }
    LKS_FORCE_INLINE static R signed_lower(R pair) {
        return V::template shift_down<32>(L::template shift_left<32>(pair));
    }
    LKS_FORCE_INLINE static R pair(R low, R high) {
        return L::bit_or(L::bit_and(low, L::set(0xffffffff)), L::template shift_left<32>(high));
    }

    // Negative where it is less than this.
    LKS_FORCE_INLINE static R below(R v, std::int64_t least) { return L::subtract(v, L::set(least)); }
    LKS_FORCE_INLINE static R above(R v, std::int64_t most) { return L::subtract(L::set(most), v); }
    LKS_FORCE_INLINE std::uint32_t left(R far) const {
        const std::uint32_t within = L::sign_bits(L::equal(far, L::set(0)));
        return (~within & ((1u << L::half) - 1)) << first_;
    }

    // v / 2^count, rounded down; any v, counts up to 63.
    LKS_FORCE_INLINE static R shift_down_each(R v, R counts) {
        const R lift = L::set(INT64_MIN);
        return L::subtract(L::shift_right_each(L::exclusive_or(v, lift), counts),
                           L::shift_right_each(lift, counts));
    }
    template <int count>
    LKS_FORCE_INLINE static R shift_rounded(R v) {
        return V::template shift_down<count>(L::add(v, L::set(std::int64_t{1} << (count - 1))));
    }

    class BodyLanes {
    public:
        LKS_FORCE_INLINE explicit BodyLanes(const Body* const* bodies) : bodies_(bodies) {
            load<&Body::rotation>(bodies, 0, pairs_);
            R more[4];
            load<&Body::rotation>(bodies, 32, more);
            last_ = more[0];
        }
        LKS_FORCE_INLINE Vector position() const {
            R columns[4];
            load<&Body::position>(bodies_, 0, columns);
            return {columns[0], columns[1], columns[2]};
        }
        LKS_FORCE_INLINE Vector rotate(const Vector& v) const {
            const Halves x = halves(v.x), y = halves(v.y), z = halves(v.z);
            const R(&p)[4] = pairs_;
            return {dot_30(p[0], upper(p[0]), p[1], x, y, z), dot_30(upper(p[1]), p[2], upper(p[2]), x, y, z),
                    dot_30(p[3], upper(p[3]), last_, x, y, z)};
        }
        LKS_FORCE_INLINE Vector rotate_transposed(const Vector& v) const {
            const Halves x = halves(v.x), y = halves(v.y), z = halves(v.z);
            const R(&p)[4] = pairs_;
            return {dot_30(p[0], upper(p[1]), p[3], x, y, z), dot_30(upper(p[0]), p[2], upper(p[3]), x, y, z),
                    dot_30(p[1], upper(p[2]), last_, x, y, z)};
        }
        // The inverse inertia in world axes, xx and xy to zz.
        LKS_FORCE_INLINE void load_inverse(R (&m)[6]) const {
            R columns[4];
            load<&Body::world_inverse>(bodies_, 0, columns);
            m[0] = columns[0];
            m[1] = upper(columns[0]);
            m[2] = columns[1];
            m[3] = upper(columns[1]);
            m[4] = columns[2];
            m[5] = upper(columns[2]);
        }
        LKS_FORCE_INLINE void load_unit(R& scale, R& inverse_shift) const {
            R columns[4];
            load<&Body::scale>(bodies_, 0, columns);
            scale = signed_lower(columns[0]);
            inverse_shift = V::template shift_down<32>(columns[0]);
        }

    private:
        const Body* const* bodies_;
        R pairs_[4];
        R last_;
    };

    struct Levers {
        Vector a, b;
    };
    LKS_FORCE_INLINE Levers surfaces() const {
        const Vector& normal = directions_[normal_row];
        return {add(from_cores_.a, scale(normal, radius_a_)),
                subtract(from_cores_.b, scale(normal, radius_b_))};
    }
    LKS_FORCE_INLINE Vector distance_now(const Vector& on_a, const Vector& on_b) const {
        return subtract(add(between_, b_.rotate(on_b)), a_.rotate(on_a));
    }

    struct Starts {
        Vector material_a, material_b, surfaces, cores;
        R allowed;
    };
    LKS_FORCE_INLINE Starts load_starts() const {
        R p[4], q[4], r[4], s[4];
        load<&ContactPoint::material_a>(points_, 0, p);
        load<&ContactPoint::material_a>(points_, 32, q);
        load<&ContactPoint::material_a>(points_, 64, r);
        load<&ContactPoint::allowed>(points_, 0, s);
        return {{p[0], p[1], p[2]}, {p[3], q[0], q[1]}, {q[2], q[3], r[0]}, {r[1], r[2], r[3]}, s[0]};
    }
    LKS_FORCE_INLINE R gap_of(const Starts& starts) const {
        const Vector motion = subtract(subtract(add(between_, from_cores_.b), from_cores_.a), starts.cores);
        return L::add(dot(directions_[normal_row], motion), starts.allowed);
    }

    // As ContactRowSide stands in memory, two numbers to a lane.
    struct Side {
        R pairs[10];
    };
    // Its weights are added to; `far` where it is beyond what lanes have.
    LKS_FORCE_INLINE Side make_side(const BodyLanes& body, R share, const Vector& lever, R (&weights)[3],
                                    R& far) const {
        R scale_of_body, inverse_shift;
        body.load_unit(scale_of_body, inverse_shift);
        R m[6];
        body.load_inverse(m);
        const R resting = L::equal(share, L::set(0));
        // The lever fits into the body's unit, and everything else into 64 bits.
        const R sizes =
            L::bit_or(L::bit_or(V::absolute(lever.x), V::absolute(lever.y)), V::absolute(lever.z));
        const R unit_bits = L::add(scale_of_body, L::set(world_fraction_bits - 1));
        const R odd = L::bit_or(L::bit_or(below(scale_of_body, least_scale), above(scale_of_body, 16)),
                                L::bit_or(below(inverse_shift, -30), above(inverse_shift, 16)));
        const R beyond = L::bit_or(L::shift_right_each(sizes, unit_bits), L::bit_and(odd, L::set(INT64_MIN)));
        far = L::bit_or(far, L::and_not(resting, beyond));

        const R down = L::add(scale_of_body, L::set(world_fraction_bits - 30));
        const Vector unit{shift_down_each(lever.x, down), shift_down_each(lever.y, down),
                          shift_down_each(lever.z, down)};
        const R zero = L::set(0);
        const R right = L::maximum_signed(L::subtract(zero, inverse_shift), zero);
        const R half = L::template shift_right<1>(L::shift_left_each(L::set(1), right));
        const R up = L::maximum_signed(inverse_shift, zero);
        Side side;
        const R turn_shift = L::subtract(L::subtract(inverse_shift, scale_of_body), L::set(1));
        constexpr int arm_bits = half_turn_fraction_bits + arm_fraction_bits - 1 - world_fraction_bits;
        const R arm_shift = L::maximum_signed(L::subtract(L::set(arm_bits), scale_of_body), zero);
        side.pairs[0] = pair(turn_shift, arm_shift);
        for (int i = 0; i < 3; ++i) {
            const Vector arm = narrow_cross(unit, directions_[i]);
            const Vector turn{narrow_dot(m[0], m[1], m[2], arm), narrow_dot(m[1], m[3], m[4], arm),
                              narrow_dot(m[2], m[4], m[5], arm)};
            const R form = V::template shift_down<30>(
                L::add(L::add(L::multiply_signed(turn.x, arm.x), L::multiply_signed(turn.y, arm.y)),
                       L::multiply_signed(turn.z, arm.z)));
            const R of_share = V::template shift_down<30>(multiply_narrow(form, share));
            const R weight = L::shift_left_each(shift_down_each(L::add(of_share, half), right), up);
            weights[i] = L::add(weights[i], L::add(share, L::and_not(resting, weight)));
            const Vector kept{shift_rounded<30 - arm_fraction_bits>(arm.x),
                              shift_rounded<30 - arm_fraction_bits>(arm.y),
                              shift_rounded<30 - arm_fraction_bits>(arm.z)};
            side.pairs[3 * i + 1] = pair(kept.x, kept.y);
            side.pairs[3 * i + 2] = pair(kept.z, turn.x);
            side.pairs[3 * i + 3] = pair(turn.y, turn.z);
        }
        for (R& p : side.pairs) {
            p = L::and_not(resting, p);
        }
        return side;
    }
    static constexpr std::int64_t least_scale = 30 - world_fraction_bits;

    // As Inverse stands in memory.
    LKS_FORCE_INLINE static R invert(R weight, R& far) {
        far = L::bit_or(far, L::bit_or(L::template shift_right<47>(weight),
                                       L::bit_and(below(weight, std::int64_t{1} << 30), L::set(INT64_MIN))));
        const R zeros = L::add(
            L::bit_and(L::leading_zeros_32(L::template shift_right<16>(weight)), L::set(63)), L::set(16));
        const R m = L::template shift_right<32>(L::shift_left_each(weight, zeros));
        return pair(MantissaLanes<L>::reciprocal(m), L::subtract(L::set(64), zeros));
    }

    LKS_FORCE_INLINE static Vector narrow_cross(const Vector& u, const Vector& v) {
        const auto part = [](R p, R q, R r, R s) {
            return shift_rounded<30>(L::subtract(L::multiply_signed(p, q), L::multiply_signed(r, s)));
        };
        return {part(u.y, v.z, u.z, v.y), part(u.z, v.x, u.x, v.z), part(u.x, v.y, u.y, v.x)};
    }
    // Its low half counts.
    LKS_FORCE_INLINE static R narrow_dot(R x, R y, R z, const Vector& v) {
        return shift_rounded<30>(L::add(L::add(L::multiply_signed(x, v.x), L::multiply_signed(y, v.y)),
                                        L::multiply_signed(z, v.z)));
    }

    ContactPoint* const* points_;
    std::uint32_t first_;
    BodyLanes a_, b_;
    Vector between_;
    R shares_, radius_a_, radius_b_;
    Vector directions_[3];
    Vector core_b_;
    Levers from_cores_;
    R far_;
};

static_assert(offsetof(ContactPoint, separation) == offsetof(ContactPoint, core_a) + 48 &&
              offsetof(ContactPoint, approach) == offsetof(ContactPoint, core_a) + 56 &&
              offsetof(ContactPoint, core_start) == offsetof(ContactPoint, material_a) + 72 &&
              offsetof(ContactPoint, slip) == offsetof(ContactPoint, allowed) + 16 &&
              offsetof(ContactPoint, allowed) == offsetof(ContactPoint, rows) + sizeof(ContactRows) &&
              sizeof(ContactRowSide) == 80 && offsetof(ContactRows, inverses) == 160);
static_assert(offsetof(Contact, radius_b) == offsetof(Contact, shares) + 16);

// Of all lanes: use(lanes) returns those that are left.
template <typename L, typename Use>
LKS_FORCE_INLINE std::uint32_t in_lanes(const ContactPointTask& task, const Use& use) {
    std::uint32_t left = 0;
    for (std::uint32_t first = 0; first < task.count; first += L::half) {
        left |= use(ContactPointLanes<L>(task, first));
    }
    return left;
}

template <typename L>
inline std::uint32_t begin_point_lanes(const ContactPointTask& task) {
    return in_lanes<L>(task, [](const ContactPointLanes<L>& lanes) { return lanes.begin(); });
}

template <typename L>
inline std::uint32_t make_point_rows_lanes(const ContactPointTask& task, WideRows& rows) {
    return in_lanes<L>(task, [&](const ContactPointLanes<L>& lanes) { return lanes.make_rows(rows); });
}

template <typename L>
inline std::uint32_t measure_point_lanes(const ContactPointTask& task) {
    return in_lanes<L>(task, [](const ContactPointLanes<L>& lanes) { return lanes.measure(); });
}

template <typename L>
constexpr ContactPointKernels leaving_contact_point_lanes() {
    return {leaving<L, begin_point_lanes<L>, const ContactPointTask&>,
            leaving<L, make_point_rows_lanes<L>, const ContactPointTask&, WideRows&>,
            leaving<L, measure_point_lanes<L>, const ContactPointTask&>};
}

} // namespace
} // namespace lks
