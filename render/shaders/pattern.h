// Anti-aliased patterns: everything is made of bands, and a band is integrated over the pixel instead of
// sampled.
#pragma once

namespace render::shaders {

inline constexpr char pattern[] = R"(
// The share of the interval of this width around x that lies in the periodic band [0, duty) of period 1.
float band(float x, float duty, float width) {
    width = max(width, 1e-5);
    float a = x - 0.5 * width;
    float b = x + 0.5 * width;
    float to_a = floor(a) * duty + min(fract(a), duty);
    float to_b = floor(b) * duty + min(fract(b), duty);
    return (to_b - to_a) / width;
}

// A pixel's extent along each coordinate; a little wider than it is, since a box filter leaves a shimmer.
vec2 footprint(vec2 coordinate) {
    return 1.2 * sqrt(dFdx(coordinate) * dFdx(coordinate) + dFdy(coordinate) * dFdy(coordinate)) + 1e-6;
}
)";

} // namespace render::shaders
