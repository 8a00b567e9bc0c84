// What the program says when something is wrong: one sentence on standard error.
#pragma once

#include <string>
#include <vector>

namespace lks_program {

inline constexpr int exit_failed = 1;
inline constexpr int exit_usage = 2;

// Prints "lockstitch: <sentence>" and returns `code`.
int complain(const std::string& sentence, int code);

// All scenes if none are named; false, with the complaint printed, if one does not exist.
bool resolve_scenes(const std::vector<std::string>& wanted, std::vector<std::string>& scenes);

} // namespace lks_program
