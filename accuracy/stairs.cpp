#include "stairs.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>

#include "bullet_crowd.h"
#include "bullet_peer.h"
#include "call_time.h"
#include "crowd_twin.h"
#include "our_crowd.h"

namespace lks_accuracy {
namespace {

constexpr int repetitions = 3;
constexpr int reference_substeps = 320;

// Each tick's cost is the least of three falls, which are the same.
Row fall(const std::string& solver, const reference::Schedule& schedule, const lks_bench::Crowd& crowd,
         const std::function<std::unique_ptr<lks_bench::CrowdWorld>()>& make, int ticks) {
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
            cost = std::min(cost, nanoseconds_of([&] { world->tick(); }));
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

std::unique_ptr<lks_bench::OurCrowd> make_ours(const lks_bench::Crowd& crowd,
                                               const reference::Schedule& schedule) {
    return std::make_unique<lks_bench::OurCrowd>(crowd, static_cast<std::uint32_t>(schedule.substeps),
                                                 static_cast<std::uint32_t>(schedule.iterations));
}

using Places = std::vector<support::Vector>;

double largest_distance(const Places& a, const Places& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        largest = std::max(largest, (a[i] - b[i]).length());
    }
    return largest;
}

// Where bones are after so many ticks.
Places our_places(const lks_bench::Crowd& crowd, const reference::Schedule& schedule, int ticks) {
    const std::unique_ptr<lks_bench::OurCrowd> world = make_ours(crowd, schedule);
    for (int tick = 0; tick < ticks; ++tick) {
        world->tick();
    }
    Places places;
    for (const lks_body_id body : world->bodies()) {
        lks_transform transform;
        lks_body_transform(world->world(), body, &transform);
        places.push_back(support::metres(transform.position));
    }
    return places;
}

Places twin_places(const lks_bench::Crowd& crowd, const reference::Schedule& schedule, bool single,
                   int ticks) {
    const std::unique_ptr<CrowdTwin> world = make_crowd_twin(crowd, schedule, single);
    for (int tick = 0; tick < ticks; ++tick) {
        world->tick();
    }
    return world->positions();
}

} // namespace

Row fall_of_ours(const reference::Schedule& schedule, int ticks) {
    const lks_bench::CrowdStairs crowd;
    return fall(
        "fixed-point", schedule, crowd, [&] { return make_ours(crowd, schedule); }, ticks);
}

Experiment measure_stairs(const Grid& grid, int ticks, const Progress& progress) {
    // Until chance has its way with them.
    const int early = std::min(ticks, 18);
    Experiment experiment{
        "ragdoll_stairs", "Ragdolls, stairs",
        "Four humanoids of 15 bodies stumble down ten steps; " + std::to_string(ticks / 60) +
            " seconds. Falls are chaotic: places are compared after " + seconds_of(early) + "."};
    experiment.quantities = {
        {"joint separation, mean", "mm",
         "how far the points that a joint holds together are apart, on the average; 0 is right", 1},
        {"joint separation, worst", "mm",
         "the most that the points of any joint are apart in any tick; 0 is right", 10},
        {"energy gained", "%",
         "the most that energy rises again, relative to what they start with; 0 is right", 5},
        {"deviation", "m",
         "the farthest that any bone is from the converged solution after " + seconds_of(early)},
        {"rounding", "m",
         "the farthest that any bone is after " + seconds_of(early) +
             " from where the same method in double precision has it at the same setting",
         0, 3}};
    experiment.unit_of_work = "body";
    experiment.has_rounding = true;
    experiment.rounding = 4;
    const lks_bench::CrowdStairs crowd;
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    const Places converged = twin_places(crowd, {reference_substeps, 1}, false, early);
    for (const int substeps : grid.substeps) {
        for (const int iterations : grid.iterations) {
            const reference::Schedule schedule{substeps, iterations};
            if (schedule.substeps * schedule.iterations > grid.most_passes) {
                continue;
            }
            progress("ragdoll_stairs: " + label_of(schedule));
            const Places twin = twin_places(crowd, schedule, false, early);
            const auto add = [&](Row row, const Places& places, double rounding) {
                row.errors.push_back(largest_distance(places, converged));
                row.errors.push_back(rounding);
                experiment.rows.push_back(std::move(row));
            };
            const Places ours = our_places(crowd, schedule, early);
            add(fall_of_ours(schedule, ticks), ours, largest_distance(ours, twin));
            for (const bool single : {true, false}) {
                const auto make = [&] { return make_crowd_twin(crowd, schedule, single); };
                const Places places = single ? twin_places(crowd, schedule, true, early) : twin;
                add(fall(single ? "float32" : "double", schedule, crowd, make, ticks), places,
                    single ? largest_distance(places, twin) : unknown);
            }
        }
        // Bullet's own iterations are ten a step, and stay so.
        if (lks_bench::has_bullet() && substeps <= grid.most_passes) {
            const auto bullet = [&] { return lks_bench::make_bullet_crowd(crowd, substeps); };
            Row row = fall("Bullet", {substeps, 10}, crowd, bullet, ticks);
            row.errors.insert(row.errors.end(), {unknown, unknown});
            experiment.rows.push_back(std::move(row));
        }
    }
    return experiment;
}

} // namespace lks_accuracy
