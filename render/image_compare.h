// Golden images: how far two pictures are apart, and a picture of the difference.
#pragma once

#include <cstddef>
#include <string>

#include "render/image.h"

namespace render {

// What another version of the driver may change: rounding along edges and in shading. A rope moved by its own
// radius changes far more pixels than this.
struct Tolerance {
    int channel_step = 2;          // a pixel counts when a channel differs by more than this
    double pixel_fraction = 0.001; // of all pixels that may count
    double minimum_psnr = 60.0;    // decibels over all channels
};

struct ImageDifference {
    bool same_size = false;
    std::size_t pixels = 0;                         // in the picture
    std::size_t different_pixels = 0;               // any channel, by any amount
    std::size_t distinct_pixels = 0;                // any channel by more than the tolerance's channel_step
    int greatest_step = 0;                          // of any channel
    double psnr = 0.0;                              // decibels; infinity for identical pictures
    int left = 0, top = 0, right = -1, bottom = -1; // of the distinct pixels, inclusive; right < left: none

    bool identical() const { return same_size && different_pixels == 0; }
    bool within(const Tolerance& tolerance) const;
    // One line for a report: "412 of 921600 pixels differ by more than 2, PSNR 58.3 dB, greatest step 93".
    std::string sentence(const Tolerance& tolerance) const;
};

ImageDifference compare_images(const Image& expected, const Image& actual, const Tolerance& tolerance = {});

// The difference times amplification over a faint grey of the expected picture, so that one sees where it is.
// Pictures of different sizes give an image of the larger width and height in which what only one of them has
// is marked.
Image difference_image(const Image& expected, const Image& actual, int amplification = 16);

} // namespace render
