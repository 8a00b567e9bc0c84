#include <algorithm>

#include "measure.h"
#include "sections.h"
#include "variant.h"

namespace lks_bench {

void measure_growth(int rounds, Results& results) {
    for (const Workload& workload : growth_workloads()) {
        const WorkloadAsset asset(workload);
        const double constraints = lks_asset_constraint_count(asset.get());
        const double units = constraints * workload.substeps * workload.iterations;
        std::vector<std::unique_ptr<Variant>> variants;
        std::vector<Contender> contenders;
        for (const std::string& name : variant_names(workload)) {
            Variant* variant = variants.emplace_back(make_variant(workload, name)).get();
            contenders.push_back({name, [variant] { variant->tick(); }, units});
        }
        // A million constraints in plain integers take a quarter of a second a tick.
        const int affordable = std::max(3, std::min(rounds, static_cast<int>(1e7 / units * 21)));
        for (const Measurement& m : measure_in_turns(contenders, std::min(rounds, affordable))) {
            results.push_back(
                {workload.name, "tick", m.name, m.nanoseconds, "ns a projection", m.ratio, m.least});
        }
        results.push_back({workload.name, "constraints", "", constraints, ""});
    }
}

} // namespace lks_bench
