// Positions of an object in rows: x, y and z of a particle follow each other.
#pragma once

#include <cstdint>

namespace lks {

// x, y, z and nothing: what a 256-bit register holds.
inline constexpr std::uint32_t row_length = 4;

// Room for whole groups of the widest kernel, in arrays and in rows.
struct RowTask {
    std::int64_t* x;
    std::int64_t* y;
    std::int64_t* z;
    std::int64_t* rows;
};

// Of some particles, and those that fill their last group of four; `first` is at the beginning of one.
struct RowKernels {
    void (*take)(const RowTask& task, std::uint32_t first, std::uint32_t count);
    void (*give_back)(const RowTask& task, std::uint32_t first, std::uint32_t count);
};

inline constexpr RowKernels no_row_kernels{nullptr, nullptr};

} // namespace lks
