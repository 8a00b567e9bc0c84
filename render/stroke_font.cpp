#include "render/stroke_font.h"

#include <algorithm>
#include <array>

namespace render {
namespace {

// Points are two digits, x and y (y counts from two below the baseline); a comma lifts the pen; a stroke that
// starts with ~ is a smooth curve whose inner points pull it without being touched. Space to tilde, in ASCII
// order.
constexpr std::array<std::string_view, 95> letters = {
    "",                                                  // space
    "08 04,02 02",                                       // !
    "08 07,28 27",                                       // "
    "12 18,32 38,06 46,04 44",                           // #
    "~47 48 08 05 45 42 02 03,29 21",                    // $
    "02 48,07 07,43 43",                                 // %
    "~44 42 02 05 25 28 08 06 42",                       // &
    "08 07",                                             // '
    "~28 06 04 21",                                      // (
    "~08 26 24 01",                                      // )
    "14 17,05 26,06 25",                                 // *
    "04 44,26 22",                                       // +
    "02 01",                                             // ,
    "04 34",                                             // -
    "02 02",                                             // .
    "01 38",                                             // /
    "~05 08 48 42 02 05",                                // 0
    "17 28 22,12 32",                                    // 1
    "~07 08 48 45 02,02 42",                             // 2
    "~07 08 48 45 15,~15 45 42 02 03",                   // 3
    "32 38 04 44",                                       // 4
    "48 08 05,~05 45 42 02 03",                          // 5
    "~38 08 04,~04 06 46 42 02 04",                      // 6
    "08 48 12",                                          // 7
    "~28 48 45 05 08 28,~25 45 42 02 05 25",             // 8
    "~46 44 04 08 48 46,~46 42 12",                      // 9
    "05 05,02 02",                                       // :
    "05 05,02 01",                                       // ;
    "36 04 32",                                          // <
    "05 45,03 43",                                       // =
    "06 34 02",                                          // >
    "~07 08 48 45 25 24,22 22",                          // ?
    "~43 44 46 16 13 43,~43 48 08 02 42",                // @
    "02 28 42,14 34",                                    // A
    "08 02,08 28,~28 48 45 25,05 25,~25 45 42 22,02 22", // B
    "~46 48 08 02 42 44",                                // C
    "08 02,08 18,~18 48 42 12,02 12",                    // D
    "48 08 02 42,05 35",                                 // E
    "48 08 02,05 35",                                    // F
    "~46 48 08 02 42 44,24 44",                          // G
    "08 02,48 42,05 45",                                 // H
    "08 02",                                             // I
    "38 34,~34 32 02 03",                                // J
    "08 02,48 04,15 42",                                 // K
    "08 02 42",                                          // L
    "02 08 34 68 62",                                    // M
    "02 08 42 48",                                       // N
    "~05 08 48 42 02 05",                                // O
    "08 02,08 28,~28 48 45 25,05 25",                    // P
    "~05 08 48 42 02 05,23 41",                          // Q
    "08 02,08 28,~28 48 45 25,05 25,25 42",              // R
    "~47 48 08 05 45 42 02 03",                          // S
    "08 48,28 22",                                       // T
    "08 04,~04 02 42 44,44 48",                          // U
    "08 22 48",                                          // V
    "08 12 36 52 68",                                    // W
    "08 42,02 48",                                       // X
    "08 25 48,25 22",                                    // Y
    "08 48 02 42",                                       // Z
    "18 08 01 11",                                       // [
    "08 31",                                             // backslash
    "08 18 11 01",                                       // ]
    "06 18 26",                                          // ^
    "01 41",                                             // _
    "08 17",                                             // `
    "~44 46 06 02 42 44,46 42",                          // a
    "08 02,~04 06 46 42 02 04",                          // b
    "~45 46 06 02 42 43",                                // c
    "48 42,~44 46 06 02 42 44",                          // d
    "04 44,~44 46 06 02 42 43",                          // e
    "~38 18 16,16 12,06 36",                             // f
    "~44 46 06 02 42 44,46 42,~42 40 00",                // g
    "08 02,~04 06 46 44,44 42",                          // h
    "06 02,08 08",                                       // i
    "16 11,~11 10 00,18 18",                             // j
    "08 02,36 03,14 32",                                 // k
    "08 02",                                             // l
    "06 02,~04 06 36 34,34 32,~34 36 66 64,64 62",       // m
    "06 02,~04 06 46 44,44 42",                          // n
    "~04 06 46 42 02 04",                                // o
    "06 00,~04 06 46 42 02 04",                          // p
    "46 40,~44 46 06 02 42 44",                          // q
    "06 02,~04 06 36",                                   // r
    "~45 46 06 04 44 42 02 03",                          // s
    "18 13,~13 12 32,06 36",                             // t
    "06 04,~04 02 42 44,46 42",                          // u
    "06 22 46",                                          // v
    "06 12 36 52 66",                                    // w
    "06 42,02 46",                                       // x
    "06 22,46 10",                                       // y
    "06 46 02 42",                                       // z
    "~28 18 15 05,~05 15 11 21",                         // {
    "08 01",                                             // |
    "~08 18 15 25,~25 15 11 01",                         // }
    "~04 06 24 42 44",                                   // ~
};
constexpr std::string_view unknown_letter = "02 08 48 42 02";
constexpr float letter_gap = 1.9f;
constexpr float space_width = 3.6f;
constexpr int pieces_a_curve = 5;

using Points = std::vector<glm::vec2>;

void draw_straight(const Points& points, std::vector<Stroke>& strokes) {
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        strokes.push_back({points[i], points[i + 1]});
    }
}

// Quadratic arcs from middle to middle of the polygon's sides.
void draw_curve(const Points& points, std::vector<Stroke>& strokes) {
    glm::vec2 start = points.front();
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const glm::vec2 pull = points[i];
        const glm::vec2 end = i + 2 == points.size() ? points.back() : (points[i] + points[i + 1]) * 0.5f;
        glm::vec2 from = start;
        for (int piece = 1; piece <= pieces_a_curve; ++piece) {
            const float t = static_cast<float>(piece) / static_cast<float>(pieces_a_curve);
            const glm::vec2 to =
                start * ((1.0f - t) * (1.0f - t)) + pull * (2.0f * t * (1.0f - t)) + end * (t * t);
            strokes.push_back({from, to});
            from = to;
        }
        start = end;
    }
}

