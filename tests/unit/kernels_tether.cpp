// Every instruction set finds the particles that may be beyond their tether, and leaves out none.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "fixed/int128.h"
#include "fixed_samples.h"
#include "kernels/compiled_kernels.h"
#include "wide_kernels.h"

using namespace lks;

namespace {

struct Problem {
    std::vector<std::int64_t> positions[3];
    std::vector<std::uint32_t> lengths;
    TetherTask task{};

    // Within the range of coordinates; lengths of all sizes, and some that fit the distance to a few units.
    Problem(test::Random& random, std::uint32_t count) {
        const int reach = 30 + static_cast<int>(random.below(33));
        for (int axis = 0; axis < 3; ++axis) {
            for (std::uint32_t i = 0; i < count; ++i) {
                positions[axis].push_back(random.any_signed(reach));
            }
            task.positions[axis] = positions[axis].data();
            task.anchor[axis] = random.any_signed(reach);
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint64_t near = distance(i) + random.below(7);
            const auto any = static_cast<std::uint32_t>(3 + random.any_magnitude(31));
            lengths.push_back(random.below(2) == 0 ? any
                                                   : static_cast<std::uint32_t>(near < 6 ? 3 : near - 3));
        }
        task.lengths = lengths.data();
    }

    fixed::UInt128 squared(std::uint32_t i) const {
        fixed::UInt128 sum{0, 0};
        for (int axis = 0; axis < 3; ++axis) {
            const std::int64_t d = positions[axis][i] - task.anchor[axis];
            sum = sum + fixed::multiply_unsigned(fixed::magnitude(d), fixed::magnitude(d));
        }
        return sum;
    }
    std::uint64_t distance(std::uint32_t i) const { return fixed::square_root(squared(i)) >> 32; }
    bool is_beyond(std::uint32_t i) const {
        const std::uint64_t length = lengths[i];
        return fixed::UInt128{length * length, 0} < squared(i);
    }
};

} // namespace

TEST_CASE("kernels: every instruction set finds the particles that may be beyond their tether") {
    const std::vector<const Kernels*> all = test::all_kernels();
    const std::uint64_t problems = test::sample_count() / 32; // of 32 particles on the average
    test::Random random(4);
    std::uint64_t different = 0, left_out = 0, beyond = 0, asked = 0;
    for (std::uint64_t p = 0; p < problems; ++p) {
        const auto first = static_cast<std::uint32_t>(random.below(9));
        const auto count = static_cast<std::uint32_t>(1 + random.below(64));
        const Problem problem(random, first + count);
        const std::uint64_t expected = kernels_scalar.beyond_tether(problem.task, first, count);
        for (const Kernels* kernels : all) {
            different += kernels->beyond_tether(problem.task, first, count) != expected ? 1 : 0;
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            const bool found = (expected >> i & 1) != 0;
            left_out += problem.is_beyond(first + i) && !found ? 1 : 0;
            beyond += found ? 1 : 0;
            ++asked;
        }
        different += count < 64 && expected >> count != 0 ? 1 : 0;
    }
    CHECK(different == 0);
    CHECK(left_out == 0);
    CHECK(beyond > asked / 10);
    CHECK(beyond < asked - asked / 10);
}
