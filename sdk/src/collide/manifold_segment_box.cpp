// A segment with a radius and a box.
//
// The distance from the box is convex along the segment, and the derivative of half its square is linear
// between the places where the segment passes the box's six planes: the nearest point is exact.
#include <algorithm>
#include <utility>

#include "collide/manifold.h"
#include "fixed/formats.h"

namespace lks::manifold_detail {
namespace {

using fixed::Direction;
using fixed::Vec3;

// The segment in the box's frame.
struct LocalSegment {
    std::int64_t centre[3];
    std::int32_t direction[3];
    std::int64_t half;
    std::int64_t extents[3];

    std::int64_t at(int axis, std::int64_t s) const {
        return centre[axis] + fixed::scale_component(direction[axis], s);
    }
    std::int64_t excess(int axis, std::int64_t s) const {
        const std::int64_t x = at(axis, s);
        return x - std::clamp(x, -extents[axis], extents[axis]);
    }
    // Of half the squared distance, World.
    std::int64_t slope(std::int64_t s) const {
        return fixed::scale_component(direction[0], excess(0, s)) +
               fixed::scale_component(direction[1], excess(1, s)) +
               fixed::scale_component(direction[2], excess(2, s));
    }
};

// Where the slope goes through zero between two places; the middle where it is zero for a while.
std::int64_t nearest_place(const LocalSegment& segment) {
    if (segment.half == 0) {
        return 0;
    }
    // Mostly it is an end. Where it is not, the slope changes its sign between two of the places below.
    if (segment.slope(segment.half) < 0) {
        return segment.half;
    }
    if (segment.slope(-segment.half) > 0) {
        return -segment.half;
    }
    std::int64_t places[8] = {-segment.half, segment.half};
    int count = 2;
    for (int axis = 0; axis < 3; ++axis) {
        if (segment.direction[axis] == 0) {
            continue;
        }
        for (const std::int64_t side : {-segment.extents[axis], segment.extents[axis]}) {
            const std::int64_t s =
                fixed::multiply_divide(side - segment.centre[axis], direction_one, segment.direction[axis]);
            if (s > -segment.half && s < segment.half) {
                places[count++] = s;
            }
        }
    }
    for (int i = 1; i < count; ++i) {
        for (int j = i; j > 0 && places[j] < places[j - 1]; --j) {
            std::swap(places[j], places[j - 1]);
        }
    }
    std::int64_t slopes[8];
    for (int i = 0; i < count; ++i) {
        slopes[i] = segment.slope(places[i]);
    }
    const auto crossing = [&](int i) { // between i and i + 1, of different slopes
        return places[i] +
               fixed::multiply_divide(places[i + 1] - places[i], -slopes[i], slopes[i + 1] - slopes[i]);
    };
    // The last place that is downhill, and the first that is uphill.
    int last_down = -1;
    int first_up = count;
    for (int i = 0; i < count; ++i) {
        last_down = slopes[i] < 0 ? i : last_down;
        first_up = slopes[i] > 0 && first_up == count ? i : first_up;
    }
    if (last_down >= 0 && first_up == last_down + 1) {
        return crossing(last_down);
    }
    const std::int64_t low = last_down >= 0 ? crossing(last_down) : -segment.half;
    const std::int64_t high = first_up < count ? crossing(first_up - 1) : segment.half;
    return (low + high) / 2;
}

// The cosine of what ways may lean from a normal that they share.
constexpr std::int64_t least_leaning = direction_one / 10 * 9;

struct Face {
    int axis;
    std::int64_t sign;
};

// As against() has it, for a side in the box's frame, from the box to the segment.
bool is_against(const Face& face, const std::int32_t (&side)[3]) {
    return face.sign * side[face.axis] < -direction_one / 2;
}

// The face through which the whole segment is out of the box soonest, but for those against its side.
Face nearest_way_out(const LocalSegment& segment, const std::int32_t (&side)[3]) {
    Face best{0, 1};
    std::int64_t least = INT64_MAX;
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t one_end = segment.at(axis, -segment.half);
        const std::int64_t other_end = segment.at(axis, segment.half);
        for (const std::int64_t sign : {1, -1}) {
            if (is_against({axis, sign}, side)) {
                continue;
            }
            const std::int64_t depth = segment.extents[axis] - std::min(sign * one_end, sign * other_end);
            if (depth < least) {
                least = depth;
                best = {axis, sign};
            }
        }
    }
    return best;
}

class SegmentBox {
public:
    SegmentBox(const Piece& segment, const Piece& box, std::int64_t margin, const Direction& side,
               Manifold& out)
        : piece_(segment), box_(box), margin_(margin), out_(out) {
        const Direction outward = -fixed::rotate_transposed(box.axes, side);
        side_[0] = outward.x;
        side_[1] = outward.y;
        side_[2] = outward.z;
        const Vec3 centre = fixed::rotate_transposed(box.axes, segment.centre - box.centre);
        const Direction direction = fixed::rotate_transposed(box.axes, axis(segment.axes, 1));
        local_ = {{centre.x, centre.y, centre.z},
                  {direction.x, direction.y, direction.z},
                  segment.half_length,
                  {box.half_extents.x, box.half_extents.y, box.half_extents.z}};
    }

