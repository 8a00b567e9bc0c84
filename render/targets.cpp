#include "render/targets.h"

#include <algorithm>
#include <iterator>

namespace render {
namespace {

GLuint new_texture(const GlFunctions& gl, GLint format, int width, int height, GLenum layout, GLenum type) {
    GLuint texture = 0;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, layout, type, nullptr);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

GLuint new_renderbuffer(const GlFunctions& gl, GLenum format, int width, int height, int samples) {
    GLuint buffer = 0;
    gl.GenRenderbuffers(1, &buffer);
    gl.BindRenderbuffer(GL_RENDERBUFFER, buffer);
    if (samples > 0) {
        gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
    } else {
        gl.RenderbufferStorage(GL_RENDERBUFFER, format, width, height);
    }
    return buffer;
}

GLuint new_framebuffer(const GlFunctions& gl) {
    GLuint framebuffer = 0;
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    return framebuffer;
}

bool complete(const GlFunctions& gl, const char* name, std::string& error) {
    const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        error = std::string("the driver refuses the ") + name + " framebuffer with status " +
                std::to_string(status);
        return false;
    }
    return true;
}

// Mip levels that are drawn, each by itself: reducing depths would not give the depths of a smaller map.
GLuint new_shadow_map(const GlFunctions& gl) {
    GLuint texture = 0;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    for (int level = 0; level < Targets::shadow_levels; ++level) {
        const int size = Targets::shadow_size >> level;
        gl.TexImage2D(GL_TEXTURE_2D, level, GL_DEPTH_COMPONENT24, size, size, 0, GL_DEPTH_COMPONENT,
                      GL_UNSIGNED_INT, nullptr);
    }
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, Targets::shadow_levels - 1);
    return texture;
}

GLuint new_shadow(const GlFunctions& gl, GLuint map, int level) {
    const GLuint framebuffer = new_framebuffer(gl);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, map, level);
    gl.DrawBuffer(GL_NONE);
    gl.ReadBuffer(GL_NONE);
    return framebuffer;
}

GLuint new_map(const GlFunctions& gl, GLuint map) {
    const GLuint framebuffer = new_framebuffer(gl);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, map, 0);
    return framebuffer;
}

GLuint new_shadow_sampler(const GlFunctions& gl, bool compare) {
    GLuint sampler = 0;
    gl.GenSamplers(1, &sampler);
    gl.SamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER,
                         compare ? GL_LINEAR_MIPMAP_NEAREST : GL_NEAREST_MIPMAP_NEAREST);
    gl.SamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, compare ? GL_LINEAR : GL_NEAREST);
    // Beyond the map nothing stands between a point and the sun.
    const GLfloat far_away[4] = {1.0f, 1.0f, 1.0f, 1.0f};
    gl.SamplerParameteri(sampler, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    gl.SamplerParameteri(sampler, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    gl.SamplerParameterfv(sampler, GL_TEXTURE_BORDER_COLOR, far_away);
    if (compare) {
        gl.SamplerParameteri(sampler, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        gl.SamplerParameteri(sampler, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    }
    return sampler;
}

} // namespace

bool Targets::create(const GlFunctions& gl, int picture_width, int picture_height, int samples,
                     std::string& error) {
    GLint largest = 0;
    GLint most_samples = 0;
    gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    gl.GetIntegerv(GL_MAX_SAMPLES, &most_samples);
    largest = std::min(largest, 16384);
    if (picture_width < 16 || picture_height < 16 || picture_width > largest || picture_height > largest) {
        error = "a picture of " + std::to_string(picture_width) + "x" + std::to_string(picture_height) +
                " pixels is not within 16 to " + std::to_string(largest) + " each way";
        return false;
    }
    width = picture_width;
    height = picture_height;
    half_width = (width + 1) / 2;
    half_height = (height + 1) / 2;
    const int used_samples = std::clamp(samples, 0, static_cast<int>(most_samples));

    shadow_map = new_shadow_map(gl);
    block_range_map = new_texture(gl, GL_RG32F, shadow_blocks, shadow_blocks, GL_RG, GL_FLOAT);
    shadow_range_map = new_texture(gl, GL_RG32F, shadow_blocks, shadow_blocks, GL_RG, GL_FLOAT);
    geometry_map = new_texture(gl, GL_RGBA32F, half_width, half_height, GL_RGBA, GL_FLOAT);
    rough_occlusion_map = new_texture(gl, GL_R16F, half_width, half_height, GL_RED, GL_FLOAT);
    occlusion_map = new_texture(gl, GL_R16F, half_width, half_height, GL_RED, GL_FLOAT);
    compare_sampler = new_shadow_sampler(gl, true);
    depth_sampler = new_shadow_sampler(gl, false);

    for (int level = 0; level < shadow_levels; ++level) {
        shadow[level] = new_shadow(gl, shadow_map, level);
        if (!complete(gl, "shadow", error)) {
            return false;
        }
    }
    block_range = new_map(gl, block_range_map);
    if (!complete(gl, "block range", error)) {
        return false;
    }
    shadow_range = new_map(gl, shadow_range_map);
    if (!complete(gl, "shadow range", error)) {
        return false;
    }

    geometry = new_map(gl, geometry_map);
    geometry_depth_ = new_renderbuffer(gl, GL_DEPTH_COMPONENT24, half_width, half_height, 0);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, geometry_depth_);
    if (!complete(gl, "geometry", error)) {
        return false;
    }
    rough_occlusion = new_map(gl, rough_occlusion_map);
    if (!complete(gl, "rough occlusion", error)) {
        return false;
    }
    occlusion = new_map(gl, occlusion_map);
    if (!complete(gl, "occlusion", error)) {
        return false;
    }

    picture = new_framebuffer(gl);
    picture_colour_ = new_renderbuffer(gl, GL_SRGB8_ALPHA8, width, height, used_samples);
    picture_depth_ = new_renderbuffer(gl, GL_DEPTH_COMPONENT24, width, height, used_samples);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, picture_colour_);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, picture_depth_);
    if (!complete(gl, "multisampled", error)) {
        return false;
    }
    resolved = new_framebuffer(gl);
    resolved_colour_ = new_renderbuffer(gl, GL_SRGB8_ALPHA8, width, height, 0);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, resolved_colour_);
    return complete(gl, "resolved", error);
}

void Targets::destroy(const GlFunctions& gl) {
    const GLuint framebuffers[] = {shadow[0],   shadow[1],    shadow[2], shadow[3],
                                   block_range, shadow_range, geometry,  rough_occlusion,
                                   occlusion,   picture,      resolved};
    const GLuint textures[] = {shadow_map,   block_range_map,     shadow_range_map,
                               geometry_map, rough_occlusion_map, occlusion_map};
    const GLuint renderbuffers[] = {geometry_depth_, picture_colour_, picture_depth_, resolved_colour_};
    const GLuint samplers[] = {compare_sampler, depth_sampler};
    gl.DeleteFramebuffers(static_cast<GLsizei>(std::size(framebuffers)), framebuffers);
    gl.DeleteTextures(static_cast<GLsizei>(std::size(textures)), textures);
    gl.DeleteRenderbuffers(static_cast<GLsizei>(std::size(renderbuffers)), renderbuffers);
    gl.DeleteSamplers(static_cast<GLsizei>(std::size(samplers)), samplers);
    *this = Targets();
}

} // namespace render
