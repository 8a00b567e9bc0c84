// The questions of contact_task.h in plain integers.
#pragma once

#include "kernels/contact_task.h"

namespace lks {
namespace {

inline std::int64_t upper(std::int64_t coordinate) {
    return coordinate >> 32;
}

inline bool may_touch_box(const BoxTask& task, std::uint32_t i) {
    bool apart = false;
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t x = upper(task.positions[axis][i]);
        const std::int64_t start = upper(task.starts[axis][i]);
        apart |= (x > task.high[axis]) & (start > task.high[axis]);
        apart |= (x < task.low[axis]) & (start < task.low[axis]);
    }
    return !apart;
}

inline bool may_touch_plane(const PlaneTask& task, std::uint32_t i) {
    const std::int64_t height = task.normal[0] * upper(task.positions[0][i]) +
                                task.normal[1] * upper(task.positions[1][i]) +
                                task.normal[2] * upper(task.positions[2][i]);
    return height < task.level;
}

// Bit i: particle first + i; count ≤ 64.
inline std::uint64_t near_box_scalar(const BoxTask& task, std::uint32_t first, std::uint32_t count) {
    std::uint64_t near = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        near |= static_cast<std::uint64_t>(may_touch_box(task, first + i)) << i;
    }
    return near;
}

inline std::uint64_t near_plane_scalar(const PlaneTask& task, std::uint32_t first, std::uint32_t count) {
    std::uint64_t near = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        near |= static_cast<std::uint64_t>(may_touch_plane(task, first + i)) << i;
    }
    return near;
}

} // namespace
} // namespace lks