    void run() {
        if (apart()) {
            return;
        }
        const std::int64_t s = nearest_place(local_);
        const Vec3 excess{local_.excess(0, s), local_.excess(1, s), local_.excess(2, s)};
        const int outside = (excess.x != 0 ? 1 : 0) + (excess.y != 0 ? 1 : 0) + (excess.z != 0 ? 1 : 0);
        if (outside == 0) {
            const Face face = nearest_way_out(local_, side_);
            touch_face(face, -local_.half, local_.half);
        } else if (outside == 1) {
            const int axis = excess.x != 0 ? 0 : excess.y != 0 ? 1 : 2;
            const std::int64_t value = excess.x + excess.y + excess.z;
            const Face face{axis, value < 0 ? -1 : 1};
            if (is_against(face, side_)) {
                touch_face({axis, -face.sign}, -local_.half, local_.half);
            } else {
                touch_along_face(face, s);
            }
        } else {
            touch_edge(s, excess);
        }
    }

private:
    // By one of the box's faces.
    bool apart() {
        for (int axis = 0; axis < 3; ++axis) {
            const std::int32_t c = local_.direction[axis];
            const std::int64_t centre = local_.centre[axis];
            const std::int64_t reach =
                fixed::scale_component(c < 0 ? -c : c, local_.half) + local_.extents[axis] + piece_.radius;
            // By more than roundings could make.
            constexpr std::int64_t room = std::int64_t{1} << (world_fraction_bits - 20);
            const std::int64_t gap = (centre < 0 ? -centre : centre) - reach;
            if (gap > margin_ + room && !is_against({axis, centre < 0 ? -1 : 1}, side_)) {
                std::int32_t outward[3] = {0, 0, 0};
                outward[axis] = centre < 0 ? -direction_one : direction_one;
                set_normal({outward[0], outward[1], outward[2]});
                out_.gap = gap;
                return true;
            }
        }
        return false;
    }

    // `outward` is from the box, in its frame; the manifold's normal is from the segment to the box.
    void set_normal(const Direction& outward) { out_.normal = -fixed::rotate(box_.axes, outward); }

    void add(std::int64_t s, const Vec3& on_box, std::uint32_t feature) {
        const Vec3 core{piece_.centre + fixed::scale(axis(piece_.axes, 1), s)};
        add_point(out_, core, box_.centre + fixed::rotate(box_.axes, on_box), piece_.radius, margin_,
                  feature);
    }

    // Of a segment: from low to high; none where low > high.
    struct Part {
        std::int64_t low, high;
    };

