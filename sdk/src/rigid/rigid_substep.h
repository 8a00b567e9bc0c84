// One substep of all bodies, and of the objects that go with them.
//
// Its stages are cut into blocks that a team works off at the same time: bodies and contacts where each is
// looked at by itself, figures (rigid/figures.h) where something is pushed. Figures have nothing in common
// that moves but shared contacts, and those the caller sweeps alone, so that the bits are the same with any
// number of workers.
#pragma once

#include "rigid/body_motion.h"
#include "rigid/free_figure.h"
#include "rigid/rigid_scene.h"
#include "rigid/wide_contacts.h"
#include "threads/team.h"

struct lks_world;

namespace lks {

class RigidSubstep {
public:
    // team: null, or who helps. Once contacts, trees and figures of the tick are known.
    RigidSubstep(lks_world& world, Team* team);

    // 1 .. substeps.
    void run(std::uint32_t substep);

private:
    ContactBodies bodies_of(const Contact& contact);
    WideContacts side_by_side(ContactStage stage);
    template <typename Use>
    void in_contact_blocks(const Use& use);
    template <typename Use>
    void in_bundles(const Use& use);
    template <typename Use>
    void for_each_figure(const FigureBundle& bundle, const Use& use);
    template <typename Use>
    void in_figures(const Use& use);
    template <typename Use>
    void in_strained(const Use& use);
    template <typename Use>
    void for_each_joint(const FigureRange& figure, const Use& use);
    void in_trees(const FigureBundle& bundle, void (*wide)(RigidScene&, const FigureBundle&),
                  void (*plain)(RigidScene&, const ArticulatedTree&));
    void solve_trees(const FigureRange& figure);
    void solve_trees(const FigureBundle& bundle);

    void begin(std::uint32_t substep);
    void strike_all();
    void predict(std::uint32_t substep);
    void carry_pushes_on();
    void push_contacts_again(const FigureRange& figure);
    void measure_contact(std::uint32_t index);
    void project_contact(std::uint32_t index, bool back);
    Move& move_of(std::uint32_t other);
    void apply_contact_moves(const FigureRange& figure);
    void project_joints(const FigureRange& figure);
    void measure_contacts(const FigureBundle& bundle);
    void measure_contacts(const FigureRange& figure);
    void project_contacts(const FigureRange& figure);
    void solve_strained(const FigureRange& figure);
    void solve_strained_trees(const FigureRange& figure);
    void project_back(const FigureRange& figure, bool strained);
    void iterate(std::uint32_t substep);
    void mark_strained(std::uint32_t body);
    void mark_hard_impacts();
    void mark_exceeded_limits();
    bool find_strained();
    bool turns_fast(std::uint32_t body) const;
    bool may_gain(const FigureRange& figure) const;
    ContactSpeeds predicted_speeds(const Contact& contact);
    void restore_speeds();
    void mark_contacts();
    bool is_strained(const FigureRange& figure) const;
    bool are_strained(const Contact& shared) const;
    bool relieve_strained();
    bool is_strained_rope(std::uint32_t object) const;
    void project_attachments();
    void project_loaded_ropes();
    void collide_objects(std::uint32_t substep);
    void keep_predicted_speeds();
    void finish_bodies();
    void finish_figures(std::uint32_t substep);
    void add_up_contact_pushes();
    void undo_errors();
    void finish(std::uint32_t substep);

    lks_world& world_;
    RigidScene& scene_;
    Team* team_;
    MotionRate rate_;
    FreeFigures free_figures_;
    std::int64_t least_speed_; // of figures whose carried pushes are worth scaling
    bool any_restitution_ = false;
};

} // namespace lks
