// The paper's cantilever beam: triangles whose three strains are solved as one block.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>

#include "accuracy/paper.h"

using namespace lks_accuracy;

TEST_CASE("20 iterations of the beam can't be told from Newton and its residual falls linearly") {
    const Beam beam = run_beam({5, 20, 100});
    const double deflection = std::abs(beam.runs.front().tip.back());
    for (const BeamRun& run : beam.runs) {
        std::printf("beam, %s, %3d iterations: tip at %.4f m, at most %.2f %% of the deflection from Newton, "
                    "%.2g of it by rounding\n",
                    run.solver.c_str(), run.iterations, run.tip.back(), 100 * run.worst_distance / deflection,
                    run.rounding / deflection);
    }
    REQUIRE(beam.runs.size() == 7);
    CHECK(deflection > 0.3); // it bends
    CHECK(beam.runs[1].worst_distance > 0.05 * deflection);
    CHECK(beam.runs[2].worst_distance < 0.01 * deflection);
    CHECK(beam.runs[3].worst_distance < 0.01 * deflection);
    // Float32 is off by its rounding: enough to be seen in a number, not in a picture.
    for (std::size_t i = 4; i < 7; ++i) {
        CHECK(beam.runs[i].rounding > 1e-8 * deflection);
        CHECK(beam.runs[i].rounding < 1e-4 * deflection);
    }
    // Straight on a logarithmic axis: the same factor in each ten iterations.
    for (std::size_t i = 20; i + 20 <= 80; i += 10) {
        const double factor = beam.residual[i + 10] / beam.residual[i];
        const double next = beam.residual[i + 20] / beam.residual[i + 10];
        CHECK(factor < 0.35);
        CHECK(next == doctest::Approx(factor).epsilon(0.25));
    }
    // What eq. 16 leaves out (g ≈ 0) stays, and is small beside the forces.
    CHECK(beam.momentum_residual.back() < 0.01);
    CHECK(beam.newton_residual.back() < 1e-12);
}
