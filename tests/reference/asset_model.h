// A model of what stands in a world, read back through the public API.
#pragma once

#include "reference/model.h"
#include "support/handles.h"

namespace reference {

// Starts where the object is now, relative to `place`.
Model model_of(const support::World& world, lks_object_id object, const support::Asset& asset,
               const lks_vec3& place, const std::vector<double>& masses, const Materials& materials,
               EdgeOrder order = EdgeOrder::canonical);

} // namespace reference
