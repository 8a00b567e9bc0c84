// Matte solids, the ground with its grid, and the sky.
#pragma once

namespace render::shaders {

inline constexpr char solid_fragment[] = R"(
in vec3 position;
in vec3 normal;
in vec3 axis; // local position
uniform vec4 colour; // w: marking
layout(location = 0) out vec4 pixel;

void main() {
    // Octants alternate; each boundary is softened over a pixel by its own distance.
    vec3 width = max(fwidth(axis), vec3(1e-6));
    vec3 sides = clamp(axis / width, -1.0, 1.0);
    float octant = sides.x * sides.y * sides.z;
    Surface s;
    s.position = position;
    s.normal = normalize(normal);
    s.outward = s.normal;
    s.albedo = colour.rgb * (1.0 - colour.w * 0.45 * (0.5 + 0.5 * octant));
    s.crease = 1.0;
    s.gloss = 0.10;
    s.sheen = 0.0;
    s.translucency = 0.0;
    s.depth_through = 0.0;
    pixel = vec4(develop(add_haze(light_surface(s), position)), 1.0);
}
)";

inline constexpr char ground_fragment[] = R"(
in vec3 position;
in vec3 normal;
in vec2 texture_point;
uniform vec4 colour; // w: 1 for an endless plane
layout(location = 0) out vec4 pixel;

float grid(vec2 at, vec2 width, float line) {
    float x = band(at.x + 0.5 * line, line, width.x);
    float y = band(at.y + 0.5 * line, line, width.y);
    return x + y - x * y;
}

void main() {
    vec2 width = footprint(texture_point);
    float fine = grid(texture_point * 4.0, width * 4.0, 0.020);
    float metre = grid(texture_point, width, 0.012);
    float fine_seen = 1.0 - smoothstep(0.02, 0.12, max(width.x, width.y));
    vec3 albedo = colour.rgb;
    albedo = mix(albedo, albedo * 0.78, fine * fine_seen * 0.55);
    albedo = mix(albedo, albedo * 0.52, metre);
    Surface s;
    s.position = position;
    s.normal = normalize(normal);
    s.outward = s.normal;
    s.albedo = albedo;
    s.crease = 1.0;
    s.gloss = 0.0;
    s.sheen = 0.0;
    s.translucency = 0.0;
    s.depth_through = 0.0;
    vec3 lit = light_surface(s);
    pixel = vec4(develop(add_haze(lit, position)), 1.0);
}
)";

inline constexpr char sky_fragment[] = R"(
in vec2 clip;
layout(location = 0) out vec4 pixel;
void main() {
    vec4 ray = view_ray * vec4(clip, 1.0, 1.0);
    pixel = vec4(develop(sky_colour(normalize(ray.xyz))), 1.0);
}
)";

inline constexpr char nothing_fragment[] = R"(
void main() {}
)";

} // namespace render::shaders
