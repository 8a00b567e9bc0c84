// What a ball on a straight way comes near: asked of the box that holds the whole way, then of its halves,
// and so on. A long slanting way crosses few of the things that its box holds.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "rigid/overlaps.h"

namespace lks {

// World; a way of no length is a point.
struct BallWay {
    fixed::Vec3 from;
    fixed::Vec3 to;
    std::int64_t radius;

    Box box() const {
        return {{std::min(from.x, to.x) - radius, std::min(from.y, to.y) - radius,
                 std::min(from.z, to.z) - radius},
                {std::max(from.x, to.x) + radius, std::max(from.y, to.y) + radius,
                 std::max(from.z, to.z) + radius}};
    }
    // Until pieces are hardly longer than the ball is wide, or an eighth of a metre.
    int halvings() const {
        const fixed::Vec3 way = to - from;
        const std::uint64_t longest =
            std::max({fixed::magnitude(way.x), fixed::magnitude(way.y), fixed::magnitude(way.z)});
        const auto enough =
            static_cast<std::uint64_t>(radius) + (std::uint64_t{1} << (world_fraction_bits - 3));
        int count = 0;
        while (count < most_halvings && longest >> count > enough) {
            ++count;
        }
        return count;
    }

    static constexpr int most_halvings = 8;
};

// Of 64 things: those bits of ask(box) that the box of the way has, and some piece's. Where up to `few` are
// left pieces are not halved further.
template <typename Ask>
std::uint64_t near_way(const BallWay& way, int halvings, int few, const Ask& ask) {
    const std::uint64_t near = ask(way.box());
    if (halvings == 0 || std::popcount(near) <= few) {
        return near;
    }
    const fixed::Vec3 whole = way.to - way.from;
    const fixed::Vec3 middle = way.from + fixed::Vec3{whole.x >> 1, whole.y >> 1, whole.z >> 1};
    return near & (near_way(BallWay{way.from, middle, way.radius}, halvings - 1, few, ask) |
                   near_way(BallWay{middle, way.to, way.radius}, halvings - 1, few, ask));
}

// Of one thing in its box.
inline bool is_near_way(const BallWay& way, int halvings, const Box& box) {
    return near_way(way, halvings, 0,
                    [&](const Box& piece) { return static_cast<std::uint64_t>(piece.overlaps(box)); }) != 0;
}

} // namespace lks
