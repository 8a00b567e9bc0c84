// What the peers' objects meet in workloads with colliders: they all stand in one place, so each has its own.
#pragma once

#include <vector>

#include "plain_float.h"
#include "workloads.h"

namespace lks_bench {

// By object; none where the workload has no colliders.
std::vector<std::vector<FloatSphere>> spheres_of(const Workload& workload);

// How an object's points lie on what it meets.
struct Resting {
    double deepest = 0;     // in metres, of any point below a surface
    std::size_t points = 0; // within a millimetre of a surface, or below it
};
Resting resting(const std::vector<Point>& points, const std::vector<FloatSphere>& spheres);

} // namespace lks_bench
