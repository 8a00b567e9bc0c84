// Every instruction set's distance kernel against plain integers: the same bits for random and extreme edges.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <string>
#include <vector>

#include "fixed/formats.h"
#include "fixed_samples.h"
#include "kernels/compiled_kernels.h"
#include "kernels/kernels.h"
#include "wide_kernels.h"

using namespace lks;

namespace {

struct Kind {
    const char* name;
    bool equal_shares;
    bool soft;
    bool damped;
    bool multiplier;
    bool relaxed; // more than one iteration
};

const Kind kinds[] = {
    {"stiff, equal shares", true, false, false, false, false},
    {"stiff, shares that differ", false, false, false, false, false},
    {"stiff, equal shares, with multipliers", true, false, false, true, false},
    {"stiff, with multipliers", false, false, false, true, false},
    {"soft, equal shares", true, true, false, false, false},
    {"soft, equal shares, relaxed", true, true, false, true, true},
    {"soft, shares that differ", false, true, false, false, false},
    {"soft, with multipliers", false, true, false, true, false},
    {"damped", true, true, true, false, false},
    {"damped, relaxed", true, true, true, true, true},
    {"damped, shares that differ", false, true, true, false, false},
    {"damped, shares that differ, relaxed", false, true, true, true, true},
};

std::vector<std::uint32_t> lengths_up_to(std::uint32_t longest) {
    std::vector<std::uint32_t> lengths(longest);
    std::iota(lengths.begin(), lengths.end(), 1u);
    return lengths;
}

// One batch: runs of these lengths, then constraints from anywhere, no particle twice.
struct Batch {
    std::vector<Run> runs;
    std::vector<Constraint> constraints;
    std::uint32_t first_single = 0;
    std::uint32_t particles = 0;

    Batch(test::Random& random, const std::vector<std::uint32_t>& lengths) {
        for (const std::uint32_t length : lengths) {
            const auto gap = static_cast<std::uint32_t>(random.below(16));
            const std::uint32_t spare = std::min(gap, (widest_group - length % widest_group) % widest_group);
            const auto first = static_cast<std::uint32_t>(constraints.size());
            runs.push_back({first, length, particles, particles + length + gap, spare});
            for (std::uint32_t i = 0; i < length; ++i) {
                constraints.push_back({particles + i, particles + length + gap + i});
            }
            particles += 2 * (length + gap);
        }
        first_single = static_cast<std::uint32_t>(constraints.size());
        std::vector<std::uint32_t> order;
        for (std::uint32_t i = 0; i < 246; ++i) {
            order.push_back(particles + i);
        }
        for (std::size_t i = order.size(); i > 1; --i) {
            std::swap(order[i - 1], order[random.bits() % i]);
        }
        for (std::size_t i = 0; i < order.size(); i += 2) {
            constraints.push_back({order[i], order[i + 1]});
        }
        particles += 246;
    }
};

// Positions and coefficients by the shape of a batch.
struct Problem {
    bool short_runs;                     // kernels may believe it or not
    std::vector<std::int64_t> positions; // x, y, z, starts
    std::vector<std::int64_t> multipliers;
    std::vector<std::uint32_t> rests, shares, parts_b, relaxations;
    ConstraintRange unequal_shares{};
    bool few_unequal; // the same
    DistanceParameters parameters{};
};

std::int64_t signed_below(test::Random& random, int bits) {
    return static_cast<std::int64_t>(random.bits()) >> (63 - bits);
}

// Of 2^rest_bits to 2^(rest_bits + 1) units long, and now and then about as long as either.
void place_in_octave(test::Random& random, std::vector<std::int64_t>& positions, std::uint32_t n,
                     const Constraint& ends, int rest_bits, int shift) {
    const std::uint64_t longest = random.below(3);
    const bool at_end = random.below(128) == 0;
    const std::int64_t least = std::int64_t{1} << (rest_bits + shift);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        std::int64_t edge = at_end ? 0 : signed_below(random, rest_bits + shift - 1);
        if (axis == longest) {
            edge = at_end ? (least << random.below(2)) + signed_below(random, shift + 1)
                          : least + static_cast<std::int64_t>(
                                        random.below(3 * (static_cast<std::uint64_t>(least) >> 2)));
            edge = random.below(2) == 0 ? edge : -edge;
        }
        positions[axis * n + ends.b] = positions[axis * n + ends.a] + edge;
    }
}

