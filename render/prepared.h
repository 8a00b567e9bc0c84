// A frame made ready for the card: its triangles in one buffer, what to draw of it, and what every shader
// knows.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>

#include "render/frame.h"
#include "render/mesh.h"
#include "render/scene_block_data.h"
#include "render/sun_view.h"

namespace render {

enum class Surface { ground, solid, cloth, rope };

struct Draw {
    Surface surface;
    std::size_t index; // in the frame's list
    glm::mat4 model;
    std::uint32_t first;
    std::uint32_t count;
    bool casts;
    bool closed; // no inside to be seen
};

struct Prepared {
    Mesh mesh;
    std::vector<Draw> draws;
    SunView sun;
};

// Replaces what is in it; the memory is kept from picture to picture.
void prepare(const Frame& frame, Prepared& prepared);

SceneBlock describe_scene(const Frame& frame, const SunView& sun, int width, int height);

} // namespace render
