#include "rigid/articulation.h"

#include <algorithm>

#include "collide/saturation.h"
#include "rigid/articulation_joint.h"
#include "rigid/articulation_passes.h"
#include "rigid/articulation_walk.h"
#include "rigid/body_motion.h"
#include "rigid/held_tree.h"
#include "rigid/uneven_tree.h"

namespace lks {
namespace {

using namespace tree_detail;
using fixed::Direction;
using fixed::Vec3;

// (hω)² of a body's swing: a ten-thousandth of its inverse inertia is left, which has 30 bits. In uneven
// trees these are moved along.
constexpr std::int64_t greatest_load = std::int64_t{1} << (world_fraction_bits + 14);
constexpr std::int64_t greatest_uneven_load = INT64_MAX;

// D⁻¹ by D = L·diag·Lᵀ.
SymmetricInverse invert_symmetric(const std::int64_t (&d)[6]) {
    const auto m = lks::multiply_32;
    const Inverse first = invert_pivot(d[0]);
    const std::int64_t l21 = divide(d[1], first);
    const std::int64_t l31 = divide(d[2], first);
    const Inverse second = invert_pivot(minus(d[3], m(l21, d[1])));
    const std::int64_t below = minus(d[4], m(l21, d[2]));
    const std::int64_t l32 = divide(below, second);
    const Inverse third = invert_pivot(minus(minus(d[5], m(l31, d[2])), m(l32, below)));
    // L⁻¹ has 1, −l21, l21·l32 − l31 and −l32.
    const std::int64_t corner = minus(m(l21, l32), l31);
    const std::int64_t zz = divide(tree_one, third);
    const std::int64_t yy = divide(tree_one, second);
    const std::int64_t yz = minus(0, m(l32, zz));
    const std::int64_t xz = m(corner, zz);
    const std::int64_t xy = minus(minus(0, m(l21, yy)), m(corner, m(l32, zz)));
    const std::int64_t xx = plus(plus(divide(tree_one, first), m(l21, m(l21, yy))), m(corner, xz));
    return {{xx, xy, xz, minus(yy, m(l32, yz)), yz, zz}};
}

// W −= U·D⁻¹·Uᵀ.
void fold_in(ArticulatedInverse& w, const ArticulatedJoint& joint) {
    Vec3 rows[6];
    Vec3 solved[6];
    rows_of(joint.column_shift, joint.column_turn, rows);
    for (int i = 0; i < 6; ++i) {
        solved[i] = symmetric(joint.inverse.entries, rows[i]);
    }
    take_out_rows(w, solved, rows, dot_32);
}

void factor_joint(RigidScene& scene, ArticulatedJoint& part, bool springs_give) {
    std::int64_t d[6] = {};
    place_joint(scene, part, part.column_shift, part.column_turn, d);
    if (springs_give) {
        soften_points(scene.joints[part.joint], part.pair_share, d);
    }
    part.inverse = invert_symmetric(d);
}

// A light link under a great tension swings faster than a substep: beyond what a substep can follow it turns
// as if it were heavier (the diagonal of an implicit geometric stiffness; Andrews, Teichmann, Kry 2017). What
// the body already turns as heavily for is its load. `may_lower`: the exponent of its inverse inertia.
void stiffen(Body& body, ArticulatedBody& part, bool may_lower) {
    constexpr std::int64_t followed = std::int64_t{2} << world_fraction_bits;
    const std::int64_t load = part.found_load;
    const std::int64_t before = part.load;
    if (load <= std::max(before, followed)) {
        return;
    }
    // 1 + what is in excess, 32 fraction bits
    const auto heaviness = [](std::int64_t pull) {
        const std::int64_t excess = std::max<std::int64_t>(pull - followed, 0);
        return (std::int64_t{1} << 32) + (excess >> (world_fraction_bits - 32));
    };
    const std::int64_t lighter = heaviness(before);
    const std::int64_t heavier = heaviness(load);
    int more = 0;
    while (may_lower && lighter <= heavier >> (more + 1)) {
        ++more;
    }
    const auto left =
        static_cast<std::int32_t>(fixed::multiply_divide(lighter, std::int64_t{1} << (30 + more), heavier));
    const auto entry = [left](std::int32_t c) {
        return static_cast<std::int32_t>(fixed::scale_component(left, c));
    };
    const SymmetricMatrix& m = body.world_inverse;
    body.world_inverse = {entry(m.xx), entry(m.xy), entry(m.xz), entry(m.yy), entry(m.yz), entry(m.zz)};
    body.inverse_shift -= more;
    part.lowered += more;
}

// The bodies and joints of one tree.
class Tree : public ArticulationWalk {
public:
    Tree(RigidScene& scene, const ArticulatedTree& range) : ArticulationWalk(scene, range) {}

