// Every instruction set measures the segments of a rope to the same bits.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>

#include "fixed/formats.h"
#include "fixed/integer.h"
#include "fixed_samples.h"
#include "kernels/compiled_kernels.h"
#include "kernels/kernels.h"
#include "wide_kernels.h"

using namespace lks;

namespace {

// Segments of about 2^reach, some of them along an axis, of a power of two, of nothing or folded back, and
// now and then anything.
ChainSegments any_segments(test::Random& random) {
    ChainSegments segments{};
    segments.count = static_cast<std::uint32_t>(1 + random.below(chain_block));
    const int reach = 30 + static_cast<int>(random.below(32));
    std::int64_t at[3] = {};
    std::int64_t step[3] = {};
    for (std::uint32_t i = 0; i <= segments.count; ++i) {
        const std::uint64_t kind = random.below(24);
        for (int axis = 0; axis < 3; ++axis) {
            const std::int64_t any = random.any_signed(reach);
            const std::int64_t along = axis == static_cast<int>(kind % 3) ? 1 : 0;
            step[axis] = kind < 3    ? along * any
                         : kind < 6  ? along * (std::int64_t{-1} << random.below(62))
                         : kind < 7  ? 0
                         : kind < 10 ? -step[axis] + random.any_signed(4)
                         : kind < 11 ? random.any_signed(62)
                                     : any;
            at[axis] = fixed::wrapping_add(at[axis], step[axis]);
            segments.points[axis][i] = at[axis];
        }
    }
    segments.directions[random.below(3)][segments.count] = random.below(2) == 0 ? direction_one : 0;
    return segments;
}

bool same(const ChainSegments& a, const ChainSegments& b) {
    for (std::uint32_t i = 0; i < a.count; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            if (static_cast<std::int32_t>(a.directions[axis][i]) !=
                static_cast<std::int32_t>(b.directions[axis][i])) {
                return false;
            }
        }
        if (a.lengths[i] != b.lengths[i] || a.versines[i] != b.versines[i]) {
            return false;
        }
    }
    return true;
}

} // namespace

TEST_CASE("kernels: every instruction set measures a rope's segments alike") {
    const std::uint64_t problems = test::sample_count() / 32; // of 32 segments on the average
    for (const Kernels* kernels : test::wide_kernels()) {
        INFO(std::string(simd_name(kernels->level)));
        test::Random random(5);
        std::uint64_t different = 0;
        std::uint64_t folded = 0;
        std::uint64_t lost = 0;
        for (std::uint64_t p = 0; p < problems; ++p) {
            ChainSegments expected = any_segments(random);
            ChainSegments segments = expected;
            kernels_scalar.chain.measure(expected);
            kernels->chain.measure(segments);
            different += same(segments, expected) ? 0 : 1;
            for (std::uint32_t i = 0; i < expected.count; ++i) {
                folded += expected.versines[i] >=
                                  (std::int64_t{2} << cosine_fraction_bits) - (std::int64_t{1} << 33)
                              ? 1
                              : 0;
                lost += expected.lengths[i] == 0 ? 1 : 0;
            }
        }
        CHECK(different == 0);
        CHECK(folded > 0);
        CHECK(lost > 0);
    }
}
