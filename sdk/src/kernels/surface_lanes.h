// Nearest points of solid shapes over lanes: nearest_surface() and is_beyond() of collide/shape.h for points
// within 56 m of the centre.
#pragma once

#include <lockstitch/collider.h>

#include "kernels/normalise_lanes.h"
#include "kernels/response_task.h"

namespace lks {
namespace {

template <typename L, lks_shape_kind kind>
class SurfaceLanes : NormaliseLanes<L> {
    using V = VectorLanes<L>;
    using N = NormaliseLanes<L>;
    using R = typename L::Register;

public:
    using typename V::Vector;

    struct Surface {
        R distance;
        Vector normal;
    };

    explicit SurfaceLanes(const ResponseTask& task)
        : radius_(L::set(task.radius)),
          half_length_(L::set(task.half_length)), half_extents_{L::set(task.half_extents[0]),
                                                                L::set(task.half_extents[1]),
                                                                L::set(task.half_extents[2])} {}

    // Negative where the shape is further than `reach`, below 2^61, from p.
    LKS_FORCE_INLINE R beyond(const Vector& p, R reach) const {
        const Vector offset = offset_from_core(p);
        const auto square = [](R v) {
            const R coarse = L::template shift_right<32>(V::absolute(v));
            return L::multiply_unsigned(coarse, coarse);
        };
        const R far = L::add(L::template shift_right<32>(L::add(radius_, reach)), L::set(1));
        return L::subtract(L::multiply_unsigned(far, far),
                           L::add(L::add(square(offset.x), square(offset.y)), square(offset.z)));
    }

    // `left` is made negative where one of the `wanted` is to be looked at by itself.
    LKS_FORCE_INLINE Surface nearest(const Vector& p, R wanted, R& left) const {
        const Vector offset = offset_from_core(p);
        if constexpr (kind == LKS_SHAPE_BOX) {
            return nearest_of_box(p, offset, wanted, left);
        } else {
            return nearest_round(offset, wanted, left);
        }
    }

private:
    LKS_FORCE_INLINE Vector offset_from_core(const Vector& p) const {
        if constexpr (kind == LKS_SHAPE_CAPSULE) {
            return {p.x, L::subtract(p.y, V::clamp(p.y, half_length_)), p.z};
        } else if constexpr (kind == LKS_SHAPE_BOX) {
            const Vector& h = half_extents_;
            return V::subtract(p, {V::clamp(p.x, h.x), V::clamp(p.y, h.y), V::clamp(p.z, h.z)});
        } else {
            return p;
        }
    }

    LKS_FORCE_INLINE Surface nearest_round(const Vector& offset, R wanted, R& left) const {
        const typename N::Unit unit = N::normalise(offset);
        left = L::bit_or(left, L::bit_and(wanted, unit.tiny));
        return {L::subtract(length_along(unit.direction, offset), radius_), unit.direction};
    }

    LKS_FORCE_INLINE static R length_along(const Vector& u, const Vector& v) {
        const R projected = V::dot(u, v);
        const R excess =
            L::subtract(L::add(L::add(L::multiply_signed(u.x, u.x), L::multiply_signed(u.y, u.y)),
                               L::multiply_signed(u.z, u.z)),
                        L::set(std::int64_t{1} << 60));
        return L::subtract(projected, V::template shift_down<27>(
                                          V::multiply_narrow(excess, V::template shift_down<34>(projected))));
    }

    LKS_FORCE_INLINE Surface nearest_of_box(const Vector& p, const Vector& offset, R wanted, R& left) const {
        const R zero = L::set(0);
        const R no_x = L::equal(offset.x, zero), no_y = L::equal(offset.y, zero);
        const R no_z = L::equal(offset.z, zero);
        const R along_one =
            L::bit_or(L::bit_or(L::bit_and(no_x, no_y), L::bit_and(no_y, no_z)), L::bit_and(no_z, no_x));
        const R round = L::and_not(along_one, wanted);
        Surface face{L::add(L::add(V::absolute(offset.x), V::absolute(offset.y)), V::absolute(offset.z)),
                     {L::and_not(no_x, side(offset.x)), L::and_not(no_y, side(offset.y)),
                      L::and_not(no_z, side(offset.z))}};
        const R inside = L::bit_and(L::bit_and(no_x, no_y), no_z);
        if (L::sign_bits(L::bit_and(inside, wanted)) != 0) {
            const Surface within = nearest_face(p);
            face = {L::select_by_sign(face.distance, within.distance, inside),
                    V::select_by_sign(face.normal, within.normal, inside)};
        }
        face.distance = L::subtract(face.distance, radius_);
        if (L::sign_bits(round) == 0) {
            return face;
        }
        const Surface other = nearest_round(offset, round, left);
        return {L::select_by_sign(other.distance, face.distance, along_one),
                V::select_by_sign(other.normal, face.normal, along_one)};
    }
    LKS_FORCE_INLINE static R side(R v) {
        const std::int64_t one = std::int64_t{1} << 30;
        return L::select_by_sign(L::set(one), L::set(-one), v);
    }
    LKS_FORCE_INLINE Surface nearest_face(const Vector& p) const {
        const R x = L::subtract(V::absolute(p.x), half_extents_.x);
        const R y = L::subtract(V::absolute(p.y), half_extents_.y);
        const R z = L::subtract(V::absolute(p.z), half_extents_.z);
        const R not_x = L::bit_or(L::subtract(x, y), L::subtract(x, z));
        const R not_y = L::subtract(y, z);
        const R zero = L::set(0);
        const R of_x = L::select_by_sign(side(p.x), zero, not_x);
        const R of_y = L::select_by_sign(zero, L::select_by_sign(side(p.y), zero, not_y), not_x);
        const R of_z = L::select_by_sign(zero, L::select_by_sign(zero, side(p.z), not_y), not_x);
        return {L::select_by_sign(x, L::select_by_sign(y, z, not_y), not_x), {of_x, of_y, of_z}};
    }

    R radius_;
    R half_length_;
    Vector half_extents_;
};

} // namespace
} // namespace lks
