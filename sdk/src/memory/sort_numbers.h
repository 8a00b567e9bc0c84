// Sorting numbers in ascending order: by the digits in which they differ, from the lowest on, which takes a
// sixth to a tenth of the instructions of comparing them.
#pragma once

#include <cstdint>

#include "memory/array.h"

namespace lks {

// Fewer than 2^32. `room` has the capacity for as many; what is in it is lost.
void sort_numbers(Array<std::uint64_t>& numbers, Array<std::uint64_t>& room);

} // namespace lks
