// Two boxes: the axis of least overlap of fifteen (Gottschalk, Lin, Manocha 1996), then the incident face cut
// to the reference face, or the two edges that meet.
#include <algorithm>
#include <cstdlib>

#include "collide/manifold.h"
#include "fixed/formats.h"

namespace lks::manifold_detail {
namespace {

using fixed::Direction;
using fixed::Vec3;

// A tenth of a millimetre.
constexpr std::int64_t tolerance = world_one / 10000;

struct Corner {
    std::int64_t u, v;  // in the reference face
    std::int64_t depth; // below it, negative above
    std::uint32_t feature;
};

// A face that eight corners are cut from at most: four, and one more for each side that cuts.
struct Polygon {
    std::uint32_t count = 0;
    Corner corners[8];

    void add(const Corner& corner) {
        if (count < 8) {
            corners[count++] = corner;
        }
    }
};

// Keeps what has sign · (u or v) ≤ extent.
Polygon cut(const Polygon& from, bool along_v, std::int64_t sign, std::int64_t extent, std::uint32_t side) {
    Polygon out;
    const auto height = [&](const Corner& c) { return sign * (along_v ? c.v : c.u) - extent; };
    for (std::uint32_t i = 0; i < from.count; ++i) {
        const Corner& a = from.corners[i];
        const Corner& b = from.corners[(i + 1) % from.count];
        const std::int64_t height_a = height(a);
        const std::int64_t height_b = height(b);
        if (height_a <= 0) {
            out.add(a);
        }
        if ((height_a < 0 && height_b > 0) || (height_a > 0 && height_b < 0)) {
            const auto between = [&](std::int64_t p, std::int64_t q) {
                return p + fixed::multiply_divide(q - p, -height_a, height_b - height_a);
            };
            Corner met{between(a.u, b.u), between(a.v, b.v), between(a.depth, b.depth),
                       (a.feature << 8 | b.feature) * 4 + side + 64};
            out.add(met);
        }
    }
    return out;
}

// In units of 2^-20 m, so that areas fit.
std::int64_t area(const Corner& a, const Corner& b, const Corner& c) {
    constexpr int down = world_fraction_bits - 20;
    return ((b.u - a.u) >> down) * ((c.v - a.v) >> down) - ((b.v - a.v) >> down) * ((c.u - a.u) >> down);
}

std::int64_t squared_distance(const Corner& a, const Corner& b) {
    constexpr int down = world_fraction_bits - 20;
    const std::int64_t u = (b.u - a.u) >> down;
    const std::int64_t v = (b.v - a.v) >> down;
    return u * u + v * v;
}

// From the middle of the face, in units of 2^-10 m: of corners that are a hair further out than others the
// first is as far.
std::int64_t squared_distance_out(const Corner& p) {
    constexpr int down = world_fraction_bits - 10;
    return (p.u >> down) * (p.u >> down) + (p.v >> down) * (p.v >> down);
}

// Four that span as much as all: the deepest, the one furthest from it, and the furthest from their line on
// either side. Of those that are next to as deep the furthest out, so that boxes at rest keep their four from
// tick to tick: what others have pushed would be forgotten.
void reduce(Polygon& polygon) {
    if (polygon.count <= greatest_point_count) {
        return;
    }
    const Corner* const c = polygon.corners;
    const auto best = [&](const auto& value) {
        std::uint32_t found = 0;
        for (std::uint32_t i = 1; i < polygon.count; ++i) {
            found = value(c[i]) > value(c[found]) ? i : found;
        }
        return found;
    };
    const std::int64_t deepest = c[best([](const Corner& p) { return p.depth; })].depth;
    const Corner first = c[best(
        [&](const Corner& p) { return p.depth < deepest - tolerance ? -1 : squared_distance_out(p); })];
    const Corner second = c[best([&](const Corner& p) { return squared_distance(first, p); })];
    const Corner third = c[best([&](const Corner& p) { return area(first, second, p); })];
    const Corner fourth = c[best([&](const Corner& p) { return -area(first, second, p); })];
    Polygon out;
    for (const Corner& p : {first, second, third, fourth}) {
        bool known = false;
        for (std::uint32_t i = 0; i < out.count; ++i) {
            known = known || out.corners[i].feature == p.feature;
        }
        if (!known) {
            out.add(p);
        }
    }
    polygon = out;
}

class Boxes {
public:
    Boxes(const Piece& a, const Piece& b, std::int64_t margin, const Direction& side, Manifold& out)
        : a_(a), b_(b), margin_(margin), side_(side), out_(out), offset_(b.centre - a.centre) {
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                cosines_[i][j] = fixed::dot(axis(a.axes, i), axis(b.axes, j));
            }
        }
    }

    void run() {
        find_faces();
        if (face_separation_ <= margin_) {
            find_edges();
        }
        const bool faces = best_edge_ < 0;
        out_.normal = faces ? face_normal_ : edge_normal_;
        if (face_separation_ <= margin_) {
            if (faces) {
                touch_face();
            } else {
                touch_edges();
            }
        }
        out_.gap = faces ? face_separation_ : edge_separation_;
    }

private:
    static std::int64_t extent(const Piece& box, int i) { return fixed::component(box.half_extents, i); }

