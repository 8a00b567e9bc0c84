// Ambient occlusion in screen space, at half size: what darkens a fold, and the ground where something lies
// on it.
#pragma once

namespace render::shaders {

// World normal and view depth of what is nearest.
inline constexpr char geometry_fragment[] = R"(
in vec3 position;
in vec3 normal;
layout(location = 0) out vec4 geometry;
void main() {
    geometry = vec4(normalize(normal), -(view * vec4(position, 1.0)).z);
}
)";

// Samples on a spiral around the pixel, out to a radius fixed in metres. Each counts by how far it rises over
// the tangent plane against its distance, and fades out at the radius. The spiral is turned by one of sixteen
// fixed angles; the 4x4 box that follows takes exactly that pattern out again.
inline constexpr char occlusion_fragment[] = R"(
uniform sampler2D geometry_map;
layout(location = 0) out vec4 visibility;

vec3 view_point(vec2 at, float depth) {
    return vec3((at * 2.0 - 1.0) * lens.xy * depth, -depth);
}

void main() {
    ivec2 cell = ivec2(gl_FragCoord.xy);
    ivec2 size = textureSize(geometry_map, 0);
    vec4 here = texelFetch(geometry_map, cell, 0);
    if (here.w > 1e5) {
        visibility = vec4(1.0);
        return;
    }
    vec3 centre = view_point((vec2(cell) + 0.5) / vec2(size), here.w);
    vec3 outward = normalize(mat3(view) * here.xyz);
    float radius = lens.z;
    float pixels = min(radius / (here.w * lens.y) * 0.5 * float(size.y), 0.16 * float(size.y));
    const int samples = 14;
    int order[16] = int[16](0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5);
    float turn = float(order[(cell.x & 3) + 4 * (cell.y & 3)]) * (6.2831853 / 16.0);
    float sum = 0.0;
    for (int i = 0; i < samples; ++i) {
        float share = (float(i) + 0.5) / float(samples);
        float angle = turn + float(i) * 2.3999632;
        vec2 offset = vec2(cos(angle), sin(angle)) * (share * pixels);
        ivec2 other = clamp(cell + ivec2(round(offset)), ivec2(0), size - 1);
        float depth = texelFetch(geometry_map, other, 0).w;
        vec3 apart = view_point((vec2(other) + 0.5) / vec2(size), depth) - centre;
        float squared = dot(apart, apart);
        float rise = max(dot(apart, outward) - 0.002 * here.w, 0.0);
        float fade = max(1.0 - squared / (radius * radius), 0.0);
        sum += fade * rise / (sqrt(squared) + 1e-4);
    }
    float open = 1.0 - 2.3 * sum / float(samples);
    visibility = vec4(clamp(open, 0.12, 1.0));
}
)";

inline constexpr char occlusion_smooth_fragment[] = R"(
uniform sampler2D geometry_map;
uniform sampler2D rough_map;
layout(location = 0) out vec4 visibility;

void main() {
    ivec2 cell = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(geometry_map, 0) - 1;
    float depth = texelFetch(geometry_map, cell, 0).w;
    float sum = 0.0;
    float weights = 0.0;
    for (int y = -2; y < 2; ++y) {
        for (int x = -2; x < 2; ++x) {
            ivec2 other = clamp(cell + ivec2(x, y), ivec2(0), last);
            float apart = (texelFetch(geometry_map, other, 0).w - depth) / (0.03 * depth);
            float weight = 1.0 / (1.0 + apart * apart * 8.0);
            sum += weight * texelFetch(rough_map, other, 0).r;
            weights += weight;
        }
    }
    visibility = vec4(sum / weights);
}
)";

} // namespace render::shaders
