#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "accuracy_report.h"
#include "colours.h"

namespace lks_accuracy {
namespace {

constexpr const char* wide = " with lines lw 3";

std::string percent(double share) {
    char text[40];
    std::snprintf(text, sizeof text, std::abs(share) < 1e-4 ? "%.1e %%" : "%.2f %%", 100 * share);
    return text;
}

// One value a frame, from frame `first` on.
std::string by_frame(const std::vector<double>& values, int first) {
    std::string lines;
    for (std::size_t i = 0; i < values.size(); ++i) {
        lines += lks_bench::value_pair(static_cast<double>(i) + first, values[i]);
    }
    return lines;
}

// What the paper has at so many iterations; null: nothing.
template <std::size_t count>
const PaperFigure* in_the_paper(const PaperFigure (&figures)[count], int iterations) {
    for (const PaperFigure& figure : figures) {
        if (figure.iterations == iterations) {
            return &figure;
        }
    }
    return nullptr;
}

// A curve of the paper's figures, times `unit`.
template <std::size_t count>
std::string paper_curve(Plot& plot, const PaperFigure (&figures)[count], double unit,
                        const std::string& title) {
    std::string points;
    for (const PaperFigure& figure : figures) {
        points += lks_bench::value_pair(figure.iterations, unit * figure.value);
    }
    return plot.script.data(points) + " with linespoints lw 2 dt 2 pt 4 ps 1.6 lc rgb '#000000' title '" +
           title + "'";
}

std::string numbered(int iterations) {
    return std::to_string(iterations) + (iterations == 1 ? " iteration" : " iterations");
}

// The chain's worst errors by iterations, a curve a solver and rate, where there are the paper's iterations.
std::vector<std::string> chain_error_curves(Plot& plot, const std::vector<ChainRun>& runs) {
    std::vector<std::string> curves;
    std::string points;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const ChainRun& run = runs[i];
        if (in_the_paper(paper_chain_errors, run.iterations) != nullptr) {
            points += lks_bench::value_pair(run.iterations, 100 * run.worst_error);
        }
        const bool is_last =
            i + 1 == runs.size() || runs[i + 1].solver != run.solver || runs[i + 1].rate_hz != run.rate_hz;
        if (is_last && !points.empty()) {
            curves.push_back(plot.script.data(points) + " with linespoints lw 2 pt " +
                             (run.rate_hz == 60 ? "6 dt 3" : "7") + line_colour_of(run.solver) + " title '" +
                             run.solver + ", " + digits(run.rate_hz) + " Hz'");
            points.clear();
        }
    }
    return curves;
}

} // namespace

Section report_spring(const std::vector<SpringRun>& runs) {
    Section section;
    section.text =
        "\n## The paper's spring\n\n1 kg on 1e-3 m/N, let go at 1.5 m, 100 frames. The period, and in "
        "brackets how far it is from that of the implicit step, 2πh / atan(ωh), which no solver of this "
        "kind can better; a spring has " +
        digits(analytic_spring_period()) + " s.\n\n" +
        table_head({"solver", "frames a second", "iterations", "period", "off the implicit step"});
    Plot plot{"paper-spring.svg", "A spring at 60 frames a second",
              lks_bench::Script("A spring at 60 frames a second")};
    plot.script.command("set xlabel 'frame'\nset ylabel 'elongation, m'\nset xrange [0:50]\n"
                        "set yrange [-0.6:0.6]");
    std::vector<std::string> curves;
    for (const SpringRun& run : runs) {
        const double implicit = implicit_spring_period(run.rate_hz);
        section.text += table_row({run.solver, digits(run.rate_hz), std::to_string(run.iterations),
                                   digits(run.period) + " s", percent(run.period / implicit - 1)});
        section.results.push_back(
            {"paper_spring", "period",
             run.solver + ", " + digits(run.rate_hz) + " Hz, " + numbered(run.iterations), run.period, "s"});
        const bool pbd = run.solver == "PBD";
        if (run.rate_hz == 60 && (pbd || run.solver == "fixed-point")) {
            curves.push_back(plot.script.data(by_frame(run.elongations, 0)) +
                             (pbd ? " with linespoints lw 1 ps 0.5 pt " + std::to_string(4 + run.iterations)
                                  : " with lines lw " + std::to_string(run.iterations == 1 ? 7 : 2)) +
                             (pbd || run.iterations == 1 ? line_colour_of(run.solver)
                                                         : std::string(" dt 2 lc rgb '#fdd0a2'")) +
                             " title '" + run.solver + ", " + numbered(run.iterations) + "'");
        }
    }
    curves.push_back("0.5 * cos(2 * pi * x / " + std::to_string(60 * analytic_spring_period()) +
                     ") with lines lw 1 lc rgb '#969696' title 'analytic, no step'");
    plot.script.command("set samples 1000\nplot " + lks_bench::comma_separated(curves));
    section.plots.push_back(std::move(plot));
    return section;
}

