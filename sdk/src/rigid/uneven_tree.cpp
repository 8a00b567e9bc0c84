#include "rigid/uneven_tree.h"

#include <algorithm>

#include "rigid/articulation_joint.h"
#include "rigid/articulation_walk.h"
#include "rigid/fine_algebra.h"

namespace lks {
namespace {

using namespace tree_detail;
using fixed::Vec3;

constexpr int bits = uneven_fraction_bits;

// Of a body in a solve, World, 256 m: what is thrown about stays within the world.
constexpr std::int64_t greatest_shift = std::int64_t{1} << (world_fraction_bits + 8);

void factor_points(const std::int64_t (&d)[6], UnevenJoint& joint) {
    joint.pivots[0] = invert_fine(d[0]);
    joint.l21 = divide(d[1], joint.pivots[0]);
    joint.l31 = divide(d[2], joint.pivots[0]);
    joint.pivots[1] = invert_fine(minus(d[3], multiply_40(joint.l21, d[1])));
    const std::int64_t below = minus(d[4], multiply_40(joint.l21, d[2]));
    joint.l32 = divide(below, joint.pivots[1]);
    joint.pivots[2] =
        invert_fine(minus(minus(d[5], multiply_40(joint.l31, d[2])), multiply_40(joint.l32, below)));
}

// L⁻¹·v.
Vec3 forward(const UnevenJoint& joint, Vec3 v) {
    v.y = minus(v.y, multiply_40(joint.l21, v.x));
    v.z = minus(minus(v.z, multiply_40(joint.l31, v.x)), multiply_40(joint.l32, v.y));
    return v;
}

Vec3 divided(const UnevenJoint& joint, const Vec3& v) {
    return {divide(v.x, joint.pivots[0]), divide(v.y, joint.pivots[1]), divide(v.z, joint.pivots[2])};
}

// D⁻¹·v.
Vec3 solved(const UnevenJoint& joint, const Vec3& v) {
    Vec3 x = divided(joint, forward(joint, v));
    x.y = minus(x.y, multiply_40(joint.l32, x.z));
    x.x = minus(minus(x.x, multiply_40(joint.l21, x.y)), multiply_40(joint.l31, x.z));
    return x;
}

// W −= U·D⁻¹·Uᵀ.
void fold_in(ArticulatedInverse& w, const UnevenJoint& joint) {
    Vec3 rows[6]; // of U·L⁻ᵀ
    Vec3 shares[6];
    rows_of(joint.column_shift, joint.column_turn, rows);
    for (int i = 0; i < 6; ++i) {
        rows[i] = forward(joint, rows[i]);
        shares[i] = divided(joint, rows[i]);
    }
    take_out_rows(w, shares, rows, dot_40);
}

class UnevenTree : public ArticulationWalk {
public:
    UnevenTree(RigidScene& scene, const ArticulatedTree& range) : ArticulationWalk(scene, range) {}

    void factor(bool springs_give) {
        for_each_body([](Body& body, ArticulatedBody& part) {
            part.inverse = own_fine_inverse(body, part.fine_share);
        });
        for_each_joint_back([&](ArticulatedJoint& part, const Joint& joint) {
            UnevenJoint& fine = uneven_joint(scene_, part);
            std::int64_t d[6] = {};
            place_joint(scene_, part, fine.column_shift, fine.column_turn, d);
            if (springs_give) {
                soften_points(joint, fine_pair_share(part), d);
            }
            factor_points(d, fine);
            if (&part != &scene_.tree_joints[range_.first_joint]) {
                fold_in(scene_.articulated[part.parent].inverse, fine);
            }
        });
    }

    std::int64_t fine_pair_share(const ArticulatedJoint& part) const {
        const std::int64_t parent = scene_.articulated[part.parent].fine_share;
        return part.child_moves ? std::max(parent, scene_.articulated[part.child].fine_share) : parent;
    }

    static UnevenJoint& uneven_joint(RigidScene& scene, const ArticulatedJoint& part) {
        return scene.uneven_joints[static_cast<std::size_t>(&part - scene.tree_joints.begin())];
    }
};

} // namespace

void factor_uneven(RigidScene& scene, const ArticulatedTree& tree, bool springs_give) {
    UnevenTree(scene, tree).factor(springs_give);
}

void fold_uneven(RigidScene& scene, const ArticulatedTree& tree, ArticulatedJoint& part, const Vec3& apart) {
    const UnevenJoint& fine = UnevenTree::uneven_joint(scene, part);
    ArticulatedBody& parent = scene.articulated[part.parent];
    part.push = -solved(fine, left_apart(scene, part, apart));
    clamp_vector(part.push, greatest_push_of(tree));
    const std::int64_t pushes[3] = {part.push.x, part.push.y, part.push.z};
    for (int axis = 0; axis < 3; ++axis) {
        parent.shift = parent.shift - multiply_40(pushes[axis], fine.column_shift[axis]);
        parent.turn = parent.turn - multiply_40(pushes[axis], fine.column_turn[axis]);
    }
}

Vec3 push_uneven(RigidScene& scene, const ArticulatedTree& tree, const ArticulatedJoint& part) {
    const UnevenJoint& fine = UnevenTree::uneven_joint(scene, part);
    const ArticulatedBody& parent = scene.articulated[part.parent];
    const auto along = [&](int axis) {
        return plus(dot_40(fine.column_shift[axis], parent.force),
                    dot_40(fine.column_turn[axis], parent.torque));
    };
    Vec3 push = part.push + solved(fine, {along(0), along(1), along(2)});
    clamp_vector(push, greatest_push_of(tree));
    push_at_joint(scene, part, push);
    return push;
}

Move move_uneven(const Body& body, const ArticulatedBody& part) {
    Move move = move_of<bits>(body, part.fine_share, part);
    clamp_vector(move.shift, greatest_shift);
    return move;
}

} // namespace lks
