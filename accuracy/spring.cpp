#include "spring.h"

#include <cmath>
#include <limits>

#include "call_time.h"
#include "paper.h"

namespace lks_accuracy {
namespace {

using reference::Engine;

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr double amplitude = 0.5;

struct Swing {
    std::vector<double> elongations; // by tick, from the start on
    double nanoseconds = 0;
};

Swing swing(Engine engine, const reference::Schedule& schedule, int ticks) {
    const auto simulation = simulate(engine, spring_scene(), schedule, pbd_spring_stiffness);
    Swing result{{amplitude}};
    double least = std::numeric_limits<double>::infinity();
    for (int tick = 0; tick < ticks; ++tick) {
        least = std::min(least, nanoseconds_of([&] { simulation->tick(); }));
        result.elongations.push_back(simulation->positions()[1].x - 1);
    }
    result.nanoseconds = least / 2;
    return result;
}

// How much of the first swing's height is left in the last half second.
double height_left(const std::vector<double>& elongations) {
    double most = 0;
    for (std::size_t i = elongations.size() - 30; i < elongations.size(); ++i) {
        most = std::max(most, std::abs(elongations[i]));
    }
    return most / amplitude;
}

} // namespace

Experiment measure_spring(const Grid& grid, const std::vector<int>& seconds, const Progress& progress) {
    Experiment experiment{
        "spring", "Spring",
        "1 kg on a spring of 1 m and 1e-3 m/N (5 Hz), let go at 1.5 m, against the analytic "
        "solution."};
    experiment.quantities = {{"period", "%", "how far the period is from the analytic one", 1},
                             {"height lost", "%",
                              "how much smaller the swing is after a second: implicit steps take energy out",
                              10}};
    for (const int s : seconds) {
        experiment.quantities.push_back({"deviation, " + seconds_of(60 * s), "m",
                                         "how far it is from where it should be after " + seconds_of(60 * s),
                                         s == 1 ? 0.05 : 0});
    }
    experiment.quantities.push_back(
        {"rounding", "m",
         "how far it is after a second from the same method in double precision at "
         "the same setting",
         0, 2});
    experiment.has_rounding = true;
    experiment.rounding = experiment.quantities.size() - 1;

    progress("spring");
    const double frequency = 2 * std::acos(-1.0) / analytic_spring_period();
    const int ticks = 60 * seconds.back();
    for (const int substeps : grid.substeps) {
        for (const int iterations : grid.iterations) {
            const reference::Schedule schedule{substeps, iterations};
            if (schedule.substeps * schedule.iterations > grid.most_passes) {
                continue;
            }
            const Swing twin = swing(Engine::double_precision, schedule, ticks);
            for (const Engine engine :
                 {Engine::fixed_point, Engine::single_precision, Engine::double_precision, Engine::pbd}) {
                const Swing found = swing(engine, schedule, ticks);
                Row row{name_of(engine), schedule, found.nanoseconds};
                const std::vector<double> first_second(found.elongations.begin(),
                                                       found.elongations.begin() + 61);
                const double period = spring_period(first_second, 1.0 / 60);
                row.errors.push_back(100 * std::abs(period / analytic_spring_period() - 1));
                row.errors.push_back(100 * (1 - height_left(first_second)));
                for (const int s : seconds) {
                    row.errors.push_back(std::abs(found.elongations[60 * static_cast<std::size_t>(s)] -
                                                  amplitude * std::cos(frequency * s)));
                }
                const bool has_twin = engine == Engine::fixed_point || engine == Engine::single_precision;
                row.errors.push_back(has_twin ? std::abs(found.elongations[60] - twin.elongations[60])
                                              : undefined);
                experiment.rows.push_back(std::move(row));
            }
        }
    }
    return experiment;
}

} // namespace lks_accuracy
