// A cloth from a grid: twelve colours in closed form, the fewest that an inner vertex with twelve constraints
// allows.
#include <utility>

#include "asset/authoring_masses.h"
#include "asset/authoring_values.h"
#include "asset/create.h"
#include "asset/particle_numbering.h"

namespace lks {
namespace {

constexpr std::uint32_t greatest_side = 4096;

class Grid {
public:
    Grid(Build& build, const lks_cloth_def& def) : build_(build), columns_(def.columns), rows_(def.rows) {}

    lks_result place_vertices(std::int64_t width, std::int64_t height) {
        if (!build_.positions.resize(std::size_t{columns_} * rows_)) {
            return build_.fail_out_of_memory();
        }
        for (std::uint32_t row = 0; row < rows_; ++row) {
            for (std::uint32_t column = 0; column < columns_; ++column) {
                // Rounded symmetrically, so that opposite vertices have opposite coordinates.
                build_.positions[index(column, row)] = {centred(width, column, columns_),
                                                        -centred(height, row, rows_), 0};
            }
        }
        return LKS_OK;
    }

    // A vertex's share of the area in quarters of a cell: inner vertices are equal to the bit.
    lks_result spread_mass(const lks_cloth_def& def, std::int64_t width, std::int64_t height) {
        Array<fixed::Scaled> quarters(build_.asset.allocator);
        if (!quarters.resize(build_.positions.size())) {
            return build_.fail_out_of_memory();
        }
        for (std::uint32_t row = 0; row < rows_; ++row) {
            for (std::uint32_t column = 0; column < columns_; ++column) {
                const std::uint64_t across = column == 0 || column + 1 == columns_ ? 1 : 2;
                const std::uint64_t down = row == 0 || row + 1 == rows_ ? 1 : 2;
                quarters[index(column, row)] = fixed::Scaled::from_u64(across * down);
            }
        }
        const std::uint64_t cells = std::uint64_t{columns_ - 1} * (rows_ - 1);
        const fixed::Scaled area =
            fixed::Scaled::from_fixed(static_cast<std::uint64_t>(width), coordinate_fraction_bits) *
            fixed::Scaled::from_fixed(static_cast<std::uint64_t>(height), coordinate_fraction_bits);
        const MassSource source{def.mass, def.area_density, def.vertex_masses, "area_density"};
        return lks::spread_mass(build_, source, quarters, area / fixed::Scaled::from_u64(4 * cells));
    }

    bool add_constraints() {
        const Family* families = build_.asset.families;
        if (families[LKS_CONSTRAINT_STRETCH].enabled &&
            !(add(LKS_CONSTRAINT_STRETCH, 0, 1, 0) && add(LKS_CONSTRAINT_STRETCH, 2, 0, 1))) {
            return false;
        }
        if (families[LKS_CONSTRAINT_SHEAR].enabled &&
            !(add(LKS_CONSTRAINT_SHEAR, 0, 1, 1) && add(LKS_CONSTRAINT_SHEAR, 2, -1, 1))) {
            return false;
        }
        return !families[LKS_CONSTRAINT_BEND].enabled ||
               (add(LKS_CONSTRAINT_BEND, 0, 2, 0) && add(LKS_CONSTRAINT_BEND, 2, 0, 2));
    }

    // Two triangles a cell, the diagonals alternating, so that the picture of a fold has no preferred
    // direction.
    bool add_triangles() {
        Array<std::uint32_t>& triangles = build_.asset.triangles;
        if (!triangles.reserve(std::size_t{6} * (columns_ - 1) * (rows_ - 1))) {
            return false;
        }
        for (std::uint32_t row = 0; row + 1 < rows_; ++row) {
            for (std::uint32_t column = 0; column + 1 < columns_; ++column) {
                const std::uint32_t top_left = index(column, row);
                const std::uint32_t top_right = index(column + 1, row);
                const std::uint32_t low_left = index(column, row + 1);
                const std::uint32_t low_right = index(column + 1, row + 1);
                const bool falling = (column + row) % 2 == 0;
                const std::uint32_t corners[6] = {top_left,  low_left,  falling ? low_right : top_right,
                                                  low_right, top_right, falling ? top_left : low_left};
                for (const std::uint32_t corner : corners) {
                    triangles.push_reserved(corner);
                }
            }
        }
        return true;
    }

private:
    std::uint32_t index(std::uint32_t column, std::uint32_t row) const { return row * columns_ + column; }

    static std::int64_t centred(std::int64_t length, std::uint32_t i, std::uint32_t count) {
        return fixed::multiply_divide(length, 2 * std::int64_t{i} - (std::int64_t{count} - 1),
                                      2 * (std::int64_t{count} - 1));
    }

    // All pairs of (column, row) and (column + across, row + down). Along the direction the colours alternate
    // in steps of its length: within a colour no vertex stands twice.
    bool add(lks_constraint_family family, std::uint32_t first_colour, int across, std::uint32_t down) {
        const std::uint32_t left = across < 0 ? 1u : 0u;
        const std::uint32_t right = across > 0 ? static_cast<std::uint32_t>(across) : 0u;
        for (std::uint32_t row = 0; row + down < rows_; ++row) {
            for (std::uint32_t column = left; column + right < columns_; ++column) {
                const std::uint32_t other = across < 0 ? column - 1 : column + right;
                const std::uint32_t phase = across == 0 ? row / down : column / (right == 2 ? 2 : 1);
                const Draft draft{index(column, row), index(other, row + down),
                                  static_cast<std::uint32_t>(family), first_colour + phase % 2};
                if (!build_.drafts.push(draft)) {
                    return false;
                }
            }
        }
        return true;
    }

    Build& build_;
    std::uint32_t columns_;
    std::uint32_t rows_;
};

} // namespace

lks_result build_cloth_grid(Build& build, const lks_cloth_def& def) {
    for (const auto& [name, value] : {std::pair{"columns", def.columns}, std::pair{"rows", def.rows}}) {
        if (value < 2 || value > greatest_side) {
            return build.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "The grid has " << value << " "
                                                                     << name << "; it must have from 2 to "
                                                                     << greatest_side << ".");
        }
    }
    if (def.columns * def.rows > LKS_MAX_VERTICES) {
        return build.fail(LKS_ERROR_LIMIT, Sentence() << "The grid has " << def.columns * def.rows
                                                      << " vertices, more than " << LKS_MAX_VERTICES << ".");
    }
    std::int64_t width = 0;
    std::int64_t height = 0;
    const LengthRange range{120, "above 0 and at most 120 m"};
    if (const lks_result result = read_length(build.error, "width", def.width, range, width);
        result != LKS_OK) {
        return result;
    }
    if (const lks_result result = read_length(build.error, "height", def.height, range, height);
        result != LKS_OK) {
        return result;
    }
    Grid grid(build, def);
    if (const lks_result result = grid.place_vertices(width, height); result != LKS_OK) {
        return result;
    }
    if (const lks_result result = grid.spread_mass(def, width, height); result != LKS_OK) {
        return result;
    }
    if (!grid.add_constraints() || !grid.add_triangles() ||
        !number_rows(build, def.columns, def.rows, def.bend.enabled != 0 ? 4 : 2)) {
        return build.fail_out_of_memory();
    }
    return assemble(build);
}

} // namespace lks
