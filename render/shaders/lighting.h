// Shadows, light and haze, shared by all surfaces.
#pragma once

namespace render::shaders {

// Shadows harden towards contact: the mean distance to what blocks the sun gives the half-width of the
// penumbra; the map is drawn at four sizes, kept as mip levels, and 25 taps in the right one filter any of
// them. The kernel is a fixed tent, without noise, so a picture has no grain.
//
// A software rasteriser runs both sides of every branch but leaves a loop as soon as no pixel of its group is
// in it, hence loops with a count instead of ifs. The range map says for most pixels in one fetch that all
// around is lit or all around is dark, and then no loop runs.
inline constexpr char shadow[] = R"(
uniform sampler2DShadow sun_shadow;
uniform sampler2D sun_depth;
uniform sampler2D shadow_range;

float sun_visibility(vec3 point, vec3 outward) {
    const float fine_texel = 1.0 / 2048.0;
    const float coarse_texel = 1.0 / 512.0;
    const float sun_width = 0.030; // penumbra half-width for a metre of distance
    const float widest = 0.14;     // metres
    float slope = 1.0 - max(dot(outward, to_sun.xyz), 0.0);
    vec3 lifted = point + outward * (sun_scale.x * (1.0 + 1.5 * slope));
    vec3 at = (sun_projection * vec4(lifted, 1.0)).xyz * 0.5 + 0.5;
    vec2 range = textureLod(shadow_range, at.xy, 0.0).rg;
    float bias = 0.004 / sun_scale.z;
    float near = min(at.z, 1.0) - bias; // beyond the last caster nothing is stored but 1
    bool inside = all(greaterThan(at.xy, vec2(0.0))) && all(lessThan(at.xy, vec2(1.0)));
    bool lit = !inside || range.r >= near;
    bool dark = !lit && range.g < near - 0.03 / sun_scale.z;
    int taps = lit || dark ? 0 : 25;

    // How the depth of the surface's own plane changes across the map: without it a slanting surface would be
    // found to block itself.
    float width = sun_scale.x / fine_texel;
    vec2 across = (mat3(sun_projection) * outward).xy * (0.5 * width);
    vec2 gradient = across / max(dot(outward, to_sun.xyz), 0.2) * (width / sun_scale.z);

    float reach = clamp(widest / sun_scale.y, 1.5, 8.0) * 0.5 * coarse_texel;
    float blockers = 0.0;
    float height = 0.0;
    vec2 place = vec2(-2.0);
    for (int i = 0; i < taps; ++i) {
        float plane = at.z + dot(place, gradient) * reach;
        float found = textureLod(sun_depth, at.xy + place * reach, 2.0).r;
        float blocks = found < min(plane, 1.0) - bias ? 1.0 : 0.0;
        blockers += blocks;
        height += blocks * (plane - found);
        place.x += 1.0;
        place = place.x > 2.5 ? vec2(-2.0, place.y + 1.0) : place;
    }
    lit = lit || (taps > 0 && blockers < 0.5);
    float half_width = clamp(0.004 + height / max(blockers, 1.0) * sun_scale.z * sun_width, 0.0, widest);
    // The map whose texels make the step between taps half to one of them: bilinear taps leave no gaps.
    float step = max(half_width / (2.5 * sun_scale.x), 0.65);
    float level = clamp(ceil(log2(step)), 0.0, 3.0);
    float texel_depth = sun_scale.x * exp2(level) / sun_scale.z;
    step = min(step, 16.0) * fine_texel;
    at.z -= 0.5 * texel_depth * min(level, 1.0);
    taps = lit ? 0 : taps;
    float sum = 0.0;
    place = vec2(-2.0);
    for (int i = 0; i < taps; ++i) {
        vec2 weight = 3.0 - abs(place);
        vec3 tap = vec3(at.xy + place * step, min(at.z + dot(place, gradient) * step, 1.0));
        sum += weight.x * weight.y * textureLod(sun_shadow, tap, level);
        place.x += 1.0;
        place = place.x > 2.5 ? vec2(-2.0, place.y + 1.0) : place;
    }
    return lit ? 1.0 : dark ? 0.0 : sum * (1.0 / 81.0);
}
)";

// For every 8x8 block of the shadow map's level 2: the nearest and the farthest depth.
inline constexpr char shadow_range_fragment[] = R"(
uniform sampler2D sun_depth;
layout(location = 0) out vec4 range;
void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * 8;
    vec2 found = vec2(1.0, 0.0);
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
            float depth = texelFetch(sun_depth, first + ivec2(x, y), 2).r;
            found = vec2(min(found.x, depth), max(found.y, depth));
        }
    }
    range = vec4(found, 0.0, 0.0);
}
)";

