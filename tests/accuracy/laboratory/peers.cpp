// What stands beside ours in the benchmark solves the same problem.
#include <doctest/doctest.h>

#include <vector>

#include "float_runs.h"
#include "plain_float.h"
#include "support/builders.h"

TEST_CASE("float32 peers have the masses of the asset, and share out by them") {
    support::Net net;
    net.side = 5;
    std::vector<double> masses;
    for (int i = 0; i < 25; ++i) {
        masses.push_back(0.001 * (1 + i % 4));
    }
    const support::Asset sheet = net.build(masses);
    const lks_asset& asset = *static_cast<const lks_asset*>(sheet);
    const std::uint32_t pin = 7;
    const auto weight = [&](std::uint32_t vertex) { return vertex == pin ? 0 : 1 / masses[vertex]; };

    const lks_bench::FloatCloth plain =
        lks_bench::make_float_cloth(asset, {pin}, lks_bench::EdgeOrder::by_colour);
    for (std::uint32_t vertex = 0; vertex < masses.size(); ++vertex) {
        CHECK(static_cast<double>(plain.particles[vertex].inverse_mass) ==
              doctest::Approx(weight(vertex)).epsilon(1e-6));
    }
    const lks_bench::FloatRuns runs = lks_bench::make_float_runs(asset, {pin});
    REQUIRE(runs.constraints.size() == plain.edges.size());
    int unequal = 0;
    for (std::size_t i = 0; i < runs.constraints.size(); ++i) {
        const double a = weight(runs.vertices[runs.constraints[i].a]);
        const double b = weight(runs.vertices[runs.constraints[i].b]);
        CHECK(static_cast<double>(runs.shares_a[i]) == doctest::Approx(a / (a + b)).epsilon(1e-6));
        CHECK(static_cast<double>(runs.shares_b[i]) == doctest::Approx(b / (a + b)).epsilon(1e-6));
        unequal += a == b ? 0 : 1;
    }
    CHECK(unequal > 10);
    for (const lks_bench::FloatBatch& batch : runs.batches) {
        CHECK_FALSE(batch.equal_shares);
    }
}
