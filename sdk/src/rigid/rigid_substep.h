// One substep of all bodies, and of the objects that go with them.
//
// Its stages are cut into blocks that a team works off at the same time: bodies and contacts where each is
// looked at by itself, figures (rigid/figures.h) where something is pushed. Figures have nothing in common
// that moves but shared contacts, and those the caller sweeps alone, so that the bits are the same with any
// number of workers.
#pragma once

#include "rigid/body_motion.h"
#include "rigid/figure_blocks.h"
#include "rigid/figure_contacts.h"
#include "rigid/free_figure.h"
#include "rigid/impacts.h"
#include "rigid/rigid_scene.h"
#include "rigid/strained_figures.h"
#include "threads/team.h"

struct lks_world;

namespace lks {

class RigidSubstep {
public:
    // team: null, or who helps. Once contacts, trees and figures of the tick are known.
    RigidSubstep(lks_world& world, Team* team);
    RigidSubstep(const RigidSubstep&) = delete;
    RigidSubstep& operator=(const RigidSubstep&) = delete;

    // 1 .. substeps.
    void run(std::uint32_t substep);

private:
    void solve_trees(const FigureBundle& bundle);

    void begin(std::uint32_t substep);
    void predict(std::uint32_t substep);
    void carry_pushes_on();
    void project_joints(const FigureRange& figure);
    void project_back(const FigureRange& figure);
    void iterate(std::uint32_t substep);
    bool turns_fast(std::uint32_t body) const;
    bool may_gain(const FigureRange& figure) const;
    void mark_contacts();
    void project_attachments();
    void project_loaded_ropes();
    void collide_objects(std::uint32_t substep);
    void finish_bodies();
    void finish_figures(std::uint32_t substep);
    void add_up_contact_pushes();
    void undo_errors();
    void finish(std::uint32_t substep);

    lks_world& world_;
    RigidScene& scene_;
    MotionRate rate_;
    FigureBlocks blocks_;
    FigureContacts contacts_;
    Impacts impacts_;
    StrainedFigures strained_;
    FreeFigures free_figures_;
    std::int64_t least_speed_; // of figures whose carried pushes are worth scaling
};

} // namespace lks