// The same over each block and its neighbours: it then holds for everything within eight texels of any point.
inline constexpr char shadow_spread_fragment[] = R"(
uniform sampler2D block_range;
layout(location = 0) out vec4 range;
void main() {
    vec2 found = vec2(1.0, 0.0);
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            ivec2 block = ivec2(gl_FragCoord.xy) + ivec2(x, y);
            bool outside = any(lessThan(block, ivec2(0))) || any(greaterThan(block, ivec2(63)));
            vec2 depth = outside ? vec2(1.0) : texelFetch(block_range, block, 0).rg;
            found = vec2(min(found.x, depth.x), max(found.y, depth.y));
        }
    }
    range = vec4(found, 0.0, 0.0);
}
)";

// The half-size occlusion map, taken from the neighbours at this fragment's own depth.
inline constexpr char occlusion_lookup[] = R"(
uniform sampler2D occlusion_map;
uniform sampler2D geometry_map;

float sky_visibility(float depth) {
    vec2 size = vec2(textureSize(occlusion_map, 0));
    vec2 at = gl_FragCoord.xy * screen.zw * size - 0.5;
    ivec2 corner = ivec2(floor(at));
    vec2 share = at - vec2(corner);
    ivec2 last = ivec2(size) - 1;
    float sum = 0.0;
    float weights = 1e-5;
    float plain = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        ivec2 cell = clamp(corner + step, ivec2(0), last);
        float near = mix(1.0 - share.x, share.x, float(step.x)) * mix(1.0 - share.y, share.y, float(step.y));
        float value = texelFetch(occlusion_map, cell, 0).r;
        float apart = abs(texelFetch(geometry_map, cell, 0).w - depth) / (0.02 * depth);
        float weight = (near + 0.02) * exp2(-min(apart * apart, 14.0));
        sum += weight * value;
        weights += weight;
        plain += near * value;
    }
    return mix(plain, sum / weights, clamp(weights * 20.0, 0.0, 1.0));
}
)";

inline constexpr char lighting[] = R"(
struct Surface {
    vec3 position;
    vec3 normal;       // as shaded
    vec3 outward;      // of the geometry
    vec3 albedo;
    float crease;      // 1: open, 0: in a groove
    float gloss;       // strength of the broad highlight
    float sheen;       // brightening at grazing angles, as of fibres
    float translucency;
    float depth_through; // metres the sun travels to the far side
};

vec3 light_surface(Surface s) {
    vec3 to_eye = normalize(eye.xyz - s.position);
    float view_depth = -(view * vec4(s.position, 1.0)).z;
    float open = sky_visibility(view_depth) * s.crease;
    float facing = dot(s.normal, to_sun.xyz);
    float outward_facing = dot(s.outward, to_sun.xyz);
    vec3 light = vec3(0.0);
    bool through = outward_facing < 0.0 && s.translucency > 0.0;
    if (outward_facing > 0.0 || through) {
        vec3 from = through ? s.position + to_sun.xyz * s.depth_through : s.position;
        float visible = sun_visibility(from, through ? -s.outward : s.outward);
        if (through) {
            light += sun_light * (visible * s.translucency * min(-outward_facing * 1.5, 1.0) * 0.6);
        } else {
            float lit = max(facing, 0.0) * smoothstep(0.0, 0.08, outward_facing);
            light += sun_light * (lit * visible * mix(1.0, s.crease, 0.6));
            vec3 halfway = normalize(to_eye + to_sun.xyz);
            float highlight = pow(max(dot(s.normal, halfway), 0.0), 28.0) * s.gloss;
            light += sun_light * (highlight * visible * lit);
        }
    }
    vec3 ambient = mix(ground_light, sky_light, 0.5 + 0.5 * s.normal.y);
    // Light that bounced once inside a crease has taken the surface's colour.
    vec3 occluded = vec3(open) + (1.0 - open) * open * 0.6 * s.albedo;
    light += ambient * occluded;
    vec3 colour = light * s.albedo;
    float grazing = pow(1.0 - clamp(dot(s.normal, to_eye), 0.0, 1.0), 4.0);
    float upward = 0.35 + 0.65 * clamp(0.5 + 0.5 * s.normal.y, 0.0, 1.0);
    colour += (0.10 + 0.5 * s.sheen * s.albedo + 0.05 * s.sheen) * sky_light * (grazing * upward * open);
    return colour;
}

vec3 add_haze(vec3 colour, vec3 point) {
    vec3 ray = point - eye.xyz;
    float distance = length(ray) / haze.x;
    float share = 1.0 - exp(-distance * distance * distance);
    return mix(colour, sky_colour(ray / max(length(ray), 1e-6)), share);
}
)";

} // namespace render::shaders
