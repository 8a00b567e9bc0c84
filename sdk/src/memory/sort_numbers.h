// Numbers in ascending order: by their bytes, from the lowest on, which takes a sixth of the instructions of
// comparing them.
#pragma once

#include <cstdint>

#include "memory/array.h"

namespace lks {

// `room` has the capacity for as many; what is in it is lost.
void sort_numbers(Array<std::uint64_t>& numbers, Array<std::uint64_t>& room);

} // namespace lks
