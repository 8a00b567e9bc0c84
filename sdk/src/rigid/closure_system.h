// A symmetric positive system of many rows, of which some push one way only, by L·D·Lᵀ: 40 fraction bits.
#pragma once

#include <cstdint>

#include "rigid/closure_parts.h"

namespace lks {

// World; times the row's scale.
struct ClosureUnknown {
    std::int64_t left;   // to be brought to zero
    std::int64_t pushed; // by now
    std::int64_t slack;  // of one that does not push: what it may exceed zero by
    int side;            // 0: it pushes both ways; −1: it pushes less than zero, or nothing; 1: more
    std::int64_t own;    // what its bodies by themselves give way by, 40 fraction bits
    std::int64_t give;   // what its spring does
    bool pushes;
    std::int64_t more; // to be pushed
};

// Finds what each is to push more, and which of them push. Each is softened by 2^-give_shift of its own.
void solve_rows(const std::int64_t* matrix, ClosureUnknown* rows, std::uint32_t count, int give_shift);

} // namespace lks
