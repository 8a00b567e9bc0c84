// What every shader knows of the picture. struct SceneBlock in scene_block_data.h is the same in C++.
#pragma once

namespace render::shaders {

inline constexpr char version[] = "#version 330 core\n";

inline constexpr char scene_block[] = R"(
layout(std140) uniform Scene {
    mat4 view_projection;
    mat4 view;
    mat4 view_ray;       // clip space to world direction
    mat4 sun_projection; // world to the sun's clip space
    vec4 eye;
    vec4 to_sun;         // unit
    vec4 sun_scale;      // metres; x, y: a texel of the shadow map's levels 0 and 2; z: its depth range
    vec4 haze;           // x: distance at which it takes over
    vec4 screen;         // width, height, 1/width, 1/height
    vec4 lens;           // x, y: tangents of half the field of view; z: occlusion radius in metres
};
)";

// Daylight: a warm key, a cool sky, and what the ground gives back.
inline constexpr char daylight[] = R"(
const vec3 sun_light = vec3(1.48, 1.32, 1.10);
const vec3 sky_light = vec3(0.35, 0.405, 0.50);
const vec3 ground_light = vec3(0.22, 0.20, 0.18);
const vec3 horizon_colour = vec3(0.60, 0.63, 0.655);
const vec3 zenith_colour = vec3(0.10, 0.205, 0.385);

vec3 sky_colour(vec3 direction) {
    float height = clamp(direction.y, 0.0, 1.0);
    vec3 sky = mix(horizon_colour, zenith_colour, 1.0 - pow(1.0 - height, 2.6));
    float towards = max(dot(direction, to_sun.xyz), 0.0);
    return sky + vec3(0.16, 0.12, 0.07) * pow(towards, 6.0);
}

// Values up to the knee are left as they are, so a colour stays the colour that was chosen; above it,
// brightness runs smoothly towards white and never reaches it.
vec3 develop(vec3 light) {
    const float knee = 0.55;
    float peak = max(max(light.r, light.g), max(light.b, 1e-6));
    float pressed = peak <= knee ? peak : knee + (1.0 - knee) * (1.0 - exp(-(peak - knee) / (1.0 - knee)));
    vec3 colour = light * (pressed / peak);
    float paling = smoothstep(knee, 4.0, peak);
    return mix(colour, vec3(pressed), 0.35 * paling);
}
)";

} // namespace render::shaders
