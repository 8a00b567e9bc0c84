#include "memory/sort_numbers.h"

#include <algorithm>
#include <bit>

namespace lks {
namespace {

// From one into the other by one digit; those with the same stay in their order.
template <int digit_bits>
void sort_by_digit(const Array<std::uint64_t>& from, Array<std::uint64_t>& to, int shift) {
    constexpr std::size_t values = std::size_t{1} << digit_bits;
    const auto digit_of = [shift](std::uint64_t number) { return number >> shift & (values - 1); };
    std::uint32_t places[values] = {};
    for (const std::uint64_t number : from) {
        ++places[digit_of(number)];
    }
    std::uint32_t place = 0;
    for (std::uint32_t& count : places) {
        const std::uint32_t next = place + count;
        count = place;
        place = next;
    }
    for (const std::uint64_t number : from) {
        to[places[digit_of(number)]++] = number;
    }
}

// By those digits only in which they differ, each of which begins with a bit that does.
template <int digit_bits>
void sort_by_digits(Array<std::uint64_t>& numbers, Array<std::uint64_t>& room, std::uint64_t differing) {
    bool in_room = false;
    for (int shift = 0; shift < 64 && differing >> shift != 0; shift += digit_bits) {
        shift += std::countr_zero(differing >> shift);
        sort_by_digit<digit_bits>(in_room ? room : numbers, in_room ? numbers : room, shift);
        in_room = !in_room;
    }
    if (in_room) {
        std::copy(room.begin(), room.end(), numbers.begin());
    }
}

} // namespace

void sort_numbers(Array<std::uint64_t>& numbers, Array<std::uint64_t>& room) {
    // Below that comparing them is quicker, and from the other on more counts for fewer digits.
    constexpr std::size_t worth_counting = 256;
    constexpr std::size_t worth_wide_digits = 2048;
    if (numbers.size() < worth_counting) {
        std::sort(numbers.begin(), numbers.end());
        return;
    }
    std::uint64_t differing = 0;
    for (const std::uint64_t number : numbers) {
        differing |= number ^ numbers[0];
    }
    static_cast<void>(room.resize(numbers.size())); // within its room
    if (numbers.size() < worth_wide_digits) {
        sort_by_digits<8>(numbers, room, differing);
    } else {
        sort_by_digits<11>(numbers, room, differing);
    }
}

} // namespace lks
