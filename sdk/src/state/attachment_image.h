// Attachments in images and hashes.
#pragma once

#include "solver/world.h"
#include "state/byte_writer.h"

namespace lks {

std::size_t attachments_image_size(const RigidScene& scene);
void write_attachments(ByteWriter& out, const RigidScene& scene);
// False: something is out of range, of the attachment at `index`, or it contradicts another one. After the
// objects and bodies of the image were checked and staged; changes nothing that is state.
bool check_attachments(ByteReader& in, std::uint32_t count, lks_world& world, std::uint32_t& index);
// What their objects need, once they are checked. False: no memory.
[[nodiscard]] bool reserve_for_attachments(ByteReader& in, std::uint32_t count, const lks_world& world);
// After objects and bodies were read.
void read_attachments(ByteReader& in, std::uint32_t count, lks_world& world);
void hash_attachments(Hash& hash, const RigidScene& scene);

} // namespace lks
