// Ropes, straight and from a polyline.
#include <cmath>

#include "asset_inspection.h"
#include "support/builders.h"

using namespace inspection;
using support::Asset;
using support::straight_rope;

TEST_CASE("a rope of any number of segments has two colours of stretch and two of bend") {
    for (const std::uint32_t segments : {1u, 2u, 3u, 4u, 5u, 8u, 50u, 63u, 64u, 65u, 1001u}) {
        CAPTURE(segments);
        const Asset asset(straight_rope(segments, 5));
        everything_holds(*asset);
        std::set<Pair> stretch, bend;
        for (std::uint32_t i = 0; i < segments; ++i) {
            stretch.insert({i, i + 1});
            if (i + 2 <= segments) {
                bend.insert({i, i + 2});
            }
        }
        CHECK(pairs(*asset, LKS_CONSTRAINT_STRETCH) == stretch);
        CHECK(pairs(*asset, LKS_CONSTRAINT_BEND) == bend);
        CHECK(pairs(*asset, LKS_CONSTRAINT_SHEAR).empty());
        CHECK(lks_asset_colour_count(asset) == (segments == 1   ? 1
                                                : segments == 2 ? 3
                                                : segments == 3 ? 3
                                                                : 4));
        CHECK(lks_asset_triangle_count(asset) == 0);
        std::uint32_t none = 7;
        CHECK(lks_asset_triangles(asset, &none, 0) == LKS_OK);
        CHECK(none == 7);
        if (segments >= 50) {
            // The last particles beyond a multiple of four are in no run: three of 51 here at most.
            CHECK(share_in_runs(*asset) > 93);
        }
    }
}

TEST_CASE("a straight rope lies along +x in equal parts from the origin") {
    const Asset asset(straight_rope(7, 1.3));
    for (std::uint32_t i = 0; i <= 7; ++i) {
        const lks::Coordinates& found = (*asset).rest_positions[(*asset).vertex_to_particle[i]];
        CHECK(support::raw_metres(found.x) == doctest::Approx(1.3 * i / 7).epsilon(1e-15));
        CHECK(found.y == 0);
        CHECK(found.z == 0);
    }
}

TEST_CASE("each point of a rope has half of its neighbouring segments' mass") {
    const std::vector<double> points{0, 0, 0, 0, 3, 0, 4, 3, 0, 4, 3, 2}; // segments of 3, 4 and 2 m
    for (const bool by_density : {false, true}) {
        lks_rope_def def = lks_default_rope_def();
        def.points = points.data();
        def.point_count = 4;
        def.mass = by_density ? 0 : 4.5;
        def.linear_density = by_density ? 0.5 : 0;
        const Asset asset(def);
        everything_holds(*asset);
        const double expected[4] = {0.75, 1.75, 1.5, 0.5};
        for (std::uint32_t v = 0; v < 4; ++v) {
            CHECK(number((*asset).masses[(*asset).vertex_to_particle[v]]) ==
                  doctest::Approx(expected[v]).epsilon(1e-15));
        }
    }
}

TEST_CASE("the rest length of a constraint at the API is the exact one rounded to 2^-40") {
    const std::vector<double> points{0, 0, 0, 0.1, 0.2, 0.3, -1.7, 0.33, 0.9, 59, -60, 60, -40, 0, 60};
    lks_rope_def def = lks_default_rope_def();
    def.points = points.data();
    def.point_count = 5;
    lks_asset* asset = nullptr;
    def.bend = support::off;
    // 59 - -1.7, -60 - 0.33, 60 - 0.9: 104 m, more than a constraint may be long.
    CHECK(lks_asset_create_rope(&def, &asset) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(asset == nullptr);

    def.point_count = 3;
    REQUIRE(lks_asset_create_rope(&def, &asset) == LKS_OK);
    everything_holds(*asset);
    for (std::uint32_t i = 0; i < asset->constraint_count(); ++i) {
        lks_constraint_info info{};
        REQUIRE(lks_asset_constraint(asset, i, &info) == LKS_OK);
        const std::int64_t exact = asset->rest_lengths[i];
        CHECK(std::llabs(info.rest_length * 65536 - exact) <= 32768);
        CHECK(info.colour < lks_asset_colour_count(asset));
    }
    lks_constraint_info info{7, 7, 7, 7, 7};
    CHECK(lks_asset_constraint(asset, asset->constraint_count(), &info) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(info.vertex_a == 7);
    CHECK(info.rest_length == 7);
    lks_asset_release(asset);
}

TEST_CASE("radius and friction and materials arrive exactly") {
    lks_rope_def def = straight_rope(10, 1);
    def.particle_radius = 0.0625;
    def.friction = 1.5;
    def.stretch = support::soft(0.25, 8);
    const Asset asset(def);
    CHECK((*asset).particle_radius == lks::coordinate_one / 16);
    CHECK((*asset).friction == LKS_FIXED(3) / 2);
    CHECK(number((*asset).families[LKS_CONSTRAINT_STRETCH].compliance) == 0.25);
    CHECK(number((*asset).families[LKS_CONSTRAINT_STRETCH].damping) == 8);
    CHECK(!(*asset).families[LKS_CONSTRAINT_SHEAR].enabled);
}

TEST_CASE("a rope that may be solved at once lists its segments in their order") {
    for (const std::uint32_t segments : {1u, 2u, 7u, 64u, 1001u}) {
        lks_rope_def def = straight_rope(segments, 5);
        if (segments == 1) {
            def.bend = support::off;
        }
        def.solver = LKS_ROPE_DIRECT;
        const Asset asset(def);
        REQUIRE((*asset).chain.size() == segments);
        for (std::uint32_t i = 0; i < segments; ++i) {
            lks_constraint_info info{};
            REQUIRE(lks_asset_constraint(asset, (*asset).chain[i], &info) == LKS_OK);
            CHECK(info.family == LKS_CONSTRAINT_STRETCH);
            CHECK(std::min(info.vertex_a, info.vertex_b) == i);
            CHECK(std::max(info.vertex_a, info.vertex_b) == i + 1);
        }
        def.solver = LKS_ROPE_AUTOMATIC;
        CHECK((*Asset(def)).chain.size() == (segments == 1 ? 0 : segments));
        def.solver = LKS_ROPE_SWEPT;
        CHECK((*Asset(def)).chain.empty());
    }
}
