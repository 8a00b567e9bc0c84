// An SVG as it is written: what small multiples need, and little else, so that its files stay small.
#pragma once

#include <string>
#include <vector>

namespace lks_accuracy {

// Pixels, from the upper left corner.
struct Place {
    double x, y;
};

enum class Mark { none, disc, ring, cross };

// How a line looks. `colour`: "#rrggbb".
struct Pen {
    std::string colour;
    double width = 1;
    std::string dashes{}; // "4 3"; "": solid
    Mark mark = Mark::none;
    bool is_line = true; // else the marks alone
};

// "title", "meaning", ...: the styles that picture.cpp knows.
class Picture {
public:
    Picture(double width, double height) : width_(width), height_(height) {}

    void text(const Place& where, const std::string& style, const std::string& text);
    // A digit times ten to some power; a plain number where that is short.
    void power(const Place& where, const std::string& style, int digit, int exponent);
    void line(const std::vector<Place>& places, const Pen& pen);
    void frame(const Place& corner, double width, double height);

    std::string svg() const;

private:
    std::string mark_of(const Pen& pen);

    double width_;
    double height_;
    std::vector<std::string> marks_{}; // their definitions, each once
    std::string body_{};
};

} // namespace lks_accuracy
