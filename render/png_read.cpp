#include "render/image.h"

#include <algorithm>

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#endif
#include <stb/stb_image.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace render {

bool read_png(const std::string& path, Image& image, std::string& error) {
    int width = 0;
    int height = 0;
    int channels = 0;
    unsigned char* data = stbi_load(path.c_str(), &width, &height, &channels, 3);
    if (data == nullptr) {
        error = "the picture " + path + " cannot be read: " + stbi_failure_reason();
        return false;
    }
    Image loaded(width, height);
    std::copy(data, data + loaded.pixels.size(), loaded.pixels.begin());
    stbi_image_free(data);
    image = std::move(loaded);
    return true;
}

} // namespace render
