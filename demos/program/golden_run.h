// One run of a scene for its golden state and images, shared by check and bless.
#pragma once

#include <functional>
#include <string>

#include "golden/golden_state.h"
#include "program/commands.h"
#include "scenes/scene.h"

namespace lks_program {

// The folder golden/: as given, else below the present folder, else where the program was built from.
std::string find_golden(const GoldenOptions& options);

// Runs the scene through its golden ticks and records them. `picture` (may be empty) is called at the scene's
// image ticks; false from it ends the run. False, with a sentence: the scene can't be made or run, or a
// picture failed.
bool run_golden(const std::string& name, const lks_demo::SceneOptions& options,
                const std::function<bool(lks_demo::Scene&, std::string&)>& picture,
                lks_golden::GoldenState& state, std::string& error);

} // namespace lks_program
