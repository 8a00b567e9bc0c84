#include "picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace lks_accuracy {
namespace {

constexpr const char* styles = "text{font-family:sans-serif;font-size:12px;fill:#333}"
                               ".sheet{font-size:20px;font-weight:bold}"
                               ".title{font-size:15px;font-weight:bold}"
                               ".remark{fill:#8a4b00}"
                               ".faint{fill:#888;text-anchor:middle}"
                               ".below{text-anchor:middle}"
                               ".beside{text-anchor:end}"
                               ".raised{font-size:9px}"
                               "polyline{fill:none;stroke-linejoin:round}";

// A tenth of a pixel is seen by nobody.
std::string pixels(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%g", std::round(10 * value) / 10);
    return text;
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    }
    return result;
}

std::string attribute(const char* name, const std::string& value) {
    std::string text = " ";
    return text.append(name).append("=\"").append(value).append("\"");
}

std::string text_begin(const Place& where, const std::string& style) {
    return "<text" + attribute("x", pixels(where.x)) + attribute("y", pixels(where.y)) +
           attribute("class", style) + ">";
}

const char* shape_of(Mark mark) {
    switch (mark) {
    case Mark::disc:
        return "<circle r=\"2.6\" fill=\"";
    case Mark::ring:
        return "<circle r=\"2.6\" fill=\"#fff\" stroke-width=\"1.2\" stroke=\"";
    case Mark::cross:
        return "<path d=\"M-2.5-2.5L2.5 2.5M2.5-2.5L-2.5 2.5\" stroke-width=\"1\" stroke=\"";
    case Mark::none:
        break;
    }
    return "";
}

} // namespace

void Picture::text(const Place& where, const std::string& style, const std::string& text) {
    body_ += text_begin(where, style) + escaped(text) + "</text>\n";
}

void Picture::power(const Place& where, const std::string& style, int digit, int exponent) {
    constexpr int least_short = -3;
    constexpr int most_short = 5;
    if (exponent >= least_short && exponent <= most_short) {
        char plain[20];
        std::snprintf(plain, sizeof plain, "%.6g", digit * std::pow(10.0, exponent));
        text(where, style, plain);
        return;
    }
    body_.append(text_begin(where, style)).append(digit == 1 ? "" : std::to_string(digit) + "·");
    body_.append("10<tspan dy=\"-5\" class=\"raised\">").append(exponent < 0 ? "−" : "");
    body_.append(std::to_string(std::abs(exponent))).append("</tspan></text>\n");
}

void Picture::line(const std::vector<Place>& places, const Pen& pen) {
    std::string points;
    for (const Place& place : places) {
        points += points.empty() ? "" : " ";
        points.append(pixels(place.x)).append(",").append(pixels(place.y));
    }
    body_ += "<polyline" + attribute("points", points);
    body_ += attribute("stroke", pen.colour);
    if (pen.is_line) {
        body_ += attribute("stroke-width", pixels(pen.width));
        body_ += pen.dashes.empty() ? "" : attribute("stroke-dasharray", pen.dashes);
    } else {
        // Some programs draw no marks of a line without a stroke.
        body_ += attribute("stroke-opacity", "0");
    }
    if (pen.mark != Mark::none) {
        std::string mark = "url(#";
        mark.append(mark_of(pen)).append(")");
        body_ +=
            attribute("marker-start", mark) + attribute("marker-mid", mark) + attribute("marker-end", mark);
    }
    body_ += "/>\n";
}

void Picture::frame(const Place& corner, double width, double height) {
    body_ += "<rect" + attribute("x", pixels(corner.x)) + attribute("y", pixels(corner.y)) +
             attribute("width", pixels(width)) + attribute("height", pixels(height)) +
             " fill=\"none\" stroke=\"#555\"/>\n";
}

std::string Picture::mark_of(const Pen& pen) {
    std::string name(1, "ndrc"[static_cast<int>(pen.mark)]);
    name.append(pen.colour, 1);
    const std::string definition =
        "<marker" + attribute("id", name) +
        " viewBox=\"-4 -4 8 8\" markerWidth=\"8\" markerHeight=\"8\" markerUnits=\"userSpaceOnUse\">" +
        shape_of(pen.mark) + pen.colour + "\"/></marker>\n";
    if (std::find(marks_.begin(), marks_.end(), definition) == marks_.end()) {
        marks_.push_back(definition);
    }
    return name;
}

std::string Picture::svg() const {
    const std::string width = pixels(width_);
    const std::string height = pixels(height_);
    std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", width) +
                       attribute("height", height) +
                       attribute("viewBox", std::string("0 0 ").append(width).append(" ").append(height)) +
                       ">\n<style>" + styles + "</style>\n<defs>\n";
    for (const std::string& mark : marks_) {
        text += mark;
    }
    return text + "</defs>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" + body_ + "</svg>\n";
}

} // namespace lks_accuracy