Problem make_problem(test::Random& random, const Batch& batch, const Kind& kind) {
    Problem problem{};
    problem.short_runs = random.below(2) == 0;
    // In most of the problems nothing leaves the fast range, or hardly any group would stay in it; in some of
    // these lengths are in the octave of the longest rest length, or hardly any group would be.
    const std::uint64_t mood = random.below(3);
    const bool calm = mood != 0;
    const bool in_octave = mood == 2;
    const std::size_t count = batch.constraints.size();
    const std::uint32_t n = batch.particles;
    const int shift = 20 + static_cast<int>(random.bits() % 11);
    const int exponent = kind.soft ? static_cast<int>(random.bits() % 12) : 0;
    const int gain_bits = exponent == 0 ? shift : direction_fraction_bits;
    // The longest edge has 22 to 30 bits in units of the difference.
    const int rest_bits = 22 + static_cast<int>(random.bits() % 8);
    problem.parameters.difference_shift = shift;
    problem.parameters.rest_exponent = 31 - rest_bits;
    problem.parameters.gain_shift = unit_fraction_bits + direction_fraction_bits - gain_bits;
    problem.parameters.product_shift = gain_bits - shift + exponent;
    problem.parameters.error_share = kind.damped ? static_cast<std::uint32_t>(random.bits() >> 33) : unit_one;
    if (kind.damped && random.below(8) == 0) {
        problem.parameters.error_share = random.below(2) == 0 ? 0 : unit_one - 1;
    }
    problem.parameters.damping_share = unit_one - std::max(problem.parameters.error_share, 1u);
    problem.positions.resize(6 * n + widest_group - 1);
    for (std::size_t i = 0; i < problem.positions.size(); ++i) {
        problem.positions[i] = signed_below(random, 61);
    }
    const std::size_t padded = count + widest_group - 1;
    problem.few_unequal = random.below(2) == 0;
    // Everywhere, or in a part.
    if (!kind.equal_shares) {
        problem.unequal_shares = {0, static_cast<std::uint32_t>(count)};
        if (random.below(2) == 0) {
            problem.unequal_shares.first = static_cast<std::uint32_t>(random.bits() % count);
            problem.unequal_shares.last =
                problem.unequal_shares.first + 1 +
                static_cast<std::uint32_t>(random.bits() % (count - problem.unequal_shares.first));
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        problem.rests.push_back(static_cast<std::uint32_t>(0x80000000u | random.bits() >> 33) >>
                                (random.bits() % 4 == 0 ? random.bits() % 4 : 0));
        const auto share = static_cast<std::uint32_t>(random.bits() >> 33);
        const bool may_differ = is_in(problem.unequal_shares, static_cast<std::uint32_t>(i));
        const bool equal = !may_differ || random.bits() % 8 != 0;
        problem.parts_b.push_back(equal ? half_part
                                        : static_cast<std::uint32_t>(random.bits() % (direction_one + 1)));
        if (random.bits() % 16 == 0 && may_differ) {
            problem.parts_b.back() = random.below(2) == 0 ? 0 : direction_one;
        }
        problem.shares.push_back(problem.parts_b.back() != half_part ? share
                                 : kind.soft                         ? share / 2
                                                                     : unit_one / 2);
        problem.relaxations.push_back(static_cast<std::uint32_t>(random.bits() >> 33));
        problem.multipliers.push_back(
            random.below(4) == 0 ? 0 : signed_below(random, calm ? rest_bits + shift : 58));
        // Most edges are near their rest length; some anything from nothing to the range.
        const Constraint ends = batch.constraints[i];
        const bool strange = !calm && random.below(61) == 0;
        const int reach = strange ? static_cast<int>(random.bits() % 62) : rest_bits + shift;
        // In half of these the edge has about its rest length all the same.
        if (strange && reach < rest_bits + shift && random.below(2) == 0) {
            problem.rests.back() >>= std::min(rest_bits + shift - reach, 31);
        }
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            std::int64_t* x = problem.positions.data() + axis * n;
            x[ends.b] = x[ends.a] + signed_below(random, reach > 60 ? 60 : reach);
        }
        if (in_octave) {
            place_in_octave(random, problem.positions, n, ends, rest_bits, shift);
        }
        if (!calm && random.below(101) == 0) {
            for (std::uint32_t axis = 0; axis < 3; ++axis) {
                problem.positions[axis * n + ends.b] = problem.positions[axis * n + ends.a];
            }
        }
        // Motions within a substep.
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            for (const std::uint32_t end : {ends.a, ends.b}) {
                problem.positions[(axis + 3) * n + end] =
                    problem.positions[axis * n + end] +
                    signed_below(random, !calm && random.below(64) == 0 ? 60 : rest_bits + shift - 6);
            }
        }
        // Now and then by as much as the edge is long, where motions end that groups may take: from no length
        // at the start of the substep, or from twice the length.
        if (random.below(16) == 0) {
            const bool from_nothing = random.below(2) == 0;
            for (std::uint32_t axis = 0; axis < 3; ++axis) {
                const std::int64_t* x = problem.positions.data() + axis * n;
                std::int64_t* start = problem.positions.data() + (axis + 3) * n;
                const std::int64_t edge = from_nothing ? 0 : (x[ends.b] - x[ends.a]) * 2;
                const std::int64_t about = signed_below(random, static_cast<int>(1 + random.bits() % 50));
                start[ends.b] = start[ends.a] + edge + about;
            }
        }
    }
    // Kernels read on, and must not mind what they find.
    problem.rests.resize(padded, UINT32_MAX);
    problem.shares.resize(padded, unit_one / 2);
    problem.parts_b.resize(padded, direction_one);
    problem.relaxations.resize(padded, unit_one - 1);
    return problem;
}

