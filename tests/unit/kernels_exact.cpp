// Every kernel, plain integers too, against the same formulas in integers that have no limit: at the ends of
// all ranges nothing is lost in between.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "big_integer.h"
#include "fixed/formats.h"
#include "fixed/int128.h"
#include "fixed/projection_reciprocal_sqrt.h"
#include "fixed_samples.h"
#include "kernels/compiled_kernels.h"
#include "wide_kernels.h"

using namespace lks;

namespace {

using B = test::Big<6>;

B big(std::int64_t value) {
    return B::from_i64(value);
}
B power(int n) {
    return B::power_of_two(n);
}
std::int64_t low(const B& value) {
    return static_cast<std::int64_t>(value.low64());
}
// value / 2^right, half up; exact where that is a shift to the left.
B rounded(const B& value, int right) {
    return right > 0 ? test::shift_right_half_up(value, right) : value << -right;
}
B floored(const B& value, int right) {
    return right > 0 ? value >> right : value << -right;
}
B between(const B& value, const B& least, const B& greatest) {
    return value < least ? least : value > greatest ? greatest : value;
}

std::vector<const Kernels*> all_kernels() {
    std::vector<const Kernels*> all = test::wide_kernels();
    all.push_back(&kernels_scalar);
    return all;
}

template <std::size_t n>
std::int64_t one_of(test::Random& random, const std::int64_t (&values)[n]) {
    return values[random.below(n)];
}

// One edge: where its ends are and were, and everything that a projection knows about it.
struct Edge {
    std::int64_t a[3], b[3], start_a[3], start_b[3];
    std::int64_t multiplier;
    std::uint32_t rest, share, part_b, relaxation;
    DistanceParameters parameters;
    bool soft, damped, records, relaxed;
};

constexpr std::int64_t unit_edges[] = {0, 1, 2, unit_one / 2 - 1, unit_one / 2, unit_one - 2, unit_one - 1};

constexpr std::int64_t part_edges[] = {
    0, 1, direction_one / 2 - 1, direction_one / 2 + 1, direction_one - 1, direction_one};

std::uint32_t any_unit(test::Random& random) {
    return random.below(3) == 0 ? static_cast<std::uint32_t>(random.bits() >> 33)
                                : static_cast<std::uint32_t>(one_of(random, unit_edges));
}

// Next to the places where something changes: no length, half a unit, the longest edge that groups take, the
// ends of the range.
std::int64_t edge_value(test::Random& random, int shift) {
    const std::int64_t unit = std::int64_t{1} << shift;
    const std::int64_t places[] = {0,
                                   unit / 2,
                                   unit,
                                   unit << 15,
                                   unit << 16,
                                   (unit << 30) - unit / 2,
                                   unit << 30,
                                   coordinate_limit / 2,
                                   coordinate_limit};
    const std::int64_t value = one_of(random, places) + static_cast<std::int64_t>(random.below(3)) - 1;
    return std::clamp(random.below(2) == 0 ? value : -value, -coordinate_limit, coordinate_limit);
}

// Where a mantissa of u is largest, and 1/√u least.
void make_almost_a_power_of_two_long(test::Random& random, Edge& edge) {
    std::uint64_t left = std::uint64_t{1} << (2 * (24 + random.below(6)));
    for (int axis = 0; axis < 3; ++axis) {
        const std::uint64_t root = fixed::square_root(fixed::UInt128{0, axis == 0 ? left / 3 : left - 1});
        left -= root * root;
        edge.a[axis] = 0;
        edge.b[axis] = static_cast<std::int64_t>(root << edge.parameters.difference_shift);
    }
}

Edge any_edge(test::Random& random) {
    Edge edge{};
    edge.soft = random.below(3) != 0;
    edge.damped = edge.soft && random.below(2) == 0;
    edge.records = random.below(2) == 0;
    edge.relaxed = edge.soft && edge.records && random.below(2) == 0;
    const int shift = 20 + static_cast<int>(random.below(11));
    const int exponent = edge.soft ? static_cast<int>(random.below(12)) : 0;
    const int gain_bits = exponent == 0 ? shift : direction_fraction_bits;
    edge.parameters.difference_shift = shift;
    edge.parameters.rest_exponent = 2 + static_cast<int>(random.below(8));
    edge.parameters.gain_shift = unit_fraction_bits + direction_fraction_bits - gain_bits;
    edge.parameters.product_shift = gain_bits - shift + exponent;
    edge.parameters.error_share = edge.damped ? any_unit(random) : unit_one;
    edge.parameters.damping_share = std::min(unit_one - edge.parameters.error_share, unit_one - 1);
    for (int axis = 0; axis < 3; ++axis) {
        const bool close = random.below(3) != 0;
        edge.a[axis] = edge_value(random, shift);
        edge.b[axis] =
            close ? std::clamp(edge.a[axis] + edge_value(random, shift), -coordinate_limit, coordinate_limit)
                  : edge_value(random, shift);
        edge.start_a[axis] = random.below(2) == 0 ? edge.a[axis] : edge_value(random, shift);
        edge.start_b[axis] = random.below(2) == 0 ? edge.b[axis] : edge_value(random, shift);
    }
    if (random.below(8) == 0) {
        make_almost_a_power_of_two_long(random, edge);
    }
    edge.multiplier = edge_value(random, shift);
    edge.rest = random.below(2) == 0 ? UINT32_MAX >> random.below(4) : 0x80000000u >> random.below(4);
    edge.part_b = random.below(2) == 0   ? half_part
                  : random.below(3) == 0 ? static_cast<std::uint32_t>(one_of(random, part_edges))
                                         : static_cast<std::uint32_t>(random.below(direction_one + 1));
    edge.share = edge.part_b != half_part ? any_unit(random)
                 : edge.soft              ? (any_unit(random) + 1) / 2
                                          : unit_one / 2;
    edge.relaxation = any_unit(random);
    return edge;
}

// solver/distance.h, step by step. Only 1/√u is the kernels' own, which fixed_reciprocal.cpp looks at.
void project_exactly(Edge& edge) {
    const DistanceParameters& p = edge.parameters;
    B wide[3];
    std::uint64_t largest = 0;
    for (int axis = 0; axis < 3; ++axis) {
        wide[axis] = big(edge.a[axis]) - big(edge.b[axis]);
        const std::int64_t w = low(wide[axis]);
        largest |= static_cast<std::uint64_t>(w ^ (w >> 63));
    }
    const auto fits = [&] {
        return std::all_of(wide, wide + 3, [&](const B& w) {
            const B d = rounded(w, p.difference_shift);
            return d >= -power(30) && d < power(30);
        });
    };
    const bool far = !fits();
    const int extra = !far ? 0 : static_cast<int>(std::bit_width(largest)) - 30 - p.difference_shift;
    const int scale = p.difference_shift + extra;
    const B one = power(direction_fraction_bits);
    B d[3];
    B u{};
    for (int axis = 0; axis < 3; ++axis) {
        d[axis] = rounded(wide[axis], scale);
        if (far) {
            d[axis] = between(d[axis], big(1) - one, one - big(1));
        }
        u = u + d[axis] * d[axis];
    }
    if (u.is_zero()) {
        return;
    }
    const fixed::ReciprocalLength reciprocal = fixed::projection_reciprocal_length(u.low64());
    const B y = B::from_u64(reciprocal.mantissa);
    const int k = reciprocal.shift;

    const B ratio = floored(B::from_u64(edge.rest) * y, 32 + p.rest_exponent + extra - k);
    B f = between(ratio, B{}, one + one) - one;
    if (edge.damped) {
        B dot = u;
        for (int axis = 0; axis < 3; ++axis) {
            const B start = rounded(big(edge.start_a[axis]) - big(edge.start_b[axis]), scale);
            dot = dot - d[axis] * between(start, -one, one - big(1));
        }
        const B aligned = rounded(between(dot, -u, u) << (2 * k), 34);
        const B motion = floored(aligned * floored(y * y, 32), 28);
        const B half = power(unit_fraction_bits - 1) - B::from_u64(p.damping_share / 2);
        f = floored(B::from_u64(p.error_share) * f - B::from_u64(p.damping_share) * motion + half,
                    unit_fraction_bits);
    }
    if (edge.relaxed) {
        const B length = between(rounded(big(edge.multiplier), scale), big(-INT32_MAX), big(INT32_MAX));
        const B share = rounded(B::from_u64(edge.relaxation) * length, unit_fraction_bits);
        f = between(f - rounded(share * y, 32 - k), -one, one);
    }
    if (edge.records) {
        const B root = between(floored(floored(u << (2 * k), 32) * y, 31), B{}, big(INT32_MAX));
        edge.multiplier = low(big(edge.multiplier) + floored((f + f) * root, 30 + k - scale));
    }
    const B gain = rounded(B::from_u64(edge.share) * f, p.gain_shift);
    for (int axis = 0; axis < 3; ++axis) {
        const B moves = rounded(d[axis] * gain, p.product_shift - extra);
        const bool alike = edge.part_b == half_part;
        const B of_b = alike ? moves : rounded(moves * B::from_u64(edge.part_b), direction_fraction_bits);
        edge.a[axis] = low(big(edge.a[axis]) + (alike ? moves : moves - of_b));
        edge.b[axis] = low(big(edge.b[axis]) - of_b);
    }
}

// The same edge in all lanes of a run and again without one, so that groups take it wherever they can.
class Copies {
public:
    Copies(const Edge& edge, const Kernels& kernels) : multipliers_(room, edge.multiplier) {
        for (int axis = 0; axis < 3; ++axis) {
            fill(axis, edge.a[axis], edge.b[axis]);
            fill(axis + 3, edge.start_a[axis], edge.start_b[axis]);
        }
        const std::vector<std::uint32_t> rests(room, edge.rest), shares(room, edge.share),
            parts_b(room, edge.part_b), relaxations(room, edge.relaxation);
        std::vector<Constraint> ends;
        for (std::uint32_t i = 0; i < count; ++i) {
            ends.push_back({i, i + count});
        }
        const Run run{0, length, 0, count, 0};
        BatchPart part{};
        part.range = {0, count};
        part.runs = &run;
        part.run_count = 1;
        part.whole = true;
        part.first_single = length;
        part.unequal_shares = {0, edge.part_b == half_part ? 0 : count};
        DistanceTask task{};
        task.parts = &part;
        task.part_count = 1;
        task.constraints = ends.data();
        task.rest_mantissas = rests.data();
        task.shares = shares.data();
        task.parts_b = parts_b.data();
        task.relaxations = edge.relaxed ? relaxations.data() : nullptr;
        task.parameters = edge.parameters;
        task.arrays = {axes_[0].data(),
                       axes_[1].data(),
                       axes_[2].data(),
                       axes_[3].data(),
                       axes_[4].data(),
                       axes_[5].data(),
                       edge.records ? multipliers_.data() : nullptr};
        task.soft = edge.soft;
        task.damped = edge.damped;
        kernels.project_distances(task);
    }

