#include "asset/build.h"

#include "asset/family_order.h"
#include "asset/spare_particles.h"

#include <algorithm>

namespace lks {
namespace {

std::uint64_t difference(std::int64_t a, std::int64_t b) {
    return a < b ? static_cast<std::uint64_t>(b) - static_cast<std::uint64_t>(a)
                 : static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b);
}

// Largest rest length that an asset may have: leaves a bit of room below the 128 m of a coordinate.
constexpr std::int64_t rest_length_limit = coordinate_one * 100;

bool place_particles(Build& build) {
    lks_asset& asset = build.asset;
    const std::size_t count = build.order.size();
    if (!asset.vertex_to_particle.resize(count) || !asset.particle_to_vertex.resize(count) ||
        !asset.rest_positions.resize(count) || !asset.masses.resize(count) ||
        !asset.inverse_masses.resize(count)) {
        return false;
    }
    for (std::uint32_t particle = 0; particle < count; ++particle) {
        const std::uint32_t vertex = build.order[particle];
        asset.particle_to_vertex[particle] = vertex;
        asset.vertex_to_particle[vertex] = particle;
        asset.rest_positions[particle] = build.positions[vertex];
        asset.masses[particle] = build.masses[vertex];
        asset.inverse_masses[particle] = fixed::Scaled::from_u64(1) / build.masses[vertex];
    }
    return true;
}

// Particles instead of vertices, the lower one first, in the order of batches. Within a batch no particle
// stands twice, so the order is total.
void order_drafts(Build& build) {
    for (Draft& draft : build.drafts) {
        const std::uint32_t a = build.asset.vertex_to_particle[draft.a];
        const std::uint32_t b = build.asset.vertex_to_particle[draft.b];
        draft.a = std::min(a, b);
        draft.b = std::max(a, b);
    }
    const FamilyOrder order = order_families(build.asset.families);
    std::sort(build.drafts.begin(), build.drafts.end(), [&](const Draft& l, const Draft& r) {
        return l.family != r.family   ? order.place[l.family] < order.place[r.family]
               : l.colour != r.colour ? l.colour < r.colour
                                      : l.a < r.a;
    });
}

std::uint32_t run_length(const Array<Draft>& drafts, std::uint32_t first, std::uint32_t end) {
    std::uint32_t i = first + 1;
    while (i < end && drafts[i].a == drafts[i - 1].a + 1 && drafts[i].b == drafts[i - 1].b + 1) {
        ++i;
    }
    return i - first;
}

bool add_constraints(const Build& build, std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; ++i) {
        const Draft& draft = build.drafts[i];
        if (!build.asset.constraints.push({draft.a, draft.b})) {
            return false;
        }
    }
    return true;
}

// One batch from drafts [first, end): its runs, then its singles.
bool add_batch(const Build& build, std::uint32_t first, std::uint32_t end) {
    lks_asset& asset = build.asset;
    Batch batch{};
    batch.first = asset.constraint_count();
    batch.count = end - first;
    batch.family = build.drafts[first].family;
    batch.colour = static_cast<std::uint32_t>(asset.batches.size());
    batch.first_run = static_cast<std::uint32_t>(asset.runs.size());
    for (std::uint32_t i = first; i < end;) {
        const std::uint32_t length = run_length(build.drafts, i, end);
        if (length >= minimum_run_length) {
            const Run run{asset.constraint_count(), length, build.drafts[i].a, build.drafts[i].b, 0};
            if (!asset.runs.push(run) || !add_constraints(build, i, length)) {
                return false;
            }
        }
        i += length;
    }
    batch.run_count = static_cast<std::uint32_t>(asset.runs.size()) - batch.first_run;
    batch.first_single = asset.constraint_count();
    for (std::uint32_t i = first; i < end;) {
        const std::uint32_t length = run_length(build.drafts, i, end);
        if (length < minimum_run_length && !add_constraints(build, i, length)) {
            return false;
        }
        i += length;
    }
    return asset.batches.push(batch);
}

bool add_batches(const Build& build) {
    const Array<Draft>& drafts = build.drafts;
    if (!build.asset.constraints.reserve(drafts.size())) {
        return false;
    }
    const auto count = static_cast<std::uint32_t>(drafts.size());
    for (std::uint32_t first = 0; first < count;) {
        std::uint32_t end = first + 1;
        while (end < count && drafts[end].family == drafts[first].family &&
               drafts[end].colour == drafts[first].colour) {
            ++end;
        }
        if (!add_batch(build, first, end)) {
            return false;
        }
        first = end;
    }
    build.asset.colour_count = static_cast<std::uint32_t>(build.asset.batches.size());
    return true;
}

