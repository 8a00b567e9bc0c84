// The steps of a rope's solve that every instruction set has: the same bits from all of them, and as near to
// what they stand for as their 31 bits allow, at the edges of their ranges too.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "fixed/formats.h"
#include "fixed_samples.h"
#include "kernels/compiled_kernels.h"
#include "kernels/kernels.h"
#include "wide_kernels.h"

using namespace lks;

namespace {

constexpr std::uint32_t room = chain_block + 1 + chain_padding;

// Runs `step(kernels, problem)` on copies of random problems, with plain integers and every other kernels.
template <typename Problem, typename Step>
void check_alike(std::uint64_t samples, const Step& step) {
    for (const Kernels* kernels : test::wide_kernels()) {
        INFO(std::string(simd_name(kernels->level)));
        test::Random random(11);
        std::uint64_t different = 0;
        for (std::uint64_t p = 0; p < samples; ++p) {
            Problem expected{};
            expected.fill(random);
            Problem found = expected;
            step(kernels_scalar, expected);
            step(*kernels, found);
            different += found.same(expected) ? 0 : 1;
        }
        CHECK(different == 0);
    }
}

bool same_values(const std::int64_t* a, const std::int64_t* b, std::uint32_t count) {
    return std::memcmp(a, b, count * sizeof(std::int64_t)) == 0;
}

std::uint32_t any_count(test::Random& random) {
    return static_cast<std::uint32_t>(1 + random.below(chain_block));
}

struct Weights {
    std::uint32_t weights[room];
    std::uint32_t shifts[room];

    void fill(test::Random& random) {
        const std::uint64_t reach = 1 + random.below(greatest_weight_shift);
        for (std::uint32_t i = 0; i < room; ++i) {
            const bool pinned = random.below(16) == 0;
            weights[i] = pinned ? 0 : static_cast<std::uint32_t>((1u << 30) | random.any_magnitude(30));
            shifts[i] = static_cast<std::uint32_t>(pinned ? greatest_weight_shift : random.below(reach));
        }
    }
    double value(std::uint32_t i) const {
        return std::ldexp(weights[i], -chain_weight_bits - static_cast<int>(shifts[i]));
    }
};

// As the elimination leaves them: d is not below the weight at the near end, nor below 2^-36.
struct Rows {
    ChainRows rows;
    Weights weights;
    std::int64_t versines[room];
    void fill(test::Random& random) {
        weights.fill(random);
        rows.count = any_count(random);
        rows.softness = std::uint64_t{1} << (27 + random.below(36));
        rows.exponent = static_cast<int>(1 + random.below(60));
        rows.scales[rows.count] = any_scale(random);
        rows.shares[rows.count] = static_cast<std::int64_t>(random.any_magnitude(chain_x_bits));
        for (std::uint32_t i = rows.count; i-- > 0;) {
            rows.scales[i] = any_scale(random);
            const double ratio =
                std::ldexp(static_cast<double>(rows.scales[i + 1]), 0) / static_cast<double>(rows.scales[i]);
            const double least = std::max(weights.value(i) * 1.0001, std::ldexp(1.0, -36));
            const double up = std::floor(1 - std::log2(least * ratio));
            rows.shifts[i] =
                static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(std::max(up, 0.0)) + 1));
            versines[i] = static_cast<std::int64_t>(
                std::min<std::uint64_t>(random.any_magnitude(61), (std::uint64_t{2} << cosine_fraction_bits) -
                                                                      (std::uint64_t{1} << 32)));
            rows.sides[i] = random.any_signed(61);
        }
    }
    void point() {
        rows.near = {weights.weights, weights.shifts};
        rows.versines = versines;
    }
    bool same(const Rows& other) const {
        const std::uint32_t n = rows.count;
        return same_values(rows.turns, other.rows.turns, n) &&
               same_values(rows.ratios, other.rows.ratios, n) &&
               same_values(rows.shares, other.rows.shares, n + 1) &&
               same_values(rows.carried + 1, other.rows.carried + 1, n) &&
               same_values(rows.multipliers, other.rows.multipliers, n);
    }
    static std::int64_t any_scale(test::Random& random) {
        return static_cast<std::int64_t>((std::uint64_t{1} << 62) | random.any_magnitude(62));
    }
};

