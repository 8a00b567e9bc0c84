// Bodies, joints and contacts in an image, as records (state/records.h):
//
//     body     generation, used; then, for the used ones, kind, shape count, BodySettings,
//              a lks_body_shape for each shape, BodyState
//     joint    generation, used; then, for the used ones, JointDescription, JointState
//     contact  key, count, normal, forgotten, a ContactPush for each point that pushes
//
// What a world has of the definitions already, byte for byte and in the same slots, is neither checked again
// nor made again from them: a rollback costs no more than its states.
#pragma once

#include "solver/world.h"
#include "state/byte_writer.h"

namespace lks {

// How many of each an image has.
struct RigidCounts {
    std::uint32_t bodies;
    std::uint32_t joints;
    std::uint32_t memories;
    std::uint32_t colliders;
};

RigidCounts rigid_counts(const lks_world& world);
std::size_t rigid_image_size(const RigidScene& scene);
void write_rigid(ByteWriter& out, const RigidScene& scene);
// Checks every value, and marks what is new to the world. False: one is out of range; `what` and `index` say
// which.
bool check_rigid(ByteReader& in, const RigidCounts& counts, lks_world& world, const char*& what,
                 std::uint32_t& index);
// What was checked just before, within reserved memory.
void read_rigid(ByteReader& in, const RigidCounts& counts, const StepRate& rate, RigidScene& scene);

// `local` leaves out where bodies are in the world.
void hash_rigid(Hash& hash, const RigidScene& scene, bool local);

} // namespace lks