    bool are(const Edge& edge) const {
        for (std::uint32_t i = 0; i < count; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                if (axes_[axis][i] != edge.a[axis] || axes_[axis][i + count] != edge.b[axis]) {
                    return false;
                }
            }
            if (edge.records && multipliers_[i] != edge.multiplier) {
                return false;
            }
        }
        return true;
    }

private:
    static constexpr std::uint32_t length = 19; // a group of every width and an end
    static constexpr std::uint32_t count = 2 * length;
    static constexpr std::uint32_t room = 2 * count + widest_group;

    void fill(int axis, std::int64_t a, std::int64_t b) {
        axes_[axis].assign(room, a);
        std::fill(axes_[axis].begin() + count, axes_[axis].end(), b);
    }

    std::vector<std::int64_t> axes_[6];
    std::vector<std::int64_t> multipliers_;
};

} // namespace

TEST_CASE("kernels: projections at the ends of every range are what integers without limits give") {
    test::Random random(17);
    std::uint64_t different = 0;
    std::uint64_t moved = 0;
    const std::uint64_t edges = test::sample_count() / (test::long_run() ? 10 : 200);
    const std::vector<const Kernels*> all = all_kernels();
    for (std::uint64_t i = 0; i < edges; ++i) {
        const Edge edge = any_edge(random);
        Edge expected = edge;
        project_exactly(expected);
        moved += expected.a[0] != edge.a[0] ? 1 : 0;
        for (const Kernels* kernels : all) {
            different += Copies(edge, *kernels).are(expected) ? 0 : 1;
        }
    }
    CHECK(different == 0);
    CHECK(moved > edges / 4);
}