void solve_rows(const Kernels& kernels, Rows& problem) {
    problem.point();
    kernels.chain.turn(problem.rows);
    kernels.chain.divide(problem.rows);
    kernels.chain.solve(problem.rows);
}

struct Changes {
    ChainSegments segments;
    std::int64_t rests[room];
    std::int64_t slacks[room];
    bool whole;

    void fill(test::Random& random) {
        segments.count = any_count(random);
        for (std::uint32_t i = 0; i < segments.count; ++i) {
            rests[i] = static_cast<std::int64_t>(random.any_magnitude(61));
            slacks[i] = random.below(64) == 0 ? rests[i] : INT64_MAX;
            segments.lengths[i] = random.below(2) == 0
                                      ? static_cast<std::int64_t>(random.any_magnitude(62))
                                      : std::max<std::int64_t>(rests[i] + random.any_signed(20), 0);
        }
    }
    bool same(const Changes& other) const {
        return whole == other.whole &&
               (!whole || same_values(segments.changes, other.segments.changes, segments.count));
    }
};

struct Moves {
    ChainMoves task;
    Weights weights;
    std::int64_t directions[3][room];
    std::int64_t multipliers[room];
    std::int64_t movements[3][room];

    void fill(test::Random& random) {
        weights.fill(random);
        task.count = any_count(random);
        task.exponent = static_cast<int>(1 + random.below(60));
        const int reach = static_cast<int>(1 + random.below(60));
        for (std::uint32_t i = 0; i < task.count; ++i) {
            multipliers[i] = random.any_signed(reach);
            for (auto& axis : directions) {
                axis[i] = random.below(8) == 0 ? direction_one : random.any_signed(30);
            }
        }
        for (auto& pushes : task.pushes) {
            pushes[0] = random.any_signed(reach);
        }
    }
    bool same(const Moves& other) const {
        for (int axis = 0; axis < 3; ++axis) {
            if (!same_values(movements[axis], other.movements[axis], task.count) ||
                task.pushes[axis][task.count] != other.task.pushes[axis][task.count]) {
                return false;
            }
        }
        return true;
    }
};

void move(const Kernels& kernels, Moves& problem) {
    problem.task.near = {problem.weights.weights, problem.weights.shifts};
    problem.task.multipliers = problem.multipliers;
    for (int axis = 0; axis < 3; ++axis) {
        problem.task.directions[axis] = problem.directions[axis];
        problem.task.movements[axis] = problem.movements[axis];
    }
    kernels.chain.push(problem.task);
}

struct Tensions {
    std::uint32_t count;
    std::int64_t stable;
    std::int64_t tensions[room];
    std::uint32_t stiffness[room];
    std::uint32_t near_shares[room];
    std::uint32_t far_shares[room];
    std::int64_t near[room];
    std::int64_t far[room];
    bool any;

    void fill(test::Random& random) {
        count = any_count(random);
        stable = std::int64_t{1} << (6 + random.below(51));
        for (std::uint32_t i = 0; i < count; ++i) {
            tensions[i] = random.any_signed(60);
            stiffness[i] = static_cast<std::uint32_t>(random.any_magnitude(32));
            near_shares[i] =
                static_cast<std::uint32_t>(std::min<std::uint64_t>(random.any_magnitude(32), unit_one));
            far_shares[i] = unit_one;
        }
    }
    bool same(const Tensions& other) const {
        return any == other.any && same_values(near, other.near, count) && same_values(far, other.far, count);
    }
};

void stiffen(const Kernels& kernels, Tensions& problem) {
    ChainTensions task{problem.count,       problem.stable,     problem.tensions, problem.stiffness,
                       problem.near_shares, problem.far_shares, problem.near,     problem.far};
    problem.any = kernels.chain.stiffen(task);
}

