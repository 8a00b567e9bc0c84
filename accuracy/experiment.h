// What one experiment of speed against error comes to: a row a solver and setting.
#pragma once

#include <string>
#include <vector>

#include "reference/particle_scene.h"

namespace lks_accuracy {

struct Quantity {
    std::string name; // "stretch, worst"
    std::string unit;
    std::string meaning;
    double seen = 0; // an error that is seen in a game: settings are ranked in this unit; 0: not by this
    int beside = -1; // of a rounding: the quantity that tells what the method itself is off
};

// Behind the name of a solver whose rope is solved at once.
inline constexpr const char* at_once_suffix = ", at once";
// Behind that of one whose cloth has tethers.
inline constexpr const char* tethered_suffix = ", tethers";

struct Row {
    std::string solver;
    reference::Schedule schedule{};
    double nanoseconds = 0;       // a particle (or body) and tick, the least of all ticks
    std::vector<double> errors{}; // by quantity; NaN: not defined for this solver

    int passes() const { return schedule.substeps * schedule.iterations; } // projections of each constraint
};

struct Experiment {
    std::string name;
    std::string title;
    std::string what; // in one sentence, what is simulated
    std::string unit_of_work = "particle";
    std::vector<Quantity> quantities{};
    // Deviation of the same quantity between fixed-point and double precision, and between double precision
    // and the converged reference: none where there is no such twin.
    bool has_rounding = false;
    std::size_t rounding = 0; // of the quantities
    std::size_t discretisation() const { return static_cast<std::size_t>(quantities[rounding].beside); }
    std::vector<Row> rows{};
};

std::string label_of(const reference::Schedule& schedule); // "20 × 1"
std::string seconds_of(int ticks);                         // "0.25 s"

// In the order of the rows, each once.
std::vector<std::string> solvers_of(const Experiment& experiment);
bool has_solver(const Experiment& experiment, const std::string& solver);
// The largest of a row's errors, each in units of what is seen.
double worst_seen(const Experiment& experiment, const Row& row);
// The row of this solver for which that is least among those of at most so many passes; null: none.
const Row* best_within(const Experiment& experiment, const std::string& solver, int passes);

} // namespace lks_accuracy
