#include "memory/sort_numbers.h"

#include <algorithm>

namespace lks {
namespace {

constexpr int byte_bits = 8;
constexpr std::size_t byte_values = std::size_t{1} << byte_bits;

std::size_t byte_of(std::uint64_t number, int shift) {
    return number >> shift & (byte_values - 1);
}

// From one into the other by one byte; those with the same stay in their order.
void sort_by_byte(const Array<std::uint64_t>& from, Array<std::uint64_t>& to, int shift) {
    std::size_t places[byte_values] = {};
    for (const std::uint64_t number : from) {
        ++places[byte_of(number, shift)];
    }
    std::size_t place = 0;
    for (std::size_t& count : places) {
        const std::size_t next = place + count;
        count = place;
        place = next;
    }
    for (const std::uint64_t number : from) {
        to[places[byte_of(number, shift)]++] = number;
    }
}

} // namespace

void sort_numbers(Array<std::uint64_t>& numbers, Array<std::uint64_t>& room) {
    // Below that comparing them is quicker.
    constexpr std::size_t worth_counting = 256;
    if (numbers.size() < worth_counting) {
        std::sort(numbers.begin(), numbers.end());
        return;
    }
    std::uint64_t differing = 0;
    for (const std::uint64_t number : numbers) {
        differing |= number ^ numbers[0];
    }
    static_cast<void>(room.resize(numbers.size())); // within its room
    bool in_room = false;
    for (int shift = 0; shift < 64; shift += byte_bits) {
        if (byte_of(differing, shift) != 0) {
            sort_by_byte(in_room ? room : numbers, in_room ? numbers : room, shift);
            in_room = !in_room;
        }
    }
    if (in_room) {
        std::copy(room.begin(), room.end(), numbers.begin());
    }
}

} // namespace lks
