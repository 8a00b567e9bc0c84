// Numbers that look like chance and are the same each time.
#pragma once

#include <cstdint>

namespace support {

// A fixed sequence (Steele, Lea, Flood: SplitMix), so that a failing test fails again.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

    // low ≤ value ≤ high; high - low must be below 2^63.
    std::int64_t between(std::int64_t low, std::int64_t high) {
        const auto span = static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low) + 1;
        return static_cast<std::int64_t>(static_cast<std::uint64_t>(low) + next() % span);
    }

private:
    std::uint64_t state_;
};

} // namespace support