    void stiffen_bodies() {
        for_each_body([](Body&, ArticulatedBody& part) {
            part.load = 0;
            part.lowered = 0;
            part.carried_force = part.carried_torque = {0, 0, 0};
        });
        stiffen_by_tensions();
    }

    // Where joints push more than four times as much as in the substep before. Less may be what another round
    // takes back, and what is heavier meanwhile turns limits back less.
    void stiffen_further() {
        for_each_joint([](const ArticulatedJoint&, Joint& joint) {
            joint.tension = std::max(joint.tension, sum_of_magnitudes(joint.push) / 4);
        });
        stiffen_by_tensions();
    }

    void factor() {
        if (range_.is_uneven) {
            factor_uneven(scene_, range_, springs_give_);
            return;
        }
        for_each_body(
            [](Body& body, ArticulatedBody& part) { part.inverse = own_inverse(body, part.share); });
        for_each_joint_back([this](ArticulatedJoint& part, const Joint&) {
            factor_joint(scene_, part, springs_give_);
            // Nothing is carried by what the root's first joint leaves of it.
            if (&part != &scene_.tree_joints[range_.first_joint]) {
                fold_in(scene_.articulated[part.parent].inverse, part);
            }
        });
    }

    // Brings the points of all joints together, `error` being how far b's is from a's, and calls
    // use(joint, push) with the push from a to b in the joint's own unit.
    template <typename Error, typename Use>
    void solve(const Error& error, const Use& use) {
        for_each_body([this](const Body& body, ArticulatedBody& part) {
            part.shift = part.turn = part.force = part.torque = {0, 0, 0};
            if (range_.is_held) {
                part.turn = own_turn_in_tree(body, range_, part, part.carried_torque);
            }
        });
        for_each_joint_back([&](ArticulatedJoint& part, const Joint& joint) {
            const Vec3 apart = error(joint, body_a(joint), body_b(joint));
            fold_error(scene_, range_, part, part.child_is_a ? -apart : apart);
        });
        for_each_joint([&](ArticulatedJoint& part, Joint& joint) {
            const Vec3 push = push_down(scene_, range_, part);
            use(joint, multiply_32(part.pair_share, part.child_is_a ? -push : push));
        });
        for_each_body([this](Body& body, ArticulatedBody& part) {
            if (range_.is_held) {
                part.torque = part.torque + part.carried_torque;
                part.carried_torque = {0, 0, 0};
            }
            apply(body, move_in_tree(body, range_, part));
        });
    }

    // What a push from outside does to all of it: the force and torque of each body. Never of uneven masses.
    void bear(std::uint32_t index, const Vec3& point, const Vec3& push) {
        for_each_body([](const Body&, ArticulatedBody& part) {
            part.shift = part.turn = part.force = part.torque = {0, 0, 0};
        });
        const Body& body = scene_.bodies[index];
        ArticulatedBody& pushed = scene_.articulated[index];
        const Vec3 torque = cross_32(lever_in_units(body, point), push);
        pushed.shift = rounded_share(pushed.share, push);
        pushed.turn = own_turn(body, pushed.share, torque);
        for_each_joint_back([this](ArticulatedJoint& part, const Joint&) {
            fold_error(scene_, range_, part, {0, 0, 0});
        });
        for_each_joint(
            [this](ArticulatedJoint& part, const Joint&) { part.push = push_down(scene_, range_, part); });
        pushed.force = pushed.force + push;
        pushed.torque = pushed.torque + torque;
    }

