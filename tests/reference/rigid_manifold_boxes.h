// Two boxes of the rigid reference solver (sdk/src/collide/manifold_boxes.cpp): the axis of least overlap of
// fifteen, then one face cut to the other, or the two edges that meet.
#pragma once

#include "reference/rigid_manifold.h"

namespace reference {

// A point of the incident face over the reference face.
template <typename Scalar>
struct FacePoint {
    Scalar u, v;
    Scalar depth; // below the reference face
    std::uint32_t feature;
};

// Keeps what has sign · (u or v) ≤ extent.
template <typename Scalar>
std::vector<FacePoint<Scalar>> cut(const std::vector<FacePoint<Scalar>>& polygon, bool along_v, Scalar sign,
                                   Scalar extent, std::uint32_t side) {
    using Point = FacePoint<Scalar>;
    std::vector<Point> out;
    const auto height = [&](const Point& p) { return sign * (along_v ? p.v : p.u) - extent; };
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point& a = polygon[i];
        const Point& b = polygon[(i + 1) % polygon.size()];
        const Scalar height_a = height(a);
        const Scalar height_b = height(b);
        if (height_a <= 0) {
            out.push_back(a);
        }
        if ((height_a < 0 && height_b > 0) || (height_a > 0 && height_b < 0)) {
            const Scalar part = height_a / (height_a - height_b);
            out.push_back({a.u + (b.u - a.u) * part, a.v + (b.v - a.v) * part,
                           a.depth + (b.depth - a.depth) * part,
                           (a.feature << 8 | b.feature) * 4 + side + 64});
        }
    }
    return out;
}

// Four that span as much as all: the deepest, the one furthest from it, and the furthest from their line on
// either side.
template <typename Scalar>
std::vector<FacePoint<Scalar>> four_of(const std::vector<FacePoint<Scalar>>& polygon) {
    using Point = FacePoint<Scalar>;
    if (polygon.size() <= 4) {
        return polygon;
    }
    const auto best = [&](const auto& value) {
        return *std::max_element(polygon.begin(), polygon.end(),
                                 [&](const Point& p, const Point& q) { return value(p) < value(q); });
    };
    // In micrometres, or rather 2^-20 m, as the SDK has them: the corners of an edge that is parallel to the
    // line are equally far from it.
    const auto whole = [](Scalar length) { return std::floor(length * Scalar(0x1p20)); };
    // Of those that are next to as deep the furthest out, in units of 2^-10 m.
    const Scalar deepest = best([](const Point& p) { return p.depth; }).depth;
    const Point first = best([&](const Point& p) {
        const Scalar u = std::floor(p.u * Scalar(0x1p10));
        const Scalar v = std::floor(p.v * Scalar(0x1p10));
        return p.depth < deepest - Scalar(1e-4) ? Scalar(-1) : u * u + v * v;
    });
    const Point second = best([&](const Point& p) {
        const Scalar u = whole(p.u - first.u);
        const Scalar v = whole(p.v - first.v);
        return u * u + v * v;
    });
    const auto area = [&](const Point& p) {
        return whole(second.u - first.u) * whole(p.v - first.v) -
               whole(second.v - first.v) * whole(p.u - first.u);
    };
    const Point third = best(area);
    const Point fourth = best([&](const Point& p) { return -area(p); });
    std::vector<Point> out;
    for (const Point& p : {first, second, third, fourth}) {
        const auto same = [&](const Point& q) { return q.feature == p.feature; };
        if (std::none_of(out.begin(), out.end(), same)) {
            out.push_back(p);
        }
    }
    return out;
}

// `side` is the normal from a to b that they touched with before.
template <typename Scalar>
class TwoBoxes {
public:
    using Vec = Vector3<Scalar>;

    TwoBoxes(const Piece<Scalar>& a, const Piece<Scalar>& b, const Vec& side, Manifold<Scalar>& out)
        : a_(a), b_(b), side_(side), out_(out) {}

    void touch() {
        find_face();
        if (face_.separation <= out_.margin()) {
            find_edges();
        }
        const Separation& best = edge_a_ < 0 ? face_ : edge_;
        out_.normal = best.normal;
        if (face_.separation <= out_.margin()) {
            if (edge_a_ < 0) {
                touch_face();
            } else {
                touch_edges();
            }
        }
        out_.gap = best.separation;
    }

private:
    struct Separation {
        Vec normal; // from a to b
        Scalar separation = 0;
    };

    static Scalar half_width(const Piece<Scalar>& box, const Vec& direction) {
        const Vec local = box.axes.back(direction);
        return std::abs(local.x) * box.half_extents.x + std::abs(local.y) * box.half_extents.y +
               std::abs(local.z) * box.half_extents.z;
    }

    // Along an axis of either direction: towards b, but for what is against their side.
    Separation along(const Vec& axis) const {
        const Scalar distance = axis.dot(b_.centre - a_.centre);
        Separation found{axis, distance};
        const Vec reversed = axis * Scalar(-1);
        if (distance < 0 ? !is_against(reversed, side_) : is_against(axis, side_)) {
            found = {reversed, -distance};
        }
        found.separation -= half_width(a_, axis) + half_width(b_, axis);
        return found;
    }

