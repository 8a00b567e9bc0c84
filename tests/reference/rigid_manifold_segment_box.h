// A point or a segment with a radius, and a box, of the rigid reference solver
// (sdk/src/collide/manifold_segment_box.cpp).
#pragma once

#include <limits>

#include "reference/rigid_manifold.h"

namespace reference {

// `side` is the normal from the segment to the box that they touched with before.
template <typename Scalar>
class SegmentAndBox {
public:
    using Vec = Vector3<Scalar>;

    SegmentAndBox(const Piece<Scalar>& segment, const Piece<Scalar>& box, const Vec& side,
                  Manifold<Scalar>& out)
        : segment_(segment), box_(box), out_(out), half_(segment.half_length),
          centre_(box.axes.back(segment.centre - box.centre)),
          direction_(box.axes.back(segment.axes.column(1))), side_(box.axes.back(side) * Scalar(-1)) {}

    void touch() {
        if (is_apart()) {
            return;
        }
        const Scalar s = nearest_place();
        const Vec excess = excess_at(s);
        int outside = 0;
        int axis = 0;
        for (int i = 0; i < 3; ++i) {
            if (component(excess, i) != 0) {
                ++outside;
                axis = i;
            }
        }
        if (outside == 0) {
            touch_face(nearest_way_out(), -half_, half_);
        } else if (outside == 1) {
            const Face face{axis, component(excess, axis) < 0 ? Scalar(-1) : Scalar(1)};
            if (is_against(face.outward(), side_)) {
                touch_face({axis, -face.sign}, -half_, half_);
            } else {
                touch_along_face(face, s);
            }
        } else {
            touch_edge(s, excess);
        }
    }

private:
    struct Face {
        int axis;
        Scalar sign;

        Vec outward() const { return along_axis(axis, sign); }
    };

    // In the box's frame.
    Vec at(Scalar s) const { return centre_ + direction_ * s; }
    Scalar extent(int i) const { return component(box_.half_extents, i); }
    Vec excess_at(Scalar s) const {
        const Vec p = at(s);
        const auto beyond = [&](int i) {
            return component(p, i) - std::clamp(component(p, i), -extent(i), extent(i));
        };
        return {beyond(0), beyond(1), beyond(2)};
    }

    // By one of the box's faces.
    bool is_apart() {
        for (int i = 0; i < 3; ++i) {
            const Scalar reach = std::abs(component(direction_, i)) * half_ + extent(i) + segment_.radius;
            const Scalar gap = std::abs(component(centre_, i)) - reach;
            const Face face{i, component(centre_, i) < 0 ? Scalar(-1) : Scalar(1)};
            if (gap - out_.margin() > Scalar(1e-6) && !is_against(face.outward(), side_)) {
                set_normal(face.outward());
                out_.gap = gap;
                return true;
            }
        }
        return false;
    }

    // The distance is convex along the segment: between the last place where it falls and the first where it
    // rises, by bisection.
    Scalar nearest_place() const {
        // Of half the squared distance; within a picometre it is level.
        const auto slope = [this](Scalar s) {
            const Scalar d = direction_.dot(excess_at(s));
            return std::abs(d) < Scalar(1e-12) ? Scalar(0) : d;
        };
        const auto last = [&](const auto& is_before) {
            if (!is_before(-half_)) {
                return -half_;
            }
            Scalar low = -half_;
            Scalar high = half_;
            for (int i = 0; i < std::numeric_limits<Scalar>::digits + 8; ++i) {
                const Scalar middle = (low + high) / 2;
                (is_before(middle) ? low : high) = middle;
            }
            return is_before(half_) ? half_ : low;
        };
        const Scalar falls = last([&](Scalar s) { return slope(s) < 0; });
        const Scalar rises = last([&](Scalar s) { return slope(s) <= 0; });
        return (falls + rises) / 2;
    }