    // After that: how far the point has gone.
    Vec3 borne_motion(std::uint32_t index, const Vec3& point) const {
        const Body& body = scene_.bodies[index];
        const ArticulatedBody& part = scene_.articulated[index];
        return rounded_share(part.share, part.force) +
               cross_32(own_turn(body, part.share, part.torque), lever_in_units(body, point));
    }
    void keep_borne() {
        for_each_joint([](const ArticulatedJoint& part, Joint& joint) {
            add_tree_push(joint, multiply_32(part.pair_share, part.child_is_a ? -part.push : part.push),
                          false);
        });
    }
    void move_borne() {
        for_each_body(
            [](Body& body, const ArticulatedBody& part) { apply(body, move_of(body, part.share, part)); });
    }

    // True: a limit was far off.
    bool undo_errors() {
        bool far_off = false;
        for_each_joint([&](const ArticulatedJoint&, const Joint& joint) {
            far_off = undo_error(joint, body_a(joint), body_b(joint), false) || far_off;
        });
        return far_off;
    }

    // Where a heavy body hangs on light ones, these turn far in a solve, and along the levers that they had
    // before it the next one would throw them about.
    void follow_uneven() {
        if (range_.is_uneven) {
            factor();
        }
    }

    void bring_together() {
        follow_uneven();
        solve(
            [](const Joint& joint, const Body& a, const Body& b) {
                Vec3 apart = points_apart(joint, a, b, false);
                clamp_vector(apart, greatest_step);
                return apart;
            },
            [](const Joint&, const Vec3&) {});
    }

    // What is undone strains no spring: those of joints' points keep their length.
    void hold_springs() {
        if (!range_.has_springs) {
            return;
        }
        springs_give_ = false;
        for_each_joint([this](const ArticulatedJoint&, Joint& joint) {
            if (has_soft_points(joint.constants)) {
                joint.start = joint_offset(joint, body_a(joint), body_b(joint));
            }
        });
        if (!range_.is_uneven && !range_.has_closures()) {
            factor();
        }
    }

    // Back to what the bodies' descriptions have.
    void raise_exponents() {
        for_each_body([](Body& body, ArticulatedBody& part) {
            const auto entry = [&part](std::int32_t c) { return c >> std::min(part.lowered, 31); };
            if (part.lowered != 0) {
                const SymmetricMatrix& m = body.world_inverse;
                body.world_inverse = {entry(m.xx), entry(m.xy), entry(m.xz),
                                      entry(m.yy), entry(m.yz), entry(m.zz)};
                body.inverse_shift += part.lowered;
                part.lowered = 0;
            }
        });
    }

    void finish_undoing(bool far_off, int round) {
        for (; round < most_undoing_rounds && far_off; ++round) {
            far_off = undo_errors();
            bring_together();
        }
        make_units();
    }

private:
    void stiffen_by_tensions() {
        for_each_body([](Body&, ArticulatedBody& part) { part.found_load = 0; });
        for_each_joint([this](const ArticulatedJoint& part, const Joint& joint) {
            add_load(part.parent, joint, !part.child_is_a);
            if (part.child_moves) {
                add_load(part.child, joint, part.child_is_a);
            }
        });
        for (std::uint32_t i = range_.first_closure; i < range_.closure_end; ++i) {
            const Closure& closure = scene_.closures[i];
            for (const ClosureSide* side : {&closure.a, &closure.b}) {
                if (closure.kind == Closure::Kind::closing && side->tree != no_tree &&
                    &scene_.trees[side->tree] == &range_) {
                    add_load(side->body, scene_.joints[closure.index], side == &closure.a);
                }
            }
        }
        for_each_body([this](Body& body, ArticulatedBody& part) {
            stiffen(body, part, range_.is_uneven);
            part.load = std::max(part.load, part.found_load);
        });
    }

