// Cloth from a triangle mesh, against a second, slower account of what its constraints are.
#include <cmath>
#include <map>

#include "asset_inspection.h"
#include "support/builders.h"

using namespace inspection;
using support::Asset;
using support::Mesh;

namespace {

struct Expected {
    std::set<Pair> stretch, shear, bend;
};

double squared(const Mesh& mesh, std::uint32_t a, std::uint32_t b) {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double d = mesh.vertices[3 * a + axis] - mesh.vertices[3 * b + axis];
        sum += d * d;
    }
    return sum;
}

// asset.h's rules, word by word. The meshes given have no two sides whose order a double could mistake.
Expected expected_pairs(const Mesh& mesh) {
    struct Wing {
        std::uint32_t opposite;
        bool longest;
    };
    std::map<Pair, std::vector<Wing>> edges;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = mesh.triangles[t + i];
            const std::uint32_t b = mesh.triangles[t + (i + 1) % 3];
            const std::uint32_t c = mesh.triangles[t + (i + 2) % 3];
            const bool longest =
                squared(mesh, a, b) > squared(mesh, b, c) && squared(mesh, a, b) > squared(mesh, c, a);
            edges[pair_of(a, b)].push_back({c, longest});
        }
    }
    Expected expected;
    std::set<Pair> taken;
    for (const auto& [edge, wings] : edges) {
        const bool diagonal = wings.size() == 2 && wings[0].longest && wings[1].longest;
        (diagonal ? expected.shear : expected.stretch).insert(edge);
        taken.insert(edge);
    }
    for (const bool shear : {true, false}) {
        for (const auto& [edge, wings] : edges) {
            if ((expected.shear.count(edge) != 0) != shear) {
                continue;
            }
            for (std::size_t w = 1; w < wings.size(); ++w) {
                const Pair pair = pair_of(wings[0].opposite, wings[w].opposite);
                if (pair.first != pair.second && squared(mesh, pair.first, pair.second) > 0 &&
                    taken.insert(pair).second) {
                    (shear ? expected.shear : expected.bend).insert(pair);
                }
            }
        }
    }
    return expected;
}

void has_expected_pairs(const lks_asset& asset, const Mesh& mesh) {
    const Expected expected = expected_pairs(mesh);
    CHECK(pairs(asset, LKS_CONSTRAINT_STRETCH) == expected.stretch);
    CHECK(pairs(asset, LKS_CONSTRAINT_SHEAR) == expected.shear);
    CHECK(pairs(asset, LKS_CONSTRAINT_BEND) == expected.bend);
}

// `spokes` triangles around vertex 0, not closed, in a slight spiral.
Mesh fan(std::uint32_t spokes) {
    Mesh mesh;
    mesh.vertices = {0, 0, 0};
    for (std::uint32_t i = 0; i <= spokes; ++i) {
        const double angle = 6.0 * i / spokes;
        const double radius = 1 + 0.25 * i / spokes;
        mesh.vertices.insert(mesh.vertices.end(), {radius * std::cos(angle), radius * std::sin(angle), 0.0});
    }
    for (std::uint32_t i = 1; i <= spokes; ++i) {
        mesh.triangles.insert(mesh.triangles.end(), {0, i, i + 1});
    }
    return mesh;
}

// Two unequal tetrahedra, base to base, without the base: a closed body.
Mesh two_tetrahedra() {
    Mesh mesh;
    mesh.vertices = {0, 0, 0, 1, 0, 0.125, 0, 1, 0, 0.5, 0.5, 1.25, 0.25, 0.25, -0.75};
    mesh.triangles = {0, 1, 3, 1, 2, 3, 2, 0, 3, 1, 0, 4, 2, 1, 4, 0, 2, 4};
    return mesh;
}

} // namespace