Section report_chain(const std::vector<ChainRun>& runs) {
    Section section;
    section.text =
        "\n## The paper's chain\n\n20 particles of 1 kg, 1 m apart, 1e-8 m/N, let go horizontally, 100 "
        "frames: the force at the fixed end against the exact implicit step (Newton).\n\n" +
        table_head({"solver", "frames a second", "iterations",
                    "worst after " + std::to_string(chain_frames_of_start) + " frames", "the paper's worst",
                    "worst of all, of the peak", "first frame"});
    Plot plot{"paper-chain.svg", "The force at a chain's fixed end", lks_bench::Script("")};
    plot.script.command("set multiplot layout 1,2\nset title 'The force at the fixed end, 125 frames a "
                        "second'\nset xlabel 'frame'\nset ylabel 'newtons'\nset key inside left top");
    std::vector<std::string> curves;
    for (const ChainRun& run : runs) {
        const std::string name = run.solver + (run.iterations > 0 ? ", " + numbered(run.iterations) : "");
        if (run.iterations > 0) {
            const PaperFigure* theirs = in_the_paper(paper_chain_errors, run.iterations);
            section.text +=
                table_row({run.solver, digits(run.rate_hz), std::to_string(run.iterations),
                           percent(run.worst_error), theirs == nullptr ? "" : percent(theirs->value),
                           percent(run.worst_of_peak), percent(run.first_error)});
            const std::string variant = name + ", " + digits(run.rate_hz) + " Hz";
            section.results.push_back(
                {"paper_chain", "worst force error after the start", variant, 100 * run.worst_error, "%"});
            section.results.push_back(
                {"paper_chain", "worst force error of the peak", variant, 100 * run.worst_of_peak, "%"});
        }
        const bool ours = run.solver == "fixed-point";
        const bool direct = run.solver == std::string("fixed-point") + at_once_suffix;
        if (run.rate_hz == 125 &&
            (ours || run.iterations == 0 || run.iterations == 1000 || (direct && run.iterations == 1))) {
            curves.push_back(plot.script.data(by_frame(run.forces, 1)) +
                             (run.iterations == 0 ? std::string(" with lines lw 6 lc rgb '#d9d9d9'")
                              : ours              ? " with lines lw 2 dt " +
                                           std::to_string(run.iterations == 50    ? 3
                                                          : run.iterations == 100 ? 2
                                                                                  : 1) +
                                           line_colour_of(run.solver)
                                     : " with points pt 7 ps 0.4" + line_colour_of(run.solver)) +
                             " title '" + name + "'");
        }
    }
    plot.script.command("plot " + lks_bench::comma_separated(curves));
    plot.script.command("set title 'Its worst error after " + std::to_string(chain_frames_of_start) +
                        " frames'\nset xlabel 'iterations'\nset ylabel '%'\nset logscale xy\n"
                        "set xrange [40:1250]\nset xtics (50, 100, 1000)\nset key inside left bottom");
    curves = chain_error_curves(plot, runs);
    curves.push_back(paper_curve(plot, paper_chain_errors, 100, "the paper"));
    plot.script.command("plot " + lks_bench::comma_separated(curves) + "\nunset multiplot");
    section.plots.push_back(std::move(plot));
    return section;
}

