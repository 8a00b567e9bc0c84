#include "plots.h"

#include <algorithm>
#include <utility>

#include "gnuplot.h"
#include "workloads.h"

namespace lks_bench {
namespace {

// In the order in which they were measured, each once.
std::vector<std::string> variants_of(const Results& results, const std::string& workload,
                                     const std::string& measured) {
    std::vector<std::string> names;
    for (const Result& r : results) {
        if (r.workload.rfind(workload, 0) == 0 && r.measured == measured && !r.variant.empty() &&
            std::find(names.begin(), names.end(), r.variant) == names.end()) {
            names.push_back(r.variant);
        }
    }
    return names;
}

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

bool is_ours(const std::string& variant) {
    return variant.rfind("float32", 0) != 0 && variant.rfind("Bullet", 0) != 0;
}

std::string title_of(const std::string& variant, const std::string& more = "") {
    return " title '" + (is_ours(variant) ? "ours, " + variant : variant) + more + "'";
}

// Blue is ours, orange float32 with the same care, grey plain float32, green what comes in packages.
std::string colour_of(const std::string& variant) {
    static const std::pair<const char*, const char*> colours[] = {
        {"scalar", "#9ecae1"},
        {"sse4.1", "#4292c6"},
        {"avx2", "#08519c"},
        {"avx512", "#081d58"},
        {"neon", "#08519c"},
        {"float32 runs, scalar", "#fdbe85"},
        {"float32 runs, AVX2", "#fd8d3c"},
        {"float32 runs, AVX-512", "#d94701"},
        {"float32 plain, coloured", "#969696"},
        {"float32 plain, by index", "#525252"},
        {"Bullet soft body", "#31a354"},
    };
    for (const auto& [name, colour] : colours) {
        if (variant == name) {
            return std::string(" lc rgb '") + colour + "'";
        }
    }
    return " lc rgb '#54278f'";
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

// A curve a variant and kind of schedule: more substeps of one iteration, more iterations of one substep.
void error_plot(const Results& results, Script& script) {
    script.command("set logscale xy\nset xlabel 'milliseconds a tick'");
    script.command("set ylabel 'residual stretch, root mean square'\nset format y '10^{%T}'");
    std::vector<std::string> curves;
    for (const std::string& variant : variants_of(results, "accuracy", "5 × 1")) {
        if (variant == "sse4.1" || variant == "float32 runs, scalar" ||
            variant == "float32 plain, by index") {
            continue;
        }
        for (const bool substeps : {true, false}) {
            std::string lines;
            for (const char* count : {"5", "10", "20", "40", "80"}) {
                const std::string label =
                    substeps ? std::string(count) + " × 1" : "1 × " + std::string(count);
                double cost = 0;
                double error = 0;
                for (const Result& r : results) {
                    if (r.workload == "accuracy" && r.measured == label && r.variant == variant) {
                        (r.unit == "ms" ? cost : error) = r.value;
                    }
                }
                if (cost > 0 && error > 0) {
                    lines += value_pair(cost, error);
                }
            }
            curves.push_back(script.data(lines) + " with linespoints lw 2" + colour_of(variant) +
                             (substeps ? " dt 1 pt 7" : " dt 2 pt 6") +
                             title_of(variant, substeps ? ", substeps" : ", iterations"));
        }
    }
    script.command("plot " + comma_separated(curves));
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
        good = make({"cost-against-error.svg",
                     "Cost against error: 64² cloth that falls and swings, 5 to 80 passes a tick"},
                    [&](Script& script) { error_plot(results, script); });
    }
    return good;
}

} // namespace lks_bench
