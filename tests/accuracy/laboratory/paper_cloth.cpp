// The paper's hanging cloth: PBD stiffens with the number of iterations, XPBD does not.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>

#include "accuracy/paper.h"
#include "support/handles.h"

using namespace lks_accuracy;
using reference::Engine;

namespace {

void check(const ClothHang& cloth, double exact, double tolerance) {
    const std::vector<int> iterations{20, 40, 80, 160};
    const std::vector<SagRun> ours = run_cloth(cloth, {Engine::fixed_point}, iterations);
    const std::vector<SagRun> pbd = run_cloth(cloth, {Engine::pbd}, iterations);
    for (std::size_t i = 0; i < iterations.size(); ++i) {
        std::printf("cloth %u x %u, %3d iterations: sag %.4f m, PBD %.4f m (exact %.4f m)\n", cloth.side,
                    cloth.side, iterations[i], ours[i].sag, pbd[i].sag, exact);
        CHECK(ours[i].sag == doctest::Approx(exact).epsilon(tolerance));
        if (i > 0) {
            CHECK(pbd[i].sag < 0.7 * pbd[i - 1].sag);
        }
    }
}

} // namespace

TEST_CASE("a hanging cloth sags the same at 20, 40, 80 and 160 iterations, PBD's less and less") {
    const ClothHang cloth{16, 1e-2, 3};
    const double exact = run_cloth(cloth, {Engine::newton}, {1}).front().sag;
    check(cloth, exact, 0.015);
}

TEST_CASE("so does the paper's of 64 x 64" * doctest::skip(!support::long_runs())) {
    const ClothHang cloth{64, 0.3, 3, 0.3};
    const double converged = run_cloth(cloth, {Engine::fixed_point}, {640}).front().sag;
    check(cloth, converged, 0.015);
}