BatchPart make_part(const Batch& batch, const Problem& problem, ConstraintRange range) {
    BatchPart part{};
    part.range = range;
    part.runs = batch.runs.data();
    part.run_count = static_cast<std::uint32_t>(batch.runs.size());
    while (part.run_count != 0 && part.runs->first + part.runs->count <= range.first) {
        ++part.runs;
        --part.run_count;
    }
    part.whole = range.first == 0 && range.last == batch.constraints.size();
    part.first_single = batch.first_single;
    part.unequal_shares = problem.unequal_shares;
    part.few_unequal = problem.few_unequal;
    return part;
}

DistanceTask make_task(const Batch& batch, const Kind& kind, Problem& problem, const BatchPart& part) {
    const std::uint32_t n = batch.particles;
    std::int64_t* x = problem.positions.data();
    DistanceTask task{};
    task.parts = &part;
    task.part_count = 1;
    task.short_runs = problem.short_runs;
    task.soft = kind.soft;
    task.damped = kind.damped;
    task.parameters = problem.parameters;
    task.constraints = batch.constraints.data();
    task.rest_mantissas = problem.rests.data();
    task.shares = problem.shares.data();
    task.parts_b = problem.parts_b.data();
    task.relaxations = kind.relaxed ? problem.relaxations.data() : nullptr;
    task.arrays = {x,
                   x + n,
                   x + 2 * n,
                   x + 3 * n,
                   x + 4 * n,
                   x + 5 * n,
                   kind.multiplier ? problem.multipliers.data() : nullptr};
    return task;
}

