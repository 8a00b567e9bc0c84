#include "stairs.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>

#include "bullet_crowd.h"
#include "bullet_peer.h"
#include "our_crowd.h"

namespace lks_accuracy {
namespace {

constexpr int repetitions = 3;

// Each tick's cost is the least of three falls, which are the same.
Row fall(const std::string& solver, const reference::Schedule& schedule, const lks_bench::Crowd& crowd,
         const std::function<std::unique_ptr<lks_bench::CrowdWorld>()>& make, int ticks) {
    using Clock = std::chrono::steady_clock;
    std::vector<double> costs(static_cast<std::size_t>(ticks), std::numeric_limits<double>::infinity());
    double sum = 0;
    std::size_t count = 0;
    double worst = 0;
    double gained = 0;
    double start_energy = 0;
    for (int repetition = 0; repetition < repetitions; ++repetition) {
        const std::unique_ptr<lks_bench::CrowdWorld> world = make();
        start_energy = world->energy();
        double least_energy = start_energy;
        for (double& cost : costs) {
            const Clock::time_point begin = Clock::now();
            world->tick();
            cost = std::min(cost, std::chrono::duration<double, std::nano>(Clock::now() - begin).count());
            for (const double error : world->joint_errors()) {
                sum += error;
                ++count;
                worst = std::max(worst, error);
            }
            const double energy = world->energy();
            gained = std::max(gained, energy - least_energy);
            least_energy = std::min(least_energy, energy);
        }
    }
    Row row{solver, schedule};
    row.nanoseconds = std::accumulate(costs.begin(), costs.end(), 0.0) /
                      (static_cast<double>(crowd.places.size()) * crowd.bone_count * ticks);
    row.errors = {1000 * sum / static_cast<double>(count), 1000 * worst, 100 * gained / start_energy};
    return row;
}

} // namespace

Experiment measure_stairs(const Grid& grid, int ticks, const Progress& progress) {
    Experiment experiment{"ragdoll_stairs", "Ragdolls, stairs",
                          "Four humanoids of 15 bodies stumble down ten steps; " +
                              std::to_string(ticks / 60) +
                              " seconds. Falls are chaotic: no places are compared."};
    experiment.quantities = {
        {"joint separation, mean", "mm",
         "how far the points that a joint holds together are apart; 0 is right", 1},
        {"joint separation, worst", "mm", "the most that any joint is in any tick", 10},
        {"energy gained", "%",
         "the most that energy rises again, relative to what they start with; 0 is right", 5}};
    experiment.unit_of_work = "body";
    const lks_bench::CrowdStairs crowd;
    for (const int substeps : grid.substeps) {
        for (const int iterations : grid.iterations) {
            const reference::Schedule schedule{substeps, iterations};
            if (schedule.substeps * schedule.iterations > grid.most_passes) {
                continue;
            }
            progress("ragdoll_stairs: " + label_of(schedule));
            const auto ours = [&] {
                return std::make_unique<lks_bench::OurCrowd>(crowd, static_cast<std::uint32_t>(substeps),
                                                             static_cast<std::uint32_t>(iterations));
            };
            experiment.rows.push_back(fall("fixed-point", schedule, crowd, ours, ticks));
        }
        // Bullet's own iterations are ten a step, and stay so.
        if (lks_bench::has_bullet() && substeps <= grid.most_passes) {
            const auto bullet = [&] { return lks_bench::make_bullet_crowd(crowd, substeps); };
            experiment.rows.push_back(fall("Bullet", {substeps, 10}, crowd, bullet, ticks));
        }
    }
    return experiment;
}

} // namespace lks_accuracy
