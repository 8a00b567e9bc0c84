// The name that was probably meant.
#pragma once

#include <string>
#include <vector>

namespace lks_demo {

// The fewest letters to insert, delete, replace, or swap with their neighbour, wins; of equals the first.
// Empty if that takes more than half of the letters of all of them.
std::string nearest_name(const std::string& wanted, const std::vector<std::string>& names);
// "; did you mean 'NAME'?", and "." where none is near.
std::string did_you_mean(const std::string& wanted, const std::vector<std::string>& names);

} // namespace lks_demo
