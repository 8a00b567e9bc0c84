#include "experiment.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace lks_accuracy {

std::string label_of(const reference::Schedule& schedule) {
    return std::to_string(schedule.substeps) + " × " + std::to_string(schedule.iterations);
}

std::string seconds_of(int ticks) {
    constexpr double rate = 60;
    char text[40];
    std::snprintf(text, sizeof text, "%g s", ticks / rate);
    return text;
}

std::vector<std::string> solvers_of(const Experiment& experiment) {
    std::vector<std::string> solvers;
    for (const Row& row : experiment.rows) {
        if (std::find(solvers.begin(), solvers.end(), row.solver) == solvers.end()) {
            solvers.push_back(row.solver);
        }
    }
    return solvers;
}

bool has_solver(const Experiment& experiment, const std::string& solver) {
    return std::any_of(experiment.rows.begin(), experiment.rows.end(),
                       [&](const Row& row) { return row.solver == solver; });
}

double worst_seen(const Experiment& experiment, const Row& row) {
    double worst = 0;
    for (std::size_t i = 0; i < experiment.quantities.size(); ++i) {
        if (experiment.quantities[i].seen > 0 && !std::isnan(row.errors[i])) {
            worst = std::max(worst, row.errors[i] / experiment.quantities[i].seen);
        }
    }
    return worst;
}

const Row* best_within(const Experiment& experiment, const std::string& solver, int passes) {
    const Row* best = nullptr;
    for (const Row& row : experiment.rows) {
        if (row.solver == solver && row.passes() <= passes &&
            std::isfinite(row.errors.front()) && // else it has diverged
            (best == nullptr || worst_seen(experiment, row) < worst_seen(experiment, *best))) {
            best = &row;
        }
    }
    return best;
}

} // namespace lks_accuracy
