#include "render/legend.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "render/stroke_font.h"

namespace render {
namespace {

constexpr Colour panel_colour = srgb(0x14181d);
constexpr float panel_opacity = 0.62f;
constexpr Colour title_colour = srgb(0xf4f1ea);
constexpr Colour detail_colour = srgb(0xbfc6cd);
constexpr float digit_width = 5.4f;

void blend(Image& image, int x, int y, Colour colour, float opacity) {
    std::uint8_t* pixel = image.at(x, y);
    for (int channel = 0; channel < 3; ++channel) {
        const float under = static_cast<float>(pixel[channel]);
        const float mixed = under + (colour[channel] * 255.0f - under) * opacity;
        pixel[channel] = static_cast<std::uint8_t>(std::clamp(mixed + 0.5f, 0.0f, 255.0f));
    }
}

// A rectangle with round corners, in pixels.
void draw_panel(Image& image, float left, float top, float right, float bottom, float corner) {
    const glm::vec2 centre((left + right) * 0.5f, (top + bottom) * 0.5f);
    const glm::vec2 half((right - left) * 0.5f - corner, (bottom - top) * 0.5f - corner);
    const int x_end = std::min(image.width, static_cast<int>(std::ceil(right)));
    const int y_end = std::min(image.height, static_cast<int>(std::ceil(bottom)));
    for (int y = std::max(0, static_cast<int>(top)); y < y_end; ++y) {
        for (int x = std::max(0, static_cast<int>(left)); x < x_end; ++x) {
            const glm::vec2 offset = glm::abs(glm::vec2(x, y) + 0.5f - centre) - half;
            const float distance = glm::length(glm::max(offset, glm::vec2(0.0f))) +
                                   std::min(std::max(offset.x, offset.y), 0.0f) - corner;
            blend(image, x, y, panel_colour, panel_opacity * std::clamp(0.5f - distance, 0.0f, 1.0f));
        }
    }
}

float distance_to(glm::vec2 point, const Stroke& stroke) {
    const glm::vec2 along = stroke.to - stroke.from;
    const float squared = glm::dot(along, along);
    const float t =
        squared > 0.0f ? std::clamp(glm::dot(point - stroke.from, along) / squared, 0.0f, 1.0f) : 0.0f;
    return glm::distance(point, stroke.from + along * t);
}

// Strokes in pixels. Coverage is gathered first: where two strokes of a letter meet they must not darken
// twice.
void draw_strokes(Image& image, const std::vector<Stroke>& strokes, Colour colour, float pen) {
    if (strokes.empty()) {
        return;
    }
    const float reach = pen * 0.5f + 1.0f;
    glm::vec2 low = strokes[0].from;
    glm::vec2 high = low;
    for (const Stroke& stroke : strokes) {
        low = glm::min(low, glm::min(stroke.from, stroke.to));
        high = glm::max(high, glm::max(stroke.from, stroke.to));
    }
    const int left = std::max(0, static_cast<int>(low.x - reach));
    const int top = std::max(0, static_cast<int>(low.y - reach));
    const int right = std::min(image.width, static_cast<int>(high.x + reach) + 1);
    const int bottom = std::min(image.height, static_cast<int>(high.y + reach) + 1);
    if (right <= left || bottom <= top) {
        return;
    }
    const auto width = static_cast<std::size_t>(right - left);
    std::vector<float> coverage(width * static_cast<std::size_t>(bottom - top), 0.0f);
    for (const Stroke& stroke : strokes) {
        const int x0 = std::max(left, static_cast<int>(std::min(stroke.from.x, stroke.to.x) - reach));
        const int x1 = std::min(right, static_cast<int>(std::max(stroke.from.x, stroke.to.x) + reach) + 1);
        const int y0 = std::max(top, static_cast<int>(std::min(stroke.from.y, stroke.to.y) - reach));
        const int y1 = std::min(bottom, static_cast<int>(std::max(stroke.from.y, stroke.to.y) + reach) + 1);
        for (int y = y0; y < y1; ++y) {
            for (int x = x0; x < x1; ++x) {
                const float covered = pen * 0.5f + 0.5f - distance_to(glm::vec2(x, y) + 0.5f, stroke);
                float& cell =
                    coverage[static_cast<std::size_t>(y - top) * width + static_cast<std::size_t>(x - left)];
                cell = std::max(cell, std::clamp(covered, 0.0f, 1.0f));
            }
        }
    }
    for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
            const float cell =
                coverage[static_cast<std::size_t>(y - top) * width + static_cast<std::size_t>(x - left)];
            if (cell > 0.0f) {
                blend(image, x, y, colour, cell);
            }
        }
    }
}

// From font units over the baseline to pixels.
void place(std::vector<Stroke>& strokes, float unit, float left, float baseline) {
    for (Stroke& stroke : strokes) {
        stroke.from = glm::vec2(left + stroke.from.x * unit, baseline - stroke.from.y * unit);
        stroke.to = glm::vec2(left + stroke.to.x * unit, baseline - stroke.to.y * unit);
    }
}

} // namespace

void draw_legend(Image& image, const Legend& legend) {
    if (legend.scene.empty() && legend.tick.empty() && legend.hash.empty() && legend.note.empty()) {
        return;
    }
    const float scale = std::max(0.6f, static_cast<float>(image.height) / 720.0f);
    const float title_unit = 2.15f * scale;
    const float detail_unit = 1.7f * scale;
    const float margin = 18.0f * scale;
    const float padding = 13.0f * scale;

    std::vector<Stroke> title;
    std::vector<Stroke> detail;
    const float title_width = lay_out_text(legend.scene, 0.0f, 0.0f, title) * title_unit;
    constexpr float gap = 7.0f;
    float x = lay_out_text(legend.tick, 0.0f, 0.0f, detail);
    if (!legend.hash.empty()) {
        x = lay_out_text(legend.hash, x > 0.0f ? x + gap : 0.0f, digit_width, detail);
    }
    if (!legend.note.empty()) {
        x = lay_out_text(legend.note, x > 0.0f ? x + gap : 0.0f, 0.0f, detail);
    }
    const float detail_width = x * detail_unit;
    const bool two_lines = !title.empty() && !detail.empty();

    const float text_height = (title.empty() ? 0.0f : capital_height * title_unit) +
                              (detail.empty() ? 0.0f : capital_height * detail_unit) +
                              (two_lines ? 11.0f * scale : 0.0f);
    const float bottom = static_cast<float>(image.height) - margin;
    const float top = bottom - text_height - padding * 2.0f;
    const float right = margin + std::max(title_width, detail_width) + padding * 2.0f - 2.0f * scale;
    draw_panel(image, margin, top, right, bottom, 7.0f * scale);

    // The baselines sit on pixel borders, or horizontal strokes would be grey.
    float baseline = top + padding;
    if (!title.empty()) {
        baseline = std::round(baseline + capital_height * title_unit);
        place(title, title_unit, margin + padding, baseline);
        draw_strokes(image, title, title_colour, 1.75f * scale);
        baseline += 11.0f * scale;
    }
    if (!detail.empty()) {
        baseline = std::round(baseline + capital_height * detail_unit);
        place(detail, detail_unit, margin + padding, baseline);
        draw_strokes(image, detail, detail_colour, 1.35f * scale);
    }
}

} // namespace render