Problem solved(const Kernels& kernels, const Batch& batch, const Kind& kind, Problem problem,
               ConstraintRange range) {
    const BatchPart part = make_part(batch, problem, range);
    kernels.project_distances(make_task(batch, kind, problem, part));
    return problem;
}

// Of which the kernel finds the positions in rows.
Problem solved_in_rows(const Kernels& kernels, const Batch& batch, const Kind& kind, Problem problem,
                       ConstraintRange range) {
    const std::uint32_t n = batch.particles;
    const std::size_t room = n + widest_group;
    std::vector<std::int64_t> axes(6 * room);
    for (std::size_t axis = 0; axis < 6; ++axis) {
        std::copy_n(&problem.positions[axis * n], n, &axes[axis * room]);
    }
    std::vector<std::int64_t> rows(2 * row_length * room, INT64_MIN);
    std::int64_t* x = axes.data();
    const RowTask now{x, x + room, x + 2 * room, rows.data()};
    const RowTask start{x + 3 * room, x + 4 * room, x + 5 * room, rows.data() + row_length * room};
    kernels.rows.take(now, 0, n);
    kernels.rows.take(start, 0, n);

    const BatchPart part = make_part(batch, problem, range);
    DistanceTask task = make_task(batch, kind, problem, part);
    task.in_rows = true;
    task.arrays = {now.rows,       now.rows + 1,   now.rows + 2,           start.rows,
                   start.rows + 1, start.rows + 2, task.arrays.multipliers};
    kernels.project_distances(task);
    kernels.rows.give_back(now, 0, n);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::copy_n(&axes[axis * room], n, &problem.positions[axis * n]);
    }
    return problem;
}

// The runs of several problems that have all but the positions in common.
void solve_side_by_side(const Kernels& kernels, const Batch& batch, const Kind& kind,
                        std::vector<Problem>& problems) {
    const BatchPart part = make_part(batch, problems[0], {0, batch.first_single});
    DistanceTask task = make_task(batch, kind, problems[0], part);
    std::vector<std::ptrdiff_t> places;
    for (const Problem& problem : problems) {
        const auto bytes = reinterpret_cast<std::intptr_t>(problem.positions.data()) -
                           reinterpret_cast<std::intptr_t>(problems[0].positions.data());
        places.push_back(bytes / static_cast<std::intptr_t>(sizeof(std::int64_t)));
    }
    task.objects = places.data();
    task.object_count = static_cast<std::uint32_t>(places.size());
    kernels.project_distances(task);
}

struct Compared {
    std::uint64_t constraints = 0;
    int problems = 0;
    int different = 0;
    int unchanged = 0;
};

// Each near where it would be, had they their positions in common, too.
void compare_side_by_side(const Kernels& kernels, test::Random& random, const Batch& batch, const Kind& kind,
                          std::uint32_t count, Compared& compared) {
    std::vector<Problem> problems(count, make_problem(random, batch, kind));
    const int about = problems[0].parameters.difference_shift + 20;
    for (Problem& problem : problems) {
        for (std::size_t i = 0; i < 3 * std::size_t{batch.particles}; ++i) {
            problem.positions[i] += signed_below(random, about);
        }
    }
    std::vector<Problem> expected;
    for (const Problem& problem : problems) {
        expected.push_back(solved(kernels_scalar, batch, kind, problem, {0, batch.first_single}));
        ++compared.problems;
        compared.unchanged += expected.back().positions == problem.positions ? 1 : 0;
    }
    solve_side_by_side(kernels, batch, kind, problems);
    for (std::uint32_t i = 0; i < count; ++i) {
        compared.different += problems[i].positions != expected[i].positions ? 1 : 0;
    }
    compared.constraints += count * std::uint64_t{batch.first_single};
}

} // namespace

