#include "rigid/meeting.h"

#include <lockstitch/collider.h>

#include <algorithm>

#include "collide/saturation.h"
#include "collide/shape.h"
#include "fixed/formats.h"
#include "rigid/piece_bounds.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::Vec3;

// A millimetre, a hundredth, and a tenth.
constexpr std::int64_t greatest_depth = world_one / 1000;
constexpr std::int64_t least_overshoot = greatest_depth / 100;
constexpr std::int64_t close_enough = greatest_depth / 10;

constexpr int greatest_step_count = 8;
constexpr int more_step_count = 16; // where halving has not told

// Shapes are to stay within what collide() can measure: 64 m.
constexpr std::int64_t longest_way = std::int64_t{64} << world_fraction_bits;

class Meeting {
public:
    Meeting(const Piece& a, const Piece& b, const Vec3& way, std::int64_t margin, const Direction& side,
            Manifold& out)
        : a_(a), b_(b), way_(way), margin_(margin), side_(side), out_(out),
          depth_(std::min(greatest_depth, (thickness(a) + thickness(b)) / 4)) {}

    void run() {
        collide(a_, b_, margin_, side_, out_);
        if (!goes_in()) {
            return;
        }
        const Manifold first = out_;
        if (!passes(first)) {
            out_ = first;
            advance();
        }
    }

private:
    // The place after a part of the way, 30 fraction bits.
    void look(std::int32_t part) {
        Piece b = b_;
        const Vec3 gone = fixed::scaled(part, way_);
        b.centre = b_.centre + gone;
        collide(a_, b, margin_, side_, out_);
        for (std::uint32_t i = 0; i < out_.count; ++i) {
            out_.points[i].core_b = out_.points[i].core_b - gone;
            out_.points[i].separation -= fixed::dot(out_.normal, gone);
        }
    }

    // On the whole way.
    std::int64_t closing() const { return -fixed::dot(out_.normal, way_); }

    // By the normal as it is.
    bool goes_in() const { return closing() > std::max<std::int64_t>(out_.gap, 0) + least_overshoot; }

    // A place on the way, and what its tangent says of the distance elsewhere: never too much.
    struct Place {
        std::int32_t part;
        std::int64_t closing;
        Manifold manifold;
    };
    Place place(std::int32_t part) const { return {part, closing(), out_}; }

    // If nothing on the way overlaps, leaves out_ where they are closest.
    bool passes(const Manifold& first) {
        look(direction_one);
        if (out_.gap < -depth_ || closing() >= -least_overshoot) {
            return out_.gap >= -depth_;
        }
        Place behind = place(direction_one);
        out_ = first;
        Place before = place(0);
        for (int step = 0; step < greatest_step_count + more_step_count; ++step) {
            std::int32_t next = before.part + (behind.part - before.part) / 2;
            if (step >= greatest_step_count) {
                // Something thin may be between them: the lowest place that both tangents leave.
                std::int64_t least = 0;
                next = lowest(before, behind, least);
                if (least >= -depth_ || next == before.part || next == behind.part) {
                    leave(before, behind, first);
                    return true;
                }
            }
            look(next);
            if (out_.gap < -depth_) {
                return false;
            }
            (closing() >= 0 ? before : behind) = place(next);
        }
        return false;
    }

    // Where the tangents of a place that comes closer and of one behind it that parts meet, and how high that
    // is.
    static std::int32_t lowest(const Place& before, const Place& behind, std::int64_t& least) {
        const std::int32_t width = behind.part - before.part;
        // Both slopes are of the whole way.
        const std::int64_t fall = before.closing;
        const std::int64_t rise = -behind.closing;
        const auto part_of = [](std::int64_t slope, std::int64_t part) {
            return fixed::multiply_shift(slope, part, direction_fraction_bits);
        };
        // From `before` on: fall · x = gap - (gap behind - rise · (width - x)).
        const std::int64_t drop = before.manifold.gap - behind.manifold.gap + part_of(rise, width);
        const std::int64_t along = drop <= 0 ? 0 : fixed::multiply_divide(drop, direction_one, fall + rise);
        const auto x = static_cast<std::int32_t>(std::min<std::int64_t>(along, width));
        least = before.manifold.gap - part_of(fall, x);
        return before.part + x;
    }

    // What still holds it before the edge, if that lets it go; else what is behind it, but for what that
    // only seems to overlap where they begin.
    void leave(const Place& before, const Place& behind, const Manifold& first) {
        out_ = before.manifold;
        if (before.closing <= out_.gap + depth_) {
            return;
        }
        out_ = behind.manifold;
        if (first.gap < -depth_) {
            return;
        }
        std::uint32_t kept = 0;
        for (std::uint32_t i = 0; i < out_.count; ++i) {
            if (out_.points[i].separation >= -depth_) {
                out_.points[kept++] = out_.points[i];
            }
        }
        out_.count = kept;
    }

    // From out_ at the beginning to where they overlap.
    void advance() {
        std::int64_t part = 0;
        for (int step = 0; step < greatest_step_count; ++step) {
            const std::int64_t room = out_.gap + depth_;
            if (room <= close_enough || closing() <= room) {
                return;
            }
            part += fixed::multiply_divide(room, direction_one, closing());
            part = std::min<std::int64_t>(part, direction_one);
            look(static_cast<std::int32_t>(part));
        }
    }

    const Piece& a_;
    const Piece& b_;
    const Vec3& way_;
    std::int64_t margin_;
    Direction side_;
    Manifold& out_;
    std::int64_t depth_; // what counts as none
};

} // namespace

void collide_on_way(const Piece& a, const Piece& b, const Vec3& way, std::int64_t margin,
                    const Direction& side, Manifold& out) {
    const bool has_edges = b.kind != LKS_SHAPE_PLANE && (a.kind == LKS_SHAPE_BOX || b.kind == LKS_SHAPE_BOX);
    if (has_edges && sum_of_magnitudes(way) <= longest_way) {
        Meeting(a, b, way, margin, side, out).run();
    } else {
        collide(a, b, margin, side, out);
    }
}

} // namespace lks
