// The scenes of cloth, rope and spring that cost and error are measured on.
#pragma once

#include <string>
#include <vector>

#include "reference/particle_scene.h"

namespace lks_accuracy {

struct MeasuredScene {
    std::string name;
    std::string title;
    std::string what;
    reference::ParticleScene scene;
    int ticks = 60;                         // stretch and energy are looked at until then
    int deviation_tick = 60;                // where particles are compared, before chaos has its way
    bool is_regular = false;                // not chaotic: places can be compared after a minute
    std::vector<int> later_ticks{};         // when they are, beside the direct solution
    bool keeps_energy = false;              // nothing takes it out: no air, nothing soft
    std::size_t lowest_vertex = 0;          // whose height is the sag; 0: the mean of all
    const char* sag_of = "";                // "the rope's end"
    bool has_compliance = false;            // PBD can't have it
    int reference_substeps = 640;           // in double precision, one iteration each
    std::vector<int> recommended{};         // substeps of one iteration that docs/accuracy.md names
    std::vector<int> recommended_at_once{}; // the same of a rope that is solved at once

    bool is_rope() const { return !scene.rest.empty(); }
    bool is_pinned() const { return !scene.pins.empty(); }
    bool may_be_tethered() const { return !is_rope() && is_pinned(); }
};

// The same rope, solved at once.
MeasuredScene at_once(MeasuredScene rope);

// The same cloth, with two tethers a vertex to its pins.
MeasuredScene tethered(MeasuredScene cloth);

MeasuredScene rope_swing();
MeasuredScene rope_heavy_end();
MeasuredScene cloth_hang();
MeasuredScene cloth_drape();
// Four times as many vertices: minutes where it is to converge.
MeasuredScene cloth_fine();
// All but the fine cloth.
std::vector<MeasuredScene> measured_scenes();

} // namespace lks_accuracy
