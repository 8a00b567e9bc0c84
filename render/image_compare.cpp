#include "render/image_compare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace render {

bool ImageDifference::within(const Tolerance& tolerance) const {
    if (!same_size) {
        return false;
    }
    const double fraction =
        static_cast<double>(distinct_pixels) / static_cast<double>(std::max<std::size_t>(pixels, 1));
    return fraction <= tolerance.pixel_fraction && psnr >= tolerance.minimum_psnr;
}

std::string ImageDifference::sentence(const Tolerance& tolerance) const {
    if (!same_size) {
        return "the pictures have different sizes";
    }
    if (different_pixels == 0) {
        return "the pictures are identical";
    }
    char text[200];
    std::snprintf(text, sizeof text,
                  "%zu of %zu pixels differ by more than %d, PSNR %.1f dB, greatest step %d", distinct_pixels,
                  pixels, tolerance.channel_step, psnr, greatest_step);
    return text;
}

ImageDifference compare_images(const Image& expected, const Image& actual, const Tolerance& tolerance) {
    ImageDifference difference;
    difference.same_size = expected.width == actual.width && expected.height == actual.height;
    if (!difference.same_size) {
        return difference;
    }
    difference.pixels = static_cast<std::size_t>(expected.width) * static_cast<std::size_t>(expected.height);
    difference.left = expected.width;
    difference.top = expected.height;
    std::uint64_t squares = 0;
    for (int y = 0; y < expected.height; ++y) {
        for (int x = 0; x < expected.width; ++x) {
            const std::uint8_t* a = expected.at(x, y);
            const std::uint8_t* b = actual.at(x, y);
            int step = 0;
            for (int channel = 0; channel < 3; ++channel) {
                const int delta = std::abs(static_cast<int>(a[channel]) - static_cast<int>(b[channel]));
                squares += static_cast<std::uint64_t>(delta) * static_cast<std::uint64_t>(delta);
                step = std::max(step, delta);
            }
            difference.greatest_step = std::max(difference.greatest_step, step);
            difference.different_pixels += step > 0 ? 1 : 0;
            if (step > tolerance.channel_step) {
                ++difference.distinct_pixels;
                difference.left = std::min(difference.left, x);
                difference.top = std::min(difference.top, y);
                difference.right = std::max(difference.right, x);
                difference.bottom = std::max(difference.bottom, y);
            }
        }
    }
    if (difference.distinct_pixels == 0) {
        difference.left = 0;
        difference.top = 0;
    }
    if (squares == 0) {
        difference.psnr = std::numeric_limits<double>::infinity();
    } else {
        const double mean = static_cast<double>(squares) / (3.0 * static_cast<double>(difference.pixels));
        difference.psnr = 10.0 * std::log10(255.0 * 255.0 / mean);
    }
    return difference;
}

Image difference_image(const Image& expected, const Image& actual, int amplification) {
    Image result(std::max(expected.width, actual.width), std::max(expected.height, actual.height));
    for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
            const bool in_expected = x < expected.width && y < expected.height;
            const bool in_actual = x < actual.width && y < actual.height;
            std::uint8_t* out = result.at(x, y);
            if (!in_expected || !in_actual) {
                out[0] = 160;
                out[1] = 0;
                out[2] = 160;
                continue;
            }
            const std::uint8_t* a = expected.at(x, y);
            const std::uint8_t* b = actual.at(x, y);
            const int grey =
                (static_cast<int>(a[0]) + 2 * static_cast<int>(a[1]) + static_cast<int>(a[2])) / 16;
            for (int channel = 0; channel < 3; ++channel) {
                const int delta = std::abs(static_cast<int>(a[channel]) - static_cast<int>(b[channel]));
                out[channel] = static_cast<std::uint8_t>(std::min(255, grey + delta * amplification));
            }
        }
    }
    return result;
}

} // namespace render
