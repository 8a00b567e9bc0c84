// Vertex stages.
#pragma once

namespace render::shaders {

// Everything with a surface: cloths and ropes come in world space with the identity as their matrix.
inline constexpr char surface_vertex[] = R"(
layout(location = 0) in vec3 vertex_position;
layout(location = 1) in vec3 vertex_normal;
layout(location = 2) in vec3 vertex_axis;
layout(location = 3) in vec2 vertex_texture;
layout(location = 4) in float vertex_part;
uniform mat4 model;
out vec3 position;
out vec3 normal;
out vec3 axis;
out vec2 texture_point;
out float part;
void main() {
    vec4 world = model * vec4(vertex_position, 1.0);
    position = world.xyz;
    normal = mat3(model) * vertex_normal;
    axis = vertex_axis;
    texture_point = vertex_texture;
    part = vertex_part;
    gl_Position = view_projection * world;
}
)";

inline constexpr char sun_vertex[] = R"(
layout(location = 0) in vec3 vertex_position;
uniform mat4 model;
void main() {
    gl_Position = sun_projection * (model * vec4(vertex_position, 1.0));
}
)";

// One triangle that covers the screen, without a buffer.
inline constexpr char screen_vertex[] = R"(
out vec2 clip;
void main() {
    clip = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(clip, 1.0, 1.0);
}
)";

} // namespace render::shaders
