// The name that was probably meant.
#pragma once

#include <string>
#include <vector>

namespace lks_demo {

// The fewest letters to insert, delete, replace, or swap with their neighbour, wins; of equals the first.
// Empty if there are no names.
std::string nearest_name(const std::string& wanted, const std::vector<std::string>& names);

} // namespace lks_demo
