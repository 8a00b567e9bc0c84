// Every kernel, plain integers too, against the same formulas in integers that have no limit: at the ends of
// all ranges nothing is lost in between.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "exact_kernels.h"
#include "fixed/formats.h"
#include "fixed/int128.h"
#include "fixed/projection_reciprocal_sqrt.h"
#include "fixed_samples.h"
#include "kernels/kernels.h"
#include "wide_kernels.h"

using namespace lks;
using namespace lks::test::exact;

namespace {

// What edges of one batch have in common.
struct Kind {
    DistanceParameters parameters;
    bool soft, damped, records, relaxed;
    // Which of the batch's ends may have shares of their own, and whether it is told that these are few.
    enum { none, of_first_edge, of_all_edges } unequal;
    bool few_unequal;
};

// One edge: where its ends are and were, and everything that a projection knows about it.
struct Edge {
    std::int64_t a[3], b[3], start_a[3], start_b[3];
    std::int64_t multiplier;
    std::uint32_t rest, share, part_b, relaxation;
};

constexpr std::int64_t unit_edges[] = {0, 1, 2, unit_one / 2 - 1, unit_one / 2, unit_one - 2, unit_one - 1};

constexpr std::int64_t part_edges[] = {
    0, 1, direction_one / 2 - 1, direction_one / 2 + 1, direction_one - 1, direction_one};

std::uint32_t any_unit(test::Random& random) {
    return random.below(3) == 0 ? static_cast<std::uint32_t>(random.bits() >> 33)
                                : static_cast<std::uint32_t>(one_of(random, unit_edges));
}

Kind any_kind(test::Random& random) {
    Kind kind{};
    kind.soft = random.below(3) != 0;
    kind.damped = kind.soft && random.below(2) == 0;
    kind.records = random.below(2) == 0;
    kind.relaxed = kind.soft && kind.records && random.below(2) == 0;
    kind.unequal = random.below(3) == 0   ? Kind::none
                   : random.below(2) == 0 ? Kind::of_first_edge
                                          : Kind::of_all_edges;
    kind.few_unequal = random.below(2) == 0;
    const int shift = 20 + static_cast<int>(random.below(11));
    const int exponent = kind.soft ? static_cast<int>(random.below(12)) : 0;
    const int gain_bits = exponent == 0 ? shift : direction_fraction_bits;
    kind.parameters.difference_shift = shift;
    kind.parameters.rest_exponent = 2 + static_cast<int>(random.below(8));
    kind.parameters.gain_shift = unit_fraction_bits + direction_fraction_bits - gain_bits;
    kind.parameters.product_shift = gain_bits - shift + exponent;
    kind.parameters.error_share = kind.damped ? any_unit(random) : unit_one;
    kind.parameters.damping_share = std::min(unit_one - kind.parameters.error_share, unit_one - 1);
    return kind;
}

// Next to the places where something changes: no length, half a unit, the octave of the longest rest length,
// the longest edge that groups take, the ends of the range.
std::int64_t edge_value(test::Random& random, const Kind& kind) {
    const std::int64_t unit = std::int64_t{1} << kind.parameters.difference_shift;
    const std::int64_t octave = unit << (31 - kind.parameters.rest_exponent);
    const std::int64_t places[] = {0,
                                   unit / 2,
                                   unit,
                                   unit << 15,
                                   unit << 16,
                                   octave,
                                   2 * octave,
                                   (unit << 30) - unit / 2,
                                   unit << 30,
                                   coordinate_limit / 2,
                                   coordinate_limit};
    const std::int64_t value = one_of(random, places) + static_cast<std::int64_t>(random.below(3)) - 1;
    return std::clamp(random.below(2) == 0 ? value : -value, -coordinate_limit, coordinate_limit);
}

// Where a mantissa of u is largest, and 1/√u least.
void make_almost_a_power_of_two_long(test::Random& random, const Kind& kind, Edge& edge) {
    std::uint64_t left = std::uint64_t{1} << (2 * (24 + random.below(6)));
    for (int axis = 0; axis < 3; ++axis) {
        const std::uint64_t root = fixed::square_root(fixed::UInt128{0, axis == 0 ? left / 3 : left - 1});
        left -= root * root;
        edge.a[axis] = 0;
        edge.b[axis] = static_cast<std::int64_t>(root << kind.parameters.difference_shift);
    }
}

Edge any_edge(test::Random& random, const Kind& kind, bool may_be_unequal) {
    Edge edge{};
    const auto value = [&] { return edge_value(random, kind); };
    for (int axis = 0; axis < 3; ++axis) {
        const bool close = random.below(3) != 0;
        edge.a[axis] = value();
        edge.b[axis] =
            close ? std::clamp(edge.a[axis] + value(), -coordinate_limit, coordinate_limit) : value();
        edge.start_a[axis] = random.below(2) == 0 ? edge.a[axis] : value();
        edge.start_b[axis] = random.below(2) == 0 ? edge.b[axis] : value();
    }
    if (random.below(8) == 0) {
        make_almost_a_power_of_two_long(random, kind, edge);
    }
    edge.multiplier = random.below(8) != 0 ? value() : random.below(2) == 0 ? INT64_MAX : INT64_MIN;
    edge.rest = random.below(2) == 0 ? UINT32_MAX >> random.below(4) : 0x80000000u >> random.below(4);
    edge.part_b = !may_be_unequal || random.below(2) == 0 ? half_part
                  : random.below(3) == 0 ? static_cast<std::uint32_t>(one_of(random, part_edges))
                                         : static_cast<std::uint32_t>(random.below(direction_one + 1));
    edge.share = edge.part_b != half_part ? any_unit(random)
                 : kind.soft              ? (any_unit(random) + 1) / 2
                                          : unit_one / 2;
    edge.relaxation = any_unit(random);
    return edge;
}

// solver/distance.h, step by step. Only 1/√u is the kernels' own, which fixed_reciprocal.cpp looks at.
void project_exactly(const Kind& kind, Edge& edge) {
    const DistanceParameters& p = kind.parameters;
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
    if (kind.damped) {
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
    if (kind.relaxed) {
        const B length = rounded(big(edge.multiplier), scale);
        const B share = rounded(B::from_u64(edge.relaxation) * length, unit_fraction_bits);
        f = between(f - rounded(share * y, 32 - k), -one, one);
    }
    if (kind.records) {
        const B root = between(floored(floored(u << (2 * k), 32) * y, 31), B{}, big(INT32_MAX));
        const auto saturated = [](const B& v) { return between(v, -power(63), power(63) - big(1)); };
        const B sum = big(edge.multiplier) + saturated(floored((f + f) * root, 30 + k - scale));
        edge.multiplier = low(kind.relaxed ? saturated(sum) : sum);
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

// How kernels find the constraints of a batch: in runs of some groups and an end, which go in stages, or of
// so many that groups roll; in rows, as few and as many; in runs of three objects that go side by side.
enum class Layout { short_run, long_run, short_rows, long_rows, side_by_side };
constexpr Layout layouts[] = {Layout::short_run, Layout::long_run, Layout::short_rows, Layout::long_rows,
                              Layout::side_by_side};

bool is_taken(const Kernels& kernels, const Kind& kind, Layout layout) {
    switch (layout) {
    case Layout::short_rows:
    case Layout::long_rows:
        return kernels.rows.take != nullptr;
    case Layout::side_by_side:
        return kernels.side_by_side && !kind.records;
    default:
        return true;
    }
}

constexpr std::size_t edge_count = 4;
using Edges = Edge[edge_count];

// One edge in all lanes of the widest group, another in those of the next group: so groups take each wherever
// they can, and follow each other from one side of a limit to the other. The first edge is the second group's
// alone.
class Copies {
public:
    Copies(const Kind& kind, const Edges& edges, const Kernels& kernels, Layout layout)
        : count_(layout == Layout::short_run || layout == Layout::short_rows ? 37 : 211),
          objects_(layout == Layout::side_by_side ? 3 : 1), room_(2 * count_ + widest_group) {
        fill(edges);
        std::vector<std::uint32_t> rests, shares, parts_b, relaxations;
        std::vector<Constraint> ends;
        for (std::uint32_t i = 0; i < count_ + widest_group; ++i) {
            const Edge& edge = edges[number(i)];
            rests.push_back(edge.rest);
            shares.push_back(edge.share);
            parts_b.push_back(edge.part_b);
            relaxations.push_back(edge.relaxation);
            ends.push_back({i, i + count_});
        }
        const Run run{0, count_, 0, count_, 0};
        BatchPart part{};
        part.range = {0, count_};
        part.runs = &run;
        part.run_count = 1;
        part.whole = true;
        part.first_single = count_;
        part.unequal_shares = kind.unequal == Kind::none ? ConstraintRange{0, 0}
                              : kind.unequal == Kind::of_all_edges
                                  ? ConstraintRange{0, count_}
                                  : ConstraintRange{widest_group, 2 * widest_group};
        part.few_unequal = kind.few_unequal;
        DistanceTask task{};
        task.parts = &part;
        task.part_count = 1;
        task.constraints = ends.data();
        task.rest_mantissas = rests.data();
        task.shares = shares.data();
        task.parts_b = parts_b.data();
        task.relaxations = kind.relaxed ? relaxations.data() : nullptr;
        task.parameters = kind.parameters;
        task.soft = kind.soft;
        task.damped = kind.damped;
        std::int64_t* multipliers = kind.records ? multipliers_.data() : nullptr;
        task.arrays = {axes_[0].data(), axes_[1].data(), axes_[2].data(), axes_[3].data(),
                       axes_[4].data(), axes_[5].data(), multipliers};
        const std::ptrdiff_t places[] = {0, place_of(room_), place_of(2 * room_)};
        if (layout == Layout::side_by_side) {
            task.objects = places;
            task.object_count = objects_;
        }
        if (layout == Layout::short_rows || layout == Layout::long_rows) {
            project_in_rows(kernels, task);
        } else {
            kernels.project_distances(task);
        }
    }

    bool are(const Kind& kind, const Edges& edges) const {
        for (std::uint32_t i = 0; i < count_; ++i) {
            const Edge& edge = edges[number(i)];
            for (std::uint32_t a = i; a < objects_ * room_; a += room_) {
                for (int axis = 0; axis < 3; ++axis) {
                    if (axes_[axis][a] != edge.a[axis] || axes_[axis][a + count_] != edge.b[axis]) {
                        return false;
                    }
                }
            }
            if (kind.records && multipliers_[i] != edge.multiplier) {
                return false;
            }
        }
        return true;
    }

private:
    static std::size_t number(std::uint32_t constraint) {
        const std::uint32_t group = constraint / widest_group;
        return group == 1 ? 0 : 1 + group % (edge_count - 1);
    }

    void fill(const Edges& edges) {
        for (std::vector<std::int64_t>& axis : axes_) {
            axis.resize(objects_ * room_);
        }
        for (std::uint32_t i = 0; i < count_; ++i) {
            const Edge& edge = edges[number(i)];
            multipliers_.push_back(edge.multiplier);
            for (std::uint32_t a = i; a < objects_ * room_; a += room_) {
                for (int axis = 0; axis < 3; ++axis) {
                    axes_[axis][a] = edge.a[axis];
                    axes_[axis][a + count_] = edge.b[axis];
                    axes_[axis + 3][a] = edge.start_a[axis];
                    axes_[axis + 3][a + count_] = edge.start_b[axis];
                }
            }
        }
        multipliers_.resize(room_);
    }

    void project_in_rows(const Kernels& kernels, DistanceTask& task) {
        std::vector<std::int64_t> rows(2 * row_length * room_);
        std::int64_t* starts = rows.data() + row_length * room_;
        const RowTask now{axes_[0].data(), axes_[1].data(), axes_[2].data(), rows.data()};
        const RowTask start{axes_[3].data(), axes_[4].data(), axes_[5].data(), starts};
        kernels.rows.take(now, 0, 2 * count_);
        kernels.rows.take(start, 0, 2 * count_);
        task.in_rows = true;
        task.arrays = {now.rows,   now.rows + 1, now.rows + 2,           starts,
                       starts + 1, starts + 2,   task.arrays.multipliers};
        kernels.project_distances(task);
        kernels.rows.give_back(now, 0, 2 * count_);
    }

    std::uint32_t count_;
    std::uint32_t objects_;
    std::uint32_t room_; // of one object
    std::vector<std::int64_t> axes_[6];
    std::vector<std::int64_t> multipliers_;
};

} // namespace

TEST_CASE("kernels: projections at the ends of every range are what integers without limits give") {
    test::Random random(17);
    std::uint64_t different = 0;
    std::uint64_t moved = 0;
    const std::uint64_t batches = test::sample_count() / edge_count / (test::long_run() ? 10 : 100);
    const std::vector<const Kernels*> all = test::all_kernels();
    for (std::uint64_t i = 0; i < batches; ++i) {
        const Kind kind = any_kind(random);
        Edges edges;
        Edges expected;
        for (std::size_t e = 0; e < edge_count; ++e) {
            edges[e] = expected[e] = any_edge(
                random, kind, kind.unequal == Kind::of_all_edges || (kind.unequal != Kind::none && e == 0));
            project_exactly(kind, expected[e]);
            moved += expected[e].a[0] != edges[e].a[0] ? 1 : 0;
        }
        for (const Kernels* kernels : all) {
            for (const Layout layout : layouts) {
                if (is_taken(*kernels, kind, layout)) {
                    different += Copies(kind, edges, *kernels, layout).are(kind, expected) ? 0 : 1;
                }
            }
        }
    }
    CHECK(different == 0);
    CHECK(moved > edge_count * batches / 4);
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
    for (const Kernels* kernels : test::all_kernels()) {
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
                    // The same along each axis.
                    const auto along_all_axes = [](const std::vector<std::int64_t>& xs,
                                                   const std::vector<std::int64_t>& starts) {
                        std::vector<std::int64_t> all;
                        for (int axis = 0; axis < 6; ++axis) {
                            const std::vector<std::int64_t>& values = axis < 3 ? xs : starts;
                            all.insert(all.end(), values.begin(), values.end());
                        }
                        return all;
                    };
                    std::vector<std::int64_t> particles = along_all_axes(x, start);
                    const PredictionClamps clamps =
                        kernels->predict({particles.data(),
                                          x.size(),
                                          x.size(),
                                          nullptr,
                                          1,
                                          kept,
                                          {acceleration, acceleration, acceleration},
                                          limit});
                    different += particles == along_all_axes(expected_x, expected_start) ? 0 : 1;
                    different +=
                        clamps.speeds == 3 * expected.speeds && clamps.positions == 3 * expected.positions
                            ? 0
                            : 1;
                }
            }
        }
    }
    CHECK(different == 0);
}
