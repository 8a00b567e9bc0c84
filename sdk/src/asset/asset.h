// What an asset is once it is built: immutable, in the solver's own particle order.
//
// Constraints stand in the order in which the solver visits them: by batch (family, then colour). A batch
// touches no particle twice, so inside it any order, vector width or number of threads gives the same bits.
// Particles are numbered so that much of a batch consists of runs, in which both ends advance by one.
#pragma once

#include <lockstitch/asset.h>

#include <atomic>
#include <cstdint>

#include "asset/constraint_runs.h"
#include "asset/tethers.h"
#include "fixed/formats.h"
#include "fixed/scaled.h"
#include "memory/array.h"

namespace lks {

inline constexpr std::uint32_t family_count = 3;

struct Family {
    bool enabled = false;
    fixed::Scaled compliance{}; // m/N
    fixed::Scaled damping{};    // N·s/m
};

// The constraints of one family and colour: first its runs (each of at least minimum_run_length), then single
// ones.
struct Batch {
    std::uint32_t first; // constraint
    std::uint32_t count;
    std::uint32_t family; // lks_constraint_family
    std::uint32_t colour; // counted through all families
    std::uint32_t first_run;
    std::uint32_t run_count;
    std::uint32_t first_single; // constraint; up to first + count
    // Differences of coordinates are shifted right by this before they are multiplied (20 .. 30), see
    // solver/distance.h.
    std::int32_t difference_shift;
    // Rest lengths are rest_mantissa · 2^(difference_shift - rest_exponent) coordinate units.
    std::int32_t rest_exponent;
};

inline constexpr std::uint32_t minimum_run_length = 8;

struct Coordinates {
    std::int64_t x, y, z;
};

} // namespace lks

// The opaque type of the C API.
struct lks_asset {
    enum class Kind : std::uint32_t { cloth = 1, rope = 2 };

    explicit lks_asset(const lks_allocator& memory)
        : allocator(memory), vertex_to_particle(memory), particle_to_vertex(memory), rest_positions(memory),
          inverse_masses(memory), masses(memory), constraints(memory), rest_lengths(memory),
          rest_mantissas(memory), batches(memory), runs(memory), incident_offsets(memory),
          incident_constraints(memory), chain(memory), tethers(memory), triangles(memory) {}

    lks_allocator allocator;
    mutable std::atomic<std::uint32_t> holders{1}; // the caller, and each world that knows it
    Kind kind = Kind::cloth;
    std::uint64_t fingerprint = 0;
    std::uint32_t colour_count = 0;

    lks::Array<std::uint32_t> vertex_to_particle;
    lks::Array<std::uint32_t> particle_to_vertex;
    lks::Array<lks::Coordinates> rest_positions;   // by particle, Coordinate format
    lks::Array<lks::fixed::Scaled> inverse_masses; // by particle, 1/kg
    lks::Array<lks::fixed::Scaled> masses;         // by particle, kg

    lks::Array<lks::Constraint> constraints;
    lks::Array<std::int64_t> rest_lengths;    // by constraint, Coordinate format
    lks::Array<std::uint32_t> rest_mantissas; // by constraint, see Batch::rest_exponent; padded
    lks::Array<lks::Batch> batches;
    lks::Array<lks::Run> runs;
    // Constraints of particle p: incident_constraints[incident_offsets[p] .. incident_offsets[p + 1]).
    lks::Array<std::uint32_t> incident_offsets;
    lks::Array<std::uint32_t> incident_constraints;

    // Of a rope that may be solved directly (asset/rope_solver.h): the constraint of each segment, in their
    // order.
    lks::Array<std::uint32_t> chain;
    lks_rope_solver solver = LKS_ROPE_AUTOMATIC; // that a rope asks for

    lks::Tethers tethers;

    lks::Array<std::uint32_t> triangles; // the caller's numbering, three a triangle

    lks::Family families[lks::family_count];
    std::int64_t particle_radius = 0; // Coordinate format
    std::int64_t friction = 0;        // World format

    std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(vertex_to_particle.size()); }
    std::uint32_t constraint_count() const { return static_cast<std::uint32_t>(constraints.size()); }
};

namespace lks {

void retain_asset(const lks_asset* asset);
void release_asset(const lks_asset* asset);

} // namespace lks
