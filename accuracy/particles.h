// Work-precision of particles: every solver at every setting of a grid, against a converged reference.
#pragma once

#include <functional>

#include "experiment.h"
#include "scenes.h"

namespace lks_accuracy {

using Progress = std::function<void(const std::string&)>;

struct Grid {
    std::vector<int> substeps;
    std::vector<int> iterations;
    int most_passes; // substeps × iterations
};
Grid whole_grid();
Grid quick_grid();

// Whether this build has Bullet beside ours.
bool has_bullet_curves();

Experiment measure_particles(const MeasuredScene& measured, const Grid& grid, const Progress& progress);

// Relative: the worst of all ticks, and the mean over constraints and ticks, of what is inextensible.
reference::Stretch stretch_over_time(const MeasuredScene& measured, reference::Engine engine,
                                     const reference::Schedule& schedule);

// The largest distance of any particle at `deviation_tick`: of fixed-point from the same method in double
// precision, and of that from the reference.
struct Rounding {
    double fixed_point = 0;
    double single_precision = 0;
    double discretisation = 0;
};
Rounding rounding_of(const MeasuredScene& measured, const reference::Schedule& schedule);

} // namespace lks_accuracy