TEST_CASE("a mesh has exactly the stretch and shear and bend pairs that the rules give") {
    SUBCASE("one triangle") {
        const Mesh mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}};
        const Asset asset(mesh.def());
        everything_holds(*asset);
        has_expected_pairs(*asset, mesh);
        CHECK(asset.constraint_count() == 3);
    }
    SUBCASE("two triangles of a rectangle: both diagonals are shear") {
        const Mesh mesh{{0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 0}, {0, 1, 2, 0, 2, 3}};
        const Asset asset(mesh.def());
        everything_holds(*asset);
        has_expected_pairs(*asset, mesh);
        CHECK(pairs(*asset, LKS_CONSTRAINT_SHEAR) == std::set<Pair>{{0, 2}, {1, 3}});
    }
    SUBCASE("two long triangles on their short edge: the far pair is bend") {
        const Mesh mesh{{0, 0, 0, 0, 1, 0, 3, 0.5, 0, -3, 0.5, 0}, {0, 2, 1, 0, 1, 3}};
        const Asset asset(mesh.def());
        everything_holds(*asset);
        has_expected_pairs(*asset, mesh);
        CHECK(pairs(*asset, LKS_CONSTRAINT_BEND) == std::set<Pair>{{2, 3}});
    }
    SUBCASE("wavy quads") {
        for (const std::uint32_t side : {3u, 5u, 17u, 33u}) {
            const Mesh mesh = support::wavy_mesh(side, 2);
            const Asset asset(mesh.def());
            everything_holds(*asset);
            has_expected_pairs(*asset, mesh);
        }
    }
    SUBCASE("a closed body, in which an opposite pair may be an edge already") {
        const Mesh mesh = two_tetrahedra();
        const Asset asset(mesh.def());
        everything_holds(*asset);
        has_expected_pairs(*asset, mesh);
    }
    SUBCASE("four wings on one edge") {
        const Mesh mesh{{0, 0, 0, 0, 0.5, 0, 1, 0.25, 0, -1, 0.25, 0, 0, 0.25, 1.125, 0, 0.25, -1.25},
                        {0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 1, 5}};
        const Asset asset(mesh.def());
        everything_holds(*asset);
        has_expected_pairs(*asset, mesh);
        CHECK(pairs(*asset, LKS_CONSTRAINT_BEND) == std::set<Pair>{{2, 3}, {2, 4}, {2, 5}});
    }
    SUBCASE("a triangle folded flat onto its neighbour: nothing to keep apart") {
        const Mesh mesh{{0, 0, 0, 1, 0, 0, 0.5, 3, 0, 0.5, 3, 0}, {0, 1, 2, 1, 0, 3}};
        const Asset asset(mesh.def());
        everything_holds(*asset);
        CHECK(pairs(*asset, LKS_CONSTRAINT_BEND).empty());
        CHECK(asset.constraint_count() == 5);
    }
}

TEST_CASE("a hub with thousands of edges gets a colour for each of them") {
    const Mesh mesh = fan(6000);
    const Asset asset(mesh.def());
    everything_holds(*asset);
    has_expected_pairs(*asset, mesh);
    std::uint32_t stretch_colours = 0;
    for (const lks::Batch& batch : (*asset).batches) {
        stretch_colours += batch.family == LKS_CONSTRAINT_STRETCH ? 1 : 0;
    }
    CHECK(stretch_colours == 6001);
}

TEST_CASE("a third of each triangle's mass goes to each corner") {
    const Mesh mesh{{0, 0, 0, 3, 0, 0, 0, 2, 0, 3, 4, 0}, {0, 1, 2, 1, 3, 2}}; // areas 3 and 6 m²
    for (const bool by_density : {false, true}) {
        lks_cloth_def def = mesh.def();
        def.mass = by_density ? 0 : 4.5;
        def.area_density = by_density ? 0.5 : 0;
        const Asset asset(def);
        const double expected[4] = {0.5, 1.5, 1.5, 1.0};
        for (std::uint32_t v = 0; v < 4; ++v) {
            CHECK(number((*asset).masses[(*asset).vertex_to_particle[v]]) ==
                  doctest::Approx(expected[v]).epsilon(1e-15));
        }
        CHECK(total_mass(*asset) == doctest::Approx(4.5).epsilon(1e-15));
    }
}

