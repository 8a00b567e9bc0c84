#include "kernels/chain_scalar.h"

#include <algorithm>
#include <bit>

#include "fixed/formats.h"
#include "fixed/vector.h"
#include "kernels/measure_segment.h"

namespace lks {

void measure_segments_scalar(ChainSegments& segments, std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; ++i) {
        fixed::Vec3 d{};
        std::int64_t* const components[3] = {&d.x, &d.y, &d.z};
        for (int axis = 0; axis < 3; ++axis) {
            *components[axis] =
                fixed::wrapping_subtract(segments.points[axis][i + 1], segments.points[axis][i]);
        }
        fixed::NormalisedVector n{};
        static_cast<void>(measure_segment(d, n));
        segments.directions[0][i] = n.direction.x;
        segments.directions[1][i] = n.direction.y;
        segments.directions[2][i] = n.direction.z;
        segments.lengths[i] = n.length;
    }
}

void measure_turns_scalar(ChainSegments& segments, std::uint32_t first, std::uint32_t count) {
    constexpr std::uint64_t two = std::uint64_t{2} << cosine_fraction_bits;
    for (std::uint32_t i = first; i < first + count; ++i) {
        std::uint64_t squared = 0;
        for (const auto& axis : segments.directions) {
            const std::int64_t d = std::int64_t{static_cast<std::int32_t>(axis[i])} -
                                   std::int64_t{static_cast<std::int32_t>(axis[i + 1])};
            squared += static_cast<std::uint64_t>(d * d);
        }
        segments.versines[i] = static_cast<std::int64_t>(std::min(squared >> 1, two));
    }
}

void measure_chain_scalar(ChainSegments& segments) {
    measure_segments_scalar(segments, 0, segments.count);
    measure_turns_scalar(segments, 0, segments.count);
}

} // namespace lks
