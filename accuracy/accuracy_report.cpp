#include "accuracy_report.h"

#include <cmath>
#include <cstdio>

#include "report_files.h"

namespace lks_accuracy {

std::string digits(double value) {
    if (std::isnan(value)) {
        return "";
    }
    const double size = std::abs(value);
    char text[40];
    std::snprintf(text, sizeof text,
                  size == 0                        ? "%.0f"
                  : size < 0.001 || size >= 100000 ? "%.1e"
                  : size < 0.1                     ? "%.4f"
                  : size < 1                       ? "%.3f"
                  : size < 10                      ? "%.2f"
                  : size < 100                     ? "%.1f"
                                                   : "%.0f",
                  value);
    return text;
}

std::string table_row(const std::vector<std::string>& cells) {
    std::string text = "|";
    for (const std::string& cell : cells) {
        text += " " + cell + " |";
    }
    return text + "\n";
}

std::string table_head(const std::vector<std::string>& cells) {
    std::string text = table_row(cells) + "|---";
    for (std::size_t i = 1; i < cells.size(); ++i) {
        text += "|--:";
    }
    return text + "|\n";
}

std::vector<Section> sections_of(const Measured& measured) {
    std::vector<Section> sections;
    const Paper& paper = measured.paper;
    if (!paper.spring.empty()) {
        sections.push_back(report_spring(paper.spring));
    }
    if (!paper.chain.empty()) {
        sections.push_back(report_chain(paper.chain));
    }
    if (paper.beam) {
        sections.push_back(report_beam(*paper.beam));
    }
    if (!paper.cloth.empty()) {
        sections.push_back(report_cloth(paper.cloth_scene, paper.cloth));
    }
    if (!paper.balloon.empty()) {
        sections.push_back(report_balloon(paper.balloon));
    }
    for (const Experiment& experiment : measured.experiments) {
        sections.push_back(report_experiment(experiment));
    }
    return sections;
}

bool write_report(const std::string& folder, const std::vector<Section>& sections, std::string& error) {
    if (!lks_bench::make_folder(folder, error)) {
        return false;
    }
    bool drawn = lks_bench::has_gnuplot(error);
    const auto picture = [](const std::string& title, const std::string& file) {
        std::string line = "\n![";
        return line.append(title).append("](").append(file).append(")\n");
    };
    lks_bench::Results results;
    std::string text = "# Speed against error\n\n" + lks_bench::machine_name() +
                       ". One thread. Costs are the least of all ticks, since other work may run beside.\n";
    for (const Section& section : sections) {
        text += section.text;
        results.insert(results.end(), section.results.begin(), section.results.end());
        for (const Plot& plot : section.plots) {
            drawn = drawn && lks_bench::draw(folder, plot.file, plot.script, error);
            if (drawn) {
                text += picture(plot.title, plot.file);
            }
        }
        for (const Drawn& drawing : section.drawings) {
            if (!lks_bench::write_file(folder, drawing.file, drawing.svg, error)) {
                return false;
            }
            text += picture(drawing.title, drawing.file);
        }
    }
    return lks_bench::write_file(folder, "results.json", to_json(results), error) &&
           lks_bench::write_file(folder, "results.csv", to_csv(results), error) &&
           lks_bench::write_file(folder, "report.md", text, error) && drawn;
}

} // namespace lks_accuracy
