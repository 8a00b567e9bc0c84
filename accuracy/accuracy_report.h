// A folder with what was measured: report.md, results.json, results.csv, and plots as SVG.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment.h"
#include "gnuplot.h"
#include "paper.h"
#include "results.h"

namespace lks_accuracy {

// What was asked for of the paper's experiments.
struct Paper {
    std::vector<SpringRun> spring{};
    std::vector<ChainRun> chain{};
    std::optional<Beam> beam{};
    ClothHang cloth_scene{};
    std::vector<SagRun> cloth{};
    std::vector<BalloonRun> balloon{};
};

struct Measured {
    Paper paper{};
    std::vector<Experiment> experiments{};
};

struct Plot {
    std::string file; // NAME.svg
    std::string title;
    lks_bench::Script script;
};

// One that needs no gnuplot.
struct Drawn {
    std::string file; // NAME.svg
    std::string title;
    std::string svg;
};

// A part of the report: text, and the plots and drawings that stand behind it.
struct Section {
    std::string text{};
    std::vector<Plot> plots{};
    std::vector<Drawn> drawings{};
    lks_bench::Results results{};
};

Section report_spring(const std::vector<SpringRun>& runs);
Section report_chain(const std::vector<ChainRun>& runs);
Section report_beam(const Beam& beam);
Section report_cloth(const ClothHang& cloth, const std::vector<SagRun>& runs);
Section report_balloon(const std::vector<BalloonRun>& runs);
Section report_experiment(const Experiment& experiment);

std::vector<Section> sections_of(const Measured& measured);
// False, with a sentence: the folder can't be written, or the plots can't be made. What can be written is.
bool write_report(const std::string& folder, const std::vector<Section>& sections, std::string& error);

std::string digits(double value); // for tables: three of them
// "| a | b |"
std::string table_row(const std::vector<std::string>& cells);
std::string table_head(const std::vector<std::string>& cells);

} // namespace lks_accuracy
