#include "render/sun_view.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace render {

SunView sun_view_of(const std::vector<glm::vec3>& casters, glm::vec3 to_sun) {
    const glm::vec3 back = glm::normalize(to_sun);
    const glm::vec3 reference =
        std::abs(back.y) < 0.95f ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(0.0f, 0.0f, 1.0f);
    const glm::vec3 right = glm::normalize(glm::cross(reference, back));
    const glm::vec3 up = glm::cross(back, right);

    glm::vec3 low(0.0f);
    glm::vec3 high(0.0f);
    for (std::size_t i = 0; i < casters.size(); ++i) {
        const glm::vec3 point(glm::dot(casters[i], right), glm::dot(casters[i], up),
                              glm::dot(casters[i], back));
        low = i == 0 ? point : glm::min(low, point);
        high = i == 0 ? point : glm::max(high, point);
    }
    // The width goes up in steps and the centre moves by whole texels of the coarser map, so that shadows do
    // not swim from one picture of a film to the next. The margin holds the widest penumbra.
    constexpr float margin = 0.2f;
    constexpr float width_step = 0.5f;
    constexpr float coarse_texels = 512.0f;
    SunView view;
    const float needed = std::fmax(high.x - low.x, high.y - low.y) + 2.0f * margin;
    view.width = std::ceil(needed * (1.0f + 2.0f / coarse_texels) / width_step) * width_step;
    const float texel = view.width / coarse_texels;
    const float centre_x = std::round((low.x + high.x) * 0.5f / texel) * texel;
    const float centre_y = std::round((low.y + high.y) * 0.5f / texel) * texel;
    const float nearest = high.z + margin;
    view.depth_range = nearest - low.z + margin;

    const float scale = 2.0f / view.width;
    const float depth_scale = 2.0f / view.depth_range;
    glm::mat4& m = view.projection;
    for (int axis = 0; axis < 3; ++axis) {
        m[axis] = glm::vec4(right[axis] * scale, up[axis] * scale, -back[axis] * depth_scale, 0.0f);
    }
    m[3] = glm::vec4(-centre_x * scale, -centre_y * scale, nearest * depth_scale - 1.0f, 1.0f);
    return view;
}

} // namespace render
