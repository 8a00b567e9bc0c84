// The one table of all hard cases: what is asserted, what was measured, how far apart the two are, and what
// the float32 twin has beside it. Printed as Markdown when the program ends.
#pragma once

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

// What the float32 twin has of a figure, finite or not, or why there is no such twin.
class Twin {
public:
    Twin(double figure) : figure_(figure) {}
    Twin(const char* why_none) : why_none_(why_none) {}

    double figure() const { return figure_; }
    const char* why_none() const { return why_none_; } // null: there is one

private:
    double figure_ = 0;
    const char* why_none_ = nullptr;
};

// Fails the test unless measured ≤ bound, and keeps a row. `unit` stands behind the figures.
void expect_at_most(const std::string& scene, const std::string& figure, const std::string& unit,
                    double bound, double measured, const Twin& single);

// The same from below.
void expect_at_least(const std::string& scene, const std::string& figure, const std::string& unit,
                     double bound, double measured, const Twin& single);

// A row that nothing is asserted of: what a limit costs.
void tell(const std::string& scene, const std::string& figure, const std::string& unit, double measured,
          const Twin& single);

} // namespace stability
