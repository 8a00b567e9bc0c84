// The paper's chain: the force at its fixed end, read out of the SDK, against the exact implicit step.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "accuracy/paper.h"

using namespace lks_accuracy;
using reference::Engine;

TEST_CASE(
    "after ten frames the chain's force is within 6 %, 2 % and 0.5 % of Newton at 50, 100, 1000 iterations") {
    // In the first ones, which start from nothing, 50 sweeps can't carry a load through 19 links.
    const std::vector<ChainRun> runs = run_chain({Engine::fixed_point}, 125, {50, 100, 1000});
    REQUIRE(runs.size() == 4);
    for (std::size_t i = 0; i < 3; ++i) {
        const ChainRun& run = runs[i + 1];
        std::printf("chain, %4d iterations: force off by %.2f %% at most after ten frames, %.0f %% in the "
                    "first, %.2f "
                    "%% of the peak in all\n",
                    run.iterations, 100 * run.worst_error, 100 * run.first_error, 100 * run.worst_of_peak);
        INFO(run.iterations << " iterations");
        REQUIRE(run.iterations == paper_chain_errors[i].iterations);
        CHECK(run.worst_error <= paper_chain_errors[i].value);
        // In all frames.
        CHECK(run.worst_of_peak <= paper_chain_errors[i].value);
    }
    // The force is there: 20 kg that fall on their chain pull with more than half their weight.
    CHECK(runs[0].forces.back() > 100);
}

// A projection knows its edge's length to 2^-30 of it, a nanometre of a metre, which at 1e-8 m/N is 0.1 N: in
// the first frames there is no more to be carried.
TEST_CASE(
    "at 1000 iterations the chain's force is within 0.5 % of Newton but for the first frames, which are "
    "within the resolution of a length") {
    struct Start {
        double rate_hz;
        std::size_t frames; // that are off by more
        double first;       // relative, the worst of them
    };
    for (const Start& start : {Start{125, 3, 0.5}, Start{60, 1, 0.03}}) {
        const std::vector<ChainRun> runs =
            run_chain({Engine::fixed_point, Engine::double_precision}, start.rate_hz, {1000});
        REQUIRE(runs.size() == 3);
        double first[2] = {}, later[2] = {}, newtons[2] = {};
        for (std::size_t frame = 0; frame < runs[0].forces.size(); ++frame) {
            for (std::size_t i = 0; i < 2; ++i) {
                const double exact = runs[0].forces[frame];
                const double off = std::abs(runs[i + 1].forces[frame] - exact);
                double& worst = frame < start.frames ? first[i] : later[i];
                worst = std::max(worst, off / exact);
                newtons[i] = frame < start.frames ? std::max(newtons[i], off) : newtons[i];
            }
        }
        std::printf(
            "chain, 1000 iterations, %.0f Hz: fixed-point off by %.2f %% (%.3f N) at most in the first "
            "%zu frames, %.2f %% later; double precision %.3f %% (%.3f N) and %.2f %%\n",
            start.rate_hz, 100 * first[0], newtons[0], start.frames, 100 * later[0], 100 * first[1],
            newtons[1], 100 * later[1]);
        INFO(start.rate_hz << " Hz");
        CHECK(later[0] <= 0.005);
        CHECK(later[1] <= 0.005);
        CHECK(first[0] <= start.first);
        CHECK(newtons[0] <= 0.1);
        CHECK(first[1] <= 0.001);
    }
}

TEST_CASE("solved at once, a single iteration a frame is within 0.3 % of Newton, and more change nothing") {
    const std::vector<ChainRun> runs = run_chain({Engine::fixed_point}, 125, {1, 5}, LKS_ROPE_DIRECT);
    REQUIRE(runs.size() == 3);
    for (const ChainRun* run : {&runs[1], &runs[2]}) {
        std::printf(
            "chain, at once, %d iterations: force off by %.2f %% at most, %.2f %% in the first frame\n",
            run->iterations, 100 * run->worst_error, 100 * run->first_error);
        INFO(run->iterations << " iterations");
        CHECK(run->worst_error <= 0.003);
        CHECK(run->worst_of_peak <= 0.001);
        // Where 50 sweeps carry two fifths of the load.
        CHECK(run->first_error <= 0.005);
    }
    // What is left is no error of the solve: it is what eq. 16 leaves out.
    const double equation = run_chain({Engine::direct_constraints}, 125, {1})[1].worst_error;
    CHECK(runs[1].worst_error == doctest::Approx(equation).epsilon(0.02));
    CHECK(runs[2].worst_error == doctest::Approx(equation).epsilon(0.02));
}

TEST_CASE("float32's own rounding spoils the force at 1000 iterations, fixed-point's does not") {
    const std::vector<ChainRun> runs =
        run_chain({Engine::fixed_point, Engine::single_precision}, 125, {1000});
    REQUIRE(runs.size() == 3);
    std::printf("chain, 1000 iterations: fixed-point %.2f %%, float32 %.1f %%\n", 100 * runs[1].worst_error,
                100 * runs[2].worst_error);
    CHECK(runs[2].worst_error > 20 * runs[1].worst_error);
}
