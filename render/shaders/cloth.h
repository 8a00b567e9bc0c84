// Cloth: a pattern in material coordinates on each side, threads close up, light through the sheet.
#pragma once

namespace render::shaders {

inline constexpr char cloth_fragment[] = R"(
in vec3 position;
in vec3 normal;
in vec2 texture_point;
in float part;
uniform vec4 front_colours[3]; // rgb; [0].w: pattern, [1].w: repeat in metres
uniform vec4 back_colours[3];
uniform float thickness;
uniform float translucency;
layout(location = 0) out vec4 pixel;

// Threads, warp over weft in a chequer: the product of two filtered square waves is the filtered chequer.
float warp_over(vec2 thread, vec2 width) {
    return 0.5 + 0.5 * (2.0 * band(thread.x * 0.5, 0.5, width.x * 0.5) - 1.0) *
                     (2.0 * band(thread.y * 0.5, 0.5, width.y * 0.5) - 1.0);
}

// A thread is round, and darkens where it dives under its neighbour; from afar the mean is left.
float thread_shade(vec2 thread, vec2 width, float over) {
    vec2 across = 2.0 * fract(thread) - 1.0;
    float dive = mix(across.x * across.x, across.y * across.y, over);
    float edge = mix(across.y * across.y, across.x * across.x, over);
    float shade = 1.0 - 0.30 * dive * dive - 0.18 * edge * edge;
    float seen = 1.0 - smoothstep(0.15, 0.6, max(width.x, width.y));
    return mix(0.90, shade, seen);
}

vec3 patterned(vec2 at, vec2 width, vec3 first, vec3 second, vec3 accent, int kind, float repeat) {
    vec2 p = at / repeat;
    vec2 w = width / repeat;
    float threads = kind == 3 ? 16.0 : 48.0; // a repeat
    float over = warp_over(p * threads, w * threads);
    float shade = thread_shade(p * threads, w * threads, over);
    vec3 colour = first;
    if (kind == 1) {
        colour = mix(second, first, band(p.y, 0.5, w.y));
    } else if (kind == 2) {
        colour = mix(second, first, 0.5 * (band(p.x, 0.5, w.x) + band(p.y, 0.5, w.y)));
    } else if (kind == 3) {
        // The first two threads of each repeat have the second colour: panes that show how far the
        // material is stretched. Weft is a shade darker than warp.
        vec3 warp = mix(first, second, band(p.x, 0.125, w.x));
        vec3 weft = mix(first * 0.86, second, band(p.y, 0.125, w.y));
        colour = mix(weft, warp, over);
    } else if (kind == 4) {
        colour = mix(second, first, 0.5 * (band(p.x, 0.5, w.x) + band(p.y, 0.5, w.y)));
        float dark = 0.5 * (band(p.x - 0.20, 0.10, w.x) + band(p.y - 0.20, 0.10, w.y));
        float line = 0.5 * (band(p.x - 0.72, 0.06, w.x) + band(p.y - 0.72, 0.06, w.y));
        colour = mix(mix(colour, colour * 0.35, dark), accent, line);
    }
    return colour * shade;
}

void main() {
    vec2 width = footprint(texture_point);
    vec3 colour;
    if (part < 0.5) {
        colour = patterned(texture_point, width, front_colours[0].rgb, front_colours[1].rgb,
                           front_colours[2].rgb, int(front_colours[0].w), front_colours[1].w);
    } else {
        colour = patterned(texture_point, width, back_colours[0].rgb, back_colours[1].rgb,
                           back_colours[2].rgb, int(back_colours[0].w), back_colours[1].w);
    }
    Surface s;
    s.position = position;
    s.normal = normalize(normal);
    s.outward = s.normal;
    s.albedo = colour;
    s.crease = 1.0;
    s.gloss = 0.04;
    s.sheen = 0.5;
    s.translucency = translucency;
    s.depth_through = thickness * 1.6 + 2.0 * sun_scale.x;
    pixel = vec4(develop(add_haze(light_surface(s), position)), 1.0);
}
)";

} // namespace render::shaders
