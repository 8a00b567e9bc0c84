// What was measured, as one flat table.
#pragma once

#include <string>
#include <vector>

namespace lks_bench {

struct Result {
    std::string workload;
    std::string measured; // "projection", "tick", ...
    std::string variant;
    double value;
    std::string unit;
    double ratio = 0; // to the first variant, median of the ratios within rounds; 0: none
    // Of the rounds, the value being their median: the least time, the highest rate, the ratio of the least
    // times; 0: none.
    double best = 0;
    double low = 0; // where the value is a median of ratios within rounds, their quartiles; 0: none
    double high = 0;
    std::vector<double> times{}; // a round each, of what is measured in turns with others: nanoseconds a unit
};

using Results = std::vector<Result>;

// Null: nothing of that kind.
const Result* find(const Results& results, const std::string& workload, const std::string& measured,
                   const std::string& variant);

std::string to_json(const Results& results); // an array, an object a line
std::string to_csv(const Results& results);

} // namespace lks_bench
