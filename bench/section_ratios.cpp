#include "measure.h"
#include "sections.h"
#include "variant.h"

namespace lks_bench {
namespace {

constexpr const char* measured_names[] = {"cloth_64", "cloth_64_soft", "cloth_64_damped", "cloth_256",
                                          "ropes_200"};
enum Place { cloth, soft, damped, large, ropes };

struct Comparison {
    const char* title;
    Place one;
    Place other;
};

constexpr Comparison comparisons[] = {
    {"soft / stiff", soft, cloth}, {"damped / stiff", damped, cloth}, {"damped / soft", damped, soft},
    {"256² / 64²", large, cloth},  {"ropes / cloth", ropes, cloth},
};

} // namespace

void measure_ratios(int rounds, Results& results) {
    for (const std::string& level : our_names()) {
        std::vector<std::unique_ptr<Variant>> variants;
        std::vector<Contender> contenders;
        for (const char* name : measured_names) {
            const Workload& workload = *find_workload(name);
            const WorkloadAsset asset(workload);
            const double constraints = lks_asset_constraint_count(asset.get());
            Variant* variant = variants.emplace_back(make_variant(workload, level)).get();
            contenders.push_back({name, [variant] { variant->project(); },
                                  constraints * workload.objects * workload.substeps * workload.iterations});
        }
        const std::vector<Measurement> measured = measure_in_turns(contenders, rounds);
        for (const Comparison& comparison : comparisons) {
            const Ratio ratio = ratio_of(measured[comparison.one], measured[comparison.other]);
            const double of_least = measured[comparison.one].least / measured[comparison.other].least;
            results.push_back({ratios_name, comparison.title, level, ratio.median, "times as long", 0,
                               of_least, ratio.low, ratio.high});
        }
    }
}

} // namespace lks_bench
