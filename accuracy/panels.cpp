#include "panels.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "picture.h"

namespace lks_accuracy {
namespace {

// Pixels.
constexpr std::size_t column_count = 3;
constexpr double panel_width = 450;
constexpr double plot_height = 230;
constexpr double left_margin = 54;
constexpr double right_margin = 14;
constexpr double tick_height = 22;
constexpr double across_height = 20;
constexpr double title_height = 26;
constexpr double line_height = 16;
constexpr double sheet_title_height = 46;
constexpr double legend_row_height = 24;
constexpr double legend_padding = 14;
constexpr double sample_length = 34;
constexpr double character_width = 7.2;
constexpr double sheet_width = panel_width * column_count;
constexpr std::size_t text_width = 66; // characters of a panel's small print

const Pen grid_pen{"#dddddd"};
const Pen seen_pen{"#c51b8a", 1.5, "2 3"};

// A logarithmic axis: what is drawn, and the pixels it is drawn into.
struct Axis {
    double least = std::numeric_limits<double>::infinity();
    double most = 0;
    double begin = 0;
    double end = 0;

    bool is_empty() const { return most == 0; }
    void add(double value) {
        least = std::min(least, value);
        most = std::max(most, value);
    }
    void widen(double factor) {
        least /= factor;
        most *= factor;
    }
    // To whole powers of ten, or to one, two or five of them where it would be less than one.
    void round() {
        least *= 0.999;
        most *= 1.001;
        const bool is_short = decades() < 1;
        double rounded_least = 0;
        double rounded_most = std::numeric_limits<double>::infinity();
        const int highest = static_cast<int>(std::ceil(std::log10(most)));
        for (int exponent = static_cast<int>(std::floor(std::log10(least))); exponent <= highest;
             ++exponent) {
            for (const int digit : {1, 2, 5}) {
                const double value = digit * std::pow(10.0, exponent);
                if (digit == 1 || is_short) {
                    rounded_least = value <= least ? value : rounded_least;
                    rounded_most = value >= most ? std::min(value, rounded_most) : rounded_most;
                }
            }
        }
        least = rounded_least;
        most = rounded_most;
    }
    bool holds(double value) const { return value >= least * 0.9999 && value <= most * 1.0001; }
    double decades() const { return std::log10(most / least); }
    double place(double value) const { return begin + (end - begin) * std::log10(value / least) / decades(); }
};

// Where there is a line and a number: every power of ten, or every other, or also two and five of them.
template <typename Visit>
void each_tick(const Axis& axis, const Visit& visit) {
    constexpr double few_decades = 2.5;
    constexpr double many_decades = 7;
    const int step = axis.decades() > many_decades ? 2 : 1;
    const int highest = static_cast<int>(std::floor(std::log10(axis.most * 1.0001)));
    for (int exponent = static_cast<int>(std::floor(std::log10(axis.least * 1.0001))); exponent <= highest;
         exponent += step) {
        for (const int digit : {1, 2, 5}) {
            const double value = digit * std::pow(10.0, exponent);
            if (axis.holds(value) && (digit == 1 || axis.decades() < few_decades)) {
                visit(axis.place(value), digit, exponent);
            }
        }
    }
}

std::size_t characters_of(const std::string& text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; // all but the rest of a UTF-8 sequence
    }));
}

Pen pen_of(Sweep sweep, const std::string& colour, double width = 2) {
    switch (sweep) {
    case Sweep::substeps:
        return {colour, width, "", Mark::disc};
    case Sweep::iterations:
        return {colour, 0.65 * width, "5 4", Mark::ring};
    case Sweep::both:
        return {colour, 0, "", Mark::cross, false};
    case Sweep::backdrop:
        break;
    }
    return {colour, 8};
}

const char* name_of(Sweep sweep) {
    switch (sweep) {
    case Sweep::substeps:
        return "more substeps";
    case Sweep::iterations:
        return "one substep, more iterations";
    case Sweep::both:
        return "more of both, fixed-point";
    case Sweep::backdrop:
        break;
    }
    return "what the method itself is off";
}

