#include "render/frame.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace render {
namespace {

bool finite(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool finite(const std::vector<float>& values) {
    for (const float value : values) {
        if (!std::isfinite(value)) {
            return false;
        }
    }
    return true;
}

bool positive(float value) {
    return std::isfinite(value) && value > 0.0f;
}

std::string number(std::size_t value) {
    return std::to_string(value);
}

bool validate_camera(const Camera& camera, std::string& error) {
    if (!finite(camera.eye) || !finite(camera.target) || !finite(camera.up)) {
        error = "the camera has a coordinate that is not finite";
        return false;
    }
    const glm::vec3 forward = camera.target - camera.eye;
    if (glm::length(forward) < 1e-6f) {
        error = "the camera's eye and target are the same point";
        return false;
    }
    if (glm::length(glm::cross(forward, camera.up)) < 1e-6f * glm::length(forward)) {
        error = "the camera looks along its own up direction";
        return false;
    }
    if (!(camera.vertical_fov_degrees >= 1.0f && camera.vertical_fov_degrees <= 150.0f)) {
        error = "the camera's field of view " + std::to_string(camera.vertical_fov_degrees) +
                " is not 1 to 150 degrees";
        return false;
    }
    if (!positive(camera.near_plane) || !std::isfinite(camera.far_plane) ||
        camera.far_plane <= camera.near_plane) {
        error = "the camera's near and far planes are not 0 < near < far";
        return false;
    }
    return true;
}

bool validate_cloth(const Cloth& cloth, std::size_t index, std::string& error) {
    const std::string name = "cloth " + number(index);
    const std::size_t vertices = cloth.positions.size() / 3;
    if (vertices == 0 || cloth.positions.size() % 3 != 0) {
        error = name + " has " + number(cloth.positions.size()) +
                " coordinates, which is not three for each vertex";
        return false;
    }
    if (!cloth.normals.empty() && cloth.normals.size() != cloth.positions.size()) {
        error = name + " has " + number(cloth.normals.size() / 3) + " normals for " + number(vertices) +
                " vertices";
        return false;
    }
    if (cloth.texture.size() != vertices * 2) {
        error = name + " has " + number(cloth.texture.size() / 2) + " texture coordinates for " +
                number(vertices) + " vertices";
        return false;
    }
    if (cloth.triangles.size() % 3 != 0) {
        error = name + " has " + number(cloth.triangles.size()) +
                " indices, which is not three for each triangle";
        return false;
    }
    for (const std::uint32_t vertex : cloth.triangles) {
        if (vertex >= vertices) {
            error = name + " has a triangle with vertex " + number(vertex) + " but only " + number(vertices) +
                    " vertices";
            return false;
        }
    }
    if (!finite(cloth.positions) || !finite(cloth.normals) || !finite(cloth.texture)) {
        error = name + " has a coordinate that is not finite";
        return false;
    }
    if (!positive(cloth.thickness) || !positive(cloth.front.repeat) || !positive(cloth.back.repeat)) {
        error = name + " has a thickness or pattern repeat that is not above 0";
        return false;
    }
    return true;
}

bool validate_rope(const Rope& rope, std::size_t index, std::string& error) {
    const std::string name = "rope " + number(index);
    const std::size_t points = rope.positions.size() / 3;
    if (points < 2 || rope.positions.size() % 3 != 0) {
        error = name + " has " + number(rope.positions.size()) +
                " coordinates, which is not three for two or more points";
        return false;
    }
    if (!rope.rest_arc.empty() && rope.rest_arc.size() != points) {
        error =
            name + " has " + number(rope.rest_arc.size()) + " rest lengths for " + number(points) + " points";
        return false;
    }
    if (!finite(rope.positions) || !finite(rope.rest_arc)) {
        error = name + " has a coordinate that is not finite";
        return false;
    }
    if (!positive(rope.radius) || !std::isfinite(rope.lay_length) || rope.lay_length < 0.0f ||
        !std::isfinite(rope.whipping_length)) {
        error = name + " has a radius, lay length or whipping length that is out of range";
        return false;
    }
    if (rope.strands < 1 || rope.strands > 16) {
        error = name + " has " + number(rope.strands) + " strands, which is not 1 to 16";
        return false;
    }
    return true;
}

bool validate_shape(const Shape& shape, std::size_t index, std::string& error) {
    const std::string name = "shape " + number(index);
    for (int column = 0; column < 4; ++column) {
        if (!finite(glm::vec3(shape.matrix[column]))) {
            error = name + " has a matrix that is not finite";
            return false;
        }
    }
    const bool round = shape.kind == ShapeKind::sphere || shape.kind == ShapeKind::capsule;
    if (round && (!positive(shape.radius) || !std::isfinite(shape.half_length) || shape.half_length < 0.0f)) {
        error = name + " has a radius or half length that is out of range";
        return false;
    }
    const glm::vec3 half = shape.half_extents;
    const bool sized = shape.kind == ShapeKind::box || (shape.kind == ShapeKind::plane && !shape.endless);
    if (sized && (!finite(half) || !positive(half.x) || !positive(half.z) ||
                  (shape.kind == ShapeKind::box && !positive(half.y)))) {
        error = name + " has half extents that are not above 0";
        return false;
    }
    return true;
}

} // namespace

bool validate(const Frame& frame, std::string& error) {
    if (!validate_camera(frame.camera, error)) {
        return false;
    }
    if (!finite(frame.to_sun) || glm::length(frame.to_sun) < 1e-6f) {
        error = "the direction to the sun has no length";
        return false;
    }
    if (!std::isfinite(frame.fade_distance) || frame.fade_distance < 0.0f) {
        error = "the fade distance is below 0";
        return false;
    }
    for (std::size_t i = 0; i < frame.cloths.size(); ++i) {
        if (!validate_cloth(frame.cloths[i], i, error)) {
            return false;
        }
    }
    for (std::size_t i = 0; i < frame.ropes.size(); ++i) {
        if (!validate_rope(frame.ropes[i], i, error)) {
            return false;
        }
    }
    for (std::size_t i = 0; i < frame.shapes.size(); ++i) {
        if (!validate_shape(frame.shapes[i], i, error)) {
            return false;
        }
    }
    return true;
}

} // namespace render
