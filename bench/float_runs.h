// The same cloth in float32, with the same care: our order, colours and runs, x, y, z as arrays or, where few
// constraints are in runs, as rows; one estimate of 1/√ and one Newton step, groups that run over the end of
// a run where nobody minds.
#pragma once

#include <cstdint>
#include <new>
#include <vector>

#include "asset/asset.h"
#include "plain_float.h"

namespace lks_bench {

// Large arrays begin at cache lines, by which cloths gain a tenth; ropes of 100 would lose a fifth.
template <typename T>
struct AtCacheLines {
    using value_type = T;

    AtCacheLines() = default;
    template <typename U>
    AtCacheLines(const AtCacheLines<U>&) {}
    static std::align_val_t alignment(std::size_t count) {
        return std::align_val_t{count * sizeof(T) < 4096 ? 16u : 64u};
    }
    T* allocate(std::size_t count) {
        return static_cast<T*>(::operator new(count * sizeof(T), alignment(count)));
    }
    void deallocate(T* values, std::size_t count) { ::operator delete(values, alignment(count)); }
    friend bool operator==(const AtCacheLines&, const AtCacheLines&) { return true; }
};

using Floats = std::vector<float, AtCacheLines<float>>;

struct FloatBatch {
    std::vector<lks::Run> runs;
    // Constraints; in rows all of a batch are singles.
    std::uint32_t first = 0;
    std::uint32_t first_single = 0;
    std::uint32_t end = 0;
    bool equal_shares = true;
};

// x, y, z and 0.
inline constexpr std::uint32_t float_row = 4;

struct FloatRuns {
    // By particle, in the solver's order, with room behind; empty of what is in rows.
    Floats x, y, z;
    Floats start_x, start_y, start_z;
    Floats moving; // 1, or 0 for what is pinned and for the room behind
    // The same in rows; empty of what is in arrays.
    Floats rows, start_rows, moving_rows;
    std::vector<lks::Constraint> places; // of the rows of a constraint's ends
    std::uint32_t count = 0;
    std::vector<std::uint32_t> vertices;
    std::vector<lks::Constraint> constraints;
    Floats rests;
    std::vector<double> inverse_masses; // by particle, 0 of what is pinned
    Floats shares_a, shares_b;          // of a correction, by the inverse masses
    std::vector<FloatBatch> batches;
};

FloatRuns make_float_runs(const lks_asset& asset, const std::vector<std::uint32_t>& pinned);

inline bool is_in_rows(const FloatRuns& cloth) {
    return !cloth.rows.empty();
}
Point place_of(const FloatRuns& cloth, std::uint32_t particle);
void put(FloatRuns& cloth, std::uint32_t particle, const Point& place);

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
