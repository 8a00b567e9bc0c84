// Authored numbers, checked: the ranges of a definition's doubles, and their exact values.
#pragma once

#include <lockstitch/asset.h>

#include "asset/build.h"

namespace lks {

// A finite number between low and high; both given as ratios so that the check is exact.
struct AuthoredRange {
    fixed::Scaled low;
    fixed::Scaled high;
    const char* text; // "from 1e-8 to 1e6 kg"
};

lks_result read_authored(lks_error* error, const char* name, double value, const AuthoredRange& range,
                         fixed::Scaled& out);
// 0 is allowed beside the range.
lks_result read_authored_or_zero(lks_error* error, const char* name, double value, const AuthoredRange& range,
                                 fixed::Scaled& out);

// A position's component within ±LKS_MAX_ASSET_COORDINATE, as a coordinate.
lks_result read_coordinate(lks_error* error, const char* what, std::uint32_t index, char axis, double value,
                           std::int64_t& out);
// What asks for it may be this long, metres, at most 120.
struct LengthRange {
    std::int64_t most;
    const char* text; // "above 0 and at most 60 m"
};

// A length above 0, as a coordinate.
lks_result read_length(lks_error* error, const char* name, double value, const LengthRange& range,
                       std::int64_t& out);

lks_result read_family(lks_error* error, const char* name, const lks_distance_material& material,
                       Family& out);

// Radius and friction, which all kinds of assets have.
lks_result read_surface(lks_error* error, double particle_radius, double friction, lks_asset& asset);

// vertex_count positions.
lks_result read_positions(Build& build, const char* what, const double* values, std::uint32_t count);

} // namespace lks
