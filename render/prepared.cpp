#include "render/prepared.h"

#include <algorithm>
#include <cmath>

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "render/targets.h"

namespace render {
namespace {

void add_draw(Prepared& prepared, Surface surface, std::size_t index, const glm::mat4& model,
              std::size_t first, bool casts, bool closed) {
    prepared.draws.push_back({surface, index, model, static_cast<std::uint32_t>(first),
                              static_cast<std::uint32_t>(prepared.mesh.indices.size() - first), casts,
                              closed});
}

} // namespace

void prepare(const Frame& frame, Prepared& prepared) {
    prepared.mesh.clear();
    prepared.draws.clear();
    const float endless = std::min(frame.camera.far_plane, 400.0f);
    for (std::size_t i = 0; i < frame.shapes.size(); ++i) {
        const Shape& shape = frame.shapes[i];
        const std::size_t first = prepared.mesh.indices.size();
        if (shape.kind == ShapeKind::plane) {
            append_plane(prepared.mesh, shape, frame.camera.eye, endless);
            add_draw(prepared, Surface::ground, i, shape.matrix, first, !shape.endless, shape.endless);
        } else {
            append_shape(prepared.mesh, shape);
            add_draw(prepared, Surface::solid, i, shape.matrix, first, true, true);
        }
    }
    for (std::size_t i = 0; i < frame.cloths.size(); ++i) {
        const std::size_t first = prepared.mesh.indices.size();
        append_cloth(prepared.mesh, frame.cloths[i]);
        add_draw(prepared, Surface::cloth, i, glm::mat4(1.0f), first, true, true);
    }
    for (std::size_t i = 0; i < frame.ropes.size(); ++i) {
        const std::size_t first = prepared.mesh.indices.size();
        append_rope(prepared.mesh, frame.ropes[i]);
        add_draw(prepared, Surface::rope, i, glm::mat4(1.0f), first, true, true);
    }
    std::vector<glm::vec3> casters;
    for (const Draw& draw : prepared.draws) {
        if (draw.casts) {
            for (std::uint32_t i = draw.first; i < draw.first + draw.count; ++i) {
                const glm::vec3 point = prepared.mesh.vertices[prepared.mesh.indices[i]].position;
                casters.push_back(draw.surface == Surface::cloth || draw.surface == Surface::rope
                                      ? point
                                      : glm::vec3(draw.model * glm::vec4(point, 1.0f)));
            }
        }
    }
    prepared.sun = sun_view_of(casters, frame.to_sun);
}

SceneBlock describe_scene(const Frame& frame, const SunView& sun, int width, int height) {
    const Camera& camera = frame.camera;
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    const float fov = glm::radians(camera.vertical_fov_degrees);
    const float distance = glm::distance(camera.eye, camera.target);
    SceneBlock block;
    block.view = glm::lookAt(camera.eye, camera.target, camera.up);
    const glm::mat4 projection = glm::perspective(fov, aspect, camera.near_plane, camera.far_plane);
    block.view_projection = projection * block.view;
    // Without the eye's place, so that a far-off eye costs no precision.
    glm::mat4 turn = block.view;
    turn[3] = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    block.view_ray = glm::inverse(projection * turn);
    block.sun_projection = sun.projection;
    block.eye = glm::vec4(camera.eye, 1.0f);
    block.to_sun = glm::vec4(glm::normalize(frame.to_sun), 0.0f);
    block.sun_scale =
        glm::vec4(sun.width / static_cast<float>(Targets::shadow_size),
                  sun.width / static_cast<float>(Targets::shadow_size >> 2), sun.depth_range, 0.0f);
    block.haze = glm::vec4(frame.fade_distance > 0.0f ? frame.fade_distance : 5.0f * distance + 8.0f, 0.0f,
                           0.0f, 0.0f);
    block.screen =
        glm::vec4(width, height, 1.0f / static_cast<float>(width), 1.0f / static_cast<float>(height));
    const float tangent = std::tan(fov * 0.5f);
    block.lens = glm::vec4(tangent * aspect, tangent, std::clamp(distance * 0.085f, 0.05f, 1.0f), 0.0f);
    return block;
}

} // namespace render