    // Half the width of a box along a direction that has these cosines with its axes.
    static std::int64_t width(const Piece& box, std::int32_t x, std::int32_t y, std::int32_t z) {
        const auto part = [](std::int32_t c, std::int64_t e) {
            return fixed::scale_component(c < 0 ? -c : c, e);
        };
        return part(x, box.half_extents.x) + part(y, box.half_extents.y) + part(z, box.half_extents.z);
    }

    // Whether the normal along an axis is the axis reversed: from a to b, or as it was.
    bool points_back(const Direction& along, std::int64_t distance) const {
        return distance < 0 ? !against(-along, side_) : against(along, side_);
    }

    void find_faces() {
        for (int i = 0; i < 6; ++i) {
            const bool of_a = i < 3;
            const int k = i % 3;
            const Direction normal = axis(of_a ? a_.axes : b_.axes, k);
            const std::int64_t distance = fixed::dot(normal, offset_);
            const std::int64_t other = of_a ? width(b_, cosines_[k][0], cosines_[k][1], cosines_[k][2])
                                            : width(a_, cosines_[0][k], cosines_[1][k], cosines_[2][k]);
            const bool back = points_back(normal, distance);
            const std::int64_t separation = (back ? -distance : distance) - extent(of_a ? a_ : b_, k) - other;
            // The other box's face has to be clearly better, so that the choice does not flicker.
            if (best_face_ < 0 || separation > face_separation_ + (of_a ? 0 : tolerance)) {
                best_face_ = i;
                face_separation_ = separation;
                face_normal_ = back ? -normal : normal; // from a to b
            }
        }
    }

