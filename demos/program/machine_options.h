// What of the machine a scene may use. None of it changes a bit.
#pragma once

#include "program/commands.h"
#include "scenes/scene.h"

namespace lks_program {

// False, with the complaint printed: it can't be had here.
bool resolve_machine(const MachineOptions& options, lks_demo::SceneOptions& scene);

} // namespace lks_program