TEST_CASE("kernels: every instruction set projects random and extreme edges as plain integers do") {
    // 12 kinds: 10^7 for each set, and in long runs for each kind of each; fewer where a build is slow. In
    // every fifth problem runs are too few for groups to roll.
    const std::uint64_t wanted = test::sample_count() / (test::long_run() ? 1 : std::size(kinds)) + 1;
    for (const Kernels* kernels : test::wide_kernels()) {
        test::Random random(31);
        for (const Kind& kind : kinds) {
            INFO(std::string(simd_name(kernels->level)), ": ", std::string(kind.name));
            int different = 0;
            int unchanged = 0;
            std::uint64_t constraints = 0;
            for (int p = 0; constraints < wanted; ++p) {
                const Batch batch(random, lengths_up_to(p % 5 == 0 ? 16 : 40));
                const auto end = static_cast<std::uint32_t>(batch.constraints.size());
                ConstraintRange range{0, end};
                if (p % 3 == 0) {
                    range.first = static_cast<std::uint32_t>(random.bits() % end);
                    range.last =
                        range.first + static_cast<std::uint32_t>(random.bits() % (end - range.first));
                }
                constraints += range.last - range.first;
                const Problem problem = make_problem(random, batch, kind);
                const Problem expected = solved(kernels_scalar, batch, kind, problem, range);
                const Problem actual = solved(*kernels, batch, kind, problem, range);
                different += expected.positions != actual.positions ? 1 : 0;
                different += expected.multipliers != actual.multipliers ? 1 : 0;
                unchanged += p % 3 != 0 && expected.positions == problem.positions ? 1 : 0;
            }
            CHECK(different == 0);
            CHECK(unchanged == 0);
        }
    }
}

TEST_CASE("kernels: parts of every length about which groups begin to roll are projected alike") {
    for (const Kernels* kernels : test::wide_kernels()) {
        test::Random random(37);
        for (const Kind& kind : kinds) {
            INFO(std::string(simd_name(kernels->level)), ": ", std::string(kind.name));
            int different = 0;
            for (std::uint32_t count = 180; count < 212; ++count) {
                for (const auto& lengths :
                     {std::vector<std::uint32_t>{count}, {count - 60, 33, 1, 9, 17}, {3, count - 3}}) {
                    const Batch batch(random, lengths);
                    const ConstraintRange range{0, static_cast<std::uint32_t>(batch.constraints.size())};
                    const Problem problem = make_problem(random, batch, kind);
                    const Problem expected = solved(kernels_scalar, batch, kind, problem, range);
                    const Problem actual = solved(*kernels, batch, kind, problem, range);
                    different += expected.positions != actual.positions ? 1 : 0;
                    different += expected.multipliers != actual.multipliers ? 1 : 0;
                }
            }
            CHECK(different == 0);
        }
    }
}

TEST_CASE("kernels: in rows they project random and extreme edges as plain integers do in arrays") {
    // From one constraint to more than begin to roll, whole batches and parts: 2·10^6 for each set, and in
    // long runs 10^7 for each kind of each.
    const std::uint64_t wanted = test::sample_count() / (test::long_run() ? 1 : 5 * std::size(kinds));
    for (const Kernels* kernels : test::wide_kernels()) {
        if (kernels->rows.take == nullptr) {
            continue;
        }
        test::Random random(43);
        for (const Kind& kind : kinds) {
            INFO(std::string(simd_name(kernels->level)), ": ", std::string(kind.name));
            int different = 0;
            int unchanged = 0;
            std::uint64_t constraints = 0;
            for (int p = 0; constraints < wanted; ++p) {
                const Batch batch(random, lengths_up_to(p % 5 == 0 ? 3 : 30));
                const auto end = static_cast<std::uint32_t>(batch.constraints.size());
                ConstraintRange range{0, end};
                if (p % 3 != 0) {
                    const std::uint64_t longest = p % 3 == 1 ? 40 : end;
                    range.first = static_cast<std::uint32_t>(random.bits() % end);
                    range.last = range.first + static_cast<std::uint32_t>(
                                                   random.bits() %
                                                   (std::min<std::uint64_t>(longest, end - range.first) + 1));
                }
                constraints += range.last - range.first;
                const Problem problem = make_problem(random, batch, kind);
                const Problem expected = solved(kernels_scalar, batch, kind, problem, range);
                const Problem actual = solved_in_rows(*kernels, batch, kind, problem, range);
                different += expected.positions != actual.positions ? 1 : 0;
                different += expected.multipliers != actual.multipliers ? 1 : 0;
                unchanged += p % 3 == 0 && actual.positions == problem.positions ? 1 : 0;
            }
            CHECK(different == 0);
            CHECK(unchanged == 0);
        }
    }
}

