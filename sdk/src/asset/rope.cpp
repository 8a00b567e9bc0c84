// A rope from a length or from a polyline: stretch in two colours, bend between points two apart in two more;
// and the order of its segments where its stretch may be solved at once instead of in colours.
#include "asset/authoring_masses.h"
#include "asset/authoring_values.h"
#include "asset/create.h"
#include "asset/particle_numbering.h"

#include <algorithm>

namespace lks {
namespace {

constexpr std::uint32_t greatest_point_count = 1048576;

lks_result place_straight(Build& build, const lks_rope_def& def) {
    if (def.segments < 1 || def.segments > greatest_point_count - 1) {
        return build.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "The rope has " << def.segments
                                                                 << " segments; it must have from 1 to "
                                                                 << greatest_point_count - 1 << ".");
    }
    std::int64_t length = 0;
    const LengthRange range{60, "above 0 and at most 60 m, if it is no polyline"};
    if (const lks_result result = read_length(build.error, "rope's length", def.length, range, length);
        result != LKS_OK) {
        return result;
    }
    if (!build.positions.resize(std::size_t{def.segments} + 1)) {
        return build.fail_out_of_memory();
    }
    for (std::uint32_t i = 0; i <= def.segments; ++i) {
        build.positions[i] = {fixed::multiply_divide(length, i, def.segments), 0, 0};
    }
    return LKS_OK;
}

lks_result place_polyline(Build& build, const lks_rope_def& def) {
    if (def.point_count < 2 || def.point_count > greatest_point_count) {
        return build.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "The rope has " << def.point_count
                                                                 << " points; it must have from 2 to "
                                                                 << greatest_point_count << ".");
    }
    if (def.points == nullptr) {
        return build.fail(LKS_ERROR_NULL_ARGUMENT, Sentence() << "The rope's points are null.");
    }
    return read_positions(build, "point", def.points, def.point_count);
}

// Half of each neighbouring segment's length, in half metres of Coordinate format.
lks_result share_lengths(const Build& build, Array<fixed::Scaled>& shares) {
    const auto count = static_cast<std::uint32_t>(build.positions.size());
    if (!shares.resize(count)) {
        return build.fail_out_of_memory();
    }
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
        const std::int64_t length = distance_between(build.positions[i], build.positions[i + 1]);
        if (length == 0) {
            return build.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence()
                                                              << "Points " << i << " and " << i + 1
                                                              << " of the rope are in the same place.");
        }
        const fixed::Scaled share =
            fixed::Scaled::from_fixed(static_cast<std::uint64_t>(length), coordinate_fraction_bits);
        shares[i] = shares[i] + share;
        shares[i + 1] = shares[i + 1] + share;
    }
    return LKS_OK;
}

bool add_constraints(Build& build) {
    const auto count = static_cast<std::uint32_t>(build.positions.size());
    const auto add = [&](lks_constraint_family family, std::uint32_t reach) {
        for (std::uint32_t i = 0; build.asset.families[family].enabled && i + reach < count; ++i) {
            const bool apart =
                squared_distance(build.positions[i], build.positions[i + reach]) != fixed::UInt128{0, 0};
            if (apart &&
                !build.drafts.push({i, i + reach, static_cast<std::uint32_t>(family), i / reach % 2})) {
                return false;
            }
        }
        return true;
    };
    return add(LKS_CONSTRAINT_STRETCH, 1) && add(LKS_CONSTRAINT_BEND, 2);
}

lks_result check_solver(const Build& build, const lks_rope_def& def) {
    const auto segments = static_cast<std::uint32_t>(build.positions.size() - 1);
    if (def.solver > LKS_ROPE_DIRECT) {
        return build.fail(LKS_ERROR_INVALID_ARGUMENT,
                          Sentence() << "The rope's solver is " << def.solver
                                     << "; it must be automatic (0), swept (1) or direct (2).");
    }
    if (def.solver == LKS_ROPE_DIRECT && def.stretch.enabled == 0) {
        return build.fail(LKS_ERROR_INVALID_ARGUMENT,
                          Sentence() << "The rope's solver is direct, but its stretch is not enabled.");
    }
    if (def.solver == LKS_ROPE_DIRECT && segments > LKS_MAX_DIRECT_SEGMENTS) {
        return build.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "The rope has " << segments
                                                                 << " segments; the direct solver takes "
                                                                 << LKS_MAX_DIRECT_SEGMENTS << " at most.");
    }
    return LKS_OK;
}

bool may_be_solved_directly(const Build& build, const lks_rope_def& def) {
    const std::size_t segments = build.positions.size() - 1;
    return def.solver == LKS_ROPE_DIRECT || (def.solver == LKS_ROPE_AUTOMATIC && def.stretch.enabled != 0 &&
                                             segments > 1 && segments <= LKS_MAX_DIRECT_SEGMENTS);
}

bool list_chain(lks_asset& asset) {
    if (!asset.chain.resize(std::size_t{asset.vertex_count()} - 1)) {
        return false;
    }
    for (const Batch& batch : asset.batches) {
        if (batch.family != LKS_CONSTRAINT_STRETCH) {
            continue;
        }
        for (std::uint32_t i = batch.first; i < batch.first + batch.count; ++i) {
            const Constraint& ends = asset.constraints[i];
            asset.chain[std::min(asset.particle_to_vertex[ends.a], asset.particle_to_vertex[ends.b])] = i;
        }
    }
    return true;
}

} // namespace

lks_result build_rope(Build& build, const lks_rope_def& def) {
    const lks_result placed = def.point_count > 0 ? place_polyline(build, def) : place_straight(build, def);
    if (placed != LKS_OK) {
        return placed;
    }
    if (const lks_result result = check_solver(build, def); result != LKS_OK) {
        return result;
    }
    Array<fixed::Scaled> lengths(build.asset.allocator);
    if (const lks_result result = share_lengths(build, lengths); result != LKS_OK) {
        return result;
    }
    const MassSource source{def.mass, def.linear_density, def.vertex_masses, "linear_density"};
    if (const lks_result result = spread_mass(build, source, lengths, fixed::Scaled::ratio(1, 2));
        result != LKS_OK) {
        return result;
    }
    if (!add_constraints(build) || !number_rows(build, static_cast<std::uint32_t>(build.positions.size()), 1,
                                                def.bend.enabled != 0 ? 4 : 2)) {
        return build.fail_out_of_memory();
    }
    if (const lks_result result = assemble(build); result != LKS_OK) {
        return result;
    }
    build.asset.solver = static_cast<lks_rope_solver>(def.solver);
    if (may_be_solved_directly(build, def) && !list_chain(build.asset)) {
        return build.fail_out_of_memory();
    }
    return LKS_OK;
}

} // namespace lks
