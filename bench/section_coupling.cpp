#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "crowd_errors.h"
#include "dressed_crowd.h"
#include "sections.h"

namespace lks_bench {
namespace {

struct Run {
    std::string name;
    std::unique_ptr<DressedCrowd> dressed;
    std::vector<double> times{}; // ms
    CrowdErrors joints{};
    CrowdErrors attachments{};

    void tick(bool settled) {
        const auto start = std::chrono::steady_clock::now();
        dressed->crowd().tick();
        times.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        // At first the capes' edges are drawn together to the shoulders.
        if (settled) {
            joints.add(dressed->crowd().joint_errors());
            attachments.add(dressed->attachment_errors());
        }
    }
    double mean() const {
        double sum = 0;
        for (const double time : times) {
            sum += time;
        }
        return sum / static_cast<double>(times.size());
    }
};

} // namespace

void measure_coupling(int rounds, Results& results) {
    const int ticks = fall_ticks(rounds);
    const int settled_after = std::min(ticks - 1, 6);
    struct Kind {
        const char* name;
        Dress dress;
        std::uint32_t workers;
    };
    std::vector<Run> runs;
    for (const std::uint32_t substeps : {20u, 8u}) {
        for (const Kind& kind :
             {Kind{"coupled", Dress::coupled, 1}, Kind{"attached only", Dress::attached, 1},
              Kind{"side by side", Dress::beside, 1}, Kind{"bodies alone", Dress::none, 1},
              Kind{"coupled, two workers", Dress::coupled, 2},
              Kind{"side by side, two workers", Dress::beside, 2}}) {
            if (substeps == 8 && kind.workers > 1) {
                continue;
            }
            runs.push_back({std::to_string(substeps) + " substeps, " + kind.name,
                            std::make_unique<DressedCrowd>(kind.dress, substeps, kind.workers)});
        }
    }
    // All take turns, tick by tick.
    for (int tick = 0; tick < ticks; ++tick) {
        for (Run& run : runs) {
            run.tick(tick >= settled_after);
        }
    }
    results.push_back({coupling_name, ticks_title(ticks), "", static_cast<double>(ticks), ""});
    results.push_back(
        {coupling_name, "particles", "", static_cast<double>(runs.front().dressed->particles()), ""});
    for (const Run& run : runs) {
        const double mean = run.mean();
        results.push_back({coupling_name, "whole tick", run.name, mean, "ms", mean / runs.front().mean()});
    }
    for (const Run& run : runs) {
        run.joints.report(coupling_name, "joint error", run.name, results);
        run.attachments.report(coupling_name, "attachment error", run.name, results);
    }
}

} // namespace lks_bench
