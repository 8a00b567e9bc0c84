// The contacts of a substep: measured, and projected one after the other, each upon what the others have
// done.
#pragma once

#include "rigid/figures.h"
#include "rigid/rigid_scene.h"
#include "rigid/wide_contacts.h"
#include "solver/world.h"

namespace lks {

class FigureContacts {
public:
    explicit FigureContacts(lks_world& world) : world_(world), scene_(world.rigid), rate_(world.rate) {}

    ContactBodies bodies_of(const Contact& contact) const;
    // Stages that points go through side by side.
    WideContacts side_by_side(ContactStage stage) const;

    // Those that act.
    void measure(std::uint32_t contact) const;
    void project(std::uint32_t contact, bool back) const;
    // Of a figure, or a bundle of them. What contacts have done is in `contact_moves`.
    void measure(const FigureBundle& bundle) const;
    void measure(const FigureRange& figure) const;
    void project(const FigureRange& figure) const;
    void project_back(const FigureRange& figure) const;
    // What they pushed in the substep before; takes it over.
    void push_again(const FigureRange& figure) const;

private:
    // Colliders have the one that stays zero.
    Move& move_of(std::uint32_t other) const;
    void apply_moves(const FigureRange& figure) const;

    lks_world& world_;
    RigidScene& scene_;
    MotionRate rate_;
};

} // namespace lks
