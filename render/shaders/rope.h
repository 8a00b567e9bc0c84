// A laid rope: strands that wind around the tube, as a bent normal and a dark groove between them.
#pragma once

namespace render::shaders {

inline constexpr char rope_fragment[] = R"(
in vec3 position;
in vec3 normal;
in vec3 axis;
in vec2 texture_point; // turn, arc
in float part;
uniform vec4 rope_colour; // w: strands
uniform vec4 tracer_colour; // w: how much it shows
uniform vec4 end_colour;  // w: whipping length
uniform vec4 rope_shape;  // radius, lay length, first and last rest arc
layout(location = 0) out vec4 pixel;

void main() {
    float radius = rope_shape.x;
    float strands = rope_colour.w;
    float arc = texture_point.y;
    float to_end = min(arc - rope_shape.z, rope_shape.w - arc);
    float bound = part > 0.0 ? 1.0 : 0.0;
    float arc_width = max(fwidth(arc), 1e-6);
    bound = max(bound, clamp(0.5 - (to_end - end_colour.w) / arc_width, 0.0, 1.0));
    bound *= end_colour.w > 0.0 ? 1.0 : 0.0;

    vec3 round_normal = normalize(normal);
    vec3 along = normalize(axis);
    vec3 around = cross(along, round_normal);

    // The body: phase runs across the strands; its gradient on the surface is where they bulge to.
    float phase = strands * (texture_point.x - arc / rope_shape.y);
    float width = max(fwidth(phase), 1e-5);
    float across = 2.0 * fract(phase) - 1.0;
    float seen = 1.0 - smoothstep(0.35, 1.1, width);
    vec3 gradient = normalize(around * (strands / (6.2831853 * radius)) - along * (strands / rope_shape.y));
    vec3 bulged = normalize(round_normal + gradient * (across * 0.85 * seen));
    float groove = across * across;
    groove *= groove;
    float crease = mix(0.80, 1.0 - 0.62 * groove * groove, seen);
    // Fibres run along the strand, a fine lighter and darker streak.
    float fibre = sin(across * 9.4) * 0.05 * (1.0 - smoothstep(0.06, 0.22, width));
    float tracer = tracer_colour.w * band(phase / strands, 1.0 / strands, 1.2 * width / strands);
    vec3 body = mix(rope_colour.rgb, tracer_colour.rgb, tracer) * (1.0 + fibre);

    // The whipping: thin turns of twine around both ends.
    float turns = arc / (radius * 0.32);
    float turn_width = max(fwidth(turns), 1e-5);
    float turn_seen = 1.0 - smoothstep(0.35, 0.9, turn_width);
    float turn_across = 2.0 * fract(turns) - 1.0;
    vec3 wound = normalize(round_normal + along * (turn_across * 0.6 * turn_seen * (1.0 - part)));
    float wound_crease = mix(0.9, 1.0 - 0.45 * pow(abs(turn_across), 6.0), turn_seen * (1.0 - part));

    Surface s;
    s.position = position;
    s.normal = normalize(mix(bulged, wound, bound));
    s.outward = round_normal;
    s.albedo = mix(body, end_colour.rgb, bound);
    s.crease = mix(crease, wound_crease, bound);
    s.gloss = 0.03;
    s.sheen = 0.35;
    s.translucency = 0.0;
    s.depth_through = 0.0;
    pixel = vec4(develop(add_haze(light_surface(s), position)), 1.0);
}
)";

} // namespace render::shaders
