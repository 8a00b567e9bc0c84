// Hashes over everything that can influence the future, as a tree: particles and pins into an object's hash,
// objects and colliders into the world's.
#pragma once

#include "solver/world.h"

namespace lks {

// Without the object's origin and id.
std::uint64_t hash_object(const Object& object, const Kernels& kernels);

// `local` leaves out where objects and colliders are in the world.
std::uint64_t hash_world(const lks_world& world, bool local);

} // namespace lks
