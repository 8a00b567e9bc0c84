// Cloth descriptions that are refused, each with a sentence that names the value, and odd ones that are not.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "support/builders.h"
#include "support/refusals.h"

using namespace support;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr lks_result invalid = LKS_ERROR_INVALID_ARGUMENT;

template <typename Change>
lks_cloth_def changed(Change change) {
    lks_cloth_def def = lks_default_cloth_def();
    change(def);
    return def;
}

template <typename Change>
void refused(Change change, const std::string& value, lks_result expected = invalid) {
    check_asset_refused(changed(change), expected, value);
}

// A mesh of a few triangles.
struct Triangles {
    std::vector<double> vertices;
    std::vector<std::uint32_t> triangles;

    lks_cloth_def def() const {
        Mesh mesh{vertices, triangles};
        lks_cloth_def result = mesh.def();
        result.vertices = vertices.data();
        result.triangles = triangles.data();
        return result;
    }
};

const std::vector<double> square{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

} // namespace

TEST_CASE("NaN and infinities are refused by name in every number of a cloth") {
    const struct {
        double value;
        const char* name;
    } bad[] = {{not_a_number, "nan"}, {infinity, "inf"}, {-infinity, "inf"}};
    for (const auto& b : bad) {
        refused([&](auto& def) { def.width = b.value; }, b.name);
        refused([&](auto& def) { def.height = b.value; }, b.name);
        refused([&](auto& def) { def.area_density = b.value; }, b.name);
        refused(
            [&](auto& def) {
                def.area_density = 0;
                def.mass = b.value;
            },
            b.name);
        refused([&](auto& def) { def.stretch.compliance = b.value; }, b.name);
        refused([&](auto& def) { def.shear.compliance = b.value; }, b.name);
        refused([&](auto& def) { def.bend.compliance = b.value; }, b.name);
        refused([&](auto& def) { def.stretch.damping = b.value; }, b.name);
        refused([&](auto& def) { def.shear.damping = b.value; }, b.name);
        refused([&](auto& def) { def.bend.damping = b.value; }, b.name);
        refused([&](auto& def) { def.particle_radius = b.value; }, b.name);
        refused([&](auto& def) { def.friction = b.value; }, b.name);

        std::vector<double> masses(21 * 21, 0.01);
        masses[100] = b.value;
        refused(
            [&](auto& def) {
                def.area_density = 0;
                def.vertex_masses = masses.data();
            },
            b.name);

        for (std::size_t i = 0; i < 12; ++i) {
            Triangles mesh{square, {0, 1, 2, 0, 2, 3}};
            mesh.vertices[i] = b.value;
            check_asset_refused(mesh.def(), invalid, b.name);
        }
    }
}

TEST_CASE("masses that are zero or negative or out of range are refused") {
    for (const double mass : {-1.0, -1e-300, 1e9, 1e300}) {
        refused(
            [&](auto& def) {
                def.area_density = 0;
                def.mass = mass;
            },
            mass < 0 ? "-1" : "1e");
    }
    refused([](auto& def) { def.area_density = -0.5; }, "-0.5");
    refused([](auto& def) { def.area_density = 1e-9; }, "vertex 0"); // comes to far below 1e-8 kg
    std::vector<double> masses(21 * 21, 0.01);
    const auto with_masses = [&](auto& def) {
        def.area_density = 0;
        def.vertex_masses = masses.data();
    };
    const struct {
        double mass;
        const char* value;
    } bad[] = {{0.0, "mass is 0|mass of 0"},
               {-2.5, "-2.5"},
               {9e-9, "9e-9|0.000000009|9000000 picograms"},
               {2e6, "2e6|2000000 "},
               {1e30, "1e30"}};
    for (const auto& b : bad) {
        masses[37] = b.mass;
        refused(with_masses, b.value);
    }
    masses[37] = 1e-8;
    masses[38] = 1e6;
    Asset(changed(with_masses));
}

TEST_CASE("no mass and two masses are refused") {
    std::vector<double> masses(21 * 21, 0.01);
    refused([](auto& def) { def.area_density = 0; }, "0");
    refused([](auto& def) { def.mass = 1; }, "1");
    refused([&](auto& def) { def.vertex_masses = masses.data(); }, "vertex_masses");
}