struct Shares {
    ChainShares task;
    std::int64_t takes[room];
    std::int64_t gives[room];

    void fill(test::Random& random) {
        task.count = any_count(random);
        for (std::uint32_t i = 0; i < task.count; ++i) {
            const std::uint64_t scale =
                (std::uint64_t{1} << 63) | (random.below(8) == 0 ? 0 : random.any_magnitude(63));
            const std::uint64_t part =
                random.below(8) == 0 ? scale : std::max<std::uint64_t>(random.any_magnitude(64) % scale, 1);
            task.scales[i] = static_cast<std::int64_t>(scale);
            task.parts[i] = static_cast<std::int64_t>(part);
            task.fars[i] =
                static_cast<std::int64_t>(random.below(8) == 0 ? part : random.any_magnitude(64) % part);
        }
    }
    bool same(const Shares& other) const {
        return same_values(takes, other.takes, task.count) && same_values(gives, other.gives, task.count);
    }
};

void share(const Kernels& kernels, Shares& problem) {
    problem.task.takes = problem.takes;
    problem.task.gives = problem.gives;
    kernels.chain.share(problem.task);
}

struct Across {
    std::uint32_t count;
    std::int64_t directions[3][1 + room];
    std::int64_t rests[room];
    std::int64_t movements[3][room];
    std::int64_t changes[3][room];
    bool off;

    void fill(test::Random& random) {
        count = any_count(random) + 1;
        const int reach = static_cast<int>(1 + random.below(60));
        const bool straight = random.below(4) == 0;
        // Two directions then have exactly one axis in their middle.
        const double zigzag = random.below(4) == 0 ? static_cast<double>(random.below(1000)) / 800 : 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint64_t kind = random.below(16);
            const double turn = kind == 0 ? 3.14 : 0.3;
            const double a = static_cast<double>(random.below(1000)) * turn / 1000;
            const double side = i % 2 == 0 ? zigzag : -zigzag;
            const double n[3] = {zigzag != 0 ? std::cos(side) : std::cos(a),
                                 zigzag != 0 ? std::sin(side) : 0.6 * std::sin(a),
                                 zigzag != 0 ? 0 : 0.8 * std::sin(a)};
            rests[i] = static_cast<std::int64_t>((std::uint64_t{1} << 40) | random.any_magnitude(60));
            for (int axis = 0; axis < 3; ++axis) {
                directions[axis][1 + i] =
                    straight ? (axis == 1 ? static_cast<std::int64_t>(random.below(3)) - direction_one : 0)
                             : std::llround(std::ldexp(n[axis], direction_fraction_bits));
                movements[axis][i] = random.any_signed(reach);
                changes[axis][i] = movements[axis][i] + random.any_signed(std::max(reach - 8, 0));
            }
        }
    }
    bool same(const Across& other) const {
        for (int axis = 0; axis < 3; ++axis) {
            if (!same_values(movements[axis], other.movements[axis], count) ||
                !same_values(changes[axis], other.changes[axis], count)) {
                return false;
            }
        }
        return off == other.off;
    }
};

void cross(const Kernels& kernels, Across& problem) {
    ChainAcross task;
    task.count = problem.count;
    task.rest_lengths = problem.rests;
    for (int axis = 0; axis < 3; ++axis) {
        task.directions[axis] = problem.directions[axis] + 1;
        task.movements[axis] = problem.movements[axis];
        task.changes[axis] = problem.changes[axis];
    }
    problem.off = kernels.chain.cross(task);
}

// Of 32 segments on the average: 10^7 of them in long runs.
std::uint64_t samples() {
    return test::sample_count() / (test::long_run() ? 32 : 256);
}

} // namespace

