#include "measure.h"

#include <algorithm>
#include <chrono>

namespace lks_bench {
namespace {

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
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
        std::vector<double> ratios;
        for (int round = 0; round < rounds; ++round) {
            ratios.push_back(times[i][static_cast<std::size_t>(round)] /
                             times[0][static_cast<std::size_t>(round)]);
        }
        results.push_back({contenders[i].name, median(times[i]),
                           *std::min_element(times[i].begin(), times[i].end()), median(ratios)});
    }
    return results;
}

} // namespace lks_bench