TEST_CASE("negative or extreme compliance and damping are refused") {
    refused([](auto& def) { def.stretch.compliance = -1e-7; }, "-1e-7|-0.0000001");
    refused([](auto& def) { def.shear.compliance = -0.25; }, "-0.25");
    refused([](auto& def) { def.bend.compliance = 1e-16; }, "1e-16|0.0000000000000001");
    refused([](auto& def) { def.bend.compliance = 2e6; }, "2");
    refused([](auto& def) { def.stretch.damping = -3; }, "-3");
    refused([](auto& def) { def.shear.damping = 1e-10; }, "1e-10|0.0000000001");
    refused([](auto& def) { def.bend.damping = 2e9; }, "2");
    for (const double compliance : {0.0, 1e-15, 1e6}) {
        Asset(changed([&](auto& def) { def.stretch.compliance = compliance; }));
    }
    for (const double damping : {0.0, 1e-9, 1e9}) {
        Asset(changed([&](auto& def) { def.bend.damping = damping; }));
    }
}

TEST_CASE("materials with rubbish in their switches are refused") {
    refused([](auto& def) { def.stretch.enabled = 2; }, "2");
    refused([](auto& def) { def.shear.reserved = 5; }, "5");
    refused([](auto& def) { def.reserved = 6; }, "6");
}

TEST_CASE("a radius or friction out of range is refused") {
    refused([](auto& def) { def.particle_radius = -0.01; }, "-0.01");
    refused([](auto& def) { def.particle_radius = 1.5; }, "1.5");
    refused([](auto& def) { def.friction = -1; }, "-1");
    refused([](auto& def) { def.friction = 101; }, "101");
}

TEST_CASE("grids that are too small or too large are refused") {
    refused([](auto& def) { def.columns = 1; }, "1");
    refused([](auto& def) { def.rows = 0; }, "0");
    refused([](auto& def) { def.columns = 4097; }, "4097");
    refused([](auto& def) { def.rows = 4000000000u; }, "4000000000");
    refused([](auto& def) { def.width = 0; }, "0");
    refused([](auto& def) { def.height = -2; }, "-2");
}

TEST_CASE("a cloth that reaches beyond the range of positions is refused") {
    refused([](auto& def) { def.width = 121; }, "121");
    refused([](auto& def) { def.height = 1e6; }, "1");
    Triangles mesh{square, {0, 1, 2, 0, 2, 3}};
    mesh.vertices[4] = 60.5;
    check_asset_refused(mesh.def(), invalid, "60.5");
    mesh.vertices[4] = -1e30;
    check_asset_refused(mesh.def(), invalid, "-1e30");
    mesh.vertices[4] = -60;
    Asset(mesh.def());
    Asset(changed([](auto& def) {
        def.width = 120;
        def.height = 120;
    }));
}

TEST_CASE("a triangle with an index out of range is refused by its index") {
    check_asset_refused(Triangles{square, {0, 1, 4, 0, 2, 3}}.def(), invalid, "4");
    check_asset_refused(Triangles{square, {0, 1, 2, 0, 2, 4294967295u}}.def(), invalid, "4294967295");
}

TEST_CASE("degenerate triangles are refused") {
    check_asset_refused(Triangles{square, {0, 1, 1, 0, 2, 3}}.def(), invalid, "0"); // a vertex twice
    check_asset_refused(Triangles{square, {0, 1, 2, 3, 3, 3}}.def(), invalid, "1"); // all the same
    std::vector<double> line = square;
    line.insert(line.end(), {2, 0, 0});
    check_asset_refused(Triangles{line, {0, 1, 2, 0, 2, 3, 0, 1, 4}}.def(), invalid,
                        "2"); // on a straight line
    line[13] = 1e-12;
    check_asset_refused(Triangles{line, {0, 1, 2, 0, 2, 3, 0, 1, 4}}.def(), invalid, "2"); // very nearly
}

