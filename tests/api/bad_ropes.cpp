// Rope descriptions that are refused, each with a sentence that names the value.
#include <doctest/doctest.h>

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
lks_rope_def changed(Change change) {
    lks_rope_def def = lks_default_rope_def();
    change(def);
    return def;
}

template <typename Change>
void refused(Change change, const std::string& value, lks_result expected = invalid) {
    check_asset_refused(changed(change), expected, value);
}

lks_rope_def polyline(const std::vector<double>& points) {
    return changed([&](auto& def) {
        def.segments = 0;
        def.length = 0;
        def.point_count = static_cast<std::uint32_t>(points.size() / 3);
        def.points = points.data();
    });
}

} // namespace

TEST_CASE("NaN and infinities are refused by name in every number of a rope") {
    const struct {
        double value;
        const char* name;
    } bad[] = {{not_a_number, "nan"}, {infinity, "inf"}, {-infinity, "inf"}};
    for (const auto& b : bad) {
        refused([&](auto& def) { def.length = b.value; }, b.name);
        refused([&](auto& def) { def.linear_density = b.value; }, b.name);
        refused(
            [&](auto& def) {
                def.linear_density = 0;
                def.mass = b.value;
            },
            b.name);
        refused([&](auto& def) { def.stretch.compliance = b.value; }, b.name);
        refused([&](auto& def) { def.stretch.damping = b.value; }, b.name);
        refused([&](auto& def) { def.bend.compliance = b.value; }, b.name);
        refused([&](auto& def) { def.bend.damping = b.value; }, b.name);
        refused([&](auto& def) { def.particle_radius = b.value; }, b.name);
        refused([&](auto& def) { def.friction = b.value; }, b.name);
        for (std::size_t i = 0; i < 9; ++i) {
            std::vector<double> points{0, 0, 0, 1, 0, 0, 2, 1, 0};
            points[i] = b.value;
            check_asset_refused(polyline(points), invalid, b.name);
        }
    }
}

TEST_CASE("masses of a rope that are zero or negative or out of range are refused") {
    refused([](auto& def) { def.linear_density = -0.2; }, "-0.2");
    refused([](auto& def) { def.linear_density = 1e-9; }, "vertex 0");
    refused(
        [](auto& def) {
            def.linear_density = 0;
            def.mass = -4;
        },
        "-4");
    refused([](auto& def) { def.linear_density = 0; }, "0");
    refused([](auto& def) { def.mass = 1; }, "1");
    std::vector<double> masses(51, 1);
    const auto with_masses = [&](auto& def) {
        def.linear_density = 0;
        def.vertex_masses = masses.data();
    };
    const struct {
        double mass;
        const char* value;
    } bad[] = {{0.0, "mass is 0|mass of 0"}, {-1.0, "-1"}, {1e-9, "vertex 50"}, {3e6, "3e6|3000000 "}};
    for (const auto& b : bad) {
        masses[50] = b.mass;
        refused(with_masses, b.value);
    }
}

TEST_CASE("negative or extreme compliance and damping of a rope are refused") {
    refused([](auto& def) { def.stretch.compliance = -0.5; }, "-0.5");
    refused([](auto& def) { def.bend.compliance = 1e-16; }, "1e-16|0.0000000000000001");
    refused([](auto& def) { def.stretch.damping = -0.125; }, "-0.125");
    refused([](auto& def) { def.bend.damping = -7; }, "-7");
    refused([](auto& def) { def.bend.enabled = 3; }, "3");
    refused([](auto& def) { def.stretch.reserved = 4; }, "4");
    refused([](auto& def) { def.particle_radius = 1.25; }, "1.25");
    refused([](auto& def) { def.friction = -0.5; }, "-0.5");
}

TEST_CASE("ropes of no length or no segments or too many are refused") {
    refused([](auto& def) { def.length = 0; }, "0");
    refused([](auto& def) { def.length = -3; }, "-3");
    refused([](auto& def) { def.length = -1; }, "length is -1; it must be above 0 and at most 60 m");
    refused([](auto& def) { def.segments = 0; }, "0");
    refused([](auto& def) { def.segments = 1048576; }, "1048576");
    refused([](auto& def) { def.length = 60.5; }, "length is 60.5; it must be above 0 and at most 60 m");
    const std::vector<double> points{0, 0, 0, 1, 0, 0};
    lks_rope_def def = polyline(points);
    def.point_count = 1;
    check_asset_refused(def, invalid, "1");
    def = polyline(points);
    def.point_count = 1048577;
    check_asset_refused(def, invalid, "1048577");
    def = polyline(points);
    def.points = nullptr;
    check_asset_refused(def, LKS_ERROR_NULL_ARGUMENT, "points");
}

TEST_CASE("segments of length zero are refused by their number") {
    const std::vector<double> points{0, 0, 0, 1, 0, 0, 1, 0, 0, 2, 0, 0};
    check_asset_refused(polyline(points), invalid, "1");
}

TEST_CASE("a polyline beyond the range of positions is refused") {
    const std::vector<double> points{0, 0, 0, 0, -60.25, 0};
    check_asset_refused(polyline(points), invalid, "-60.25");
    const std::vector<double> edge{0, 0, 0, 0, -60, 0, 60, -60, 0};
    Asset(polyline(edge));
    const std::vector<double> long_bend{0, 0, 0, 0, -60, 0, 60, -60, 60};
    check_asset_refused(polyline(long_bend), invalid, "100");
}

TEST_CASE("a rope that doubles back onto itself has no bend constraint of length zero") {
    // Points 0 and 2 fall together: no direction to keep them apart in.
    const std::vector<double> points{0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0};
    lks_error error{};
    lks_rope_def def = polyline(points);
    def.error = &error;
    lks_asset* asset = nullptr;
    const lks_result result = lks_asset_create_rope(&def, &asset);
    if (result == LKS_OK) {
        World world;
        lks_object_def object = lks_default_object_def();
        object.asset = asset;
        world.add(object);
        world.step(30);
        lks_asset_release(asset);
    } else {
        CHECK(result == invalid);
        check_sentence(error.message, "0");
    }
}

TEST_CASE("a solver that does not exist or does not fit the rope is refused") {
    refused([](auto& def) { def.solver = 3; }, "3");
    refused([](auto& def) { def.solver = UINT32_MAX; }, "4294967295");
    refused(
        [](auto& def) {
            def.solver = LKS_ROPE_DIRECT;
            def.stretch = off;
        },
        "stretch");
    refused(
        [](auto& def) {
            def.solver = LKS_ROPE_DIRECT;
            def.segments = LKS_MAX_DIRECT_SEGMENTS + 1;
        },
        "16385");
    // Of itself it takes what fits.
    Asset(changed([](auto& def) { def.stretch = off; }));
    Asset(changed([](auto& def) { def.segments = LKS_MAX_DIRECT_SEGMENTS + 1; }));
    Asset(changed([](auto& def) {
        def.solver = LKS_ROPE_DIRECT;
        def.segments = LKS_MAX_DIRECT_SEGMENTS;
    }));
    Asset(changed([](auto& def) {
        def.solver = LKS_ROPE_DIRECT;
        def.segments = 1;
        def.bend = off;
    }));
}
