#include "plot_looks.h"

#include <algorithm>
#include <utility>

namespace lks_bench {

std::vector<std::string> variants_of(const Results& results, const std::string& workload,
                                     const std::string& measured) {
    std::vector<std::string> names;
    for (const Result& r : results) {
        if (r.workload.rfind(workload, 0) == 0 && r.measured == measured && !r.variant.empty() &&
            std::find(names.begin(), names.end(), r.variant) == names.end()) {
            names.push_back(r.variant);
        }
    }
    return names;
}

bool is_ours(const std::string& variant) {
    return variant.rfind("float32", 0) != 0 && variant.rfind("Bullet", 0) != 0;
}

std::string name_in_plots(const std::string& variant) {
    return is_ours(variant) ? "ours, " + variant : variant;
}

std::string colour_of(const std::string& variant) {
    static const std::pair<const char*, const char*> colours[] = {
        {"scalar", "#9ecae1"},
        {"sse4.1", "#4292c6"},
        {"avx2", "#08519c"},
        {"avx512", "#081d58"},
        {"neon", "#08519c"},
        {"float32 runs, scalar", "#fdbe85"},
        {"float32 runs, AVX2", "#fd8d3c"},
        {"float32 runs, AVX-512", "#d94701"},
        {"float32 plain, coloured", "#969696"},
        {"float32 plain, by index", "#525252"},
        {"Bullet soft body", "#31a354"},
    };
    for (const auto& [name, colour] : colours) {
        if (variant == name) {
            return std::string(" lc rgb '") + colour + "'";
        }
    }
    return " lc rgb '#54278f'";
}

} // namespace lks_bench