TEST_CASE("kernels: three to sixteen objects side by side move as each does by itself") {
    // Once each number of objects with each of these runs: some 134,000 constraints of each kind. In long
    // runs again and again, up to 10^7.
    const std::uint64_t wanted = test::long_run() ? test::sample_count() : 1;
    for (const Kernels* kernels : test::wide_kernels()) {
        if (!kernels->side_by_side) {
            continue;
        }
        test::Random random(41);
        for (const Kind& kind : kinds) {
            if (kind.multiplier) {
                continue;
            }
            INFO(std::string(simd_name(kernels->level)), ": ", std::string(kind.name));
            Compared compared;
            while (compared.constraints < wanted) {
                for (std::uint32_t count = least_side_by_side; count <= most_side_by_side; ++count) {
                    for (const auto& lengths : {lengths_up_to(40), {50}, {10, 9}, {1}, {97, 16, 2}}) {
                        compare_side_by_side(*kernels, random, Batch(random, lengths), kind, count, compared);
                    }
                }
            }
            CHECK(compared.different == 0);
            // Of the many in long runs; one constraint may have nothing to do.
            CHECK(compared.unchanged <= compared.problems / 1000);
        }
    }
}

TEST_CASE("kernels: a part of a run writes nothing behind its end, where others may be at work") {
    // One end's particles lie behind the other's: what is written there again as it was undoes their
    // movement.
    constexpr std::uint32_t part = 3;
    const Run run{0, 21, part, 0, widest_group - 1};
    const Constraint none{};
    const std::vector<std::uint32_t> rests(2 * widest_group, 0x80000000u); // an eighth of a metre
    const std::vector<std::uint32_t> shares(2 * widest_group, unit_one / 2);
    const std::vector<std::uint32_t> parts(2 * widest_group, half_part);
    const auto projected = [&](const Kernels& kernels) {
        std::vector<std::int64_t> axes(6 * widest_group, 0);
        std::fill_n(axes.begin() + part, part, coordinate_one / 10);
        BatchPart cut{};
        cut.range = {0, part};
        cut.runs = &run;
        cut.run_count = 1;
        cut.first_single = run.count;
        DistanceTask task{};
        task.parts = &cut;
        task.part_count = 1;
        task.constraints = &none;
        task.rest_mantissas = rests.data();
        task.shares = shares.data();
        task.parts_b = parts.data();
        task.parameters = {26, 4, 35, 0, unit_one, 0};
        task.arrays = {axes.data(),
                       axes.data() + 2 * widest_group,
                       axes.data() + 4 * widest_group,
                       nullptr,
                       nullptr,
                       nullptr,
                       nullptr};
        kernels.project_distances(task);
        return axes;
    };
    const std::vector<std::int64_t> expected = projected(kernels_scalar);
    CHECK(expected[part] > coordinate_one / 10);
    for (const Kernels* kernels : test::wide_kernels()) {
        INFO(std::string(simd_name(kernels->level)));
        CHECK(projected(*kernels) == expected);
    }
}
