// The angle of a vector, in integers.
#pragma once

#include "fixed/integer.h"

namespace lks::fixed {

namespace detail {

// atan(i / 16) in Q40.
inline constexpr std::int64_t arc_tangents[17] = {0,
                                                  68630207382,
                                                  136729762476,
                                                  203792226205,
                                                  269356888665,
                                                  333025434656,
                                                  394472523667,
                                                  453450075953,
                                                  509785937287,
                                                  563378169562,
                                                  614186442488,
                                                  662221940338,
                                                  707536951605,
                                                  750214985909,
                                                  790361942978,
                                                  828098590892,
                                                  863554413089};

// atan(r) in Q40 for r in [0, 1] with 32 fraction bits.
constexpr std::int64_t arc_tangent(std::int64_t r) {
    const std::int64_t i = (r + (std::int64_t{1} << 27)) >> 28; // the nearest sixteenth
    const std::int64_t c = i << 28;
    // tan(a − b) = (r − c) / (1 + r·c), at most 1/32.
    const std::int64_t below = (std::int64_t{1} << 32) + ((r >> 4) * i);
    const std::int64_t d = ((r - c) * (std::int64_t{1} << 34)) / below; // 34 fraction bits
    const std::int64_t square = (d * d) >> 34;
    // d − d³/3 + d⁵/5 − d⁷/7; the next term is below 2^-48.
    const std::int64_t series = (std::int64_t{1} << 34) -
                                ((square * ((std::int64_t{1} << 34) / 3 -
                                            ((square * ((std::int64_t{1} << 34) / 5 - square / 7)) >> 34))) >>
                                 34);
    return arc_tangents[i] + ((d * series) >> 28);
}

} // namespace detail

inline constexpr std::int64_t quarter_turn = 1727108826179; // π/2 in Q40
inline constexpr std::int64_t half_circle = 3454217652358;  // π

// The angle from the x axis to (x, y) in radians, Q40, from -π to π; zero for (0, 0). |x|, |y| < 2^31, of one
// format. Error: at most 2^-31.
constexpr std::int64_t angle_of(std::int64_t y, std::int64_t x) {
    const std::int64_t height = y < 0 ? -y : y;
    const std::int64_t width = x < 0 ? -x : x;
    if (height == 0 && width == 0) {
        return 0;
    }
    std::int64_t angle = height <= width ? detail::arc_tangent((height << 32) / width)
                                         : quarter_turn - detail::arc_tangent((width << 32) / height);
    angle = x < 0 ? half_circle - angle : angle;
    return y < 0 ? -angle : angle;
}

} // namespace lks::fixed
