// Small multiples: plots in a grid on one sheet, with one legend for all.
#pragma once

#include <string>
#include <vector>

namespace lks_accuracy {

struct Point {
    double x, y; // both above zero
};

// What the points of a curve have in common.
enum class Sweep { substeps, iterations, both, backdrop };

struct Curve {
    std::string solver;
    std::string colour; // "#rrggbb"
    Sweep sweep = Sweep::substeps;
    double width = 2; // of its line: what others lie on is wider
    std::vector<Point> points{};
};

// Logarithmic on both axes.
struct Panel {
    std::string title;
    std::string meaning;
    std::vector<Curve> curves{};
    std::vector<std::string> remarks{}; // sentences about what can't be drawn
    double seen = 0;                    // drawn as a line; 0: none
};

struct Sheet {
    std::string title;
    std::string across; // what the horizontal axes are
    std::vector<Panel> panels{};
};

// Lines of at most so many characters; longer words stand alone.
std::vector<std::string> wrapped(const std::string& text, std::size_t width);

// As SVG.
std::string drawn(const Sheet& sheet);

} // namespace lks_accuracy
