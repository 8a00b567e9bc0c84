// Colliders in floating point: how deep a particle is in one, and the contact of the float32 twin.
//
// The method is the SDK's: a particle's way through the substep is traced in the shape's moving frame, the
// plane at the hit holds it back, an overlap that was there before is undone without speed, and friction is
// Coulomb's on positions. Colliders move without turning.
#pragma once

#include <lockstitch/lockstitch.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/xpbd.h"
#include "support/numbers.h"

namespace stability {

template <typename Scalar>
class Shape {
public:
    using Vec = reference::Vector3<Scalar>;

    // Positions are relative to `place`.
    Shape(const lks_collider_def& def, const lks_vec3& place) : kind_(def.shape) {
        const auto number = [](lks_fixed value) { return static_cast<Scalar>(support::metres(value)); };
        radius_ = number(def.radius);
        half_length_ = number(def.half_length);
        half_ = Vec(support::metres(def.half_extents));
        static_friction_ = number(def.static_friction);
        dynamic_friction_ = number(def.dynamic_friction);
        set_rotation(def.transform.rotation);
        set_place(support::metres(support::operator-(def.transform.position, place)));
    }

    // At once, and over the next tick.
    void set_place(const support::Vector& centre) { from_ = to_ = Vec(centre); }
    void move_to(const support::Vector& centre) { to_ = Vec(centre); }
    void end_tick() { from_ = to_; }

    // How far a particle of this radius is inside at the end of the tick; negative outside.
    Scalar depth(const Vec& position, Scalar particle_radius) const {
        Vec normal;
        return particle_radius - distance(to_local(position - to_), normal);
    }

    void resolve(Vec& position, Vec& start, Scalar from, Scalar to, Scalar margin, Scalar friction) const {
        const Vec end = to_local(position - (from_ + (to_ - from_) * to));
        const Vec begin = to_local(start - (from_ + (to_ - from_) * from));
        Vec normal;
        Scalar closing = 0; // along the normal, what the particle may not go beyond
        if (!trace(begin, end, margin, normal, closing)) {
            return;
        }
        Vec ignored;
        const Scalar overlap = margin - distance(begin, ignored);
        const Scalar old_depth = std::min(closing, std::max(overlap, Scalar(0)));
        const Scalar new_depth = closing - old_depth;
        Vec push = normal * closing;
        const Vec motion = end - begin + normal * new_depth;
        const Vec sliding = motion - normal * normal.dot(motion);
        const Scalar slid = sliding.length();
        if (slid > 0 && new_depth > 0) {
            const bool sticks = slid <= static_friction_ * friction * new_depth;
            push =
                push -
                sliding * (sticks ? 1 : std::min(dynamic_friction_ * friction * new_depth / slid, Scalar(1)));
        }
        position = position + to_world(push);
        if (old_depth > 0) {
            start = start + to_world(normal * old_depth);
        }
    }

private:
    void set_rotation(const lks_rotation& rotation) {
        const auto part = [](std::int32_t c) {
            return static_cast<Scalar>(static_cast<double>(c) / LKS_ROTATION_ONE);
        };
        const Scalar x = part(rotation.x), y = part(rotation.y), z = part(rotation.z), w = part(rotation.w);
        columns_[0] = {1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)};
        columns_[1] = {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)};
        columns_[2] = {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)};
    }
    Vec to_local(const Vec& v) const { return {columns_[0].dot(v), columns_[1].dot(v), columns_[2].dot(v)}; }
    Vec to_world(const Vec& v) const { return columns_[0] * v.x + columns_[1] * v.y + columns_[2] * v.z; }

    // To the surface, negative inside, and the way out.
    Scalar distance(const Vec& p, Vec& normal) const {
        if (kind_ == LKS_SHAPE_PLANE) {
            normal = {0, 1, 0};
            return p.y;
        }
        if (kind_ == LKS_SHAPE_BOX) {
            return distance_from_box(p, normal);
        }
        const Scalar along = kind_ == LKS_SHAPE_CAPSULE ? std::clamp(p.y, -half_length_, half_length_) : 0;
        const Vec out{p.x, p.y - along, p.z};
        const Scalar length = out.length();
        normal = length > 0 ? out * (1 / length) : Vec{1, 0, 0};
        return length - radius_;
    }

    Scalar distance_from_box(const Vec& p, Vec& normal) const {
        const Vec nearest{std::clamp(p.x, -half_.x, half_.x), std::clamp(p.y, -half_.y, half_.y),
                          std::clamp(p.z, -half_.z, half_.z)};
        const Vec out = p - nearest;
        const Scalar length = out.length();
        if (length > 0) {
            normal = out * (1 / length);
            return length;
        }
        const Scalar x = half_.x - std::abs(p.x), y = half_.y - std::abs(p.y), z = half_.z - std::abs(p.z);
        const auto sign = [](Scalar value) { return value < 0 ? Scalar(-1) : Scalar(1); };
        if (x <= y && x <= z) {
            normal = {sign(p.x), 0, 0};
            return -x;
        }
        if (y <= z) {
            normal = {0, sign(p.y), 0};
            return -y;
        }
        normal = {0, 0, sign(p.z)};
        return -z;
    }

    // The way from an outside start until it meets the shape, by the planes through the nearest points; from
    // an inside one, the nearest way out of its end.
    bool trace(const Vec& begin, const Vec& end, Scalar margin, Vec& normal, Scalar& depth) const {
        Vec here = begin;
        // What the numbers can tell apart there.
        const Scalar tolerance = std::max(Scalar(1e-6), 8 * std::numeric_limits<Scalar>::epsilon() *
                                                            (begin.length() + end.length()));
        for (int i = 0; i < 64; ++i) {
            const Scalar gap = distance(here, normal) - margin;
            const Scalar closing = -normal.dot(end - here);
            if (i == 0 && gap < -tolerance) {
                depth = margin - distance(end, normal);
                return depth > 0;
            }
            if (closing <= gap) {
                return false;
            }
            if (gap < tolerance) {
                depth = closing - gap;
                return true;
            }
            here = here + (end - here) * (gap / closing);
        }
        return false;
    }

    std::uint32_t kind_;
    Scalar radius_, half_length_;
    Vec half_;
    Scalar static_friction_, dynamic_friction_;
    Vec columns_[3];
    Vec from_, to_;
};

} // namespace stability
