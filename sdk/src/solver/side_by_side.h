// Which objects may go through a tick side by side, in one call of a kernel: ropes and small cloths of one
// asset that are pinned at the same vertices. A single rope's runs are too short to fill a kernel's time.
#pragma once

#include <cstddef>

#include "kernels/kernels.h"
#include "solver/object.h"

namespace lks {

// Whether it may with others at all.
bool may_go_side_by_side(const Kernels& kernels, const Object& object);
// Of two that may.
bool are_alike(const Object& a, const Object& b);

// How far the particles of one are from those of another that is alike: for DistanceTask::objects.
std::ptrdiff_t distance_between(const Object& from, const Object& to);

} // namespace lks
