// One way to solve a workload: ours on an instruction set, or a peer of ours. All hold the same constraints
// and pins, start from the same places, and visit the constraints in our order unless their name says
// otherwise.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "workloads.h"

namespace lks_bench {

struct Point {
    double x, y, z; // metres
};

class Variant {
public:
    virtual ~Variant() = default;

    // As many projections of all constraints as a tick has, and nothing else.
    virtual void project() = 0;
    // A whole 60th of a second.
    virtual void tick() = 0;
    // The first object's vertices.
    virtual std::vector<Point> points() const = 0;
};

// The names of all that can solve this workload on this machine, ours first, then float32 with the same care,
// plain float32, and packages. The first one is plain integers.
std::vector<std::string> variant_names(const Workload& workload);
// Instruction sets of this machine, plain integers first.
std::vector<lks_simd> available_levels();
// Those of them that are ours.
std::vector<std::string> our_names();
// The same of ours with two workers: for whole ticks only.
std::string with_two_workers(const std::string& name);

// Of a name out of the above. Exits with a sentence if a peer does not come to what double precision comes
// to: it must not be fast by being wrong.
std::unique_ptr<Variant> make_variant(const Workload& workload, const std::string& name);

} // namespace lks_bench
