#include "crowd_errors.h"

#include <algorithm>

namespace lks_bench {

void CrowdErrors::add(const std::vector<double>& errors) {
    for (const double error : errors) {
        sum_ += error;
        worst_ = std::max(worst_, error);
    }
    count_ += errors.size();
}

void CrowdErrors::report(const char* workload, const std::string& measured, const std::string& variant,
                         double factor, const char* unit, Results& results) const {
    if (count_ != 0) {
        results.push_back(
            {workload, measured + ", mean", variant, factor * sum_ / static_cast<double>(count_), unit});
        results.push_back({workload, measured + ", worst", variant, factor * worst_, unit});
    }
}

} // namespace lks_bench