TEST_CASE("kernels: every instruction set solves the steps of a rope alike") {
    check_alike<Rows>(samples(), solve_rows);
    check_alike<Changes>(samples(), [](const Kernels& kernels, Changes& problem) {
        problem.segments.rest_lengths = problem.rests;
        problem.segments.slacks = problem.slacks;
        problem.whole = kernels.chain.stretch(problem.segments);
    });
    check_alike<Moves>(samples(), move);
    check_alike<Tensions>(samples(), stiffen);
    check_alike<Shares>(samples(), share);
    check_alike<Across>(samples(), cross);
}

TEST_CASE("kernels: rows of a rope are divided within 2^-28") {
    test::Random random(3);
    double worst_ratio = 0;
    double worst_share = 0;
    double worst_carried = 0;
    double worst_turn = 0;
    double worst_multiplier = 0;
    for (std::uint64_t p = 0; p < samples(); ++p) {
        Rows problem{};
        problem.fill(random);
        solve_rows(kernels_scalar, problem);
        const ChainRows& rows = problem.rows;
        for (std::uint32_t i = 0; i < rows.count; ++i) {
            const double ratio =
                static_cast<double>(rows.scales[i + 1]) / static_cast<double>(rows.scales[i]);
            const double inverse = std::ldexp(ratio, static_cast<int>(rows.shifts[i]) - 1);
            const double share = problem.weights.value(i) * inverse;
            const double found = std::ldexp(static_cast<double>(rows.shares[i]), -chain_x_bits);
            const double v = std::ldexp(static_cast<double>(problem.versines[i]), -cosine_fraction_bits);
            const double behind = std::ldexp(static_cast<double>(rows.shares[i + 1]), -chain_x_bits);
            const double carried = std::ldexp(static_cast<double>(rows.carried[i + 1]), -carried_bits);
            const double turn = std::ldexp(static_cast<double>(rows.softness), -chain_share_bits) +
                                problem.weights.value(i + 1) * v * (2 - v);
            const double turned =
                std::ldexp(static_cast<double>(static_cast<std::uint64_t>(rows.turns[i])), -chain_share_bits);
            const double found_ratio = std::ldexp(static_cast<double>(rows.ratios[i]), -30);
            worst_ratio = std::max(worst_ratio, std::abs(found_ratio / ratio - 1));
            // Of small shares, too, but for the unit in which they are counted.
            worst_share = std::max(worst_share, (std::abs(found - share) - std::ldexp(1.0, -59)) / share);
            worst_carried =
                std::max(worst_carried, std::abs(carried - behind * (1 - v)) - std::ldexp(behind, -30));
            // Of what folds back the sine is near zero again, and less exact.
            const double fold = v > 1 ? std::ldexp(problem.weights.value(i + 1), -28) : 0;
            worst_turn = std::max(worst_turn, (std::abs(turned - turn) - std::ldexp(1.0, -61) - fold) / turn);
            const double multiplier =
                std::ldexp(static_cast<double>(rows.sides[i]) * inverse, side_shift - rows.exponent);
            const auto limit = static_cast<double>(multiplier_limit);
            const double bounded = std::clamp(multiplier, -limit, limit);
            const double unit = std::max(std::ldexp(inverse, side_shift - rows.exponent + 2), 1.0);
            worst_multiplier = std::max(
                worst_multiplier,
                (std::abs(static_cast<double>(rows.multipliers[i]) - bounded) - unit) / std::abs(multiplier));
        }
    }
    const double limit = std::ldexp(1.0, -28);
    CHECK(worst_ratio <= limit);
    CHECK(worst_share <= limit);
    CHECK(worst_carried <= std::ldexp(1.0, -58));
    CHECK(worst_turn <= limit);
    CHECK(worst_multiplier <= limit);
}

