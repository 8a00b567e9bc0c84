#include "stability/support/course.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace stability {
namespace {

using support::Vector;

// What is no number is worse than every number.
void keep_greatest(double& greatest, double value) {
    if (!(value <= greatest)) {
        greatest = value;
    }
}

} // namespace

Meter::Meter(reference::Model model, const Vector& gravity, double tolerance)
    : model_(std::move(model)), gravity_(gravity), tolerance_(tolerance), pinned_(model_.positions.size()) {
    for (const reference::Edge& edge : model_.edges) {
        longest_ = std::max(longest_, edge.rest);
    }
}

Measured Meter::measure(const std::vector<Vector>& positions, const std::vector<Vector>& velocities) const {
    Measured result;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        keep_greatest(result.reach, positions[i].length());
        if (!pinned_[i]) {
            result.kinetic_energy += 0.5 * model_.masses[i] * velocities[i].dot(velocities[i]);
            result.energy -= model_.masses[i] * gravity_.dot(positions[i]);
        }
    }
    for (const reference::Edge& edge : model_.edges) {
        const double error = (positions[edge.a] - positions[edge.b]).length() - edge.rest;
        if (edge.rest >= shortest_) {
            const double stretch = std::abs(error) / edge.rest;
            keep_greatest(result.stretch, stretch);
            result.off += stretch <= tolerance_ ? 0 : 1;
        }
        if (edge.compliance > 0) {
            result.elastic_energy += 0.5 * error * error / edge.compliance;
        }
    }
    result.off /= static_cast<double>(model_.edges.size());
    result.energy += result.kinetic_energy;
    return result;
}

Course::Course(const Measured& start, double tick_seconds)
    : start_(start), worst_(start), last_(start), tick_seconds_(tick_seconds) {}

void Course::add(const Measured& now) {
    last_ = now;
    ++ticks_;
    keep_greatest(worst_.stretch, now.stretch);
    keep_greatest(worst_.kinetic_energy, now.kinetic_energy);
    keep_greatest(worst_.energy, now.energy);
    keep_greatest(worst_.elastic_energy, now.elastic_energy);
    keep_greatest(worst_.reach, now.reach);
    keep_greatest(worst_.depth, now.depth);
    if (!(now.off <= 0.01)) {
        recovered_after_ = ticks_;
    }
    if (!(now.depth <= 1e-5)) {
        out_after_ = ticks_;
    }
    finite_ = finite_ && std::isfinite(now.stretch) && std::isfinite(now.energy) && std::isfinite(now.reach);
}

double Course::recovery() const {
    return seconds_until(recovered_after_);
}

double Course::way_out() const {
    return seconds_until(out_after_);
}

double Course::seconds_until(std::size_t tick) const {
    if (tick == ticks_ && ticks_ > 0) {
        return std::numeric_limits<double>::infinity();
    }
    return static_cast<double>(tick) * tick_seconds_;
}

} // namespace stability