TEST_CASE("masses given one by one are kept exactly by vertex") {
    const Mesh mesh = support::wavy_mesh(6, 1);
    std::vector<double> masses;
    for (std::uint32_t v = 0; v < 36; ++v) {
        masses.push_back(1e-8 + 0.1 * v);
    }
    lks_cloth_def def = mesh.def();
    def.mass = 0;
    def.area_density = 0;
    def.vertex_masses = masses.data();
    const Asset asset(def);
    everything_holds(*asset);
    std::uint32_t wrong = 0;
    for (std::uint32_t v = 0; v < 36; ++v) {
        wrong += number((*asset).masses[(*asset).vertex_to_particle[v]]) != masses[v] ? 1 : 0;
    }
    CHECK(wrong == 0);
}

TEST_CASE("positions are the nearest coordinates to the doubles and triangles come back as given") {
    const Mesh mesh = support::wavy_mesh(9, 1.7);
    const Asset asset(mesh.def());
    CHECK(asset.triangles() == mesh.triangles);
    std::uint32_t wrong = 0;
    for (std::uint32_t v = 0; v < 81; ++v) {
        const lks::Coordinates& found = (*asset).rest_positions[(*asset).vertex_to_particle[v]];
        const std::int64_t components[3] = {found.x, found.y, found.z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            // Scaling by 2^56 is exact, and from 2^53 units on a double is a whole number of them.
            const double units = std::ldexp(mesh.vertices[3 * v + axis], 56);
            const bool exact = std::fabs(units) >= 0x1p53;
            wrong +=
                components[axis] == (exact ? static_cast<std::int64_t>(units) : std::llround(units)) ? 0 : 1;
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("much of a mesh stands in runs and its first colour in one") {
    const Mesh mesh = support::wavy_mesh(65, 2);
    const Asset asset(mesh.def());
    everything_holds(*asset);
    const double share = share_in_runs(*asset);
    MESSAGE("65² mesh: ", share, " % in runs, ", lks_asset_colour_count(asset), " colours");
    CHECK(share > 5);
    const lks::Batch& first = (*asset).batches[0];
    CHECK(first.run_count == 1);
    CHECK(first.first_single == first.first + first.count);
    CHECK(lks_asset_colour_count(asset) < 40);
}

TEST_CASE("renumbering the vertices of a mesh changes no lengths and no masses") {
    const Mesh mesh = support::wavy_mesh(12, 1);
    const std::uint32_t count = 144;
    Mesh turned = mesh; // vertex v becomes 143 - v
    for (std::uint32_t v = 0; v < count; ++v) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            turned.vertices[3 * (count - 1 - v) + axis] = mesh.vertices[3 * v + axis];
        }
    }
    for (std::uint32_t& index : turned.triangles) {
        index = count - 1 - index;
    }
    const Asset a(mesh.def());
    const Asset b(turned.def());
    everything_holds(*b);
    std::multiset<std::int64_t> lengths_a((*a).rest_lengths.begin(), (*a).rest_lengths.end());
    std::multiset<std::int64_t> lengths_b((*b).rest_lengths.begin(), (*b).rest_lengths.end());
    CHECK(lengths_a == lengths_b);
    std::uint32_t wrong = 0;
    for (std::uint32_t v = 0; v < count; ++v) {
        wrong +=
            (*a).masses[(*a).vertex_to_particle[v]] == (*b).masses[(*b).vertex_to_particle[count - 1 - v]]
                ? 0
                : 1;
    }
    CHECK(wrong == 0);
    CHECK(lks_asset_fingerprint(a) != lks_asset_fingerprint(b));
}