TEST_CASE("kernels: what particles of a rope share is never more than all, and nothing where nothing is") {
    test::Random random(4);
    double worst = 0;
    const double one = std::ldexp(1.0, carried_bits);
    for (std::uint64_t p = 0; p < samples(); ++p) {
        Shares problem{};
        problem.fill(random);
        share(kernels_scalar, problem);
        for (std::uint32_t i = 0; i < problem.task.count; ++i) {
            const auto scale = static_cast<double>(static_cast<std::uint64_t>(problem.task.scales[i]));
            const auto part = static_cast<double>(static_cast<std::uint64_t>(problem.task.parts[i]));
            const auto far = static_cast<double>(static_cast<std::uint64_t>(problem.task.fars[i]));
            worst = std::max(worst,
                             std::abs(static_cast<double>(problem.takes[i]) / one - (scale - part) / scale));
            if (part >= std::ldexp(1.0, 33)) {
                worst = std::max(worst, std::abs(static_cast<double>(problem.gives[i]) / one - far / part));
            }
            if (problem.task.scales[i] == problem.task.parts[i]) {
                CHECK(problem.takes[i] == 0);
            }
            if (far == 0) {
                CHECK(problem.gives[i] == 0);
            }
            if (problem.takes[i] < 0 || problem.gives[i] < 0) {
                CHECK(false);
            }
        }
    }
    CHECK(worst <= std::ldexp(1.0, -29));
}

TEST_CASE("kernels: particles of a rope move by their weight times what pushes them") {
    test::Random random(6);
    std::uint64_t wrong = 0;
    for (std::uint64_t p = 0; p < samples(); ++p) {
        Moves problem{};
        problem.fill(random);
        const std::int64_t before = problem.task.pushes[0][0];
        move(kernels_scalar, problem);
        for (int axis = 0; axis < 3; ++axis) {
            for (std::uint32_t i = 0; i < problem.task.count; ++i) {
                const auto push =
                    static_cast<double>(problem.task.pushes[axis][i] - problem.task.pushes[axis][i + 1]);
                const double weight = problem.weights.value(i);
                const auto limit = static_cast<double>(substep_motion_limit);
                const double movement =
                    std::clamp(std::ldexp(push * weight, problem.task.exponent), -limit, limit);
                // A unit before it is shifted up, or half of one after it was shifted down.
                const double unit = std::max(
                    std::ldexp(1.0, problem.task.exponent - 1 - static_cast<int>(problem.weights.shifts[i])),
                    0.51);
                const double error = std::abs(static_cast<double>(problem.movements[axis][i]) - movement);
                wrong += error <= unit + std::abs(movement) * 1e-15 ? 0 : 1;
            }
        }
        CHECK(problem.task.pushes[0][0] == before);
    }
    CHECK(wrong == 0);
}

TEST_CASE("kernels: of a rope's second pass nothing along it is left") {
    test::Random random(7);
    double worst = 0;
    double worst_where_it_turns_little = 0;
    for (std::uint64_t p = 0; p < samples(); ++p) {
        Across problem{};
        problem.fill(random);
        Across made = problem;
        cross(kernels_scalar, made);
        for (std::uint32_t i = 0; i < problem.count; ++i) {
            double tangent[3];
            double squared = 0;
            double along = 0;
            double size = 0;
            for (int axis = 0; axis < 3; ++axis) {
                tangent[axis] = static_cast<double>(problem.directions[axis][i]) +
                                static_cast<double>(problem.directions[axis][i + 1]);
                squared += tangent[axis] * tangent[axis];
                const auto across = static_cast<double>(made.changes[axis][i]);
                along += tangent[axis] * across;
                size = std::max(size, std::abs(static_cast<double>(problem.changes[axis][i] -
                                                                   problem.movements[axis][i])));
                CHECK(made.movements[axis][i] == problem.movements[axis][i] + made.changes[axis][i]);
            }
            if (squared > std::ldexp(1.01, 52)) {
                // Products are rounded down to four units, seven of them.
                const double error = (std::abs(along) / std::sqrt(squared) - 16) / (size + 1);
                worst = std::max(worst, error);
                if (squared > std::ldexp(15.01 / 16, 62)) {
                    worst_where_it_turns_little = std::max(worst_where_it_turns_little, error);
                }
            }
        }
    }
    CHECK(worst <= std::ldexp(1.0, -22)); // where it nearly folds back
    CHECK(worst_where_it_turns_little <= std::ldexp(1.0, -27));
}
