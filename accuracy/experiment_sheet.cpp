#include "experiment_sheet.h"

#include <algorithm>
#include <cmath>

#include "colours.h"

namespace lks_accuracy {
namespace {

bool is_drawn(double error) {
    return std::isfinite(error) && error > 0;
}

double place(const Row& row, Across across) {
    return across == Across::nanoseconds ? row.nanoseconds : row.passes();
}

bool is_double(const std::string& solver) {
    return solver.rfind("double", 0) == 0;
}

// The reference code in double precision lies on fixed-point's errors, at a cost that says nothing.
bool has_place(const std::string& solver, Across across) {
    return across == Across::projections || !is_double(solver);
}

// Many of them have the same errors: then each shows beside those that are drawn later.
double width_of(const std::string& solver) {
    return is_double(solver) ? 5 : solver.rfind("float32", 0) == 0 ? 3.2 : 1.8;
}

int least_iterations(const Experiment& experiment, const std::string& solver) {
    int least = 0;
    for (const Row& row : experiment.rows) {
        if (row.solver == solver && (least == 0 || row.schedule.iterations < least)) {
            least = row.schedule.iterations;
        }
    }
    return least;
}

// A setting stands on the curve of substeps, on that of iterations or, as those of one substep and one
// iteration do, on both.
bool belongs(const reference::Schedule& schedule, int least, Sweep sweep) {
    const bool few_iterations = schedule.iterations == least;
    switch (sweep) {
    case Sweep::substeps:
        return few_iterations;
    case Sweep::iterations:
        return schedule.substeps == 1;
    case Sweep::both:
        return schedule.substeps > 1 && !few_iterations;
    case Sweep::backdrop:
        break;
    }
    return few_iterations;
}

void add_curve(const Experiment& experiment, const std::string& solver, std::size_t quantity, Across across,
               Sweep sweep, Panel& panel) {
    const int least = least_iterations(experiment, solver);
    Curve curve{solver, sweep == Sweep::backdrop ? "#e0e0e0" : colour_of(solver), sweep, width_of(solver)};
    for (const Row& row : experiment.rows) {
        if (row.solver == solver && belongs(row.schedule, least, sweep) && is_drawn(row.errors[quantity])) {
            curve.points.push_back({place(row, across), row.errors[quantity]});
        }
    }
    const bool is_only_a_start = sweep == Sweep::iterations && curve.points.size() == 1;
    if (!curve.points.empty() && !is_only_a_start) {
        panel.curves.push_back(std::move(curve));
    }
}

std::string listed(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) {
        text += (text.empty() ? "" : "; ") + part;
    }
    return text;
}

// Of the solvers that have a place: who has no such error, who none at some settings, and who has exactly 0,
// which a logarithmic axis does not reach.
std::vector<std::string> remarks_on(const Experiment& experiment, std::size_t quantity, Across across) {
    std::vector<std::string> undefined;
    std::vector<std::string> diverged;
    std::vector<std::string> exact;
    for (const std::string& solver : solvers_of(experiment)) {
        if (!has_place(solver, across)) {
            continue;
        }
        std::size_t all = 0;
        std::size_t unknown = 0;
        std::size_t zero = 0;
        for (const Row& row : experiment.rows) {
            if (row.solver == solver) {
                ++all;
                unknown += std::isfinite(row.errors[quantity]) ? 0 : 1;
                zero += row.errors[quantity] == 0 ? 1 : 0;
            }
        }
        const auto share = [&](std::size_t count) {
            return solver + " at " +
                   (count == all ? "every setting" : std::to_string(count) + " of " + std::to_string(all));
        };
        if (unknown == all) {
            undefined.push_back(solver);
        } else if (unknown > 0) {
            diverged.push_back(share(unknown));
        }
        if (zero > 0) {
            exact.push_back(share(zero));
        }
    }
    std::vector<std::string> remarks;
    const auto add = [&](const std::string& what, const std::vector<std::string>& who) {
        if (!who.empty()) {
            remarks.push_back(what + listed(who) + ".");
        }
    };
    add("Exactly 0, below any axis: ", exact);
    add("No finite number: ", diverged);
    add("Not defined for: ", undefined);
    return remarks;
}

Panel panel_of(const Experiment& experiment, std::size_t index, Across across) {
    const Quantity& quantity = experiment.quantities[index];
    Panel panel{quantity.name + " (" + quantity.unit + ")",
                quantity.meaning,
                {},
                remarks_on(experiment, index, across),
                quantity.seen};
    const std::vector<std::string> solvers = solvers_of(experiment);
    if (quantity.beside >= 0 && across == Across::projections) {
        for (const std::string& solver : solvers) {
            if (is_double(solver)) {
                add_curve(experiment, solver, static_cast<std::size_t>(quantity.beside), across,
                          Sweep::backdrop, panel);
            }
        }
    }
    std::vector<std::string> from_below;
    for (const std::string& solver : solvers) {
        if (has_place(solver, across)) {
            from_below.push_back(solver);
        }
    }
    std::stable_sort(from_below.begin(), from_below.end(),
                     [](const std::string& a, const std::string& b) { return width_of(a) > width_of(b); });
    for (const Sweep sweep : {Sweep::both, Sweep::iterations, Sweep::substeps}) {
        for (const std::string& solver : from_below) {
            if (sweep != Sweep::both || solver.rfind("fixed-point", 0) == 0) {
                add_curve(experiment, solver, index, across, sweep, panel);
            }
        }
    }
    return panel;
}

} // namespace

Sheet sheet_of(const Experiment& experiment, Across across) {
    const std::vector<std::string> solvers = solvers_of(experiment);
    const bool is_at_once = std::any_of(solvers.begin(), solvers.end(), [](const std::string& solver) {
        return solver.find(at_once_suffix) != std::string::npos;
    });
    Sheet sheet{experiment.title +
                    (across == Across::nanoseconds ? ": error against cost" : ": error against projections"),
                across == Across::nanoseconds
                    ? "nanoseconds a " + experiment.unit_of_work + " and tick"
                    : std::string("projections ") + (is_at_once ? "(at once: solves) " : "") +
                          "of each constraint and tick"};
    for (std::size_t i = 0; i < experiment.quantities.size(); ++i) {
        sheet.panels.push_back(panel_of(experiment, i, across));
    }
    return sheet;
}

} // namespace lks_accuracy
