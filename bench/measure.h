// Medians of what was measured in turns, so that what disturbs the machine disturbs all alike.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lks_bench {

struct Contender {
    std::string name;
    std::function<void()> run;
    double units = 1; // of work in one run
};

struct Measurement {
    std::string name;
    double nanoseconds = 0; // a unit, median
    double least = 0;
    double ratio = 0;          // to the first contender, median of the ratios within a round
    std::vector<double> times; // nanoseconds a unit, a round each
};

// Of the ratios within rounds: three quarters are above `low`, three quarters below `high`.
struct Ratio {
    double low;
    double median;
    double high;
};

// `rounds` times each of them once, in an order that changes from round to round.
std::vector<Measurement> measure_in_turns(const std::vector<Contender>& contenders, int rounds);
// How many times as long the one took as the other, both of them measured in turns.
Ratio ratio_of(const Measurement& one, const Measurement& other);
Ratio ratio_of(const std::vector<double>& one, const std::vector<double>& other); // their times

} // namespace lks_bench
