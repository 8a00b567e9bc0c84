// A cloth from an indexed triangle mesh.
#include <algorithm>

#include "asset/authoring_masses.h"
#include "asset/authoring_values.h"
#include "asset/create.h"
#include "asset/edge_colouring.h"
#include "asset/particle_numbering.h"
#include "asset/triangle_edges.h"

namespace lks {
namespace {

using fixed::Scaled;

// Twice a triangle's area, in m².
Scaled doubled_area(const Coordinates& a, const Coordinates& b, const Coordinates& c) {
    // Within ±60 m, so edges fit into 63 bits and the difference of two products into 127.
    const std::int64_t u[3] = {b.x - a.x, b.y - a.y, b.z - a.z};
    const std::int64_t v[3] = {c.x - a.x, c.y - a.y, c.z - a.z};
    Scaled squared;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        const fixed::Int128 component =
            fixed::multiply_signed(u[j], v[k]) - fixed::multiply_signed(u[k], v[j]);
        const Scaled size = Scaled::from_u128(fixed::abs(component), 2 * coordinate_fraction_bits);
        squared = squared + size * size;
    }
    return fixed::square_root(squared);
}

// Every triangle gives a third of its area to each of its corners, in the triangles' order. Units: a sixth of
// a m².
lks_result share_areas(const Build& build, Array<Scaled>& shares) {
    if (!shares.resize(build.positions.size())) {
        return build.fail_out_of_memory();
    }
    const Array<std::uint32_t>& triangles = build.asset.triangles;
    const Scaled flattest = Scaled::ratio(1, 1000000000);
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
        const Coordinates& a = build.positions[triangles[t]];
        const Coordinates& b = build.positions[triangles[t + 1]];
        const Coordinates& c = build.positions[triangles[t + 2]];
        const Scaled area = doubled_area(a, b, c);
        const fixed::UInt128 longest =
            std::max({squared_distance(a, b), squared_distance(b, c), squared_distance(c, a)});
        if (area < Scaled::from_u128(longest, 2 * coordinate_fraction_bits) * flattest) {
            return build.fail(LKS_ERROR_INVALID_ARGUMENT,
                              Sentence() << "Triangle " << static_cast<std::uint64_t>(t / 3)
                                         << " has no area: its corners are in one line.");
        }
        for (std::size_t corner = 0; corner < 3; ++corner) {
            Scaled& share = shares[triangles[t + corner]];
            share = share + area;
        }
    }
    return LKS_OK;
}

// An edge, or a pair of vertices on both sides of one.
struct Pair {
    std::uint32_t low;
    std::uint32_t high;
    std::uint32_t family;
};

bool before(const Pair& l, const Pair& r) {
    return l.low != r.low ? l.low < r.low : l.high != r.high ? l.high < r.high : l.family < r.family;
}

bool same_ends(const Pair& l, const Pair& r) {
    return l.low == r.low && l.high == r.high;
}

bool is_diagonal(const TriangleSide* first, const TriangleSide* end) {
    return end - first >= 2 &&
           std::all_of(first, end, [](const TriangleSide& side) { return side.longest != 0; });
}

class MeshConstraints {
public:
    MeshConstraints(Build& build, const Array<TriangleSide>& sides)
        : build_(build), sides_(sides), pairs_(build.asset.allocator) {}

    bool add() {
        const bool collected = visit_edges([this](const TriangleSide* first, const TriangleSide* end) {
            return add_edge(first, end) && add_opposites(first, end);
        });
        if (!collected) {
            return false;
        }
        // Stretch before shear before bend: of two constraints between the same vertices the first is kept.
        std::sort(pairs_.begin(), pairs_.end(), before);
        const Pair* kept = std::unique(pairs_.begin(), pairs_.end(), same_ends);
        for (std::uint32_t family = 0; family < family_count; ++family) {
            const std::size_t first = build_.drafts.size();
            for (const Pair* pair = pairs_.begin(); pair != kept; ++pair) {
                if (pair->family == family && is_built(*pair) &&
                    !build_.drafts.push({pair->low, pair->high, family, 0})) {
                    return false;
                }
            }
            if (!colour_edges(build_, first, build_.drafts.size())) {
                return false;
            }
            if (family == LKS_CONSTRAINT_STRETCH) {
                stretch_count_ = build_.drafts.size();
            }
        }
        return true;
    }

