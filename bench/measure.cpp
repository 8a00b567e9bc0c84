#include "measure.h"

#include <algorithm>
#include <chrono>

namespace lks_bench {
namespace {

// So many quarters of the values are less.
double quartile(std::vector<double> values, std::size_t quarters) {
    std::sort(values.begin(), values.end());
    return values[std::min(values.size() * quarters / 4, values.size() - 1)];
}

double median(const std::vector<double>& values) {
    return quartile(values, 2);
}

std::vector<double> ratios_of(const std::vector<double>& ones, const std::vector<double>& others) {
    std::vector<double> ratios;
    for (std::size_t round = 0; round < ones.size(); ++round) {
        ratios.push_back(ones[round] / others[round]);
    }
    return ratios;
}

} // namespace

std::vector<Measurement> measure_in_turns(const std::vector<Contender>& contenders, int rounds) {
    using Clock = std::chrono::steady_clock;
    const std::size_t count = contenders.size();
    std::vector<std::vector<double>> times(count);
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t turn = 0; turn < count; ++turn) {
            const std::size_t i = (turn + static_cast<std::size_t>(round)) % count;
            const Clock::time_point begin = Clock::now();
            contenders[i].run();
            const double elapsed = std::chrono::duration<double, std::nano>(Clock::now() - begin).count();
            times[i].push_back(elapsed / contenders[i].units);
        }
    }
    std::vector<Measurement> results;
    for (std::size_t i = 0; i < count; ++i) {
        results.push_back({contenders[i].name, median(times[i]),
                           *std::min_element(times[i].begin(), times[i].end()),
                           median(ratios_of(times[i], times[0])), times[i]});
    }
    return results;
}

Ratio ratio_of(const Measurement& one, const Measurement& other) {
    return ratio_of(one.times, other.times);
}

Ratio ratio_of(const std::vector<double>& one, const std::vector<double>& other) {
    const std::vector<double> ratios = ratios_of(one, other);
    return {quartile(ratios, 1), median(ratios), quartile(ratios, 3)};
}

} // namespace lks_bench