float draw_letter(std::string_view description, std::vector<Stroke>& strokes) {
    float width = 0.0f;
    while (!description.empty()) {
        const std::size_t comma = std::min(description.find(','), description.size());
        std::string_view stroke = description.substr(0, comma);
        description.remove_prefix(std::min(comma + 1, description.size()));
        const bool curved = stroke.front() == '~';
        if (curved) {
            stroke.remove_prefix(1);
        }
        Points points;
        for (std::size_t i = 0; i + 1 < stroke.size(); i += 3) {
            const glm::vec2 point(static_cast<float>(stroke[i] - '0'),
                                  static_cast<float>(stroke[i + 1] - '2'));
            width = std::max(width, point.x);
            points.push_back(point);
        }
        if (curved) {
            draw_curve(points, strokes);
        } else {
            draw_straight(points, strokes);
        }
    }
    return width;
}

} // namespace

float lay_out_text(std::string_view text, float x, float fixed, std::vector<Stroke>& strokes) {
    for (const char letter : text) {
        if (letter == ' ') {
            x += fixed > 0.0f ? fixed : space_width;
            continue;
        }
        const auto index = static_cast<std::size_t>(static_cast<unsigned char>(letter)) - 32;
        const std::size_t first = strokes.size();
        const float width = draw_letter(index < letters.size() ? letters[index] : unknown_letter, strokes);
        const float shift = fixed > 0.0f ? (fixed - letter_gap - width) * 0.5f : 0.0f;
        for (std::size_t i = first; i < strokes.size(); ++i) {
            strokes[i].from.x += x + shift;
            strokes[i].to.x += x + shift;
        }
        x += fixed > 0.0f ? fixed : width + letter_gap;
    }
    return x;
}

} // namespace render
