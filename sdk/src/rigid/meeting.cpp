#include "rigid/meeting.h"

#include <lockstitch/collider.h>

#include <algorithm>

#include "collide/saturation.h"
#include "fixed/formats.h"
#include "rigid/piece_bounds.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::Vec3;

// A millimetre, a hundredth, and a tenth.
constexpr std::int64_t greatest_depth = (std::int64_t{1} << world_fraction_bits) / 1000;
constexpr std::int64_t least_overshoot = greatest_depth / 100;
constexpr std::int64_t close_enough = greatest_depth / 10;

constexpr int greatest_step_count = 8;

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

    // If nothing on the way overlaps, leaves out_ where they are closest.
    bool passes(const Manifold& first) {
        look(direction_one);
        if (out_.gap < -depth_ || closing() >= -least_overshoot) {
            return out_.gap >= -depth_;
        }
        Manifold before = first;
        Manifold behind = out_;
        std::int32_t low = 0;
        std::int32_t high = direction_one;
        for (int step = 0; step < greatest_step_count; ++step) {
            const std::int32_t middle = low + (high - low) / 2;
            look(middle);
            if (out_.gap < -depth_) {
                return false;
            }
            if (closing() >= 0) {
                low = middle;
                before = out_;
            } else {
                high = middle;
                behind = out_;
            }
        }
        // What still holds it before the edge, if that lets it go.
        out_ = before;
        if (closing() > out_.gap + depth_) {
            out_ = behind;
        }
        return true;
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
