// What of the machine a scene may use. None of it changes a bit.
#pragma once

#include "program/commands.h"
#include "scenes/scene.h"

namespace lks_program {

// False, with the complaint printed: it can't be had here.
bool resolve_machine(const MachineOptions& options, lks_demo::SceneOptions& scene);
// Says so where LOCKSTITCH_SIMD names no instruction set of this machine: the library takes the best one
// then.
void warn_of_environment();
// Says on standard error which instruction set a world uses.
void tell_instruction_set(const lks_world* world);

} // namespace lks_program
