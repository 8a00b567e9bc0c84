#include "experiment.h"

#include <algorithm>
#include <cmath>

namespace lks_accuracy {

std::string label_of(const reference::Schedule& schedule) {
    return std::to_string(schedule.substeps) + " × " + std::to_string(schedule.iterations);
}

bool has_solver(const Experiment& experiment, const std::string& solver) {
    return std::any_of(experiment.rows.begin(), experiment.rows.end(),
                       [&](const Row& row) { return row.solver == solver; });
}

const Row* best_within(const Experiment& experiment, const std::string& solver, int passes) {
    const Row* best = nullptr;
    for (const Row& row : experiment.rows) {
        const double error = row.errors[experiment.main_quantity];
        if (row.solver == solver && row.passes() <= passes && std::isfinite(error) &&
            (best == nullptr || error < best->errors[experiment.main_quantity])) {
            best = &row;
        }
    }
    return best;
}

} // namespace lks_accuracy
