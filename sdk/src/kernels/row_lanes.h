// From arrays to rows and back, four particles at a time.
#pragma once

#include "kernels/leave_lanes.h"
#include "kernels/row_task.h"

namespace lks {
namespace {

template <typename L>
inline void take_rows(const RowTask& task, std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; i += L::half) {
        const typename L::Register axes[3] = {L::load(task.x + i), L::load(task.y + i), L::load(task.z + i)};
        typename L::Register rows[L::half];
        L::to_rows(axes, rows);
        for (std::uint32_t lane = 0; lane < L::half; ++lane) {
            L::store(L::row(task.rows, i + lane), rows[lane]);
        }
    }
}

template <typename L>
inline void give_rows_back(const RowTask& task, std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; i += L::half) {
        typename L::Register rows[L::half];
        for (std::uint32_t lane = 0; lane < L::half; ++lane) {
            rows[lane] = L::load(L::row(task.rows, i + lane));
        }
        typename L::Register axes[3];
        L::from_rows(rows, axes);
        L::store(task.x + i, axes[0]);
        L::store(task.y + i, axes[1]);
        L::store(task.z + i, axes[2]);
    }
}

// With registers left as of L.
template <typename L, typename Lanes = L>
constexpr RowKernels leaving_row_lanes() {
    return {leaving<L, take_rows<Lanes>>, leaving<L, give_rows_back<Lanes>>};
}

} // namespace
} // namespace lks
