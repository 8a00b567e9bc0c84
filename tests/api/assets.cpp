// What an asset tells about itself, in the caller's numbering, and what it refuses to tell.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "support/builders.h"

using namespace support;

TEST_CASE("a grid's vertices run along rows from the top left and its front is +z") {
    lks_cloth_def def = lks_default_cloth_def();
    def.columns = 4;
    def.rows = 3;
    def.width = 3;
    def.height = 1;
    const Asset asset(def);
    REQUIRE(asset.vertex_count() == 12);
    World world;
    const lks_object_id object = world.add(asset, at(0, 0, 0));
    const std::vector<Vector> positions = world.positions_from(object, {});
    for (std::uint32_t row = 0; row < 3; ++row) {
        for (std::uint32_t column = 0; column < 4; ++column) {
            const Vector expected{-1.5 + column, 0.5 - 0.5 * row, 0};
            CHECK((positions[row * 4 + column] - expected).length() < 1e-15);
        }
    }
    const std::vector<std::uint32_t> triangles = asset.triangles();
    CHECK(triangles.size() == 3u * 2 * 3 * 2);
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
        const Vector u = positions[triangles[t + 1]] - positions[triangles[t]];
        const Vector v = positions[triangles[t + 2]] - positions[triangles[t]];
        CHECK(u.x * v.y - u.y * v.x == doctest::Approx(0.5));
    }
}

TEST_CASE("a mesh's vertices and triangles come back as they were given") {
    const Mesh mesh = wavy_mesh(5, 1);
    const Asset asset(mesh.def());
    CHECK(asset.triangles() == mesh.triangles);
    World world;
    const lks_object_id object = world.add(asset, at(0, 0, 0));
    const std::vector<Vector> positions = world.positions_from(object, {});
    for (std::size_t i = 0; i < positions.size(); ++i) {
        CHECK(positions[i].x == doctest::Approx(mesh.vertices[3 * i]).epsilon(1e-15));
        CHECK(positions[i].y == doctest::Approx(mesh.vertices[3 * i + 1]).epsilon(1e-15));
        CHECK(positions[i].z == doctest::Approx(mesh.vertices[3 * i + 2]).epsilon(1e-15));
    }
}

TEST_CASE("no colour touches a vertex twice and colours never go back") {
    Net net;
    const Asset grid = net.build();
    const Mesh description = wavy_mesh(20, 2);
    const Asset mesh(description.def());
    const Asset rope = Chain().build();
    for (const Asset* asset : {&grid, &mesh, &rope}) {
        std::set<std::pair<std::uint32_t, std::uint32_t>> touched;
        std::uint32_t last = 0;
        bool clean = true;
        for (const lks_constraint_info& info : asset->constraints()) {
            clean = clean && info.colour >= last && info.colour < lks_asset_colour_count(*asset);
            clean = clean && touched.insert({info.colour, info.vertex_a}).second;
            clean = clean && touched.insert({info.colour, info.vertex_b}).second;
            last = info.colour;
        }
        CHECK(clean);
    }
    CHECK(grid.constraint_count() == 2u * 64 * 63 + 2 * 63 * 63 + 2 * 64 * 62);
}

TEST_CASE("rest lengths are those of the description") {
    Net net;
    net.side = 9;
    net.width = 2; // cells of 0.25 m
    const Asset asset = net.build();
    const double expected[] = {0.25, 0.25 * std::sqrt(2.0), 0.5};
    for (const lks_constraint_info& info : asset.constraints()) {
        CHECK(std::abs(metres(info.rest_length) - expected[info.family]) < 1e-12);
    }
}

TEST_CASE("a family that is switched off is not built") {
    Net net;
    net.side = 6;
    net.shear = off;
    net.bend = off;
    const Asset asset = net.build();
    CHECK(asset.constraint_count() == 2u * 6 * 5);
    for (const lks_constraint_info& info : asset.constraints()) {
        CHECK(info.family == LKS_CONSTRAINT_STRETCH);
    }
}

TEST_CASE("constraints that don't exist and buffers that are too small are refused and stay untouched") {
    const Asset asset = Net().build();
    lks_constraint_info info{7, 7, 7, 7, 7};
    CHECK(lks_asset_constraint(asset, asset.constraint_count(), &info) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(lks_asset_constraint(asset, 4294967295u, &info) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(info.vertex_a == 7);
    std::vector<std::uint32_t> indices(std::size_t{3} * lks_asset_triangle_count(asset), 7);
    CHECK(lks_asset_triangles(asset, indices.data(), indices.size() - 1) == LKS_ERROR_BUFFER_TOO_SMALL);
    CHECK(lks_asset_triangles(asset, indices.data(), 0) == LKS_ERROR_BUFFER_TOO_SMALL);
    CHECK(std::count(indices.begin(), indices.end(), 7u) == static_cast<std::ptrdiff_t>(indices.size()));
    const Asset rope = Chain().build();
    CHECK(lks_asset_triangle_count(rope) == 0);
    CHECK(lks_asset_triangles(rope, indices.data(), indices.size()) == LKS_OK);
    CHECK(lks_asset_triangles(rope, nullptr, 0) == LKS_OK);
    CHECK(indices[0] == 7);
}

TEST_CASE("equal descriptions have equal fingerprints and any difference shows") {
    const auto fingerprint = [](auto change) {
        Net net;
        net.side = 7;
        change(net);
        return lks_asset_fingerprint(net.build());
    };
    const std::uint64_t plain = fingerprint([](Net&) {});
    CHECK(plain != 0);
    CHECK(plain == fingerprint([](Net&) {}));
    std::set<std::uint64_t> all{plain};
    CHECK(all.insert(fingerprint([](Net& net) { net.side = 8; })).second);
    CHECK(all.insert(fingerprint([](Net& net) { net.width = 2.0000001; })).second);
    CHECK(all.insert(fingerprint([](Net& net) { net.particle_mass = 0.0010000001; })).second);
    CHECK(all.insert(fingerprint([](Net& net) { net.stretch.compliance = 1e-9; })).second);
    CHECK(all.insert(fingerprint([](Net& net) { net.shear = soft(1e-9); })).second);
    CHECK(all.insert(fingerprint([](Net& net) { net.bend = soft(1e-9); })).second);
    CHECK(all.insert(fingerprint([](Net& net) { net.bend = soft(1e-9, 1); })).second);
    CHECK(all.insert(fingerprint([](Net& net) { net.bend = off; })).second);
    CHECK(all.insert(fingerprint([](Net& net) { net.radius = 0.001; })).second);
    CHECK(all.insert(fingerprint([](Net& net) { net.friction = 1.001; })).second);
}
