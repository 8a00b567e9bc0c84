// Hashes over everything that can influence the future, as a tree: particles and pins into an object's hash;
// objects, colliders, bodies, joints, attachments and what contacts of bodies pushed into the world's.
#pragma once

#include "solver/world.h"

namespace lks {

// Without the object's origin and id.
std::uint64_t hash_object(const Object& object, const Kernels& kernels);

// `local` leaves out where objects, colliders and bodies are in the world.
std::uint64_t hash_world(const lks_world& world, bool local);

} // namespace lks
