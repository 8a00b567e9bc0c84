// Everything that is drawn into: shadow maps, the half-size occlusion passes, the multisampled picture and
// what it is resolved to.
#pragma once

#include <string>

#include "render/gl_functions.h"

namespace render {

struct Targets {
    static constexpr int shadow_levels = 4;
    static constexpr int shadow_size = 2048; // of level 0; each further level has half
    static constexpr int shadow_blocks = 64; // across; each holds 8x8 texels of level 2

    int width = 0;
    int height = 0;
    int half_width = 0;
    int half_height = 0;

    GLuint shadow_map = 0;
    GLuint block_range_map = 0;  // nearest and farthest depth of a block
    GLuint shadow_range_map = 0; // and of a block with its neighbours
    GLuint geometry_map = 0;     // world normal and view depth, half size
    GLuint rough_occlusion_map = 0;
    GLuint occlusion_map = 0;

    GLuint shadow[shadow_levels] = {}; // framebuffers
    GLuint block_range = 0;
    GLuint shadow_range = 0;
    GLuint geometry = 0;
    GLuint rough_occlusion = 0;
    GLuint occlusion = 0;
    GLuint picture = 0;
    GLuint resolved = 0;

    GLuint compare_sampler = 0; // a depth map as a shadow
    GLuint depth_sampler = 0;   // the same map as plain depths

    // False with a sentence when a size is beyond the driver or a framebuffer is refused.
    bool create(const GlFunctions& gl, int picture_width, int picture_height, int samples,
                std::string& error);
    void destroy(const GlFunctions& gl);

private:
    GLuint geometry_depth_ = 0; // renderbuffers
    GLuint picture_colour_ = 0;
    GLuint picture_depth_ = 0;
    GLuint resolved_colour_ = 0;
};

} // namespace render
