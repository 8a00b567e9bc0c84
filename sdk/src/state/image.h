// An image: the whole state as one little-endian block.
//
//     header     magic, versions, size, checksum, tick rate, substeps, iterations, counts, tick, gravity
//     objects    one a slot: generation, used; then, for the used ones, the object
//     colliders  one a slot: generation, used; then, for the used ones, the collider
//     bodies, joints, contacts  state/rigid_image.h
//     attachments               state/attachment_image.h
//
// Every part is a multiple of 8 bytes. The checksum (state/checksum.h) covers everything behind it. An object
// is its settings, its pins, and its six arrays as they stand in memory.
#pragma once

#include <cstddef>
#include <cstdint>

#include "solver/world.h"

namespace lks {

inline constexpr std::uint64_t image_magic = 0x3165746174736b4c; // "Lkstate1" as bytes
inline constexpr std::uint32_t image_version = 8;

struct ImageHeader {
    std::uint64_t magic;
    std::uint32_t version;
    std::uint32_t solver_version;
    std::uint64_t size;
    std::uint64_t checksum; // of all that follows
    std::uint32_t ticks_per_second;
    std::uint32_t substeps;
    std::uint32_t iterations;
    std::uint32_t reserved;
    std::uint32_t object_slots;
    std::uint32_t collider_slots;
    std::uint32_t body_slots;
    std::uint32_t joint_slots;
    std::uint32_t contact_count;
    std::uint32_t attachment_slots;
    std::uint64_t tick;
    fixed::Vec3 gravity;
};

inline constexpr std::size_t image_header_size = 32 + 24 + 16 + 8 + 24;
inline constexpr std::size_t image_checked_from = 32;
inline constexpr std::size_t image_slot_size = 8;
inline constexpr std::size_t image_pin_size = 32;

struct ImageObject {
    std::uint64_t fingerprint;
    std::uint32_t vertex_count;
    std::uint32_t record_forces;
    std::uint32_t pin_count;
    std::uint32_t constraint_count;   // 0 unless forces are recorded
    std::uint64_t recorded_pin_count; // 0 unless forces are recorded
    std::int64_t gravity_factor;
    std::int64_t linear_damping;
    fixed::Vec3 origin;
};

inline constexpr std::size_t image_object_size = 8 + 16 + 8 + 16 + 24;
inline constexpr std::size_t image_collider_size = 16 + 5 * 8 + 3 * 8 + 2 * 24 + 2 * 16;

std::size_t image_size(const lks_world& world);
// Into at least image_size bytes.
void write_image(const lks_world& world, unsigned char* memory);
// Checks everything before it changes anything; reports what is wrong. Where particles are, and multipliers,
// may be any numbers.
lks_result load_image(lks_world& world, const unsigned char* memory, std::size_t size);

} // namespace lks