    // As far as one that keeps them apart.
    void find_edges() {
        std::int64_t best = face_separation_ + 4 * tolerance;
        const Vec3 offset = fixed::rotate_transposed(a_.axes, offset_);
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                const std::int64_t most = overlap_along_edges(offset, i, j) + tolerance;
                if (most < 0 && most <= best) {
                    continue;
                }
                const Direction u = axis(a_.axes, i);
                const Direction v = axis(b_.axes, j);
                // Edges within 3° of each other meet as faces do.
                fixed::NormalisedVector way{};
                if (!fixed::normalise(fixed::cross(u, v), way) || way.length < (std::int64_t{1} << 60) / 20) {
                    continue;
                }
                const Direction& n = way.direction;
                const std::int64_t distance = fixed::dot(n, offset_);
                const Direction in_a = fixed::rotate_transposed(a_.axes, n);
                const Direction in_b = fixed::rotate_transposed(b_.axes, n);
                const bool back = points_back(n, distance);
                const std::int64_t separation = (back ? -distance : distance) -
                                                width(a_, in_a.x, in_a.y, in_a.z) -
                                                width(b_, in_b.x, in_b.y, in_b.z);
                if (separation > best) {
                    best = separation;
                    best_edge_ = 3 * i + j;
                    edge_separation_ = separation;
                    edge_normal_ = back ? -n : n;
                }
                if (separation > margin_) {
                    return;
                }
            }
        }
    }

    // The separation along u×v as it is, no unit vector: where negative, the true one is no greater. `offset`
    // is in the axes of a.
    std::int64_t overlap_along_edges(const Vec3& offset, int i, int j) const {
        const int i1 = (i + 1) % 3;
        const int i2 = (i + 2) % 3;
        const std::int64_t t[3] = {offset.x, offset.y, offset.z};
        const std::int64_t distance =
            fixed::scale_component(cosines_[i1][j], t[i2]) - fixed::scale_component(cosines_[i2][j], t[i1]);
        const auto part = [](std::int32_t c, std::int64_t e) {
            return fixed::scale_component(c < 0 ? -c : c, e);
        };
        return std::abs(distance) - part(cosines_[i2][j], extent(a_, i1)) -
               part(cosines_[i1][j], extent(a_, i2)) -
               part(cosines_[i][(j + 2) % 3], extent(b_, (j + 1) % 3)) -
               part(cosines_[i][(j + 1) % 3], extent(b_, (j + 2) % 3));
    }

    void touch_face() {
        const bool of_a = best_face_ < 3;
        const Piece& reference = of_a ? a_ : b_;
        const Piece& incident = of_a ? b_ : a_;
        const int k = best_face_ % 3;
        const Direction outward = of_a ? face_normal_ : -face_normal_;
        out_.normal = face_normal_;

        // The incident face: the one that looks most against the reference face.
        const Direction local = fixed::rotate_transposed(incident.axes, outward);
        const std::int32_t parts[3] = {local.x, local.y, local.z};
        int face = 0;
        for (int i = 1; i < 3; ++i) {
            face = fixed::magnitude(parts[i]) > fixed::magnitude(parts[face]) ? i : face;
        }
        const bool positive_face = parts[face] < 0;
        const int along_u = (k + 1) % 3;
        const int along_v = (k + 2) % 3;
        const Direction axis_u = axis(reference.axes, along_u);
        const Direction axis_v = axis(reference.axes, along_v);

        Polygon polygon;
        for (std::uint32_t corner = 0; corner < 4; ++corner) {
            const bool first = corner == 1 || corner == 2;
            const bool second = corner >= 2;
            std::int64_t place[3];
            place[face] = positive_face ? extent(incident, face) : -extent(incident, face);
            const int p = (face + 1) % 3;
            const int q = (face + 2) % 3;
            place[p] = first ? extent(incident, p) : -extent(incident, p);
            place[q] = second ? extent(incident, q) : -extent(incident, q);
            const Vec3 world = incident.centre - reference.centre +
                               fixed::rotate(incident.axes, Vec3{place[0], place[1], place[2]});
            const std::uint32_t feature =
                (first ? 1u << p : 0u) | (second ? 1u << q : 0u) | (positive_face ? 1u << face : 0u);
            polygon.add({fixed::dot(axis_u, world), fixed::dot(axis_v, world),
                         extent(reference, k) - fixed::dot(outward, world), feature});
        }
        // A little beyond the face: what lies edge upon edge, but for roundings, keeps its corners. Cut off
        // by a hair, an edge would have one anywhere.
        const std::int64_t extent_u = extent(reference, along_u) + tolerance;
        const std::int64_t extent_v = extent(reference, along_v) + tolerance;
        polygon = cut(polygon, false, 1, extent_u, 0);
        polygon = cut(polygon, false, -1, extent_u, 1);
        polygon = cut(polygon, true, 1, extent_v, 2);
        polygon = cut(polygon, true, -1, extent_v, 3);
        reduce(polygon);
        const std::uint32_t side = static_cast<std::uint32_t>(best_face_ * 6 + face) << 24;
        for (std::uint32_t i = 0; i < polygon.count; ++i) {
            const Corner& c = polygon.corners[i];
            const Vec3 on_reference = reference.centre + fixed::scale(axis_u, c.u) +
                                      fixed::scale(axis_v, c.v) + fixed::scale(outward, extent(reference, k));
            const Vec3 on_incident = on_reference - fixed::scale(outward, c.depth);
            add_point(out_, of_a ? on_reference : on_incident, of_a ? on_incident : on_reference, 0, margin_,
                      side ^ c.feature);
        }
    }

    // The middle of the edge of a box that is furthest along a direction, and lies along one of its axes.
    static Vec3 supporting_edge(const Piece& box, int along, const Direction& towards) {
        const Direction local = fixed::rotate_transposed(box.axes, towards);
        const std::int32_t parts[3] = {local.x, local.y, local.z};
        std::int64_t place[3];
        for (int i = 0; i < 3; ++i) {
            place[i] = i == along ? 0 : parts[i] < 0 ? -extent(box, i) : extent(box, i);
        }
        return box.centre + fixed::rotate(box.axes, Vec3{place[0], place[1], place[2]});
    }

    void touch_edges() {
        const int i = best_edge_ / 3;
        const int j = best_edge_ % 3;
        out_.normal = edge_normal_;
        const Direction u = axis(a_.axes, i);
        const Direction v = axis(b_.axes, j);
        const Vec3 p = supporting_edge(a_, i, edge_normal_);
        const Vec3 q = supporting_edge(b_, j, -edge_normal_);
        const Vec3 r = p - q;
        const std::int32_t cosine = cosines_[i][j];
        const std::int64_t sine_squared =
            std::max<std::int64_t>(direction_one - ((std::int64_t{cosine} * cosine) >> 30), 1);
        const std::int64_t along_a = fixed::dot(u, r);
        const std::int64_t along_b = fixed::dot(v, r);
        const std::int64_t s =
            std::clamp(fixed::multiply_divide(fixed::scale_component(cosine, along_b) - along_a,
                                              direction_one, sine_squared),
                       -extent(a_, i), extent(a_, i));
        const std::int64_t t =
            std::clamp(fixed::scale_component(cosine, s) + along_b, -extent(b_, j), extent(b_, j));
        add_point(out_, p + fixed::scale(u, s), q + fixed::scale(v, t), 0, margin_,
                  0x80000000u | static_cast<std::uint32_t>(best_edge_));
    }

    const Piece& a_;
    const Piece& b_;
    std::int64_t margin_;
    Direction side_;
    Manifold& out_;
    Vec3 offset_;
    std::int32_t cosines_[3][3];
    int best_face_ = -1;
    int best_edge_ = -1;
    std::int64_t face_separation_ = 0;
    std::int64_t edge_separation_ = 0;
    Direction face_normal_{};
    Direction edge_normal_{};
};

} // namespace

void collide_boxes(const Piece& a, const Piece& b, std::int64_t margin, const Direction& side,
                   Manifold& out) {
    Boxes(a, b, margin, side, out).run();
}

} // namespace lks::manifold_detail