    std::size_t stretch_count() const { return stretch_count_; }

private:
    template <typename Visit>
    bool visit_edges(const Visit& visit) const {
        const TriangleSide* first = sides_.begin();
        while (first != sides_.end()) {
            const TriangleSide* end = first + 1;
            while (end != sides_.end() && end->low == first->low && end->high == first->high) {
                ++end;
            }
            if (!visit(first, end)) {
                return false;
            }
            first = end;
        }
        return true;
    }

    // Without shear there are no diagonals: every edge is stretch, or the mesh would have holes.
    bool counts_as_diagonal(const TriangleSide* first, const TriangleSide* end) const {
        return build_.asset.families[LKS_CONSTRAINT_SHEAR].enabled && is_diagonal(first, end);
    }

    bool add_edge(const TriangleSide* first, const TriangleSide* end) {
        const auto family = counts_as_diagonal(first, end) ? LKS_CONSTRAINT_SHEAR : LKS_CONSTRAINT_STRETCH;
        return pairs_.push({first->low, first->high, static_cast<std::uint32_t>(family)});
    }

    bool add_opposites(const TriangleSide* first, const TriangleSide* end) {
        const auto family = counts_as_diagonal(first, end) ? LKS_CONSTRAINT_SHEAR : LKS_CONSTRAINT_BEND;
        for (const TriangleSide* side = first + 1; side < end; ++side) {
            const std::uint32_t low = std::min(first->opposite, side->opposite);
            const std::uint32_t high = std::max(first->opposite, side->opposite);
            if (low != high && !pairs_.push({low, high, static_cast<std::uint32_t>(family)})) {
                return false;
            }
        }
        return true;
    }

    bool is_built(const Pair& pair) const {
        // The opposite vertices of a folded mesh may be in the same place: nothing to keep apart.
        return build_.asset.families[pair.family].enabled &&
               squared_distance(build_.positions[pair.low], build_.positions[pair.high]) !=
                   fixed::UInt128{0, 0};
    }

    Build& build_;
    const Array<TriangleSide>& sides_;
    Array<Pair> pairs_;
    std::size_t stretch_count_ = 0;
};

lks_result check_mesh_def(const Build& build, const lks_cloth_def& def) {
    if (def.vertex_count < 3 || def.vertex_count > LKS_MAX_VERTICES) {
        return build.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "The mesh has " << def.vertex_count
                                                                 << " vertices; it must have from 3 to "
                                                                 << LKS_MAX_VERTICES << ".");
    }
    if (def.triangle_count < 1 || def.triangle_count > LKS_MAX_TRIANGLES) {
        return build.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "The mesh has " << def.triangle_count
                                                                 << " triangles; it must have from 1 to "
                                                                 << LKS_MAX_TRIANGLES << ".");
    }
    if (def.vertices == nullptr || def.triangles == nullptr) {
        return build.fail(LKS_ERROR_NULL_ARGUMENT,
                          Sentence() << "The mesh's " << (def.vertices == nullptr ? "vertices" : "triangles")
                                     << " are null.");
    }
    return LKS_OK;
}

} // namespace

lks_result build_cloth_mesh(Build& build, const lks_cloth_def& def) {
    if (const lks_result result = check_mesh_def(build, def); result != LKS_OK) {
        return result;
    }
    if (const lks_result result = read_positions(build, "vertex", def.vertices, def.vertex_count);
        result != LKS_OK) {
        return result;
    }
    const std::size_t index_count = std::size_t{3} * def.triangle_count;
    if (!build.asset.triangles.resize(index_count)) {
        return build.fail_out_of_memory();
    }
    std::copy_n(def.triangles, index_count, build.asset.triangles.begin());
    Array<TriangleSide> sides(build.asset.allocator);
    if (const lks_result result = list_triangle_sides(build, sides); result != LKS_OK) {
        return result;
    }
    Array<Scaled> areas(build.asset.allocator);
    if (const lks_result result = share_areas(build, areas); result != LKS_OK) {
        return result;
    }
    const MassSource source{def.mass, def.area_density, def.vertex_masses, "area_density"};
    if (const lks_result result = spread_mass(build, source, areas, Scaled::ratio(1, 6)); result != LKS_OK) {
        return result;
    }
    MeshConstraints constraints(build, sides);
    if (!constraints.add() || !number_mesh(build, constraints.stretch_count())) {
        return build.fail_out_of_memory();
    }
    return assemble(build);
}

} // namespace lks
