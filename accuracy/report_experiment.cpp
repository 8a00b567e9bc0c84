#include <algorithm>
#include <cmath>

#include "accuracy_report.h"
#include "experiment_sheet.h"

namespace lks_accuracy {
namespace {

constexpr int budgets[] = {5, 10, 20, 40, 80, 160};

// Of ours: swept, and where there is such a thing, solved at once.
std::vector<std::string> suffixes_of(const Experiment& experiment) {
    std::vector<std::string> suffixes{""};
    for (const char* suffix : {at_once_suffix, tethered_suffix}) {
        if (has_solver(experiment, std::string("fixed-point") + suffix)) {
            suffixes.push_back(suffix);
        }
    }
    return suffixes;
}

// A setting a row, a solver a column.
std::string whole_table(const Experiment& experiment, std::size_t quantity) {
    const std::vector<std::string> solvers = solvers_of(experiment);
    std::vector<std::string> head{"substeps × iterations"};
    head.insert(head.end(), solvers.begin(), solvers.end());
    std::string text = table_head(head);
    std::vector<std::string> labels;
    for (const Row& row : experiment.rows) {
        const std::string label = label_of(row.schedule);
        if (std::find(labels.begin(), labels.end(), label) == labels.end()) {
            labels.push_back(label);
        }
    }
    for (const std::string& label : labels) {
        std::vector<std::string> cells{label};
        for (const std::string& solver : solvers) {
            const auto found =
                std::find_if(experiment.rows.begin(), experiment.rows.end(), [&](const Row& row) {
                    return row.solver == solver && label_of(row.schedule) == label;
                });
            cells.push_back(found != experiment.rows.end() ? digits(found->errors[quantity]) : "");
        }
        text += table_row(cells);
    }
    return text;
}

std::string budget_table(const Experiment& experiment, const std::string& solver) {
    std::vector<std::string> head{"passes a tick, at most", "best setting",
                                  "ns a " + experiment.unit_of_work + " and tick", "worst, of what is seen"};
    for (const Quantity& quantity : experiment.quantities) {
        head.push_back(quantity.name + ", " + quantity.unit);
    }
    std::string text = table_head(head);
    for (const int budget : budgets) {
        const Row* best = best_within(experiment, solver, budget);
        if (best == nullptr || (budget > budgets[0] && best->passes() <= budget / 2)) {
            continue; // nothing better than with less
        }
        std::vector<std::string> cells{std::to_string(budget), label_of(best->schedule),
                                       digits(best->nanoseconds), digits(worst_seen(experiment, *best))};
        for (const double error : best->errors) {
            cells.push_back(digits(error));
        }
        text += table_row(cells);
    }
    return text;
}

// Where fixed-point's own rounding stands beside what the method itself is off. `suffix`: of the solvers.
std::string rounding_table(const Experiment& experiment, const std::string& suffix) {
    std::string text = table_head({"substeps × iterations", "method's own error, m",
                                   "fixed-point's rounding, m", "share", "float32's rounding, m"});
    for (const Row& row : experiment.rows) {
        if (row.solver != "fixed-point" + suffix || row.schedule.iterations != 1) {
            continue;
        }
        double own = 0;
        double single = 0;
        for (const Row& other : experiment.rows) {
            if (label_of(other.schedule) == label_of(row.schedule)) {
                own = other.solver == "double" + suffix ? other.errors[experiment.discretisation()] : own;
                single = other.solver == "float32" + suffix ? other.errors[experiment.rounding] : single;
            }
        }
        const double rounding = row.errors[experiment.rounding];
        text += table_row({label_of(row.schedule), digits(own), digits(rounding),
                           "1 : " + digits(own / rounding), digits(single)});
    }
    return text;
}

Drawn draw_experiment(const Experiment& experiment, Across across, const char* suffix) {
    const Sheet sheet = sheet_of(experiment, across);
    return {experiment.name + suffix + ".svg", sheet.title, drawn(sheet)};
}

} // namespace

Section report_experiment(const Experiment& experiment) {
    Section section;
    section.text = "\n## " + experiment.title + "\n\n" + experiment.what + "\n\n";
    for (const Quantity& quantity : experiment.quantities) {
        section.text += "* **" + quantity.name + "** (" + quantity.unit + "): " + quantity.meaning +
                        (quantity.seen > 0 ? "; seen from " + digits(quantity.seen) + " on" : "") + "\n";
    }
    for (const std::string& suffix : suffixes_of(experiment)) {
        section.text += "\nFixed-point" + suffix +
                        ", the best setting at each budget: that whose worst error is least, each in units "
                        "of what is seen.\n\n" +
                        budget_table(experiment, "fixed-point" + suffix);
        if (experiment.has_rounding) {
            section.text +=
                "\nPlaces" + suffix + ", one iteration a substep:\n\n" + rounding_table(experiment, suffix);
        }
    }
    for (std::size_t quantity = 0; quantity < experiment.quantities.size(); ++quantity) {
        if (experiment.has_rounding && quantity == experiment.rounding) {
            continue;
        }
        section.text += "\nThe whole grid, " + experiment.quantities[quantity].name + " (" +
                        experiment.quantities[quantity].unit + "):\n\n" + whole_table(experiment, quantity);
    }
    section.drawings.push_back(draw_experiment(experiment, Across::nanoseconds, ""));
    section.drawings.push_back(draw_experiment(experiment, Across::projections, "-projections"));
    for (const Row& row : experiment.rows) {
        const std::string variant = row.solver + ", " + label_of(row.schedule);
        section.results.push_back({experiment.name, "cost", variant, row.nanoseconds,
                                   "ns a " + experiment.unit_of_work + " and tick"});
        section.results.push_back(
            {experiment.name, "passes", variant, static_cast<double>(row.passes()), "a constraint and tick"});
        for (std::size_t i = 0; i < row.errors.size(); ++i) {
            if (std::isfinite(row.errors[i])) {
                section.results.push_back({experiment.name, experiment.quantities[i].name, variant,
                                           row.errors[i], experiment.quantities[i].unit});
            }
        }
    }
    return section;
}

} // namespace lks_accuracy
