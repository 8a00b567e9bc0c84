// Cloth from a grid.
#include <cmath>

#include "asset_inspection.h"
#include "support/builders.h"

using namespace inspection;
using support::Asset;

namespace {

lks_cloth_def grid_def(std::uint32_t columns, std::uint32_t rows) {
    lks_cloth_def def = lks_default_cloth_def();
    def.columns = columns;
    def.rows = rows;
    return def;
}

struct ExpectedPairs {
    std::set<Pair> stretch, shear, bend;
};

ExpectedPairs expected_pairs(std::uint32_t columns, std::uint32_t rows) {
    ExpectedPairs expected;
    const auto add = [&](std::set<Pair>& pairs, std::uint32_t x, std::uint32_t y, int across, int down) {
        const int other_x = static_cast<int>(x) + across;
        const int other_y = static_cast<int>(y) + down;
        if (other_x >= 0 && other_x < static_cast<int>(columns) && other_y < static_cast<int>(rows)) {
            pairs.insert(pair_of(y * columns + x, static_cast<std::uint32_t>(other_y) * columns +
                                                      static_cast<std::uint32_t>(other_x)));
        }
    };
    for (std::uint32_t y = 0; y < rows; ++y) {
        for (std::uint32_t x = 0; x < columns; ++x) {
            add(expected.stretch, x, y, 1, 0);
            add(expected.stretch, x, y, 0, 1);
            add(expected.shear, x, y, 1, 1);
            add(expected.shear, x, y, -1, 1);
            add(expected.bend, x, y, 2, 0);
            add(expected.bend, x, y, 0, 2);
        }
    }
    return expected;
}

void has_expected_pairs(const lks_asset& asset, std::uint32_t columns, std::uint32_t rows) {
    const ExpectedPairs expected = expected_pairs(columns, rows);
    CHECK(pairs(asset, LKS_CONSTRAINT_STRETCH) == expected.stretch);
    CHECK(pairs(asset, LKS_CONSTRAINT_SHEAR) == expected.shear);
    CHECK(pairs(asset, LKS_CONSTRAINT_BEND) == expected.bend);
}

const lks::Coordinates& position(const lks_asset& asset, std::uint32_t vertex) {
    return asset.rest_positions[asset.vertex_to_particle[vertex]];
}

const lks::fixed::Scaled& mass(const lks_asset& asset, std::uint32_t vertex) {
    return asset.masses[asset.vertex_to_particle[vertex]];
}

} // namespace

TEST_CASE("a grid of any size has exactly the pairs along rows and columns and diagonals and two apart") {
    for (const Pair& size : {Pair{2, 2}, Pair{2, 3}, Pair{3, 2}, Pair{3, 3}, Pair{5, 4}, Pair{9, 17},
                             Pair{33, 7}, Pair{40, 41}, Pair{64, 64}}) {
        const std::uint32_t columns = size.first;
        const std::uint32_t rows = size.second;
        CAPTURE(columns);
        CAPTURE(rows);
        const Asset asset(grid_def(columns, rows));
        CHECK(asset.vertex_count() == columns * rows);
        everything_holds(*asset);
        has_expected_pairs(*asset, columns, rows);
    }
}

TEST_CASE("a grid has twelve colours and nearly all its constraints stand in runs") {
    for (const std::uint32_t side : {64u, 65u, 66u, 67u, 100u, 256u}) {
        CAPTURE(side);
        const Asset asset(grid_def(side, side));
        CHECK(lks_asset_colour_count(asset) == 12);
        const std::uint32_t n = side;
        CHECK(asset.constraint_count() == 2 * n * (n - 1) + 2 * (n - 1) * (n - 1) + 2 * n * (n - 2));
        const double share = share_in_runs(*static_cast<const lks_asset*>(asset));
        const double of_8 = share_in_groups(*static_cast<const lks_asset*>(asset), 8);
        const double of_16 = share_in_groups(*static_cast<const lks_asset*>(asset), 16);
        MESSAGE("side ", side, ": ", share, " % in runs, ", of_8, " % in groups of 8, ", of_16, " % of 16");
        // Up to three columns beyond a multiple of four have neighbours in no run, so that all others have.
        CHECK(share > (side % 4 == 0 ? 99.9 : 98.5));
        CHECK(of_8 > (side % 4 == 0 ? 99.9 : 89.0));
        CHECK(of_16 > (side % 64 == 0 ? 99.8 : 79.0));
    }
}

TEST_CASE("families that are off are not built and count no colours") {
    lks_cloth_def def = grid_def(20, 20);
    def.shear = support::off;
    def.bend = support::off;
    const Asset stretch(def);
    everything_holds(*stretch);
    CHECK(stretch.constraint_count() == 2 * 20 * 19);
    CHECK(lks_asset_colour_count(stretch) == 4);

    def.stretch = support::off;
    def.bend = support::stiff();
    const Asset bend(def);
    everything_holds(*bend);
    CHECK(bend.constraint_count() == 2 * 20 * 18);
    CHECK(pairs(*bend, LKS_CONSTRAINT_BEND).size() == bend.constraint_count());

    def.bend = support::off;
    const Asset none(def);
    everything_holds(*none);
    CHECK(none.constraint_count() == 0);
    CHECK(lks_asset_colour_count(none) == 0);
}

