// A picture of a scene: what the renderer draws, read through the public views.
#pragma once

#include <cstdint>
#include <string>

#include "render/frame.h"
#include "scenes/scene.h"

namespace lks_program {

// `interpolation` is lks_world_interpolation's, or LKS_VIEW_LAST_TICK. False, with a sentence: a view was
// refused.
bool make_frame(const lks_demo::Scene& scene, std::uint32_t interpolation, render::Frame& frame,
                std::string& error);

} // namespace lks_program
