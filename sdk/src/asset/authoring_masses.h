// Masses of vertices: given one by one, or spread by area or length.
#pragma once

#include "asset/build.h"

namespace lks {

struct MassSource {
    double mass;                 // kg in all
    double density;              // kg/m² or kg/m
    const double* vertex_masses; // kg
    const char* density_name;    // "area_density"
};

// `extents` is each vertex's share of the area or length, in any unit; `unit` is that unit in m² or m.
// Exactly one source must be given, and each vertex come to 1e-8 .. 1e6 kg.
lks_result spread_mass(Build& build, const MassSource& source, const Array<fixed::Scaled>& extents,
                       const fixed::Scaled& unit);

} // namespace lks
