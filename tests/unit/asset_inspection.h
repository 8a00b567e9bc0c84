// What must hold for every asset, whatever it was built from: checked against exact 128-bit reference
// arithmetic.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "asset/asset.h"
#include "asset/family_order.h"

namespace inspection {

__extension__ using Wide = unsigned __int128;

inline Wide square_of_difference(std::int64_t a, std::int64_t b) {
    const Wide difference = a < b ? Wide(b) - Wide(a) : Wide(a) - Wide(b);
    return static_cast<std::uint64_t>(difference) * Wide(static_cast<std::uint64_t>(difference));
}

inline Wide squared_length(const lks_asset& asset, const lks::Constraint& constraint) {
    const lks::Coordinates& a = asset.rest_positions[constraint.a];
    const lks::Coordinates& b = asset.rest_positions[constraint.b];
    return square_of_difference(a.x, b.x) + square_of_difference(a.y, b.y) + square_of_difference(a.z, b.z);
}

inline void numbering_is_a_permutation(const lks_asset& asset) {
    const std::uint32_t count = asset.vertex_count();
    REQUIRE(asset.particle_to_vertex.size() == count);
    REQUIRE(asset.rest_positions.size() == count);
    REQUIRE(asset.masses.size() == count);
    REQUIRE(asset.inverse_masses.size() == count);
    std::uint32_t wrong = 0;
    for (std::uint32_t vertex = 0; vertex < count; ++vertex) {
        const std::uint32_t particle = asset.vertex_to_particle[vertex];
        wrong += particle >= count || asset.particle_to_vertex[particle] != vertex ? 1 : 0;
    }
    CHECK(wrong == 0);
}

// The batches divide the constraints, in the order of families and colours, and none touches a particle
// twice: the promise on which "inside a colour, no order" rests.
inline void batches_are_independent(const lks_asset& asset) {
    const lks::FamilyOrder order = lks::order_families(asset.families);
    std::vector<std::uint32_t> last_batch(asset.vertex_count(), UINT32_MAX);
    std::uint32_t next = 0;
    std::uint32_t touched_twice = 0;
    for (std::uint32_t b = 0; b < asset.batches.size(); ++b) {
        const lks::Batch& batch = asset.batches[b];
        CHECK(batch.first == next);
        CHECK(batch.count > 0);
        CHECK(batch.colour == b);
        CHECK(batch.family < lks::family_count);
        CHECK(asset.families[batch.family].enabled);
        if (b > 0) {
            CHECK(order.place[batch.family] >= order.place[asset.batches[b - 1].family]);
        }
        next = batch.first + batch.count;
        REQUIRE(next <= asset.constraint_count());
        for (std::uint32_t i = batch.first; i < next; ++i) {
            for (const std::uint32_t end : {asset.constraints[i].a, asset.constraints[i].b}) {
                REQUIRE(end < asset.vertex_count());
                touched_twice += last_batch[end] == b ? 1 : 0;
                last_batch[end] = b;
            }
        }
    }
    CHECK(next == asset.constraint_count());
    CHECK(asset.colour_count == asset.batches.size());
    CHECK(touched_twice == 0);
}

inline bool continues(const lks::Constraint& before, const lks::Constraint& after) {
    return after.a == before.a + 1 && after.b == before.b + 1;
}

// Runs first, ascending and maximal; then single constraints, ascending, in which no long enough run is left.
inline void runs_are_maximal(const lks_asset& asset) {
    std::uint32_t next_run = 0;
    std::uint32_t wrong = 0;
    for (const lks::Batch& batch : asset.batches) {
        CHECK(batch.first_run == next_run);
        std::uint32_t at = batch.first;
        for (std::uint32_t r = batch.first_run; r < batch.first_run + batch.run_count; ++r) {
            const lks::Run& run = asset.runs[r];
            CHECK(run.first == at);
            CHECK(run.count >= lks::minimum_run_length);
            for (std::uint32_t i = 0; i < run.count; ++i) {
                const lks::Constraint& constraint = asset.constraints[run.first + i];
                wrong += constraint.a != run.a + i || constraint.b != run.b + i ? 1 : 0;
            }
            if (r > batch.first_run) {
                const lks::Run& before = asset.runs[r - 1];
                wrong += run.a < before.a ? 1 : 0;
                wrong += run.a == before.a + before.count && run.b == before.b + before.count ? 1 : 0;
            }
            at += run.count;
        }
        next_run += batch.run_count;
        CHECK(batch.first_single == at);
        std::uint32_t length = 1;
        for (std::uint32_t i = batch.first_single + 1; i < batch.first + batch.count; ++i) {
            wrong += asset.constraints[i].a <= asset.constraints[i - 1].a ? 1 : 0;
            length = continues(asset.constraints[i - 1], asset.constraints[i]) ? length + 1 : 1;
            wrong += length >= lks::minimum_run_length ? 1 : 0;
        }
    }
    CHECK(next_run == asset.runs.size());
    CHECK(wrong == 0);
}

inline bool length_is_exact(Wide square, std::int64_t length) {
    const Wide unit = static_cast<std::uint64_t>(length);
    if (length < (std::int64_t{1} << 60)) {
        // |length - √square| ≤ 0.6: half a unit of rounding, and what a 64-bit mantissa loses.
        return (10 * unit - 6) * (10 * unit - 6) <= 100 * square &&
               100 * square <= (10 * unit + 6) * (10 * unit + 6);
    }
    return (unit - 1) * (unit - 1) <= square && square <= (unit + 1) * (unit + 1);
}

// |mantissa - length·2^power| ≤ 1/2.
inline bool mantissa_is_nearest(std::uint32_t mantissa, std::int64_t length, std::int32_t power) {
    const Wide units = static_cast<std::uint64_t>(length);
    if (power >= 0) {
        return units << power == mantissa;
    }
    const Wide doubled = units << 1;
    const Wide low = (Wide(mantissa) * 2 - (mantissa == 0 ? 0 : 1)) << -power;
    const Wide high = (Wide(mantissa) * 2 + 1) << -power;
    return low <= doubled && doubled <= high;
}

inline std::int32_t logarithm(std::uint64_t value) {
    std::int32_t result = -1;
    for (; value != 0; value >>= 1) {
        ++result;
    }
    return result;
}

inline void lengths_are_exact(const lks_asset& asset) {
    REQUIRE(asset.rest_lengths.size() == asset.constraint_count());
    REQUIRE(asset.rest_mantissas.size() == asset.constraint_count() + lks::widest_group - 1);
    std::uint32_t wrong_lengths = 0;
    std::uint32_t wrong_mantissas = 0;
    for (const lks::Batch& batch : asset.batches) {
        std::int64_t longest = 0;
        std::uint32_t greatest = 0;
        for (std::uint32_t i = batch.first; i < batch.first + batch.count; ++i) {
            const std::int64_t length = asset.rest_lengths[i];
            longest = std::max(longest, length);
            greatest = std::max(greatest, asset.rest_mantissas[i]);
            wrong_lengths +=
                length > 0 && length_is_exact(squared_length(asset, asset.constraints[i]), length) ? 0 : 1;
            wrong_mantissas += mantissa_is_nearest(asset.rest_mantissas[i], length,
                                                   batch.rest_exponent - batch.difference_shift)
                                   ? 0
                                   : 1;
        }
        const std::int32_t metres =
            logarithm(static_cast<std::uint64_t>(longest)) - lks::coordinate_fraction_bits;
        const std::int32_t halved = metres >= 0 ? metres / 2 : -((1 - metres) / 2);
        CHECK(batch.difference_shift == std::min(30, std::max(20, 28 + halved)));
        CHECK(greatest >= std::uint32_t{1} << 31);
    }
    CHECK(wrong_lengths == 0);
    CHECK(wrong_mantissas == 0);
}

inline void incidences_are_complete(const lks_asset& asset) {
    std::vector<std::vector<std::uint32_t>> expected(asset.vertex_count());
    for (std::uint32_t i = 0; i < asset.constraint_count(); ++i) {
        expected[asset.constraints[i].a].push_back(i);
        expected[asset.constraints[i].b].push_back(i);
    }
    REQUIRE(asset.incident_offsets.size() == asset.vertex_count() + std::size_t{1});
    REQUIRE(asset.incident_offsets[0] == 0);
    REQUIRE(asset.incident_offsets[asset.vertex_count()] == asset.incident_constraints.size());
    std::uint32_t wrong = 0;
    for (std::uint32_t p = 0; p < asset.vertex_count(); ++p) {
        const std::vector<std::uint32_t> found(asset.incident_constraints.begin() + asset.incident_offsets[p],
                                               asset.incident_constraints.begin() +
                                                   asset.incident_offsets[p + 1]);
        wrong += found == expected[p] ? 0 : 1;
    }
    CHECK(wrong == 0);
}

// w·m = 1 within two roundings of a 64-bit mantissa.
inline void masses_have_inverses(const lks_asset& asset) {
    const lks::fixed::Scaled one = lks::fixed::Scaled::from_u64(1);
    std::uint32_t wrong = 0;
    for (std::uint32_t p = 0; p < asset.vertex_count(); ++p) {
        const lks::fixed::Scaled product = asset.masses[p] * asset.inverse_masses[p];
        const lks::fixed::Scaled error = subtract_or_zero(product, one) + subtract_or_zero(one, product);
        wrong += error.is_zero() || error.log2_floor() < -62 ? 0 : 1;
    }
    CHECK(wrong == 0);
}

inline void everything_holds(const lks_asset& asset) {
    numbering_is_a_permutation(asset);
    batches_are_independent(asset);
    runs_are_maximal(asset);
    lengths_are_exact(asset);
    incidences_are_complete(asset);
    masses_have_inverses(asset);
}

// The constraints in runs, in percent.
inline double share_in_runs(const lks_asset& asset) {
    std::uint64_t count = 0;
    for (const lks::Run& run : asset.runs) {
        count += run.count;
    }
    return 100.0 * static_cast<double>(count) / asset.constraint_count();
}

// In percent: constraints that kernels of so many lanes take in whole groups, spare lanes included.
inline double share_in_groups(const lks_asset& asset, std::uint32_t lanes) {
    std::uint64_t count = 0;
    for (const lks::Run& run : asset.runs) {
        const std::uint32_t rest = run.count % lanes;
        count += run.count - (rest + run.spare >= lanes ? 0 : rest);
    }
    return 100.0 * static_cast<double>(count) / asset.constraint_count();
}

using Pair = std::pair<std::uint32_t, std::uint32_t>; // vertices, the lower one first

inline Pair pair_of(std::uint32_t a, std::uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

// One family's pairs of vertices; fails where a pair stands twice in the whole asset.
inline std::set<Pair> pairs(const lks_asset& asset, lks_constraint_family family) {
    std::set<Pair> all;
    std::set<Pair> result;
    for (std::uint32_t i = 0; i < asset.constraint_count(); ++i) {
        lks_constraint_info info{};
        REQUIRE(lks_asset_constraint(&asset, i, &info) == LKS_OK);
        const Pair pair = pair_of(info.vertex_a, info.vertex_b);
        const bool is_new = all.insert(pair).second;
        CHECK(is_new);
        if (info.family == static_cast<std::uint32_t>(family)) {
            result.insert(pair);
        }
    }
    return result;
}

// The shortest way for a test to a number.
inline double number(const lks::fixed::Scaled& value) {
    double result = static_cast<double>(value.mantissa);
    for (std::int32_t e = value.exponent; e < 0; ++e) {
        result /= 2;
    }
    for (std::int32_t e = value.exponent; e > 0; --e) {
        result *= 2;
    }
    return result;
}

inline double total_mass(const lks_asset& asset) {
    double sum = 0;
    for (const lks::fixed::Scaled& mass : asset.masses) {
        sum += number(mass);
    }
    return sum;
}

} // namespace inspection