TEST_CASE("the same triangle twice is refused in whatever winding") {
    for (const std::vector<std::uint32_t>& again : std::vector<std::vector<std::uint32_t>>{
             {0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}) {
        std::vector<std::uint32_t> triangles{0, 1, 2, 0, 2, 3};
        triangles.insert(triangles.end(), again.begin(), again.end());
        check_asset_refused(Triangles{square, triangles}.def(), invalid, "2");
    }
}

TEST_CASE("edges of length zero are refused") {
    std::vector<double> vertices = square;
    vertices.insert(vertices.end(), {1, 1, 0}); // vertex 4 lies on vertex 2
    check_asset_refused(Triangles{vertices, {0, 1, 2, 0, 2, 3, 2, 4, 3}}.def(), invalid, "2");
    // Shorter than the unit of positions: zero in effect.
    vertices[12] = 1 + 1e-17;
    check_asset_refused(Triangles{vertices, {0, 1, 2, 0, 2, 3, 2, 4, 3}}.def(), invalid, "2");
}

TEST_CASE("a vertex in no triangle is refused by its number") {
    std::vector<double> vertices = square;
    vertices.insert(vertices.end(), {5, 5, 5});
    check_asset_refused(Triangles{vertices, {0, 1, 2, 0, 2, 3}}.def(), invalid, "4");
}

TEST_CASE("counts that don't fit and missing arrays are refused") {
    Triangles mesh{square, {0, 1, 2, 0, 2, 3}};
    lks_cloth_def def = mesh.def();
    def.vertex_count = 2;
    check_asset_refused(def, invalid, "2");
    def = mesh.def();
    def.vertex_count = LKS_MAX_VERTICES + 1;
    check_asset_refused(def, invalid, "4194305");
    def = mesh.def();
    def.triangle_count = 0;
    check_asset_refused(def, invalid, "0");
    def = mesh.def();
    def.triangle_count = LKS_MAX_TRIANGLES + 1;
    check_asset_refused(def, invalid, "8388609");
    def = mesh.def();
    def.vertices = nullptr;
    check_asset_refused(def, LKS_ERROR_NULL_ARGUMENT, "vertices");
    def = mesh.def();
    def.triangles = nullptr;
    check_asset_refused(def, LKS_ERROR_NULL_ARGUMENT, "triangles");
}

TEST_CASE("an edge of three triangles works and joins its wings") {
    // Three wings on the edge 0-1, like a book.
    Triangles book{{0, 0, 0, 0, 1, 0, 1, 0.5, 0, -0.5, 0.5, 0.9, -0.5, 0.5, -0.9},
                   {0, 1, 2, 1, 0, 3, 0, 1, 4}};
    lks_cloth_def def = book.def();
    def.bend.compliance = 1e-3;
    const Asset asset(def);
    CHECK(asset.vertex_count() == 5);
    CHECK(asset.constraints().size() == 7 + 2);
    int joined[5] = {};
    for (const lks_constraint_info& info : asset.constraints()) {
        if (info.family != LKS_CONSTRAINT_STRETCH) {
            // The first triangle's opposite vertex with each other one's.
            CHECK((info.vertex_a == 2 || info.vertex_b == 2));
            ++joined[info.vertex_a];
            ++joined[info.vertex_b];
        }
    }
    CHECK(joined[2] == 2);
    CHECK(joined[3] == 1);
    CHECK(joined[4] == 1);

    World world;
    const lks_object_id object = world.add(asset, at(0, 0, 0));
    world.pin(object, 0);
    world.step(300);
    const std::vector<Vector> positions = world.positions_from(object, {});
    for (const lks_constraint_info& info : asset.constraints()) {
        if (info.family == LKS_CONSTRAINT_STRETCH) {
            const double length = (positions[info.vertex_a] - positions[info.vertex_b]).length();
            CHECK(length == doctest::Approx(metres(info.rest_length)).epsilon(0.01));
        }
    }
}

TEST_CASE("disconnected pieces and opposite windings work") {
    std::vector<double> vertices = square;
    for (const double x : {3.0, 4.0}) {
        vertices.insert(vertices.end(), {x, 0, 0});
    }
    vertices.insert(vertices.end(), {3, 1, 0});
    const Asset asset(Triangles{vertices, {0, 1, 2, 0, 3, 2, 4, 5, 6}}.def());
    CHECK(asset.vertex_count() == 7);
    World world;
    world.add(asset, at(0, 0, 0));
    world.step(10);
}

TEST_CASE("tether anchors that are no vertices, stand twice or are too many are refused") {
    const auto with = [](const std::vector<std::uint32_t>& anchors) {
        return [&anchors](lks_cloth_def& def) {
            def.tether_anchors = anchors.data();
            def.tether_anchor_count = static_cast<std::uint32_t>(anchors.size());
        };
    };
    refused(with({3, 441}), "441");
    refused(with({4294967295u}), "4294967295");
    refused(with({7, 3, 5, 3}), "vertex 3");
    std::vector<std::uint32_t> many(LKS_MAX_TETHER_ANCHORS + 1);
    for (std::uint32_t i = 0; i < many.size(); ++i) {
        many[i] = i;
    }
    refused(with(many), "257", LKS_ERROR_LIMIT);
    refused([](auto& def) { def.tether_anchor_count = 1; }, "tether_anchors", LKS_ERROR_NULL_ARGUMENT);
    for (const std::uint32_t count : {0u, 5u, 4294967295u}) {
        refused([&](auto& def) { def.tethers_per_vertex = count; }, std::to_string(count));
    }
    many.pop_back();
    lks_cloth_def def = lks_default_cloth_def();
    with(many)(def);
    const Asset asset(def);
    World world;
    const lks_object_id object = world.add(asset, at(0, 0, 0));
    for (const std::uint32_t vertex : many) {
        world.pin(object, vertex);
    }
    world.step(10);
}
