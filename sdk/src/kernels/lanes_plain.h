// One 64-bit lane in plain integers: what prediction needs of lanes.
#pragma once

#include <cstdint>

#include "solver/wrapping.h"

namespace lks {
namespace {

struct LanesPlain {
    static constexpr std::uint32_t half = 1;
    using Register = std::int64_t;

    static Register load(const std::int64_t* p) { return *p; }
    static void store(std::int64_t* p, Register v) { *p = v; }
    static Register set(std::int64_t value) { return value; }

    static Register add(Register a, Register b) { return wrapping_add(a, b); }
    static Register subtract(Register a, Register b) { return wrapping_subtract(a, b); }
    // Not signed.
    template <int count>
    static Register shift_right(Register v) {
        return static_cast<Register>(static_cast<std::uint64_t>(v) >> count);
    }
    // Of the low halves.
    static Register multiply_signed(Register a, Register b) {
        return std::int64_t{static_cast<std::int32_t>(a)} * static_cast<std::int32_t>(b);
    }
    static Register multiply_unsigned(Register a, Register b) {
        return static_cast<Register>(std::uint64_t{static_cast<std::uint32_t>(a)} *
                                     static_cast<std::uint32_t>(b));
    }

    static Register bit_and(Register a, Register b) { return a & b; }
    static Register bit_or(Register a, Register b) { return a | b; }
    static bool any(Register v) { return v != 0; }
};

} // namespace
} // namespace lks
