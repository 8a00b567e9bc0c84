// The same cloth in float32, with the same care: our order, colours and runs, x, y, z as arrays, one estimate
// of 1/√ and one Newton step, groups that run over the end of a run where nobody minds.
#pragma once

#include <cstdint>
#include <vector>

#include "asset/asset.h"
#include "plain_float.h"

namespace lks_bench {

struct FloatBatch {
    std::vector<lks::Run> runs;
    std::vector<std::uint32_t> singles; // constraints
    bool equal_shares = true;
};

struct FloatRuns {
    std::vector<float> x, y, z; // by particle, in the solver's order, with room behind
    std::vector<float> start_x, start_y, start_z;
    std::vector<float> moving; // 1, or 0 for what is pinned and for the room behind
    std::uint32_t count = 0;
    std::vector<std::uint32_t> vertices;
    std::vector<lks::Constraint> constraints;
    std::vector<float> rests;
    std::vector<double> inverse_masses;    // by particle, 0 of what is pinned
    std::vector<float> shares_a, shares_b; // of a correction, by the inverse masses
    std::vector<FloatBatch> batches;
};

FloatRuns make_float_runs(const lks_asset& asset, const std::vector<std::uint32_t>& pinned);

// `project` is one pass over all constraints, no compliance, L/len clamped to 2; `predict` is x += v + g·h²,
// what a substep begins with, `fall` being g·h² on y; `push_out` is what ends it over a sphere.
struct FloatKernel {
    const char* name;
    void (*project)(FloatRuns& cloth);
    void (*predict)(FloatRuns& cloth, float fall);
    void (*push_out)(FloatRuns& cloth, const FloatSphere& sphere);
};

void lay_level(FloatRuns& cloth); // as in plain_float.h

std::vector<Point> points_of(const FloatRuns& cloth); // by vertex

extern const FloatKernel float_runs_scalar;
extern const FloatKernel float_runs_avx2;   // on x86-64
extern const FloatKernel float_runs_avx512; // on x86-64

// The same cloth in double precision, one constraint after the other: what the others must come to.
void project_double(const FloatRuns& cloth, std::vector<double>& x, std::vector<double>& y,
                    std::vector<double>& z);

} // namespace lks_bench