    // The face through which the whole segment is out soonest, but for those against its side.
    Face nearest_way_out() const {
        Face best{0, 1};
        Scalar least = std::numeric_limits<Scalar>::max();
        for (int i = 0; i < 3; ++i) {
            for (const Scalar sign : {Scalar(1), Scalar(-1)}) {
                const Face face{i, sign};
                const Scalar depth =
                    extent(i) - std::min(sign * component(at(-half_), i), sign * component(at(half_), i));
                if (!is_against(face.outward(), side_) && depth < least) {
                    least = depth;
                    best = face;
                }
            }
        }
        return best;
    }

    // `outward` is from the box, in its frame.
    void set_normal(const Vec& outward) { out_.normal = box_.axes * outward * Scalar(-1); }

    void add(Scalar s, const Vec& on_box, std::uint32_t feature) {
        out_.add(segment_.centre + segment_.axes.column(1) * s, box_.at(on_box), feature);
    }

    // Of the segment: from low to high; none where low > high.
    struct Part {
        Scalar low, high;
    };

    // What of it is between the two sides of the axis.
    Part between(int i, const Part& part) const {
        const Scalar d = component(direction_, i);
        const Scalar c = component(centre_, i);
        if (d == 0) {
            return std::abs(c) <= extent(i) ? part : Part{1, 0};
        }
        const Scalar one = (-extent(i) - c) / d;
        const Scalar other = (extent(i) - c) / d;
        return {std::max(part.low, std::min(one, other)), std::min(part.high, std::max(one, other))};
    }

    Part part_over(int face_axis) const {
        const Part part = between((face_axis + 1) % 3, {-half_, half_});
        return between((face_axis + 2) % 3, part);
    }

    // The part of the segment that is over the face, which holds at least s.
    void touch_along_face(const Face& face, Scalar s) {
        const Part part = part_over(face.axis);
        if (part.low > part.high) {
            touch_face(face, s, s);
        } else {
            touch_face(face, part.low, part.high);
        }
    }

    // Nearest beyond an edge or a corner; what lies over the face beside, or along the edge, is held too.
    void touch_edge(Scalar s, const Vec& excess) {
        const Vec outward = excess * (1 / excess.length());
        set_normal(outward);
        const auto size = [&](int i) { return std::abs(component(excess, i)); };
        int greatest = 0;
        int least = 0;
        for (int i = 1; i < 3; ++i) {
            greatest = size(i) > size(greatest) ? i : greatest;
            least = size(i) < size(least) ? i : least;
        }
        // Its distance along the one normal, if its own way leans by less than 26 degrees from that.
        const auto hold = [&](Scalar place, std::uint32_t feature) {
            const Vec way = excess_at(place);
            if (outward.dot(way) > Scalar(0.9) * way.length()) {
                add(place, at(place) - way, feature);
            }
        };
        const Part over = part_over(greatest);
        if (over.low < over.high) {
            if (s <= over.low) {
                hold(over.high, 2);
            } else {
                hold(over.low, 1);
            }
        } else {
            const Part all{-half_, half_};
            const Part beside = size(least) == 0 ? between(least, all) : all;
            if (beside.low < s) {
                hold(beside.low, 1);
            }
            if (beside.high > s) {
                hold(beside.high, 2);
            }
        }
        add(s, at(s) - excess, 0);
    }

    void touch_face(const Face& face, Scalar low, Scalar high) {
        set_normal(face.outward());
        const auto touch_at = [&](Scalar s, std::uint32_t feature) {
            const Vec p = at(s);
            const Scalar height = face.sign * extent(face.axis) - component(p, face.axis);
            add(s, p + along_axis(face.axis, height), feature);
        };
        touch_at(low, 1);
        if (low != high) {
            touch_at(high, 2);
        }
    }

    const Piece<Scalar>& segment_;
    const Piece<Scalar>& box_;
    Manifold<Scalar>& out_;
    Scalar half_;
    Vec centre_, direction_, side_; // of the segment, in the box's frame
};

} // namespace reference
