// Pinned particles: infinite mass, moved evenly over the substeps of a tick from where they are to their
// targets.
#pragma once

#include "solver/object.h"

namespace lks {

// Remembers where each pinned particle starts this tick.
void begin_pin_motion(Object& object);

// Puts the pinned particles where they are at the end of substep `substep` (1 .. substeps); their starts are
// where they were at the end of the one before. Called after the prediction, and again after contacts, which
// know no masses.
void place_pins(Object& object, std::uint32_t substep, std::uint32_t substeps);

// from + (to − from)·numerator/denominator in integers, exact at both ends, wrapping.
std::int64_t interpolate_coordinate(std::int64_t from, std::int64_t to, std::uint32_t numerator,
                                    std::uint32_t denominator);

} // namespace lks
