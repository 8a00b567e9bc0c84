// How a tree is moved by what pushes it from outside at several of its bodies at once: by what closes its
// loops (rigid/closures.h).
//
// The elimination of rigid/articulation.h with 40 fraction bits, and with the rows of what hinges and fixed
// joints don't let turn beside those of the points. With the points alone, what closes a loop would turn
// bodies that rows turn back, and such a loop gains energy.
#pragma once

#include "rigid/articulation_walk.h"
#include "rigid/row_joint.h"

namespace lks {

// Of a turning push about an axis of the world: what its torque is, with 40 fraction bits.
fixed::Vec3 fine_axis_in_units(const Body& body, const Joint& joint, const fixed::Direction& axis);

// A push of so much, World. To the nearest: what is always rounded one way turns thin bodies in the end.
inline Wrench push_times(const Wrench& unit, std::int64_t push) {
    using namespace tree_detail;
    return {rounded_share<fine_fraction_bits>(push, unit.force),
            rounded_share<fine_fraction_bits>(push, unit.torque)};
}

struct OwnMotion {
    fixed::Vec3 shift;
    fixed::Vec3 turn;
};

class ClosureTree : public ArticulationWalk {
public:
    ClosureTree(RigidScene& scene, const ArticulatedTree& tree) : ArticulationWalk(scene, tree) {}

    // With springs that give, or that are held.
    void factor(bool springs_give);

    // Finds what brings together what its joints hold, with speed or without.
    void solve(bool in_substep);

    bool is_apart() const;

    // Pushed at a lever in the body's unit, the next solve begins with it: World, in the body's own unit.
    void carry(std::uint32_t body, const fixed::Vec3& lever, const fixed::Vec3& push);

    // What pushes it: first what each body that is pushed would do by itself,
    void begin();
    void add_own_motion(std::uint32_t body, const Wrench& push);
    // then what its joints push, and then once more what pushes it.
    void spread();
    void add_push(std::uint32_t body, const Wrench& push);

    // By all of that: how far any of its bodies turns its points aside from where they go to first order,
    // World;
    std::int64_t greatest_bend() const;
    // the bodies go there; its joints remember their pushes.
    void move();
    void keep_pushes();
    // Motors of which that asks more than they are capable of are left to the sweeps, once its factors are
    // found anew. False: they are capable of all.
    bool drop_motors();
    // As at the beginning of a substep.
    void take_motors();

    // What a push does to a body by itself, and how far it goes along the push.
    OwnMotion own_motion(std::uint32_t body, const Wrench& push) const;
    std::int64_t own_give(std::uint32_t body, const Wrench& push) const;

private:
    using Algebra = RowAlgebra<FineRows>;

    ClosureTreeJoint& rows_of(const ArticulatedJoint& part);
    void place(const ArticulatedJoint& part, const Joint& joint, ClosureTreeJoint& rows);
    void factor_joint(const ArticulatedJoint& part, const Joint& joint, bool springs_give,
                      ClosureTreeJoint& rows);
    int find_wrenches(const ClosureTreeJoint& rows, const fixed::Vec3& lever,
                      const fixed::Vec3 (&axes)[most_held_rows], Wrench (&wrenches)[most_rows]) const;
    fixed::Vec3 turned_by(const ArticulatedJoint& part, const Joint& joint, const ClosureTreeJoint& rows,
                          std::uint32_t first, std::uint32_t end) const;
    std::int64_t own_turn_about(std::uint32_t body, const fixed::Vec3& axis) const;
    void fold(const ArticulatedJoint& part, ClosureTreeJoint& rows);
    void fold_errors(const ArticulatedJoint& part, const Joint& joint, bool in_substep,
                     ClosureTreeJoint& rows);
    void fold_rest(const ArticulatedJoint& part, const fixed::Vec3& apart,
                   const std::int64_t (&turned)[most_held_rows], ClosureTreeJoint& rows);
    void hand_down(const ArticulatedJoint& part, ClosureTreeJoint& rows);
};

} // namespace lks
