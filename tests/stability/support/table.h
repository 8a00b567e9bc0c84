// The one table of all hard cases: what is asserted, what was measured, how far apart the two are, and what
// the float32 twin has beside it. Printed as Markdown when the program ends.
#pragma once

#include <limits>
#include <sstream>
#include <string>

namespace stability {

// A scene's name out of words and numbers.
template <typename... Parts>
std::string named(const Parts&... parts) {
    std::ostringstream text;
    (text << ... << parts);
    return text.str();
}

// Where the twin has no such scene (bodies that touch, counters of the SDK).
inline constexpr double no_twin = -std::numeric_limits<double>::infinity();

// Fails the test unless measured ≤ bound, and keeps a row. `unit` stands behind the figures. A twin that is
// not finite may be given as it is.
void expect_at_most(const std::string& scene, const std::string& figure, const std::string& unit,
                    double bound, double measured, double single = no_twin);

// The same from below.
void expect_at_least(const std::string& scene, const std::string& figure, const std::string& unit,
                     double bound, double measured, double single = no_twin);

// A row that nothing is asserted of: what a limit costs.
void tell(const std::string& scene, const std::string& figure, const std::string& unit, double measured,
          double single = no_twin);

} // namespace stability