Section report_beam(const Beam& beam) {
    Section section;
    const double deflection = std::abs(beam.runs.front().tip.back());
    section.text =
        "\n## The paper's cantilever beam\n\n1 m × 0.2 m of 40 St. Venant-Kirchhoff triangles, E = 1e5, "
        "ν = 0.3, 50 frames of 8 ms; its tip falls " +
        digits(deflection) + " m.\n\n" +
        table_head({"solver", "iterations", "tip at the end, m", "farthest from Newton",
                    "farthest from double precision"});
    Plot tip{"paper-beam.svg", "A cantilever beam", lks_bench::Script("")};
    tip.script.command("set multiplot layout 1,2\nset title 'Height of the tip'\nset xlabel 'frame'\n"
                       "set ylabel 'm'\nset key inside right top");
    std::vector<std::string> curves;
    for (const BeamRun& run : beam.runs) {
        const bool exact = run.iterations == 0;
        const bool single = run.solver == name_of(reference::Engine::xpbd_single);
        const std::string name = exact ? run.solver : numbered(run.iterations);
        section.text += table_row({run.solver, exact ? "" : std::to_string(run.iterations),
                                   digits(run.tip.back()), percent(run.worst_distance / deflection),
                                   single ? percent(run.rounding / deflection) : ""});
        section.results.push_back({"paper_beam", "tip off Newton's, of the deflection",
                                   (single ? "float32, " : "") + name, 100 * run.worst_distance / deflection,
                                   "%"});
        if (single) {
            continue; // not to be told from double precision in the plot
        }
        static const char* const shades[] = {"#c6dbef", "#9ecae1", "#6baed6", "#3182bd", "#08519c"};
        const std::size_t shade = curves.empty() ? 0 : (curves.size() - 1) % 5;
        curves.push_back(tip.script.data(by_frame(run.tip, 1)) +
                         (exact ? std::string(" with lines lw 7 lc rgb '#d9d9d9'")
                                : std::string(" with lines lw 2 lc rgb '") + shades[shade] + "'") +
                         " title '" + name + "'");
    }
    tip.script.command("plot " + lks_bench::comma_separated(curves));
    tip.script.command(
        "set title 'Residuals in frame 26'\nset xlabel 'iteration'\nset ylabel ''\nset logscale y\n"
        "set format y '10^{%T}'\nset key inside right bottom\nset yrange [1e-9:10]");
    tip.script.command("plot " +
                       lks_bench::comma_separated(
                           {tip.script.data(by_frame(beam.residual, 0)) + wide +
                                " lc rgb '#08519c' title 'XPBD, constraints (eq. 9)'",
                            tip.script.data(by_frame(beam.momentum_residual, 0)) + wide +
                                " dt 2 lc rgb '#fd8d3c' title 'XPBD, momentum (eq. 8), kg·m'",
                            tip.script.data(by_frame(beam.newton_residual, 0)) +
                                " with linespoints lw 2 pt 7 lc rgb '#000000' title 'Newton, constraints'"}));
    tip.script.command("unset multiplot");
    section.plots.push_back(std::move(tip));
    return section;
}

Section report_cloth(const ClothHang& cloth, const std::vector<SagRun>& runs) {
    Section section;
    section.text =
        "\n## The paper's hanging cloth\n\n" + std::to_string(cloth.side) + " × " +
        std::to_string(cloth.side) + " vertices, distance constraints of " + digits(cloth.compliance) +
        " m/N, one kilogram, held at two corners; PBD with k = " + digits(cloth.pbd_stiffness) +
        ". How far the lower edge hangs after " + digits(cloth.seconds) +
        " seconds, and what a step takes; the paper's time is that of 24 thousand constraints on a "
        "GTX 1070, ours of one thread, XPBD and PBD being plain reference code.\n\n" +
        table_head({"solver", "iterations", "sag, m", "ms a step", "the paper's XPBD, ms"});
    Plot plot{"paper-cloth.svg", "A hanging cloth by iterations", lks_bench::Script("")};
    plot.script.command(
        "set multiplot layout 1,2\nset title 'Sag of a hanging cloth'\nset xlabel 'iterations "
        "a frame'\nset ylabel 'm'\nset logscale x 2\nset xtics (20, 40, 80, 160)\n"
        "set xrange [18:180]\nset yrange [0:*]\nset key inside left bottom");
    std::vector<std::string> curves;
    std::vector<std::string> costs;
    std::string lines;
    std::string cost_lines;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const SagRun& run = runs[i];
        const PaperFigure* theirs = in_the_paper(paper_cloth_milliseconds, run.iterations);
        section.text += table_row({run.solver, std::to_string(run.iterations), digits(run.sag),
                                   digits(run.milliseconds), theirs == nullptr ? "" : digits(theirs->value)});
        section.results.push_back(
            {"paper_cloth", "sag", run.solver + ", " + numbered(run.iterations), run.sag, "m"});
        section.results.push_back(
            {"paper_cloth", "cost", run.solver + ", " + numbered(run.iterations), run.milliseconds, "ms"});
        lines += lks_bench::value_pair(run.iterations, run.sag);
        cost_lines += lks_bench::value_pair(run.iterations, run.milliseconds);
        if (i + 1 == runs.size() || runs[i + 1].solver != run.solver) {
            // It lies upon ours.
            const bool is_reference = run.solver == name_of(reference::Engine::xpbd);
            const std::string looks = std::string(is_reference ? " with linespoints lw 2 dt 2 pt 6 ps 1.8"
                                                               : " with linespoints lw 3 pt 7") +
                                      line_colour_of(run.solver) + " title '" + run.solver + "'";
            curves.push_back(plot.script.data(lines) + looks);
            costs.push_back(plot.script.data(cost_lines) + looks);
            lines.clear();
            cost_lines.clear();
        }
    }
    plot.script.command("plot " + lks_bench::comma_separated(curves));
    costs.push_back(paper_curve(plot, paper_cloth_milliseconds, 1, "the paper, GTX 1070"));
    plot.script.command("set title 'Time a step'\nset ylabel 'ms'\nset logscale y\nset yrange [*:*]\n"
                        "set key inside left top\nplot " +
                        lks_bench::comma_separated(costs) + "\nunset multiplot");
    section.plots.push_back(std::move(plot));
    return section;
}

