#include "kernels/x86_features.h"

#if defined(__x86_64__) || defined(_M_X64) || defined(__i386__) || defined(_M_IX86)

#include <cstdint>

#if defined(_MSC_VER)
#include <immintrin.h>
#include <intrin.h>
#else
#include <cpuid.h>
#endif

namespace lks {
namespace {

struct Leaf {
    std::uint32_t a, b, c, d;
};

Leaf cpuid(std::uint32_t leaf) {
    Leaf result{};
#if defined(_MSC_VER)
    int registers[4];
    __cpuidex(registers, 0, 0);
    if (static_cast<std::uint32_t>(registers[0]) >= leaf) {
        __cpuidex(registers, static_cast<int>(leaf), 0);
        result = {static_cast<std::uint32_t>(registers[0]), static_cast<std::uint32_t>(registers[1]),
                  static_cast<std::uint32_t>(registers[2]), static_cast<std::uint32_t>(registers[3])};
    }
#else
    (void)__get_cpuid_count(leaf, 0, &result.a, &result.b, &result.c, &result.d); // zeros where there is none
#endif
    return result;
}

// Which registers the operating system saves.
std::uint32_t saved_state() {
#if defined(_MSC_VER)
    return static_cast<std::uint32_t>(_xgetbv(0));
#else
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return low;
#endif
}

constexpr bool all_of(std::uint32_t value, std::uint32_t bits) {
    return (value & bits) == bits;
}

constexpr std::uint32_t bit(int place) {
    return std::uint32_t{1} << place;
}

} // namespace

X86Features detect_x86_features() {
    const Leaf basic = cpuid(1);
    const Leaf extended = cpuid(7);
    constexpr std::uint32_t ssse3_sse41 = bit(9) | bit(19);
    constexpr std::uint32_t osxsave = bit(27);
    const std::uint32_t saved = all_of(basic.c, osxsave) ? saved_state() : 0;
    constexpr std::uint32_t ymm = bit(1) | bit(2);
    constexpr std::uint32_t zmm = ymm | bit(5) | bit(6) | bit(7);
    constexpr std::uint32_t avx512 = bit(16) | bit(17) | bit(28) | bit(30) | bit(31); // F DQ CD BW VL
    X86Features features{};
    features.sse41 = all_of(basic.c, ssse3_sse41);
    features.avx2 = features.sse41 && all_of(saved, ymm) && all_of(extended.b, bit(5));
    features.avx512 = features.avx2 && all_of(saved, zmm) && all_of(extended.b, avx512);
    return features;
}

} // namespace lks

#endif
