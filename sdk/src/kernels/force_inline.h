// Registers live through a whole group only if its steps are one function; compilers that see many copies of
// a step stop inlining them, which made a projection 40 % slower.
#pragma once

#include <cstdint>

#if defined(_MSC_VER)
#define LKS_FORCE_INLINE __forceinline
#define LKS_NEVER_INLINE __declspec(noinline)
#else
#define LKS_FORCE_INLINE inline __attribute__((always_inline))
#define LKS_NEVER_INLINE __attribute__((noinline))
#endif

// Before what few groups need: by itself where code is sent over a network.
#if defined(__wasm__)
#define LKS_SELDOM LKS_NEVER_INLINE
#else
#define LKS_SELDOM LKS_FORCE_INLINE
#endif

// Before a function whose loops are short: what compilers make ready for vectors would outweigh them.
#if defined(__GNUC__) && !defined(__clang__)
#define LKS_SHORT_LOOPS __attribute__((noinline, optimize("no-tree-vectorize")))
#else
#define LKS_SHORT_LOOPS LKS_NEVER_INLINE
#endif
// Before such a loop.
#if defined(__clang__)
#define LKS_SHORT_LOOP _Pragma("clang loop vectorize(disable)")
#else
#define LKS_SHORT_LOOP
#endif

// A pointer that compilers take as it stands: they would keep sums of base and offset for each displacement
// instead, and need more registers and additions for them than loads and stores.
#if defined(__GNUC__)
template <typename T>
LKS_FORCE_INLINE T* as_it_stands(T* pointer) {
    __asm__("" : "+r"(pointer));
    return pointer;
}
// A factor of a wide product: extended once for several of them, they would be taken as three products each.
LKS_FORCE_INLINE std::int64_t as_it_stands(std::int64_t factor) {
    __asm__("" : "+r"(factor));
    return factor;
}
#else
template <typename T>
LKS_FORCE_INLINE T* as_it_stands(T* pointer) {
    return pointer;
}
LKS_FORCE_INLINE std::int64_t as_it_stands(std::int64_t factor) {
    return factor;
}
#endif