Section report_balloon(const std::vector<BalloonRun>& runs) {
    Section section;
    section.text =
        "\n## The paper's balloon\n\nA sphere of 162 particles and 480 springs around a volume that is held "
        "at 1.5 times its own, in the reference solvers (the SDK has no volume constraint). Volume "
        "reached, of its own.\n\n" +
        table_head({"shell, m/N", "volume, m⁶/J", "solver", "iterations", "volume", "stretch of the shell"});
    Plot plot{"paper-balloon.svg", "A balloon", lks_bench::Script("Volume that a balloon reaches")};
    plot.script.command(
        "set xlabel 'compliance of the volume, m^6/J'\nset ylabel 'of its own volume'\n"
        "set logscale x\nset format x '10^{%T}'\nset xrange [7e-5:0.15]\nset yrange [1.1:1.55]");
    // By solver, iterations and shell: a point a compliance of the volume.
    std::vector<std::pair<std::string, std::string>> lines;
    for (const BalloonRun& run : runs) {
        char shell[40];
        std::snprintf(shell, sizeof shell, ", shell %g m/N", run.shell_compliance);
        const std::string title =
            run.solver + (run.iterations > 0 ? ", " + numbered(run.iterations) : "") + shell;
        // Float32's points are those of double precision.
        if (run.solver != name_of(reference::Engine::xpbd_single)) {
            const auto same = [&](const auto& line) { return line.first == title; };
            auto line = std::find_if(lines.begin(), lines.end(), same);
            if (line == lines.end()) {
                line = lines.insert(line, {title, ""});
            }
            line->second += lks_bench::value_pair(run.volume_compliance, run.volume);
        }
        section.text += table_row({digits(run.shell_compliance), digits(run.volume_compliance), run.solver,
                                   run.iterations == 0 ? "" : std::to_string(run.iterations),
                                   digits(run.volume), percent(run.stretch)});
        section.results.push_back({"paper_balloon", "volume",
                                   run.solver + ", " + digits(run.shell_compliance) + " m/N, " +
                                       digits(run.volume_compliance) + " m6/J, " + numbered(run.iterations),
                                   run.volume, "of its own"});
    }
    std::vector<std::string> curves;
    for (const auto& [title, points] : lines) {
        const std::string solver = title.substr(0, title.find(','));
        const bool exact = solver == "Newton";
        std::string looks = " with lines lw 7 lc rgb '#d9d9d9'";
        if (!exact) {
            looks = " with linespoints lw 1 ps 1 pt ";
            looks.append(std::to_string(5 + curves.size() % 8)).append(line_colour_of(solver));
        }
        looks.append(" title '").append(title).append("'");
        curves.push_back(plot.script.data(points) + looks);
    }
    plot.script.command("plot " + lks_bench::comma_separated(curves));
    section.plots.push_back(std::move(plot));
    return section;
}

} // namespace lks_accuracy
