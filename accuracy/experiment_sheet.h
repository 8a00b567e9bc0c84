// The work-precision diagrams of an experiment: a panel for every measure.
#pragma once

#include "experiment.h"
#include "panels.h"

namespace lks_accuracy {

enum class Across { nanoseconds, projections };

Sheet sheet_of(const Experiment& experiment, Across across);

} // namespace lks_accuracy
