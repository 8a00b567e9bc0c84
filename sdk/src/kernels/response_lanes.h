// Contacts of L::half particles with one collider: what collide/contact.cpp does with one, to the bit. What
// is far from the centre, moves by metres or is otherwise out of the ordinary is left to it.
#pragma once

#include <algorithm>
#include <bit>

#include "fixed/formats.h"
#include "kernels/leave_lanes.h"
#include "kernels/surface_lanes.h"
#include "kernels/way_share.h"

namespace lks {
namespace {

template <typename L, lks_shape_kind kind>
class ResponseLanes : NormaliseLanes<L> {
    using V = VectorLanes<L>;
    using N = NormaliseLanes<L>;
    using S = SurfaceLanes<L, kind>;
    using R = typename L::Register;
    using typename V::Halves;
    using typename V::Vector;
    using Surface = typename S::Surface;

public:
    explicit ResponseLanes(const ResponseTask& task)
        : task_(task), surface_(task), greatest_sure_depth_(L::set(greatest_sure_depth(task))),
          greatest_new_depth_(L::set(task.greatest_new_depth)) {}

    // Of particles first .. first + L::half - 1 those whose bits are set; returns the bits of those left.
    LKS_FORCE_INLINE std::uint32_t respond(std::uint32_t first, std::uint32_t near) const {
        const Vector position = load(task_.positions, first);
        const Vector start = load(task_.starts, first);
        R far = L::set(0);
        const Way way = find_way(position, start, far);
        const R wanted = L::shift_left_each(L::set(near), sign_counts());
        R left = L::and_not(L::equal(far, L::set(0)), wanted);
        R hit = L::and_not(left, wanted);
        Contact contact;
        if constexpr (kind == LKS_SHAPE_PLANE) {
            const R margin = L::set(task_.radius);
            const R height = L::subtract(way.end.y, margin);
            hit = L::bit_and(hit, height);
            contact = take_depth(L::subtract(L::set(0), height), L::subtract(margin, way.start.y));
        } else {
            // The distance changes by no more than the way is long.
            const R length_bound = L::add(L::add(V::absolute(way.motion.x), V::absolute(way.motion.y)),
                                          V::absolute(way.motion.z));
            hit = L::and_not(surface_.beyond(way.end, length_bound), hit);
            if (L::sign_bits(hit) == 0) {
                return L::sign_bits(left);
            }
            contact = trace(way, hit, left);
        }
        const R new_depth = L::subtract(contact.depth, contact.old_depth);
        left = L::bit_or(left, L::bit_and(hit, L::subtract(greatest_new_depth_, new_depth)));
        hit = L::and_not(left, hit);
        if (L::sign_bits(hit) == 0) {
            return L::sign_bits(left);
        }
        apply(way, contact, position, start, first, hit, left);
        return L::sign_bits(left);
    }

private:
    // The relative way of a particle through the substep, in the shape's frame.
    struct Way {
        Vector start, end, motion;
    };
    struct Contact {
        Vector normal; // not of planes
        R depth, old_depth;
    };

    // Up to which friction() has room.
    static std::int64_t greatest_sure_depth(const ResponseTask& task) {
        const std::int64_t coefficient =
            (std::max(task.static_friction, task.dynamic_friction) >> friction_fraction_bits) + 1;
        return (std::int64_t{1} << 60) / coefficient;
    }
    static R sign_counts() {
        static constexpr std::int64_t counts[8] = {63, 62, 61, 60, 59, 58, 57, 56};
        static_assert(L::half <= 8);
        return L::load(counts);
    }
    template <typename Pointer>
    LKS_FORCE_INLINE static Vector load(Pointer const (&axes)[3], std::uint32_t first) {
        return {L::load(axes[0] + first), L::load(axes[1] + first), L::load(axes[2] + first)};
    }
    LKS_FORCE_INLINE static Vector constant(const std::int64_t (&v)[3]) {
        return {L::set(v[0]), L::set(v[1]), L::set(v[2])};
    }

    using Matrix = std::int64_t[3][3];
    LKS_FORCE_INLINE static Vector rotate(const Matrix& m, const Vector& v) {
        const Halves x = V::halves(v.x), y = V::halves(v.y), z = V::halves(v.z);
        const auto row = [&](const std::int64_t(&r)[3]) {
            return V::dot_30(L::set(r[0]), L::set(r[1]), L::set(r[2]), x, y, z);
        };
        return {row(m[0]), row(m[1]), row(m[2])};
    }
    LKS_FORCE_INLINE static Vector rotate_back(const Matrix& m, const Vector& v) {
        const Halves x = V::halves(v.x), y = V::halves(v.y), z = V::halves(v.z);
        const auto column = [&](int c) {
            return V::dot_30(L::set(m[0][c]), L::set(m[1][c]), L::set(m[2][c]), x, y, z);
        };
        return {column(0), column(1), column(2)};
    }