    // (hω)² of the body's swing across the lever under the joint's tension: p/r times
    // |r|²·tr Ĵ − rᵀĴr, World.
    void add_load(std::uint32_t index, const Joint& joint, bool on_a) {
        const Body& body = scene_.bodies[index];
        ArticulatedBody& part = scene_.articulated[index];
        const JointConstants& c = joint.constants;
        const SwingArm& arm = on_a ? c.arm_a : c.arm_b;
        const std::int32_t share = on_a ? c.shares.a : c.shares.b;
        const std::int64_t most = range_.is_uneven
                                      ? std::min(greatest_uneven_push, INT64_MAX >> std::max(-body.scale, 0))
                                      : greatest_push;
        const std::int64_t pull =
            in_units(body, std::min(fixed::scale_component(share, joint.tension), most));
        const std::int64_t load =
            fixed::multiply_shift(fixed::multiply_shift(pull, arm.length, world_fraction_bits), arm.across,
                                  30 - body.inverse_shift - part.lowered);
        part.found_load = std::min(fixed::saturating_add(part.found_load, load),
                                   range_.is_uneven ? greatest_uneven_load : greatest_load);
    }

    bool springs_give_ = true;
};

} // namespace

void factor_articulation(RigidScene& scene, const ArticulatedTree& tree) {
    Tree all(scene, tree);
    all.stiffen_bodies();
    if (!tree.has_closures()) { // factor_closures
        all.factor();
    }
}

void stiffen_articulation(RigidScene& scene, const ArticulatedTree& tree) {
    Tree(scene, tree).stiffen_bodies();
}

void invert_points(const TreeLanes (&motion)[6], std::uint32_t first, std::uint32_t count,
                   TreeLanes (&inverse)[6]) {
    for (std::uint32_t lane = first; lane < first + count; ++lane) {
        std::int64_t d[6];
        for (int i = 0; i < 6; ++i) {
            d[i] = motion[i][lane];
        }
        const SymmetricInverse inverted = invert_symmetric(d);
        for (int i = 0; i < 6; ++i) {
            inverse[i][lane] = inverted.entries[i];
        }
    }
}

void add_tree_push(Joint& joint, const Vec3& push, bool is_uneven) {
    joint.push = joint.push + push;
    clamp_vector(joint.push, is_uneven ? greatest_uneven_push : greatest_push);
}

void solve_articulation(RigidScene& scene, const ArticulatedTree& tree) {
    if (tree.has_closures()) {
        return; // solve_closures
    }
    Tree all(scene, tree);
    all.follow_uneven();
    all.solve(left_of_points,
              [&tree](Joint& joint, const Vec3& push) { add_tree_push(joint, push, tree.is_uneven); });
}

std::int64_t response_of(RigidScene& scene, const ArticulatedTree& tree, std::uint32_t body,
                         const Vec3& point, const Direction& along) {
    Tree all(scene, tree);
    all.bear(body, point,
             {world_from_direction(along.x), world_from_direction(along.y), world_from_direction(along.z)});
    return fixed::dot(along, all.borne_motion(body, point));
}

void push_from_outside(RigidScene& scene, const ArticulatedTree& tree, std::uint32_t body, const Vec3& point,
                       const Vec3& push) {
    Tree all(scene, tree);
    all.bear(body, point, push);
    all.keep_borne();
    all.move_borne();
}

void shift_from_outside(RigidScene& scene, const ArticulatedTree& tree, std::uint32_t body, const Vec3& point,
                        const Vec3& push) {
    Tree all(scene, tree);
    all.bear(body, point, push);
    all.move_borne();
    all.make_units();
}

void stiffen_further(RigidScene& scene, const ArticulatedTree& tree) {
    Tree(scene, tree).stiffen_further();
}

bool undo_tree_errors(RigidScene& scene, const ArticulatedTree& tree) {
    return Tree(scene, tree).undo_errors();
}

void finish_undoing(RigidScene& scene, const ArticulatedTree& tree, bool far_off, int round) {
    Tree(scene, tree).finish_undoing(far_off, round);
}

void undo_articulation(RigidScene& scene, const ArticulatedTree& tree) {
    Tree all(scene, tree);
    all.hold_springs();
    if (tree.has_closures()) { // undo_closures
        static_cast<void>(all.undo_errors());
    } else if (tree.is_held && undo_held_tree(scene, tree)) {
        all.bring_together();
        all.make_units();
    } else {
        const bool far_off = all.undo_errors();
        all.bring_together();
        all.finish_undoing(far_off, 1);
    }
    if (tree.is_uneven) {
        all.raise_exponents();
    }
}

} // namespace lks
