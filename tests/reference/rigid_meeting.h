// Where two shapes of the rigid reference solver touch that move towards each other
// (sdk/src/rigid/meeting.h).
#pragma once

#include "reference/rigid_touch.h"

namespace reference {

template <typename Scalar>
Scalar thickness(const Piece<Scalar>& piece) {
    const Vector3<Scalar>& e = piece.half_extents;
    return piece.kind == LKS_SHAPE_PLANE ? std::numeric_limits<Scalar>::max()
           : piece.kind == LKS_SHAPE_BOX ? std::min({e.x, e.y, e.z})
                                         : piece.radius;
}

template <typename Scalar>
class Meeting {
public:
    using Vec = Vector3<Scalar>;
    using Found = Manifold<Scalar>;

    Meeting(const Piece<Scalar>& a, const Piece<Scalar>& b, const Vec& way, Scalar margin, const Vec& side)
        : a_(a), b_(b), way_(way), margin_(margin), side_(side),
          depth_(std::min(Scalar(1e-3), (thickness(a) + thickness(b)) / 4)) {}

    Found found() const {
        const Found first = at(0);
        if (!has_edges() || closing(first) <= std::max(first.gap, Scalar(0)) + overshoot) {
            return first;
        }
        const Found end = at(1);
        if (end.gap < -depth_) {
            return meeting(first);
        }
        if (closing(end) >= -overshoot) {
            return end;
        }
        Place before{0, first};
        Place behind{1, end};
        for (int step = 0; step < step_count + more_step_count; ++step) {
            Scalar next = (before.part + behind.part) / 2;
            if (step >= step_count) {
                // Something thin may be between them: the lowest place that both tangents leave.
                const Scalar fall = closing(before.found);
                const Scalar rise = -closing(behind.found);
                const Scalar drop = before.found.gap - behind.found.gap + rise * (behind.part - before.part);
                next = before.part + std::max(drop, Scalar(0)) / (fall + rise);
                const Scalar least = before.found.gap - fall * (next - before.part);
                if (least >= -depth_ || next <= before.part || next >= behind.part) {
                    return left(before.found, behind.found, first);
                }
            }
            const Place between{next, at(next)};
            if (between.found.gap < -depth_) {
                return meeting(first);
            }
            (closing(between.found) >= 0 ? before : behind) = between;
        }
        return meeting(first);
    }

private:
    bool has_edges() const {
        return b_.kind != LKS_SHAPE_PLANE && (a_.kind == LKS_SHAPE_BOX || b_.kind == LKS_SHAPE_BOX);
    }
    Scalar closing(const Found& found) const { return -found.normal.dot(way_); }

    struct Place {
        Scalar part;
        Found found;
    };

    // What still holds it before the edge, if that lets it go; else what is behind it, but for what that only
    // seems to overlap where they begin.
    Found left(const Found& before, Found behind, const Found& first) const {
        if (closing(before) <= before.gap + depth_) {
            return before;
        }
        if (first.gap >= -depth_) {
            std::erase_if(behind.points, [this](const auto& point) { return point.separation < -depth_; });
        }
        return behind;
    }

    // After this part of the way.
    Found at(Scalar part) const {
        Piece<Scalar> b = b_;
        b.centre = b.centre + way_ * part;
        Found found = touch(a_, b, margin_, side_);
        for (ManifoldPoint<Scalar>& point : found.points) {
            point.core_b = point.core_b - way_ * part;
            point.separation += closing(found) * part;
        }
        return found;
    }

    // Where the depth is reached.
    Found meeting(Found found) const {
        Scalar part = 0;
        for (int step = 0; step < step_count; ++step) {
            const Scalar room = found.gap + depth_;
            if (room <= Scalar(1e-4) || closing(found) <= room) {
                break;
            }
            part = std::min(part + room / closing(found), Scalar(1));
            found = at(part);
        }
        return found;
    }

    static constexpr Scalar overshoot = Scalar(1e-5);
    static constexpr int step_count = 8;
    static constexpr int more_step_count = 16;

    const Piece<Scalar>& a_;
    const Piece<Scalar>& b_;
    Vec way_;
    Scalar margin_;
    Vec side_;
    Scalar depth_; // what counts as none
};

} // namespace reference
