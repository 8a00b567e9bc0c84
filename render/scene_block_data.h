// The C++ side of the uniform block in shaders/scene_block.h: vec4s and mat4s only, so std140 adds no
// padding.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace render {

struct SceneBlock {
    glm::mat4 view_projection;
    glm::mat4 view;
    glm::mat4 view_ray;
    glm::mat4 sun_projection;
    glm::vec4 eye;
    glm::vec4 to_sun;
    glm::vec4 sun_scale;
    glm::vec4 haze;
    glm::vec4 screen;
    glm::vec4 lens;
};
static_assert(sizeof(SceneBlock) == 4 * 64 + 6 * 16);

} // namespace render