TEST_CASE("kernels: predictions at the ends of every range are what integers without limits give") {
    const std::int64_t places[] = {-INT64_MAX - 1,
                                   -coordinate_limit - 1,
                                   -coordinate_limit,
                                   -(std::int64_t{1} << 61),
                                   -1,
                                   0,
                                   1,
                                   (std::int64_t{1} << 61) - 1,
                                   coordinate_limit,
                                   coordinate_limit + 1,
                                   INT64_MAX};
    const std::int64_t limits[] = {1, 1 << 20, substep_motion_limit - 1, substep_motion_limit};
    const std::uint32_t shares[] = {0, 1, unit_one / 2, unit_one - 1, unit_one};
    std::uint64_t different = 0;
    for (const Kernels* kernels : all_kernels()) {
        for (const std::int64_t limit : limits) {
            const std::int64_t motions[] = {-INT64_MAX - 1, -limit - 1, -limit,    1 - limit, -1, 0, 1,
                                            limit - 1,      limit,      limit + 1, INT64_MAX};
            for (const std::int64_t acceleration :
                 {-limit, std::int64_t{-1}, std::int64_t{0}, limit / 2, limit}) {
                for (const std::uint32_t kept : shares) {
                    std::vector<std::int64_t> x, start, expected_x, expected_start;
                    PredictionClamps expected;
                    for (const std::int64_t place : places) {
                        for (const std::int64_t motion : motions) {
                            x.push_back(place);
                            start.push_back(low(big(place) - big(motion)));
                            // The motion is what is left of it in 64 bits.
                            const B damped = rounded(big(motion) * B::from_u64(kept), unit_fraction_bits);
                            const B inertial = between(damped, big(-limit), big(limit));
                            const B fast = inertial + big(acceleration);
                            const B limited = between(fast, big(-limit), big(limit));
                            const B here = between(big(place), big(-coordinate_limit), big(coordinate_limit));
                            const B there =
                                between(here + limited, big(-coordinate_limit), big(coordinate_limit));
                            expected.speeds += inertial == damped && limited == fast ? 0 : 1;
                            expected.positions += here == big(place) && there == here + limited ? 0 : 1;
                            expected_x.push_back(low(there));
                            expected_start.push_back(low(here));
                        }
                    }
                    const PredictionClamps clamps =
                        kernels->predict({x.data(), start.data(), x.size(), acceleration, kept, limit});
                    different += x == expected_x && start == expected_start ? 0 : 1;
                    different +=
                        clamps.speeds == expected.speeds && clamps.positions == expected.positions ? 0 : 1;
                }
            }
        }
    }
    CHECK(different == 0);
}

