#include <cmath>

#include "asset/asset.h"
#include "measure.h"
#include "sections.h"
#include "variant.h"

namespace lks_bench {
namespace {

constexpr int ticks_before = 60;
constexpr int ticks_looked_at = 60;

struct Schedule {
    std::uint32_t substeps, iterations;
};

constexpr Schedule schedules[] = {{1, 5},  {1, 10}, {1, 20}, {1, 40}, {1, 80}, {5, 1}, {10, 1},
                                  {20, 1}, {40, 1}, {80, 1}, {5, 4},  {10, 4}, {20, 4}};

// Squares of relative stretches, in a simulation as it runs.
class StretchMeter {
public:
    explicit StretchMeter(const lks_asset& asset) : asset_(asset) {}

    void look(const std::vector<Point>& points) {
        constexpr double metre = 1.0 / 72057594037927936.0; // 2^-56
        for (std::uint32_t i = 0; i < asset_.constraint_count(); ++i) {
            const Point& a = points[asset_.particle_to_vertex[asset_.constraints[i].a]];
            const Point& b = points[asset_.particle_to_vertex[asset_.constraints[i].b]];
            const double length = std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
            const double stretch = length / (static_cast<double>(asset_.rest_lengths[i]) * metre) - 1;
            sum_ += stretch * stretch;
            ++count_;
        }
    }
    double root_mean_square() const { return std::sqrt(sum_ / static_cast<double>(count_)); }

private:
    const lks_asset& asset_;
    double sum_ = 0;
    std::uint64_t count_ = 0;
};

} // namespace

void measure_accuracy(int rounds, Results& results) {
    for (const Schedule schedule : schedules) {
        const Workload workload{.name = accuracy_name,
                                .title = "",
                                .substeps = schedule.substeps,
                                .iterations = schedule.iterations,
                                .warm_ticks = 0};
        const std::string label =
            std::to_string(schedule.substeps) + " × " + std::to_string(schedule.iterations);
        const WorkloadAsset asset(workload);
        std::vector<std::unique_ptr<Variant>> variants;
        std::vector<Contender> contenders;
        for (const std::string& name : variant_names(workload)) {
            Variant* variant = variants.emplace_back(make_variant(workload, name)).get();
            StretchMeter meter(*asset.get());
            for (int tick = 0; tick < ticks_before + ticks_looked_at; ++tick) {
                variant->tick();
                if (tick >= ticks_before) {
                    meter.look(variant->points());
                }
            }
            results.push_back({accuracy_name, label, name, meter.root_mean_square(), "relative stretch"});
            contenders.push_back({name, [variant] { variant->tick(); }, 1});
        }
        for (const Measurement& m : measure_in_turns(contenders, rounds)) {
            results.push_back({accuracy_name, label, m.name, m.nanoseconds * 1e-6, "ms", 0, m.least * 1e-6});
        }
    }
}

} // namespace lks_bench
