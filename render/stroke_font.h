// A drawn alphabet: every letter is a few pen strokes, so a legend is sharp at any size and needs no font
// file.
#pragma once

#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

namespace render {

// Font units: capitals are 6 high over the baseline at 0, small letters 4, descenders go to -2.
struct Stroke {
    glm::vec2 from;
    glm::vec2 to;
};

constexpr float capital_height = 6.0f;

// Adds the strokes of one line of text, starting at x, and returns where the next letter would start. With
// fixed above 0 every letter takes that width (digits in a column).
float lay_out_text(std::string_view text, float x, float fixed, std::vector<Stroke>& strokes);

} // namespace render