struct SmallPrint {
    std::string line;
    const char* style;
};

// First what it means, then what can't be drawn.
std::vector<SmallPrint> small_print(const Panel& panel) {
    std::vector<SmallPrint> lines;
    const auto add = [&](const std::string& text, const char* style) {
        for (const std::string& line : wrapped(text, text_width)) {
            lines.push_back({line, style});
        }
    };
    add(panel.meaning, "meaning");
    for (const std::string& remark : panel.remarks) {
        add(remark, "remark");
    }
    return lines;
}

struct Entry {
    std::string text;
    Pen pen;

    double width() const {
        return sample_length + 34 + character_width * static_cast<double>(characters_of(text));
    }
};

using LegendRow = std::vector<Entry>;

void add_rows(const LegendRow& entries, std::vector<LegendRow>& rows) {
    double x = sheet_width;
    for (const Entry& entry : entries) {
        if (x + entry.width() > sheet_width - right_margin) {
            rows.emplace_back();
            x = left_margin;
        }
        rows.back().push_back(entry);
        x += entry.width();
    }
}

// Every solver in its colour, then what is solid, dashed and crossed.
std::vector<LegendRow> legend_of(const Sheet& sheet) {
    LegendRow solvers;
    LegendRow kinds;
    bool is_seen = false;
    const auto add = [](LegendRow& entries, Entry entry) {
        if (std::none_of(entries.begin(), entries.end(),
                         [&](const Entry& other) { return other.text == entry.text; })) {
            entries.push_back(std::move(entry));
        }
    };
    const auto each_curve = [&](const auto& visit) {
        for (const Panel& panel : sheet.panels) {
            std::for_each(panel.curves.begin(), panel.curves.end(), visit);
        }
    };
    each_curve([&](const Curve& curve) {
        if (curve.sweep != Sweep::backdrop) {
            add(solvers, {curve.solver, {curve.colour, 4}});
        }
    });
    for (const Sweep sweep : {Sweep::substeps, Sweep::iterations, Sweep::both, Sweep::backdrop}) {
        each_curve([&](const Curve& curve) {
            if (curve.sweep == sweep) {
                add(kinds,
                    {name_of(sweep), pen_of(sweep, sweep == Sweep::backdrop ? curve.colour : "#555555")});
            }
        });
    }
    for (const Panel& panel : sheet.panels) {
        is_seen = is_seen || panel.seen > 0;
    }
    if (is_seen) {
        add(kinds, {"seen in a game from here up", seen_pen});
    }
    std::vector<LegendRow> rows;
    add_rows(solvers, rows);
    add_rows(kinds, rows);
    return rows;
}

// Draws what belongs to one sheet, row by row.
class Drawing {
public:
    explicit Drawing(const Sheet& sheet)
        : sheet_(sheet), legend_(legend_of(sheet)), picture_(sheet_width, height_of(sheet)) {}

    std::string draw() {
        picture_.text({12, 30}, "sheet", sheet_.title);
        for (const Panel& panel : sheet_.panels) {
            for (const Curve& curve : panel.curves) {
                for (const Point& point : curve.points) {
                    across_.add(point.x);
                }
            }
        }
        across_.widen(1.25);
        double top = sheet_title_height;
        for (std::size_t first = 0; first < sheet_.panels.size(); first += column_count) {
            const std::size_t behind = std::min(first + column_count, sheet_.panels.size());
            for (std::size_t i = first; i < behind; ++i) {
                draw_panel(sheet_.panels[i], panel_width * static_cast<double>(i - first), top,
                           head_height(first), i + column_count >= sheet_.panels.size());
            }
            top += row_height(first);
        }
        draw_legend(top + legend_padding);
        return picture_.svg();
    }

private:
    // Of the row that begins with this panel: as high as its longest small print.
    double head_height(std::size_t first) const {
        std::size_t lines = 0;
        for (std::size_t i = first; i < std::min(first + column_count, sheet_.panels.size()); ++i) {
            lines = std::max(lines, small_print(sheet_.panels[i]).size());
        }
        return title_height + line_height * static_cast<double>(lines);
    }
    bool has_across(std::size_t first) const { return first + 2 * column_count > sheet_.panels.size(); }
    double row_height(std::size_t first) const {
        return head_height(first) + plot_height + tick_height + (has_across(first) ? across_height : 0) + 12;
    }
    double height_of(const Sheet& sheet) const {
        double height =
            sheet_title_height + 2 * legend_padding + legend_row_height * static_cast<double>(legend_.size());
        for (std::size_t first = 0; first < sheet.panels.size(); first += column_count) {
            height += row_height(first);
        }
        return height;
    }

