// What a cloth or a rope went through: the figures by which the hard cases are judged. The same code measures
// the SDK and the float32 twin.
#pragma once

#include <cstddef>
#include <vector>

#include "reference/model.h"
#include "support/numbers.h"

namespace stability {

struct Measured {
    double stretch = 0;        // largest |length / rest - 1|
    double off = 0;            // share of the edges whose stretch is beyond the tolerance
    double kinetic_energy = 0; // J
    double energy = 0;         // J: kinetic and of height
    double elastic_energy = 0; // J, of what has a compliance
    double reach = 0;          // m, of the farthest particle from the place
    double depth = 0;          // m, of the deepest free particle in a collider
};

// Of what the laws of motion know: masses, edges and gravity.
class Meter {
public:
    Meter(reference::Model model, const support::Vector& gravity, double tolerance);

    // Edges that are shorter than this share of the longest are left out of stretch.
    void leave_out_shorter_than(double share) { shortest_ = share * longest_; }
    void set_pinned(std::size_t particle, bool pinned) { pinned_[particle] = pinned; }
    bool is_pinned(std::size_t particle) const { return pinned_[particle]; }

    Measured measure(const std::vector<support::Vector>& positions,
                     const std::vector<support::Vector>& velocities) const;

    const reference::Model& model() const { return model_; }

private:
    reference::Model model_;
    support::Vector gravity_;
    double tolerance_;
    std::vector<bool> pinned_;
    double longest_ = 0;
    double shortest_ = 0;
};

// The extremes over the ticks since it began.
class Course {
public:
    Course() = default;
    Course(const Measured& start, double tick_seconds);

    void add(const Measured& now);

    const Measured& start() const { return start_; }
    const Measured& worst() const { return worst_; } // of each figure by itself
    const Measured& last() const { return last_; }
    // The most that the energy has been above what there was at the start with the springs', J. What springs
    // hold later is left out: where they are stiff it is the error that the iterations left, and comes to
    // nothing.
    double gained() const { return worst_.energy - start_.energy - start_.elastic_energy; }
    // The same as a share of the greatest kinetic energy.
    double gained_share() const { return gained() / worst_.kinetic_energy; }
    // Seconds until 99 of 100 edges were within the tolerance for good; infinite where they never are. A
    // cloth that was crumpled may keep a fold or two that it cannot get out of.
    double recovery() const;
    // Seconds until no free particle was in a collider for good; infinite where one still is.
    double way_out() const;
    // Every number is one.
    bool is_finite() const { return finite_; }

private:
    double seconds_until(std::size_t tick) const;

    Measured start_, worst_, last_;
    double tick_seconds_ = 0;
    std::size_t ticks_ = 0;
    std::size_t recovered_after_ = 0; // ticks
    std::size_t out_after_ = 0;
    bool finite_ = true;
};

} // namespace stability
