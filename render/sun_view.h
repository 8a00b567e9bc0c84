// The sun's camera: an orthographic view that just holds what can cast a shadow.
#pragma once

#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace render {

struct SunView {
    glm::mat4 projection{1.0f}; // world to clip space
    float width = 1.0f;         // metres across, both ways
    float depth_range = 1.0f;   // metres
};

// Without casters the view is one metre around the origin.
SunView sun_view_of(const std::vector<glm::vec3>& casters, glm::vec3 to_sun);

} // namespace render