TEST_CASE("kernels: heights above planes at the ends of the range are what integers without limits give") {
    const std::int64_t places[] = {-INT64_MAX - 1, -coordinate_limit, -1, 0, coordinate_limit, INT64_MAX};
    const std::int32_t components[] = {-direction_one, -1, 0, 1, direction_one};
    test::Random random(8);
    std::uint64_t different = 0;
    for (std::uint64_t i = 0; i < 20000; ++i) {
        std::vector<std::int64_t> axes[3];
        PlaneTask task{};
        for (int axis = 0; axis < 3; ++axis) {
            for (int particle = 0; particle < 64; ++particle) {
                axes[axis].push_back(one_of(random, places));
            }
            task.positions[axis] = axes[axis].data();
            task.normal[axis] = components[random.below(std::size(components))];
        }
        std::uint64_t below = 0;
        const auto height = [&](std::size_t particle) {
            B sum{};
            for (int axis = 0; axis < 3; ++axis) {
                sum = sum + big(task.normal[axis]) * floored(big(axes[axis][particle]), 32);
            }
            return sum;
        };
        // At the height of one of them, or an end of the range that planes have.
        constexpr std::int64_t end = (std::int64_t{1} << 61) - 1;
        task.level = std::clamp(low(height(random.below(64))), -end, end);
        for (std::size_t particle = 0; particle < 64; ++particle) {
            below |= std::uint64_t{height(particle) < big(task.level)} << particle;
        }
        for (const Kernels* kernels : all_kernels()) {
            different += kernels->near_plane(task, 0, 64) == below ? 0 : 1;
        }
    }
    CHECK(different == 0);
}
