#include "render/image.h"

namespace render {

Image::Image(int image_width, int image_height)
    : width(image_width), height(image_height),
      pixels(static_cast<std::size_t>(image_width) * static_cast<std::size_t>(image_height) * 3) {}

std::uint8_t* Image::at(int x, int y) {
    return pixels.data() +
           (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 3;
}

const std::uint8_t* Image::at(int x, int y) const {
    return pixels.data() +
           (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 3;
}

} // namespace render
