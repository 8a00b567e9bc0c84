// What colour a solver has in every plot.
#pragma once

#include <string>

namespace lks_accuracy {

std::string colour_of(const std::string& solver);      // "#rrggbb"
std::string line_colour_of(const std::string& solver); // as gnuplot wants it

} // namespace lks_accuracy
