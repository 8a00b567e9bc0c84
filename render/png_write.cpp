// stb's own deflate takes longer than drawing the picture. zlib at its fastest level, and one fixed filter
// (Up) instead of trying all five on every row, is five times faster and smaller.
#include "render/image.h"

#include <cstdio>
#include <cstdlib>

#include <zlib.h>

namespace {

unsigned char* compress_fast(unsigned char* data, int size, int* compressed_size, int) {
    uLongf length = compressBound(static_cast<uLong>(size));
    auto* buffer = static_cast<unsigned char*>(std::malloc(length));
    if (buffer == nullptr) {
        return nullptr;
    }
    if (compress2(buffer, &length, data, static_cast<uLong>(size), 1) != Z_OK) {
        std::free(buffer);
        return nullptr;
    }
    *compressed_size = static_cast<int>(length);
    return buffer;
}

} // namespace

#define STBIW_ZLIB_COMPRESS compress_fast
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace render {

bool write_png(const std::string& path, const Image& image, std::string& error) {
    if (image.width <= 0 || image.height <= 0) {
        error = "an image without pixels cannot be written to " + path;
        return false;
    }
    stbi_write_force_png_filter = 2;
    int size = 0;
    unsigned char* file_bytes =
        stbi_write_png_to_mem(image.pixels.data(), image.width * 3, image.width, image.height, 3, &size);
    if (file_bytes == nullptr) {
        error = "there is not enough memory to encode " + path;
        return false;
    }
    // Written beside its place and moved there, so that whoever reads the folder never sees half a picture.
    const std::string partial = path + ".part";
    std::FILE* file = std::fopen(partial.c_str(), "wb");
    bool written = false;
    if (file != nullptr) {
        written = std::fwrite(file_bytes, 1, static_cast<std::size_t>(size), file) ==
                  static_cast<std::size_t>(size);
        written = std::fclose(file) == 0 && written;
    }
    std::free(file_bytes);
    if (!written || std::rename(partial.c_str(), path.c_str()) != 0) {
        std::remove(partial.c_str());
        error = "the picture " + path + " cannot be written";
        return false;
    }
    return true;
}

} // namespace render
