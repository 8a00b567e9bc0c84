#include "solver/kept_rope.h"

#include <algorithm>

#include "collide/saturation.h"
#include "fixed/formats.h"

namespace lks {

using fixed::Vec3;

// use(values, where they are kept, how many) for all that a solve and contacts change.
template <typename Use>
void KeptRope::each(const Use& use) {
    std::int64_t* kept = memory_;
    const std::uint32_t count = object_.count();
    for (int axis = 0; axis < 3; ++axis) {
        use(object_.axis(axis), kept, count);
        use(object_.start_axis(axis), kept + count, count);
        kept += 2 * std::size_t{count};
    }
    use(object_.multipliers.data(), kept, static_cast<std::uint32_t>(object_.multipliers.size()));
}

void KeptRope::keep() {
    each([](std::int64_t* values, std::int64_t* kept, std::uint32_t count) {
        std::copy_n(values, count, kept);
    });
}

void KeptRope::put_back() {
    each([](std::int64_t* values, const std::int64_t* kept, std::uint32_t count) {
        std::copy_n(kept, count, values);
    });
}

void KeptRope::limit_speeds(std::uint64_t substeps_per_second) {
    const std::int64_t always = 4 * coordinate_one / static_cast<std::int64_t>(substeps_per_second);
    const std::uint32_t count = object_.count();
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto kept = [&](std::uint32_t array) { return memory_[std::size_t{array} * count + i]; };
        const Vec3 came = saturating_subtract(Vec3{kept(0), kept(2), kept(4)}, {kept(1), kept(3), kept(5)});
        const Vec3 now{object_.axis(0)[i], object_.axis(1)[i], object_.axis(2)[i]};
        const Vec3 start{object_.start_axis(0)[i], object_.start_axis(1)[i], object_.start_axis(2)[i]};
        fixed::NormalisedVector before{};
        fixed::NormalisedVector way{};
        fixed::normalise(came, before);
        const std::int64_t most = std::max(before.length, always);
        if (!fixed::normalise(saturating_subtract(now, start), way) || way.length <= most) {
            continue;
        }
        const Vec3 begin = saturating_subtract(now, fixed::scale(way.direction, most));
        object_.start_axis(0)[i] = begin.x;
        object_.start_axis(1)[i] = begin.y;
        object_.start_axis(2)[i] = begin.z;
    }
}

} // namespace lks