    void draw_panel(const Panel& panel, double left, double top, double head, bool is_lowest) {
        picture_.text({left + 12, top + 16}, "title", panel.title);
        double y = top + title_height + 8;
        for (const SmallPrint& print : small_print(panel)) {
            picture_.text({left + 12, y}, print.style, print.line);
            y += line_height;
        }
        Axis across = across_;
        across.begin = left + left_margin;
        across.end = left + panel_width - right_margin;
        Axis up;
        up.end = top + head + 4;
        up.begin = up.end + plot_height;
        for (const Curve& curve : panel.curves) {
            for (const Point& point : curve.points) {
                up.add(point.y);
            }
        }
        const double middle = (across.begin + across.end) / 2;
        if (up.is_empty()) {
            picture_.text({middle, (up.begin + up.end) / 2}, "faint", "nothing that can be drawn");
        } else {
            up.round();
            draw_ticks(across, up);
            draw_curves(panel, across, up);
            if (is_lowest) {
                picture_.text({middle, up.begin + tick_height + 14}, "below", sheet_.across);
            }
        }
        picture_.frame({across.begin, up.end}, across.end - across.begin, plot_height);
    }

    void draw_ticks(const Axis& across, const Axis& up) {
        each_tick(up, [&](double y, int digit, int exponent) {
            picture_.line({{across.begin, y}, {across.end, y}}, grid_pen);
            picture_.power({across.begin - 6, y + 4}, "beside", digit, exponent);
        });
        each_tick(across, [&](double x, int digit, int exponent) {
            picture_.line({{x, up.begin}, {x, up.end}}, grid_pen);
            picture_.power({x, up.begin + 16}, "below", digit, exponent);
        });
    }

    void draw_curves(const Panel& panel, const Axis& across, const Axis& up) {
        if (up.holds(panel.seen)) {
            const double y = up.place(panel.seen);
            picture_.line({{across.begin, y}, {across.end, y}}, seen_pen);
        }
        for (const Curve& curve : panel.curves) {
            std::vector<Place> places;
            for (const Point& point : curve.points) {
                places.push_back({across.place(point.x), up.place(point.y)});
            }
            picture_.line(places, pen_of(curve.sweep, curve.colour, curve.width));
        }
    }

    void draw_legend(double y) {
        for (const LegendRow& row : legend_) {
            double x = left_margin;
            for (const Entry& entry : row) {
                std::vector<Place> sample{{x, y}, {x + sample_length / 2, y}, {x + sample_length, y}};
                if (!entry.pen.is_line) {
                    sample = {{x + sample_length / 2, y}};
                }
                picture_.line(sample, entry.pen);
                picture_.text({x + sample_length + 8, y + 4}, "legend", entry.text);
                x += entry.width();
            }
            y += legend_row_height;
        }
    }

    const Sheet& sheet_;
    std::vector<LegendRow> legend_;
    Picture picture_;
    Axis across_;
};

} // namespace

std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
    std::vector<std::string> lines;
    std::string line;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        if (!line.empty() && characters_of(line) + 1 + characters_of(word) > width) {
            lines.push_back(std::exchange(line, ""));
        }
        line += (line.empty() ? "" : " ") + word;
        begin = end + 1;
    }
    if (!line.empty()) {
        lines.push_back(line);
    }
    return lines;
}

std::string drawn(const Sheet& sheet) {
    return Drawing(sheet).draw();
}

} // namespace lks_accuracy