TEST_CASE("a grid is centred and mirror-symmetric to the bit and starts at the top left") {
    for (const auto& [columns, rows] : {Pair{2, 2}, Pair{7, 10}, Pair{64, 33}, Pair{301, 4}}) {
        lks_cloth_def def = grid_def(columns, rows);
        def.width = 1.7;
        def.height = 0.9;
        const Asset asset(def);
        std::uint32_t wrong = 0;
        for (std::uint32_t y = 0; y < rows; ++y) {
            for (std::uint32_t x = 0; x < columns; ++x) {
                const lks::Coordinates& here = position(*asset, y * columns + x);
                const lks::Coordinates& mirrored = position(*asset, y * columns + columns - 1 - x);
                const lks::Coordinates& flipped = position(*asset, (rows - 1 - y) * columns + x);
                wrong += here.x != -mirrored.x || here.y != mirrored.y || here.z != 0 ? 1 : 0;
                wrong += here.y != -flipped.y || here.x != flipped.x ? 1 : 0;
                const double ideal_x = 1.7 * (static_cast<double>(x) / (columns - 1) - 0.5);
                const double ideal_y = 0.9 * (0.5 - static_cast<double>(y) / (rows - 1));
                wrong += std::fabs(support::raw_metres(here.x) - ideal_x) > 1e-15 ? 1 : 0;
                wrong += std::fabs(support::raw_metres(here.y) - ideal_y) > 1e-15 ? 1 : 0;
            }
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("inner vertices of a grid have equal masses to the bit and borders half and corners a quarter") {
    for (const bool by_density : {false, true}) {
        lks_cloth_def def = grid_def(31, 17);
        def.width = 1.3;
        def.height = 0.7;
        def.mass = by_density ? 0 : 0.45;
        def.area_density = by_density ? 0.45 / (1.3 * 0.7) : 0;
        const Asset asset(def);
        const lks::fixed::Scaled inner = mass(*asset, 31 + 1);
        const lks::fixed::Scaled half = inner.times_power_of_two(-1);
        const lks::fixed::Scaled quarter = inner.times_power_of_two(-2);
        std::uint32_t wrong = 0;
        for (std::uint32_t y = 0; y < 17; ++y) {
            for (std::uint32_t x = 0; x < 31; ++x) {
                const int borders = (x == 0 || x == 30 ? 1 : 0) + (y == 0 || y == 16 ? 1 : 0);
                const lks::fixed::Scaled expected = borders == 0 ? inner : borders == 1 ? half : quarter;
                wrong += mass(*asset, y * 31 + x) == expected ? 0 : 1;
            }
        }
        CHECK(wrong == 0);
        CHECK(number(inner) == doctest::Approx(0.45 / (30 * 16)).epsilon(1e-14));
        CHECK(total_mass(*asset) == doctest::Approx(0.45).epsilon(1e-13));
    }
}

TEST_CASE("a grid's triangles cover each cell once and are counter-clockwise from the front") {
    const Asset asset(grid_def(6, 5));
    const std::vector<std::uint32_t> triangles = asset.triangles();
    REQUIRE(lks_asset_triangle_count(asset) == 2 * 5 * 4);
    REQUIRE(triangles.size() == 3 * 2 * 5 * 4);
    const double cell = 2.0 / 5 * 2.0 / 4;
    std::vector<double> covered(5 * 4, 0.0);
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
        double x[3], y[3];
        std::uint32_t column = 5, row = 4;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = triangles[t + corner];
            x[corner] = support::raw_metres(position(*asset, vertex).x);
            y[corner] = support::raw_metres(position(*asset, vertex).y);
            column = std::min(column, vertex % 6);
            row = std::min(row, vertex / 6);
        }
        const double area = ((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])) / 2;
        CHECK(area == doctest::Approx(cell / 2));
        covered[row * 5 + column] += area;
    }
    for (const double area : covered) {
        CHECK(area == doctest::Approx(cell));
    }
}

TEST_CASE("the widest grid keeps its exactness and one too narrow for its columns is refused") {
    lks_cloth_def wide = grid_def(4, 4);
    wide.width = 120;
    wide.height = 120;
    const Asset asset(wide);
    everything_holds(*asset);

    // 64 columns in a width of seven coordinate units: neighbours would coincide.
    lks_cloth_def narrow = grid_def(64, 2);
    narrow.width = 1e-16;
    narrow.height = 1;
    narrow.area_density = 0;
    const std::vector<double> masses(128, 0.001);
    narrow.vertex_masses = masses.data();
    lks_error error{};
    narrow.error = &error;
    lks_asset* refused = nullptr;
    CHECK(lks_asset_create_cloth(&narrow, &refused) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(refused == nullptr);
    CHECK(error.message[0] != '\0');
    lks_asset_release(refused);
}