    // Less what is not between the two sides of the axis.
    void keep_between(int axis, Part& part) const {
        const std::int64_t d = local_.direction[axis];
        if (d == 0) {
            if (local_.excess(axis, 0) != 0) {
                part = {1, 0};
            }
            return;
        }
        const std::int64_t sides[2] = {-local_.extents[axis], local_.extents[axis]};
        const auto place = [&](std::int64_t side) {
            return fixed::multiply_divide(side - local_.centre[axis], direction_one, d);
        };
        part.low = std::max(part.low, place(sides[d < 0 ? 1 : 0]));
        part.high = std::min(part.high, place(sides[d < 0 ? 0 : 1]));
    }

    Part part_over(int face_axis) const {
        Part part{-local_.half, local_.half};
        for (int axis = 0; axis < 3; ++axis) {
            if (axis != face_axis) {
                keep_between(axis, part);
            }
        }
        return part;
    }

    // The part of the segment that is over the face, which holds at least s.
    void touch_along_face(const Face& face, std::int64_t s) {
        const Part part = part_over(face.axis);
        if (part.low > part.high) {
            touch_face(face, s, s);
        } else {
            touch_face(face, part.low, part.high);
        }
    }

    // Nearest beyond an edge or a corner. That point alone would let the segment tip about it until the next
    // search: what lies over the face beside, or along the edge, is held too.
    void touch_edge(std::int64_t s, const Vec3& excess) {
        fixed::NormalisedVector way{};
        fixed::normalise(excess, way);
        set_normal(way.direction);
        const std::int64_t sizes[3] = {std::abs(excess.x), std::abs(excess.y), std::abs(excess.z)};
        const int over = static_cast<int>(std::max_element(sizes, sizes + 3) - sizes);
        const Part face = part_over(over);
        if (face.low < face.high) {
            // It is on one side of s, its far end is that of the segment, or where the face ends again.
            if (s <= face.low) {
                hold(face.high, way.direction, 2);
            } else {
                hold(face.low, way.direction, 1);
            }
        } else {
            const std::int64_t* const least = std::min_element(sizes, sizes + 3);
            Part beside{-local_.half, local_.half};
            if (*least == 0) {
                keep_between(static_cast<int>(least - sizes), beside);
            }
            if (beside.low < s) {
                hold(beside.low, way.direction, 1);
            }
            if (beside.high > s) {
                hold(beside.high, way.direction, 2);
            }
        }
        // Also where both are held: it carries on what it has pushed while they come and go.
        add_nearest(s, 0);
    }

    // Its distance along the one normal, if its own way leans by less than 26 degrees from that.
    void hold(std::int64_t s, const Direction& outward, std::uint32_t feature) {
        const Vec3 excess{local_.excess(0, s), local_.excess(1, s), local_.excess(2, s)};
        fixed::NormalisedVector way{};
        if (fixed::normalise(excess, way) && fixed::dot(way.direction, outward) > least_leaning) {
            add_nearest(s, feature);
        }
    }

    void add_nearest(std::int64_t s, std::uint32_t feature) {
        add(s,
            {local_.at(0, s) - local_.excess(0, s), local_.at(1, s) - local_.excess(1, s),
             local_.at(2, s) - local_.excess(2, s)},
            feature);
    }

    void touch_face(const Face& face, std::int64_t low, std::int64_t high) {
        std::int32_t outward[3] = {0, 0, 0};
        outward[face.axis] = static_cast<std::int32_t>(face.sign * direction_one);
        set_normal({outward[0], outward[1], outward[2]});
        const auto touch = [&](std::int64_t s, std::uint32_t feature) {
            std::int64_t on_box[3] = {local_.at(0, s), local_.at(1, s), local_.at(2, s)};
            on_box[face.axis] = face.sign * local_.extents[face.axis];
            add(s, {on_box[0], on_box[1], on_box[2]}, feature);
        };
        touch(low, 1);
        if (low != high) {
            touch(high, 2);
        }
    }

    const Piece& piece_;
    const Piece& box_;
    std::int64_t margin_;
    Manifold& out_;
    LocalSegment local_{};
    std::int32_t side_[3];
};

} // namespace

void collide_segment_box(const Piece& segment, const Piece& box, std::int64_t margin, const Direction& side,
                         Manifold& out) {
    SegmentBox(segment, box, margin, side, out).run();
}

} // namespace lks::manifold_detail
