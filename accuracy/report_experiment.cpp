#include <algorithm>
#include <cmath>

#include "accuracy_report.h"

namespace lks_accuracy {
namespace {

constexpr int budgets[] = {5, 10, 20, 40, 80, 160};

std::vector<std::string> solvers_of(const Experiment& experiment) {
    std::vector<std::string> solvers;
    for (const Row& row : experiment.rows) {
        if (std::find(solvers.begin(), solvers.end(), row.solver) == solvers.end()) {
            solvers.push_back(row.solver);
        }
    }
    return solvers;
}

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

// Points of one solver and quantity, in the order of the grid.
template <typename Wanted>
std::string lines_of(const Experiment& experiment, const std::string& solver, std::size_t quantity,
                     bool against_cost, const Wanted& wanted) {
    std::string lines;
    for (const Row& row : experiment.rows) {
        const double error = row.errors[quantity];
        if (row.solver == solver && std::isfinite(error) && error > 0 && wanted(row.schedule)) {
            lines += lks_bench::value_pair(against_cost ? row.nanoseconds : row.schedule.substeps, error);
        }
    }
    return lines;
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
                own = other.solver == "double" + suffix ? other.errors[experiment.discretisation] : own;
                single = other.solver == "float32" + suffix ? other.errors[experiment.rounding] : single;
            }
        }
        const double rounding = row.errors[experiment.rounding];
        text += table_row({label_of(row.schedule), digits(own), digits(rounding),
                           "1 : " + digits(own / rounding), digits(single)});
    }
    return text;
}

Plot draw_experiment(const Experiment& experiment) {
    const Quantity& main = experiment.quantities[experiment.main_quantity];
    Plot plot{experiment.name + ".svg", experiment.title, lks_bench::Script("", 1280, 680)};
    lks_bench::Script& script = plot.script;
    if (experiment.has_rounding) {
        script.command("set multiplot layout 1,2");
    }
    script.command("set title '" + experiment.title + ": " + main.name + "'\nset logscale xy\n" +
                   "set xlabel 'nanoseconds a " + experiment.unit_of_work + " and tick'\nset ylabel '" +
                   main.unit +
                   "'\nset format y '10^{%T}'\nset format x '%g'\nset key outside bottom center maxrows 6");
    std::vector<std::string> curves;
    for (const std::string& solver : solvers_of(experiment)) {
        const auto add = [&](const char* style, const std::string& title, const auto& wanted) {
            const std::string lines = lines_of(experiment, solver, experiment.main_quantity, true, wanted);
            if (!lines.empty()) {
                curves.push_back(script.data(lines) + style + colour_of(solver) +
                                 (title.empty() ? " notitle" : " title '" + title + "'"));
            }
        };
        if (solver.rfind("double", 0) == 0) {
            continue; // lies on fixed-point's errors, at a cost that says nothing
        }
        const bool fixed_iterations = experiment.name == "ragdoll_stairs" && solver == "Bullet";
        add(" with linespoints lw 3 pt 7 ps 0.7", solver + ", substeps",
            [&](const reference::Schedule& s) { return s.iterations == 1 || fixed_iterations; });
        if (!fixed_iterations) {
            add(" with linespoints lw 2 dt 2 pt 6 ps 0.7", solver + ", iterations",
                [](const reference::Schedule& s) { return s.substeps == 1; });
        }
        if (solver.rfind("fixed-point", 0) == 0) {
            add(" with points pt 2 ps 0.7", solver + ", both",
                [](const reference::Schedule& s) { return s.substeps > 1 && s.iterations > 1; });
        }
    }
    script.command("plot " + lks_bench::comma_separated(curves));
    if (!experiment.has_rounding) {
        return plot;
    }

    script.command("set title '" + experiment.title +
                   ": places'\nset format x '%g'\nset xlabel 'substeps of one iteration'\n"
                   "set ylabel 'm'");
    const auto one_iteration = [](const reference::Schedule& s) { return s.iterations == 1; };
    const auto curve = [&](const std::string& solver, std::size_t quantity, const std::string& looks) {
        return script.data(lines_of(experiment, solver, quantity, false, one_iteration)) +
               " with linespoints lw 3 " + looks;
    };
    std::vector<std::string> kinds;
    for (const std::string& suffix : suffixes_of(experiment)) {
        const auto add = [&](const std::string& solver, std::size_t quantity, const std::string& title) {
            std::string looks = "pt 7" + colour_of(solver + suffix);
            looks.append(" title '").append(title).append(suffix).append("'");
            kinds.push_back(curve(solver + suffix, quantity, looks));
        };
        add("double", experiment.discretisation, "off the converged solution (double)");
        add("float32", experiment.rounding, "rounding of float32");
        add("fixed-point", experiment.rounding, "rounding of fixed-point");
    }
    script.command("plot " + lks_bench::comma_separated(kinds));
    script.command("unset multiplot");
    return plot;
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
    section.plots.push_back(draw_experiment(experiment));
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
