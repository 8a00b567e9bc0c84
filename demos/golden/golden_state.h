// A golden state: what a scene must be, to the bit, every ten ticks, as text that a person can diff.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace lks_golden {

inline constexpr std::uint32_t format_version = 2;
inline constexpr std::uint32_t ticks_between_records = 10;

struct ObjectRecord {
    std::uint32_t index = 0;
    std::string name;
    std::uint64_t hash = 0;
};

struct TickRecord {
    std::uint64_t tick = 0;
    std::uint64_t state = 0;
    std::uint64_t local = 0;
    std::vector<ObjectRecord> objects;
    std::vector<std::uint32_t> bodies; // a digest of each, in the order in which they were added
};

// One vertex at the last tick: raw coordinates relative to the object's origin, and metres in the world.
struct PointRecord {
    std::string object;
    std::uint32_t vertex = 0;
    std::string raw;
    std::string metres;
};

// A body at the last tick: metres in the world, and its rotation in units of 2^-30.
struct BodyRecord {
    std::string name;
    std::string metres;
    std::string rotation;
};

struct GoldenState {
    std::string scene;
    std::vector<std::pair<std::string, std::string>> parameters;
    std::vector<TickRecord> ticks;
    std::vector<PointRecord> points;
    std::vector<BodyRecord> bodies;

    const TickRecord* find_tick(std::uint64_t tick) const;
};

std::string to_text(const GoldenState& state);
// False, with a sentence that names the line: not a golden state.
bool parse(const std::string& text, GoldenState& state, std::string& error);

// One sentence for each difference, naming scene, tick and object or body; the first `limit` of them. Empty:
// equal.
std::vector<std::string> differences(const GoldenState& expected, const GoldenState& actual,
                                     std::size_t limit = 5);

// The same for a file's text, which must be what to_text writes, to the letter (line ends of either kind).
// What does not parse is named by its line.
std::vector<std::string> differences(const std::string& expected_text, const GoldenState& actual,
                                     std::size_t limit = 5);

} // namespace lks_golden