    LKS_FORCE_INLINE Way find_way(const Vector& position, const Vector& start, R& far) const {
        far = L::bit_or(V::template not_within<62>(position), V::template not_within<62>(start));
        Way way;
        way.end = local(task_.end_rotation, task_.end_centre, position, far);
        way.start = local(task_.start_rotation, task_.start_centre, start, far);
        way.motion = V::subtract(way.end, way.start);
        far = L::bit_or(far, V::template not_within<59>(way.motion));
        return way;
    }
    LKS_FORCE_INLINE Vector local(const Matrix& rotation, const std::int64_t (&centre)[3], const Vector& v,
                                  R& far) const {
        if constexpr (kind == LKS_SHAPE_PLANE) {
            // Halved as in plane_local(), which this is where nothing is at its limit.
            const auto half = [](R a) { return V::template shift_down<1>(a); };
            Vector relative =
                V::subtract({half(v.x), half(v.y), half(v.z)},
                            {L::set(centre[0] >> 1), L::set(centre[1] >> 1), L::set(centre[2] >> 1)});
            far = L::bit_or(far, V::template not_within<60>(relative));
            if (task_.turned) {
                relative = rotate_back(rotation, relative);
            }
            return V::add(relative, relative);
        } else {
            const Vector relative = V::subtract(v, constant(centre));
            far = L::bit_or(far, V::template not_within<61>(relative));
            return task_.turned ? rotate_back(rotation, relative) : relative;
        }
    }

    LKS_FORCE_INLINE static R closing_of(const Surface& surface, const Vector& rest) {
        return L::subtract(L::set(0), V::dot(surface.normal, rest));
    }
    // trace() of collide/trace.h; `hit` keeps those that meet the shape.
    LKS_FORCE_INLINE Contact trace(const Way& way, R& hit, R& left) const {
        Surface nearest = surface_.nearest(way.start, hit, left);
        const R start_distance = nearest.distance;
        Vector rest = way.motion;
        R closing = closing_of(nearest, rest);
        hit = L::bit_and(L::and_not(left, hit), L::subtract(nearest.distance, closing));
        const R tolerance = L::set(task_.tolerance);
        R outside = L::bit_and(hit, L::subtract(tolerance, nearest.distance));
        for (int step = 0; step < greatest_steps && L::sign_bits(outside) != 0; ++step) {
            const R share = shares(nearest.distance, closing, L::sign_bits(outside));
            const Vector next_rest = V::subtract(rest, {V::scale_30(share, V::halves(rest.x)),
                                                        V::scale_30(share, V::halves(rest.y)),
                                                        V::scale_30(share, V::halves(rest.z))});
            const Surface next = surface_.nearest(V::subtract(way.end, next_rest), outside, left);
            rest = V::select_by_sign(rest, next_rest, outside);
            nearest = {L::select_by_sign(nearest.distance, next.distance, outside),
                       V::select_by_sign(nearest.normal, next.normal, outside)};
            closing = L::select_by_sign(closing, closing_of(next, next_rest), outside);
            hit = L::bit_and(L::and_not(left, hit), L::subtract(nearest.distance, closing));
            outside = L::bit_and(L::bit_and(hit, outside), L::subtract(tolerance, nearest.distance));
        }
        left = L::bit_or(left, outside);
        hit = L::and_not(outside, hit);
        Contact contact =
            take_depth(L::subtract(closing, nearest.distance), L::subtract(L::set(0), start_distance));
        contact.normal = nearest.normal;
        return contact;
    }
    static constexpr int greatest_steps = 40; // nearly all take fewer than 25

    static R shares(R distance, R closing, std::uint32_t wanted) {
        alignas(64) std::int64_t distances[L::half], closings[L::half], result[L::half];
        L::store(distances, distance);
        L::store(closings, closing);
        for (std::uint32_t i = 0; i < L::half; ++i) {
            result[i] = (wanted >> i & 1) != 0 ? way_share(static_cast<std::uint64_t>(distances[i]),
                                                           static_cast<std::uint64_t>(closings[i]))
                                               : 0;
        }
        return L::load(result);
    }

    LKS_FORCE_INLINE Contact take_depth(R depth, R start_depth) const {
        const R old_depth = L::minimum_signed(depth, L::maximum_signed(start_depth, L::set(0)));
        Contact contact;
        contact.old_depth = L::minimum_signed(old_depth, L::set(task_.greatest_recovery));
        contact.depth = L::subtract(depth, L::subtract(old_depth, contact.old_depth));
        return contact;
    }

    LKS_FORCE_INLINE static Vector along_normal(const Contact& contact, R size) {
        if constexpr (kind == LKS_SHAPE_PLANE) {
            return {L::set(0), size, L::set(0)};
        } else {
            return V::scale(contact.normal, size);
        }
    }

    LKS_FORCE_INLINE static R times_friction(std::uint32_t coefficient, R depth) {
        const R c = L::set(coefficient);
        const R high = L::multiply_unsigned(L::template shift_right<32>(depth), c);
        const R low =
            L::add(L::multiply_unsigned(depth, c), L::set(std::int64_t{1} << (friction_fraction_bits - 1)));
        return L::add(L::template shift_left<32 - friction_fraction_bits>(high),
                      L::template shift_right<friction_fraction_bits>(low));
    }

