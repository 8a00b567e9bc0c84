// Bodies, joints and contacts in an image: one record a slot, all of one size, and the pushes of contacts.
#pragma once

#include "solver/world.h"
#include "state/bytes.h"
#include "state/hash.h"

namespace lks {

// How many of each an image has.
struct RigidCounts {
    std::uint32_t bodies;
    std::uint32_t joints;
    std::uint32_t memories;
};

RigidCounts rigid_counts(const RigidScene& scene);
std::size_t rigid_image_size(const RigidScene& scene);
void write_rigid(ByteWriter& out, const RigidScene& scene);
// Checks every value. False: one is out of range; `what` and `index` say which.
bool check_rigid(ByteReader& in, const RigidCounts& counts, lks_world& world, const char*& what,
                 std::uint32_t& index);
// What was checked, within reserved memory.
void read_rigid(ByteReader& in, const RigidCounts& counts, const StepRate& rate, RigidScene& scene);

// `local` leaves out where bodies are in the world.
void hash_rigid(Hash& hash, const RigidScene& scene, bool local);

} // namespace lks
