// What is measured of a fall: for how long, and how far joints or attachments were apart.
#pragma once

#include <string>
#include <vector>

#include "results.h"

namespace lks_bench {

// Mean and worst of all ticks.
class CrowdErrors {
public:
    // Of one tick.
    void add(const std::vector<double>& errors);
    // Times a factor, in that unit; nothing where there was nothing.
    void report(const char* workload, const std::string& measured, const std::string& variant, double factor,
                const char* unit, Results& results) const;
    // Of metres, in millimetres.
    void report(const char* workload, const std::string& measured, const std::string& variant,
                Results& results) const {
        report(workload, measured, variant, 1000, "mm", results);
    }

private:
    double sum_ = 0;
    double worst_ = 0;
    std::size_t count_ = 0;
};

// All of it, but where a quick look is asked for.
inline constexpr int whole_fall = 300;
constexpr int fall_ticks(int rounds) {
    constexpr int enough_rounds = 21;
    return rounds < enough_rounds ? 3 * rounds : whole_fall;
}
// Of so many ticks: what is measured of less is measured in the air.
constexpr const char* ticks_title(int ticks) {
    return ticks < whole_fall ? "ticks of the 300 of a fall: no figures to compare" : "ticks";
}

} // namespace lks_bench
