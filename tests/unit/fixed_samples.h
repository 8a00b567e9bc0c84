// Samples for the tests of fixed/: a repeatable generator that favours every magnitude alike, edge values,
// and counters that keep doctest's macros out of loops of ten million.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "support/random.h"
#include "support/sanitised.h"

namespace lks::test {

class Random : public support::Random {
public:
    using support::Random::Random;

    std::uint64_t bits() { return next(); }
    std::uint64_t below(std::uint64_t n) { return bits() % n; }

    // 0 to 2^width - 1, every bit length equally likely; one in sixteen is next to a power of two.
    std::uint64_t any_magnitude(int width = 64) {
        const int length = static_cast<int>(below(static_cast<std::uint64_t>(width) + 1));
        if (length == 0)
            return 0;
        const std::uint64_t top = std::uint64_t{1} << (length - 1);
        const std::uint64_t b = bits();
        if ((b & 15) == 0)
            return (top - 1) + ((b >> 4) & 1);
        return top | (bits() & (top - 1));
    }

    // |result| < 2^width, both signs.
    std::int64_t any_signed(int width = 63) {
        const std::int64_t size = static_cast<std::int64_t>(any_magnitude(width));
        return (bits() & 1) != 0 ? -size : size;
    }
};

// Foreign targets are told when they are built: not all see the environment.
inline bool long_run() {
#if defined(LKS_TEST_LONG_SAMPLES)
    return true;
#else
    const char* value = std::getenv("LOCKSTITCH_LONG");
    return value != nullptr && std::strcmp(value, "1") == 0;
#endif
}

// Ten million of each. Unoptimised and sanitised builds, which are there to find other things, and emulators
// take a hundredth: they are twenty times as slow, and edges are tried everywhere.
inline std::uint64_t sample_count() {
#if defined(LKS_TEST_LONG_SAMPLES)
    return LKS_TEST_LONG_SAMPLES;
#elif (defined(__OPTIMIZE__) || defined(NDEBUG)) && !defined(LKS_TEST_EMULATED)
    return support::sanitised ? 100'000 : 10'000'000;
#else
    return 100'000;
#endif
}

// Of what takes microseconds to compare with its exact result: a fifth, but in long runs.
inline std::uint64_t slow_sample_count() {
    return sample_count() / (long_run() ? 1 : 5);
}

inline constexpr std::uint64_t edges_u64[] = {0,
                                              1,
                                              2,
                                              3,
                                              0x7fffffff,
                                              0x80000000,
                                              0xffffffff,
                                              0x100000000,
                                              0x100000001,
                                              0x7fffffffffffffff,
                                              0x8000000000000000,
                                              0x8000000000000001,
                                              0xfffffffeffffffff,
                                              0xffffffff00000000,
                                              0xfffffffffffffffe,
                                              0xffffffffffffffff};

// Counts, remembers the first failure's inputs, and the largest error.
struct Tally {
    std::uint64_t failures = 0;
    std::uint64_t first[4] = {};
    long double worst = 0;

    void expect(bool good, std::uint64_t a = 0, std::uint64_t b = 0, std::uint64_t c = 0,
                std::uint64_t d = 0) {
        if (good)
            return;
        if (failures++ == 0) {
            first[0] = a;
            first[1] = b;
            first[2] = c;
            first[3] = d;
        }
    }

    void measure(long double error) {
        if (error < 0)
            error = -error;
        if (error > worst)
            worst = error;
    }
};

} // namespace lks::test

// Which inputs failed first stands in the message.
#define LKS_CHECK_TALLY(tally)                                                                               \
    do {                                                                                                     \
        INFO("first failure: ", (tally).first[0], " ", (tally).first[1], " ", (tally).first[2], " ",         \
             (tally).first[3]);                                                                              \
        CHECK((tally).failures == 0);                                                                        \
    } while (false)