// The formats in which a batch's lengths are kept: solver/distance.h. With differences of 56 - s fraction
// bits and gains of s bits, their errors for an edge of length L are 2^(s-57) and L·2^-(s+1): equal at
// s = 28 + log2(L)/2.
void choose_formats(lks_asset& asset, Batch& batch) {
    std::int64_t longest = 0;
    for (std::uint32_t i = batch.first; i < batch.first + batch.count; ++i) {
        longest = std::max(longest, asset.rest_lengths[i]);
    }
    const fixed::Scaled length =
        fixed::Scaled::from_fixed(static_cast<std::uint64_t>(longest), coordinate_fraction_bits);
    batch.difference_shift = std::clamp(28 + (length.log2_floor() >> 1), 20, 30);
    const auto mantissa = [&](std::int64_t rest) {
        // rest · 2^(rest_exponent - s), rounded.
        return fixed::Scaled::from_fixed(static_cast<std::uint64_t>(rest), 0)
            .to_fixed(batch.rest_exponent - batch.difference_shift);
    };
    const std::int32_t bits = fixed::Scaled::from_fixed(static_cast<std::uint64_t>(longest), 0).log2_floor();
    batch.rest_exponent = 31 - (bits - batch.difference_shift);
    if (mantissa(longest) > UINT32_MAX) {
        --batch.rest_exponent;
    }
    for (std::uint32_t i = batch.first; i < batch.first + batch.count; ++i) {
        asset.rest_mantissas[i] = static_cast<std::uint32_t>(mantissa(asset.rest_lengths[i]));
    }
}

lks_result measure(const Build& build) {
    lks_asset& asset = build.asset;
    if (!asset.rest_lengths.resize(asset.constraints.size()) ||
        !asset.rest_mantissas.resize(asset.constraints.size() + widest_group - 1)) {
        return build.fail_out_of_memory();
    }
    for (std::uint32_t i = 0; i < asset.constraint_count(); ++i) {
        const Constraint& constraint = asset.constraints[i];
        asset.rest_lengths[i] =
            distance_between(asset.rest_positions[constraint.a], asset.rest_positions[constraint.b]);
        if (asset.rest_lengths[i] == 0) {
            return build.fail(LKS_ERROR_INVALID_ARGUMENT,
                              Sentence()
                                  << "Vertices " << asset.particle_to_vertex[constraint.a] << " and "
                                  << asset.particle_to_vertex[constraint.b] << " are in the same place.");
        }
        if (asset.rest_lengths[i] > rest_length_limit) {
            return build.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "The constraint between vertices "
                                                                     << asset.particle_to_vertex[constraint.a]
                                                                     << " and "
                                                                     << asset.particle_to_vertex[constraint.b]
                                                                     << " is longer than 100 m.");
        }
    }
    for (Batch& batch : asset.batches) {
        choose_formats(asset, batch);
    }
    return LKS_OK;
}

bool list_incidences(lks_asset& asset) {
    if (!asset.incident_offsets.resize(std::size_t{asset.vertex_count()} + 1) ||
        !asset.incident_constraints.resize(2 * asset.constraints.size())) {
        return false;
    }
    for (const Constraint& constraint : asset.constraints) {
        ++asset.incident_offsets[constraint.a + 1];
        ++asset.incident_offsets[constraint.b + 1];
    }
    for (std::uint32_t particle = 0; particle < asset.vertex_count(); ++particle) {
        asset.incident_offsets[particle + 1] += asset.incident_offsets[particle];
    }
    // Filled from the back: each particle's offset ends where its list starts.
    for (std::uint32_t i = asset.constraint_count(); i-- > 0;) {
        asset.incident_constraints[--asset.incident_offsets[asset.constraints[i].a + 1]] = i;
        asset.incident_constraints[--asset.incident_offsets[asset.constraints[i].b + 1]] = i;
    }
    // Now offsets[p + 1] is the start of p's list; move them down by one.
    for (std::uint32_t particle = 0; particle < asset.vertex_count(); ++particle) {
        asset.incident_offsets[particle] = asset.incident_offsets[particle + 1];
    }
    asset.incident_offsets[asset.vertex_count()] =
        static_cast<std::uint32_t>(asset.incident_constraints.size());
    return true;
}

} // namespace

fixed::UInt128 squared_distance(const Coordinates& a, const Coordinates& b) {
    const std::uint64_t x = difference(a.x, b.x);
    const std::uint64_t y = difference(a.y, b.y);
    const std::uint64_t z = difference(a.z, b.z);
    return fixed::multiply_unsigned(x, x) + fixed::multiply_unsigned(y, y) + fixed::multiply_unsigned(z, z);
}

std::int64_t distance_between(const Coordinates& a, const Coordinates& b) {
    return fixed::square_root(fixed::Scaled::from_u128(squared_distance(a, b), 2 * coordinate_fraction_bits))
        .to_i64_fixed(coordinate_fraction_bits);
}

lks_result assemble(Build& build) {
    if (!place_particles(build)) {
        return build.fail_out_of_memory();
    }
    order_drafts(build);
    if (!add_batches(build)) {
        return build.fail_out_of_memory();
    }
    if (const lks_result result = measure(build); result != LKS_OK) {
        return result;
    }
    if (!find_spare_particles(build.asset) || !list_incidences(build.asset)) {
        return build.fail_out_of_memory();
    }
    return LKS_OK;
}

} // namespace lks
