#include "error_plot.h"

#include "plot_looks.h"
#include "sections.h"

namespace lks_bench {
namespace {

// What is above is a heap of threads and not a cloth: it is drawn at the upper edge.
constexpr double most_stretch = 0.3;

// A curve a variant and way to spend passes.
struct Way {
    const char* title;
    std::vector<const char*> schedules;
    const char* looks;
};

const std::vector<Way>& ways() {
    static const std::vector<Way> all = {
        {"N × 1: substeps", {"5 × 1", "10 × 1", "20 × 1", "40 × 1", "80 × 1"}, " dt 1 pt 7"},
        {"N × 4: both", {"5 × 4", "10 × 4", "20 × 4"}, " dt 3 pt 5"},
        {"1 × N: iterations", {"1 × 5", "1 × 10", "1 × 20", "1 × 40", "1 × 80"}, " dt 2 pt 6"},
    };
    return all;
}

// Of one curve: what is in the frame, and what is above it.
struct Curve {
    std::string inside, above;
};

Curve curve_of(const Results& results, const std::string& variant, const Way& way) {
    Curve curve;
    for (const char* schedule : way.schedules) {
        double cost = 0;
        double error = 0;
        for (const Result& r : results) {
            if (r.workload == accuracy_name && r.measured == schedule && r.variant == variant) {
                (r.unit == "ms" ? cost : error) = r.value;
            }
        }
        if (cost > 0 && error > 0 && error <= most_stretch) {
            curve.inside += value_pair(cost, error);
        } else if (cost > 0) {
            // Also where it is no number any more.
            curve.above += value_pair(cost, most_stretch);
        }
    }
    return curve;
}

} // namespace

void error_plot(const Results& results, Script& script) {
    script.command("set logscale xy\nset xlabel 'milliseconds a tick'");
    script.command("set ylabel 'residual stretch, root mean square'\nset format y '10^{%T}'");
    script.command("set yrange [*:" + std::to_string(most_stretch) + "]");
    std::vector<std::string> curves;
    std::vector<std::string> legend;
    bool explodes = false;
    for (const std::string& variant : variants_of(results, accuracy_name, "5 × 1")) {
        if (variant == "sse4.1" || variant == "float32 runs, scalar") {
            continue;
        }
        for (const Way& way : ways()) {
            const Curve curve = curve_of(results, variant, way);
            if (!curve.inside.empty()) {
                curves.push_back(script.data(curve.inside) + " with linespoints lw 2" + way.looks +
                                 colour_of(variant) + " notitle");
            }
            if (!curve.above.empty()) {
                curves.push_back(script.data(curve.above) + " with points pt 9 ps 1.5" + colour_of(variant) +
                                 " notitle");
                explodes = true;
            }
        }
        legend.push_back("NaN with lines lw 4" + colour_of(variant) + " title '" + name_in_plots(variant) +
                         "'");
    }
    for (const Way& way : ways()) {
        legend.push_back(std::string("NaN with linespoints lw 2 lc rgb 'black'") + way.looks + " title '" +
                         way.title + "'");
    }
    if (explodes) {
        legend.push_back(
            "NaN with points pt 9 ps 1.5 lc rgb 'black' title 'explodes: over 30 %, drawn at the edge'");
    }
    curves.insert(curves.end(), legend.begin(), legend.end());
    script.command("plot " + comma_separated(curves));
}

} // namespace lks_bench
