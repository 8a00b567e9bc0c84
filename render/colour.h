// Colours as a person picks them: sRGB-encoded, 0 to 1. The renderer makes them linear itself.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

namespace render {

using Colour = glm::vec3;

// From 0xRRGGBB.
constexpr Colour srgb(std::uint32_t hex) {
    return Colour(static_cast<float>((hex >> 16) & 0xffu) / 255.0f,
                  static_cast<float>((hex >> 8) & 0xffu) / 255.0f, static_cast<float>(hex & 0xffu) / 255.0f);
}

// Colours that sit well together in the renderer's daylight.
namespace palette {
inline constexpr Colour warm_grey = srgb(0xc9c2b8);
inline constexpr Colour terracotta = srgb(0xbf6b4b);
inline constexpr Colour slate = srgb(0x5f6f7f);
inline constexpr Colour ground = srgb(0xa19e99);
inline constexpr Colour cream = srgb(0xeadfc8);
inline constexpr Colour crimson = srgb(0xa92f36);
inline constexpr Colour indigo = srgb(0x33497f);
inline constexpr Colour teal = srgb(0x2f7b7d);
inline constexpr Colour ochre = srgb(0xcf9a3e);
inline constexpr Colour moss = srgb(0x6c7d48);
inline constexpr Colour hemp = srgb(0xc2a072);
inline constexpr Colour charcoal = srgb(0x3a3d42);
} // namespace palette

} // namespace render
