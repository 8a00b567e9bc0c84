#include "plots.h"

#include <algorithm>

#include "error_plot.h"
#include "gnuplot.h"
#include "plot_looks.h"
#include "workloads.h"

namespace lks_bench {
namespace {

std::vector<std::string> workloads_of(const Results& results, const std::string& measured,
                                      const std::string& prefix) {
    std::vector<std::string> names;
    for (const Result& r : results) {
        if (r.measured == measured && r.workload.rfind(prefix, 0) == 0 &&
            std::find(names.begin(), names.end(), r.workload) == names.end()) {
            names.push_back(r.workload);
        }
    }
    return names;
}

std::string title_of(const std::string& variant) {
    return " title '" + name_in_plots(variant) + "'";
}

void size_plot(const Results& results, Script& script) {
    script.command("set logscale xy\nset xlabel 'constraints'\nset xrange [*:2e6]\nset format x '10^{%T}'");
    script.command("set ylabel 'nanoseconds a projection, whole tick'");
    std::vector<std::string> curves;
    for (const std::string& variant : variants_of(results, "growth", "tick")) {
        std::string lines;
        for (const std::string& workload : workloads_of(results, "tick", "growth")) {
            const Result* cost = find(results, workload, "tick", variant);
            const Result* size = find(results, workload, "constraints", "");
            if (cost != nullptr && size != nullptr) {
                lines += value_pair(size->value, cost->value);
            }
        }
        curves.push_back(script.data(lines) + " with linespoints pt 7 lw 2 " +
                         (is_ours(variant) ? "dt 1" : "dt 2") + colour_of(variant) + title_of(variant));
    }
    script.command("plot " + comma_separated(curves));
}

// Other schedules project at the same cost, with colliders and without: their bars would crowd out the
// others.
bool has_bars(const std::string& name) {
    const Workload* workload = find_workload(name);
    const Workload usual;
    return workload == nullptr || (!workload->colliders && workload->substeps == usual.substeps &&
                                   workload->iterations == usual.iterations);
}

// Groups of bars: a group a workload, a bar a variant.
void bar_plot(const Results& results, const std::vector<std::string>& workloads, bool peers, Script& script) {
    script.command("set style data histogram\nset style histogram cluster gap 1\nset style fill solid 0.9");
    script.command("set ylabel 'nanoseconds a projection'\nset yrange [0.1:*]\nset logscale y");
    script.command("set xtics rotate by -20 noenhanced");
    std::vector<std::string> bars;
    for (const std::string& variant : variants_of(results, "", "projection")) {
        if (!peers && !is_ours(variant)) {
            continue;
        }
        std::string lines;
        for (const std::string& workload : workloads) {
            const Result* cost = find(results, workload, "projection", variant);
            lines +=
                workload + " " + (cost != nullptr ? std::to_string(cost->value) : std::string("NaN")) + "\n";
        }
        bars.push_back(script.data(lines) + " using 2:xtic(1)" + colour_of(variant) + title_of(variant));
    }
    script.command("plot " + comma_separated(bars));
}

} // namespace

bool draw_plots(const std::string& folder, const Results& results, std::vector<Plot>& drawn,
                std::string& error) {
    if (!has_gnuplot(error)) {
        return false;
    }
    const auto make = [&](const Plot& plot, const auto& fill) {
        Script script(plot.title);
        fill(script);
        drawn.push_back(plot);
        return draw(folder, plot.file, script, error);
    };
    std::vector<std::string> measured;
    std::vector<std::string> with_peers;
    for (const std::string& workload : workloads_of(results, "projection", "")) {
        if (!has_bars(workload)) {
            continue;
        }
        measured.push_back(workload);
        if (find(results, workload, "projection", "float32 plain, coloured") != nullptr) {
            with_peers.push_back(workload);
        }
    }
    bool good = true;
    if (good && !workloads_of(results, "tick", "growth").empty()) {
        good = make({"cost-against-size.svg", "Cost against size: cloths of 20 substeps"},
                    [&](Script& script) { size_plot(results, script); });
    }
    if (good && !measured.empty()) {
        good = make({"cost-against-simd.svg", "Cost against instruction set, 20 × 1"},
                    [&](Script& script) { bar_plot(results, measured, false, script); });
    }
    if (good && !with_peers.empty()) {
        good =
            make({"ours-against-peers.svg", "Ours and its peers, one thread, the same constraints, 20 × 1"},
                 [&](Script& script) { bar_plot(results, with_peers, true, script); });
    }
    if (good && !variants_of(results, "accuracy", "5 × 1").empty()) {
        good = make(
            {"cost-against-error.svg",
             "Cost against error: 64² cloth let go where it hangs from two corners, 5 to 80 passes a tick"},
            [&](Script& script) { error_plot(results, script); });
    }
    return good;
}

} // namespace lks_bench