    // By how much it slides less.
    LKS_FORCE_INLINE Vector friction(const Way& way, const Contact& contact, R hit, R& left) const {
        const R zero = L::set(0);
        const R new_depth = L::subtract(contact.depth, contact.old_depth);
        Vector sliding = V::add(way.motion, along_normal(contact, new_depth));
        if constexpr (kind == LKS_SHAPE_PLANE) {
            sliding.y = zero;
        } else {
            sliding = V::subtract(sliding, V::scale(contact.normal, V::dot(contact.normal, sliding)));
        }
        // Nothing to do, nor to worry about.
        const R idle = L::bit_or(L::equal(new_depth, zero),
                                 L::equal(L::bit_or(L::bit_or(sliding.x, sliding.y), sliding.z), zero));
        const typename N::Unit slide = N::normalise(sliding);
        const R odd =
            L::bit_or(L::bit_or(slide.tiny, L::subtract(greatest_sure_depth_, new_depth)),
                      L::exclusive_or(L::equal(V::template not_within<59>(sliding), zero), L::set(-1)));
        left = L::bit_or(left, L::bit_and(hit, L::and_not(idle, odd)));
        const R loss = L::minimum_signed(times_friction(task_.dynamic_friction, new_depth), slide.length);
        const R slips = L::subtract(times_friction(task_.static_friction, new_depth), slide.length);
        const Vector less = V::select_by_sign(sliding, V::scale(slide.direction, loss), slips);
        return {L::and_not(idle, less.x), L::and_not(idle, less.y), L::and_not(idle, less.z)};
    }

    LKS_FORCE_INLINE void apply(const Way& way, const Contact& contact, const Vector& position,
                                const Vector& start, std::uint32_t first, R hit, R& left) const {
        Vector push = along_normal(contact, contact.depth);
        if (task_.static_friction != 0) {
            push = V::subtract(push, friction(way, contact, hit, left));
            hit = L::and_not(left, hit);
        }
        if (task_.turned) {
            push = rotate(task_.end_rotation, push);
        }
        const auto move = [](std::int64_t* axis, R from, R by, R moved) {
            const R to = V::clamp(L::add(from, by), coordinate_limit);
            L::store(axis, L::select_by_sign(from, to, moved));
        };
        move(task_.positions[0] + first, position.x, push.x, hit);
        move(task_.positions[1] + first, position.y, push.y, hit);
        move(task_.positions[2] + first, position.z, push.z, hit);
        const R recovers = L::bit_and(hit, L::subtract(L::set(0), contact.old_depth));
        if (L::sign_bits(recovers) != 0) {
            Vector recovery = along_normal(contact, contact.old_depth);
            if (task_.turned) {
                recovery = rotate(task_.end_rotation, recovery);
            }
            const auto follow = [recovers](std::int64_t* axis, R from, R by) {
                L::store(axis, L::select_by_sign(from, L::add(from, by), recovers));
            };
            follow(task_.starts[0] + first, start.x, recovery.x);
            follow(task_.starts[1] + first, start.y, recovery.y);
            follow(task_.starts[2] + first, start.z, recovery.z);
        }
    }

    const ResponseTask& task_;
    S surface_;
    R greatest_sure_depth_, greatest_new_depth_;
};

template <typename L, lks_shape_kind kind>
inline std::uint64_t respond_lanes(const ResponseTask& task, std::uint32_t first, std::uint32_t count,
                                   std::uint64_t near) {
    const ResponseLanes<L, kind> lanes(task);
    std::uint64_t left = near;
    for (std::uint32_t i = 0; i + L::half <= count; i += L::half) {
        const auto wanted = static_cast<std::uint32_t>(near >> i) & ((1u << L::half) - 1);
        if (std::popcount(wanted) >= static_cast<int>(L::worth_a_response)) {
            left &= ~(static_cast<std::uint64_t>(wanted) << i);
            left |= static_cast<std::uint64_t>(lanes.respond(first + i, wanted)) << i;
        }
    }
    return left;
}

// Two at a time: a box takes longer than two of them one by one.
template <typename L>
constexpr ResponseKernels response_lanes_but_boxes() {
    return {respond_lanes<L, LKS_SHAPE_PLANE>, respond_lanes<L, LKS_SHAPE_SPHERE>,
            respond_lanes<L, LKS_SHAPE_CAPSULE>, nullptr};
}
template <typename L>
constexpr ResponseKernels leaving_response_lanes() {
    return {leaving<L, respond_lanes<L, LKS_SHAPE_PLANE>>, leaving<L, respond_lanes<L, LKS_SHAPE_SPHERE>>,
            leaving<L, respond_lanes<L, LKS_SHAPE_CAPSULE>>, leaving<L, respond_lanes<L, LKS_SHAPE_BOX>>};
}

} // namespace
} // namespace lks
