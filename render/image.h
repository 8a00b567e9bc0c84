// A picture in memory, and PNG files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace render {

// Eight-bit sRGB, three bytes a pixel, top row first.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;

    Image() = default;
    Image(int image_width, int image_height);

    std::uint8_t* at(int x, int y);
    const std::uint8_t* at(int x, int y) const;
};

// Both return false with a sentence in error, and leave neither a half-written file nor a half-read image.
bool write_png(const std::string& path, const Image& image, std::string& error);
bool read_png(const std::string& path, Image& image, std::string& error);

} // namespace render