    void find_face() {
        for (int i = 0; i < 6; ++i) {
            const Separation found = along(i < 3 ? a_.axes.column(i) : b_.axes.column(i - 3));
            // b's has to be clearly better, so that the choice does not flicker.
            if (i == 0 || found.separation > face_.separation + (i < 3 ? 0 : tolerance)) {
                best_face_ = i;
                face_ = found;
            }
        }
    }

    // As far as one that keeps them apart.
    void find_edges() {
        Scalar best = face_.separation + 4 * tolerance;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                const Vec way = cross(a_.axes.column(i), b_.axes.column(j));
                const Scalar sine = way.length();
                if (sine < Scalar(0.05)) {
                    continue; // meet as faces do
                }
                const Separation found = along(way * (1 / sine));
                if (found.separation > best) {
                    best = found.separation;
                    edge_a_ = i;
                    edge_b_ = j;
                    edge_ = found;
                }
                if (found.separation > out_.margin()) {
                    return;
                }
            }
        }
    }

    void touch_face() {
        const bool of_a = best_face_ < 3;
        const Piece<Scalar>& reference = of_a ? a_ : b_;
        const Piece<Scalar>& incident = of_a ? b_ : a_;
        const int k = best_face_ % 3;
        const Vec outward = of_a ? face_.normal : face_.normal * Scalar(-1);
        const int along_u = (k + 1) % 3;
        const int along_v = (k + 2) % 3;
        const Vec u = reference.axes.column(along_u);
        const Vec v = reference.axes.column(along_v);
        const Vec middle = reference.centre + outward * component(reference.half_extents, k);

        const BoxFace<Scalar> face(incident.half_extents, incident.axes.back(outward) * Scalar(-1));
        std::vector<FacePoint<Scalar>> polygon;
        for (int corner = 0; corner < 4; ++corner) {
            const auto [local, feature] = face.corner(corner == 1 || corner == 2, corner >= 2);
            const Vec from_middle = incident.at(local) - middle;
            polygon.push_back({u.dot(from_middle), v.dot(from_middle), -outward.dot(from_middle), feature});
        }
        // A little beyond the face: what lies edge upon edge keeps its corners.
        const Scalar extent_u = component(reference.half_extents, along_u) + tolerance;
        const Scalar extent_v = component(reference.half_extents, along_v) + tolerance;
        polygon = cut(polygon, false, Scalar(1), extent_u, 0);
        polygon = cut(polygon, false, Scalar(-1), extent_u, 1);
        polygon = cut(polygon, true, Scalar(1), extent_v, 2);
        polygon = cut(polygon, true, Scalar(-1), extent_v, 3);
        const auto faces = static_cast<std::uint32_t>(best_face_ * 6 + face.axis()) << 24;
        for (const FacePoint<Scalar>& p : four_of(polygon)) {
            const Vec on_reference = middle + u * p.u + v * p.v;
            const Vec on_incident = on_reference - outward * p.depth;
            out_.add(of_a ? on_reference : on_incident, of_a ? on_incident : on_reference, faces ^ p.feature);
        }
    }

    // The middle of the edge along an axis that is furthest towards a direction.
    static Vec supporting_edge(const Piece<Scalar>& box, int along, const Vec& towards) {
        const Vec local = box.axes.back(towards);
        Vec place;
        for (int i = 0; i < 3; ++i) {
            const Scalar extent = component(box.half_extents, i);
            place = place + along_axis(i, i == along                ? Scalar(0)
                                          : component(local, i) < 0 ? -extent
                                                                    : extent);
        }
        return box.at(place);
    }

    void touch_edges() {
        const Vec u = a_.axes.column(edge_a_);
        const Vec v = b_.axes.column(edge_b_);
        const Vec p = supporting_edge(a_, edge_a_, out_.normal);
        const Vec q = supporting_edge(b_, edge_b_, out_.normal * Scalar(-1));
        const Vec across = cross(u, v);
        const Scalar most_s = component(a_.half_extents, edge_a_);
        const Scalar most_t = component(b_.half_extents, edge_b_);
        const Scalar s =
            std::clamp((u.dot(v) * v.dot(p - q) - u.dot(p - q)) / across.dot(across), -most_s, most_s);
        const Scalar t = std::clamp(v.dot(p + u * s - q), -most_t, most_t);
        out_.add(p + u * s, q + v * t, 0x80000000u | static_cast<std::uint32_t>(3 * edge_a_ + edge_b_));
    }

    static constexpr Scalar tolerance = Scalar(1e-4);

    const Piece<Scalar>& a_;
    const Piece<Scalar>& b_;
    Vec side_;
    Manifold<Scalar>& out_;
    int best_face_ = 0;
    Separation face_;
    int edge_a_ = -1, edge_b_ = -1;
    Separation edge_;
};

} // namespace reference
