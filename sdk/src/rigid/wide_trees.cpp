#include "rigid/wide_trees.h"

#include <bit>

#include "rigid/articulation.h"
#include "rigid/figures.h"

namespace lks {
namespace {

using fixed::Vec3;

// As many of the greatest pushes at the longest levers are below 2^62.
constexpr std::uint32_t greatest_tree = 64;
constexpr int widest_shift = 30;

int turn_shift_of(const Body& body) {
    return body.inverse_shift - body.scale - 1 + half_turn_fraction_bits - world_fraction_bits;
}
// Both to 32 fraction bits.
int inverse_shift_of(const Body& body) {
    return body.inverse_shift + 32 - 30;
}
int lever_shift_of(const Body& body) {
    return 32 - world_fraction_bits - body.scale;
}

bool is_in_range(int shift) {
    return shift >= -widest_shift && shift <= widest_shift;
}

bool fits_lanes(const Body& body) {
    return is_in_range(turn_shift_of(body)) && is_in_range(inverse_shift_of(body)) &&
           is_in_range(lever_shift_of(body));
}

bool have_same_units(const Body& a, const Body& b) {
    return a.scale == b.scale && a.inverse_shift == b.inverse_shift;
}

std::uint32_t body_count(const ArticulatedTree& tree) {
    return tree.body_end - tree.first_body;
}

const Body& body_of(const RigidScene& scene, const ArticulatedTree& tree, std::uint32_t i) {
    return scene.bodies[scene.tree_bodies[tree.first_body + i]];
}

const ArticulatedTree* only_tree(const RigidScene& scene, const FigureRange& figure) {
    const std::uint32_t first = figure.begins[static_cast<std::size_t>(Part::tree)];
    return figure.count(Part::tree) == 1 ? &scene.trees[index_of(scene.figure_parts[first])] : nullptr;
}

// Those that aren't are solved otherwise, pushed by what is no joint of theirs, or turned beyond 2^62.
bool is_plain(const ArticulatedTree& tree) {
    return !tree.is_held && !tree.is_uneven && !tree.is_loaded && !tree.has_springs && !tree.has_closures() &&
           tree.lever_doublings == 0;
}

bool fits_lanes(const RigidScene& scene, const ArticulatedTree& tree) {
    // Where something doesn't move there are fewer bodies.
    bool fits = is_plain(tree) && body_count(tree) <= greatest_tree &&
                body_count(tree) == tree.joint_end - tree.first_joint + 1;
    for (std::uint32_t i = 0; i < body_count(tree) && fits; ++i) {
        fits = fits_lanes(body_of(scene, tree, i));
    }
    return fits;
}

// Where a joint's parent stands among the tree's bodies: from that of the joint before on.
std::uint32_t find_parent(const RigidScene& scene, const ArticulatedTree& tree, std::uint32_t joint,
                          std::uint32_t before) {
    const std::uint32_t parent = scene.tree_joints[tree.first_joint + joint].parent;
    while (scene.tree_bodies[tree.first_body + before] != parent) {
        ++before;
    }
    return before;
}

// Whether b is built as a, which fits: then it does, too.
bool are_alike(const RigidScene& scene, const ArticulatedTree& a, const ArticulatedTree& b) {
    const std::uint32_t count = body_count(a);
    bool alike =
        is_plain(b) && body_count(b) == count && b.joint_end - b.first_joint == a.joint_end - a.first_joint;
    for (std::uint32_t i = 0; i < count && alike; ++i) {
        alike = have_same_units(body_of(scene, a, i), body_of(scene, b, i));
    }
    std::uint32_t parent = 0;
    for (std::uint32_t i = 0; i + 1 < count && alike; ++i) {
        parent = find_parent(scene, a, i, parent);
        const ArticulatedJoint& joint = scene.tree_joints[b.first_joint + i];
        alike = scene.tree_bodies[b.first_body + parent] == joint.parent &&
                scene.tree_joints[a.first_joint + i].child_is_a == joint.child_is_a;
    }
    return alike;
}

void set(TreeLanes (&lanes)[3], std::uint32_t lane, const Vec3& v) {
    lanes[0][lane] = v.x;
    lanes[1][lane] = v.y;
    lanes[2][lane] = v.z;
}

Vec3 get(const TreeLanes (&lanes)[3], std::uint32_t lane) {
    return {lanes[0][lane], lanes[1][lane], lanes[2][lane]};
}

void set_rotation(const Body& body, WideTreeBody& wide, std::uint32_t lane) {
    for (int i = 0; i < 9; ++i) {
        wide.rotation[i][lane] = body.rotation.m[i / 3][i % 3];
    }
}

void set_pose(const Body& body, WideTreeBody& wide, std::uint32_t lane) {
    set(wide.position, lane, body.position);
    const Quaternion& q = body.orientation;
    const std::int64_t components[4] = {q.x, q.y, q.z, q.w};
    for (int i = 0; i < 4; ++i) {
        wide.orientation[i][lane] = components[i];
    }
    set_rotation(body, wide, lane);
}

void get_pose(const WideTreeBody& wide, std::uint32_t lane, Body& body) {
    body.position = get(wide.position, lane);
    if ((wide.turns_far >> lane & 1) != 0) {
        turn_body(body, get(wide.turn, lane));
        return;
    }
    body.orientation = {wide.orientation[0][lane], wide.orientation[1][lane], wide.orientation[2][lane],
                        wide.orientation[3][lane]};
    for (int i = 0; i < 9; ++i) {
        body.rotation.m[i / 3][i % 3] = static_cast<std::int32_t>(wide.rotation[i][lane]);
    }
}

void set_inertia(const Body& body, std::int64_t share, WideTreeBody& wide, std::uint32_t lane) {
    wide.share[lane] = share;
    const SymmetricMatrix& m = body.world_inverse;
    const std::int32_t entries[6] = {m.xx, m.xy, m.xz, m.yy, m.yz, m.zz};
    for (int i = 0; i < 6; ++i) {
        wide.world_inverse[i][lane] = entries[i];
    }
}

void set_joint(const Joint& joint, WideTreeJoint& wide, std::uint32_t lane) {
    const JointDescription& d = joint.description;
    set(wide.parent_point, lane, wide.child_is_a ? d.point_b : d.point_a);
    set(wide.child_point, lane, wide.child_is_a ? d.point_a : d.point_b);
    set(wide.start, lane, joint.start);
}

void get_factors(const WideTreeJoint& wide, std::uint32_t lane, ArticulatedJoint& part) {
    part.pair_share = wide.pair_share[lane];
    part.parent_lever = get(wide.parent_lever, lane);
    part.child_lever = get(wide.child_lever, lane);
    for (int axis = 0; axis < 3; ++axis) {
        part.column_shift[axis] = get(wide.column_shift[axis], lane);
        part.column_turn[axis] = get(wide.column_turn[axis], lane);
    }
    for (int i = 0; i < 6; ++i) {
        part.inverse.entries[i] = wide.inverse[i][lane];
    }
}

// The trees of one bundle.
class WideTrees {
public:
    WideTrees(RigidScene& scene, const FigureBundle& bundle)
        : scene_(scene), bundle_(bundle), body_count_(body_count(tree(0))) {}

    std::uint32_t count() const { return bundle_.end - bundle_.first; }
    const ArticulatedTree& tree(std::uint32_t lane) const {
        return *only_tree(scene_, scene_.figure_ranges[bundle_.first + lane]);
    }

    // What all lanes have in common.
    void set_shape() {
        for (std::uint32_t i = 0; i < body_count_; ++i) {
            const Body& body = body_of(scene_, tree(0), i);
            wide_body(i).turn_shift = turn_shift_of(body);
            wide_body(i).inverse_shift = inverse_shift_of(body);
            wide_body(i).lever_shift = lever_shift_of(body);
        }
        std::uint32_t parent = 0;
        for (std::uint32_t i = 0; i + 1 < body_count_; ++i) {
            parent = find_parent(scene_, tree(0), i, parent);
            wide_joint(i).parent = parent;
            wide_joint(i).child_is_a = scene_.tree_joints[tree(0).first_joint + i].child_is_a;
        }
    }

    void factor() {
        for (std::uint32_t lane = 0; lane < count(); ++lane) {
            stiffen_articulation(scene_, tree(lane));
        }
        for_each_body([this](std::uint32_t index, WideTreeBody& wide, std::uint32_t lane) {
            set_inertia(scene_.bodies[index], scene_.articulated[index].share, wide, lane);
            set_rotation(scene_.bodies[index], wide, lane);
        });
        for_each_joint([this](ArticulatedJoint& part, WideTreeJoint& wide, std::uint32_t lane) {
            set_joint(scene_.joints[part.joint], wide, lane);
        });
        scene_.tree_kernels().factor(task(false));
    }

    void solve() {
        move_points(true, all_lanes());
        for_each_joint([this](ArticulatedJoint& part, WideTreeJoint& wide, std::uint32_t lane) {
            add_tree_push(scene_.joints[part.joint], get(wide.push, lane), false);
        });
    }

    void hand_out_factors(std::uint32_t lane) {
        ArticulatedJoint* const joints = &scene_.tree_joints[tree(lane).first_joint];
        for (std::uint32_t i = 0; i + 1 < body_count_; ++i) {
            get_factors(wide_joint(i), lane, joints[i]);
        }
    }

    void undo() {
        std::uint32_t far_off = undo_errors(all_lanes());
        move_points(false, all_lanes());
        int round = 1;
        for (; round < most_undoing_rounds && std::popcount(far_off) >= int{least_trees_in_lanes}; ++round) {
            const std::uint32_t lanes = far_off;
            far_off = undo_errors(lanes);
            move_points(false, lanes);
        }
        // Rounds that few need go tree by tree.
        for (std::uint32_t lane = 0; lane < count(); ++lane) {
            const bool goes_on = (far_off >> lane & 1) != 0;
            if (goes_on) {
                hand_out_factors(lane);
            }
            finish_undoing(scene_, tree(lane), goes_on, round);
        }
    }

private:
    WideTreeBody& wide_body(std::uint32_t i) { return scene_.wide_bodies[bundle_.first_body + i]; }
    WideTreeJoint& wide_joint(std::uint32_t i) { return scene_.wide_joints[bundle_.first_joint + i]; }

    TreeTask task(bool keeps_start) {
        return {&wide_body(0), &wide_joint(0), body_count_ - 1, count(), keeps_start, invert_points};
    }

    template <typename Use>
    void for_each_body(const Use& use) {
        for (std::uint32_t lane = 0; lane < count(); ++lane) {
            const std::uint32_t* const bodies = &scene_.tree_bodies[tree(lane).first_body];
            for (std::uint32_t i = 0; i < body_count_; ++i) {
                use(bodies[i], wide_body(i), lane);
            }
        }
    }
    template <typename Use>
    void for_each_joint(const Use& use) {
        for (std::uint32_t lane = 0; lane < count(); ++lane) {
            ArticulatedJoint* const joints = &scene_.tree_joints[tree(lane).first_joint];
            for (std::uint32_t i = 0; i + 1 < body_count_; ++i) {
                use(joints[i], wide_joint(i), lane);
            }
        }
    }

    // Bit i: lane i.
    std::uint32_t all_lanes() const { return (1u << count()) - 1; }

    // Of these lanes; those in which a limit was far off.
    std::uint32_t undo_errors(std::uint32_t lanes) {
        std::uint32_t far_off = 0;
        for (std::uint32_t lane = 0; lane < count(); ++lane) {
            if ((lanes >> lane & 1) != 0 && undo_tree_errors(scene_, tree(lane))) {
                far_off |= 1u << lane;
            }
        }
        return far_off;
    }

    // Bodies of these lanes, so that the points of all joints are together.
    void move_points(bool keeps_start, std::uint32_t lanes) {
        for_each_body([this](std::uint32_t index, WideTreeBody& wide, std::uint32_t lane) {
            set_pose(scene_.bodies[index], wide, lane);
        });
        scene_.tree_kernels().solve(task(keeps_start));
        for_each_body([&](std::uint32_t index, WideTreeBody& wide, std::uint32_t lane) {
            if ((lanes >> lane & 1) != 0) {
                get_pose(wide, lane, scene_.bodies[index]);
            }
        });
    }

    RigidScene& scene_;
    const FigureBundle& bundle_;
    std::uint32_t body_count_;
};

// The end of the figures from `first` on that go side by side.
std::uint32_t end_of_bundle(const RigidScene& scene, std::uint32_t first) {
    const ArticulatedTree* tree = only_tree(scene, scene.figure_ranges[first]);
    std::uint32_t end = first + 1;
    if (tree == nullptr || !fits_lanes(scene, *tree)) {
        return end;
    }
    for (; end < scene.figure_ranges.size() && end - first < tree_lanes; ++end) {
        const ArticulatedTree* other = only_tree(scene, scene.figure_ranges[end]);
        if (other == nullptr || !are_alike(scene, *tree, *other)) {
            break;
        }
    }
    return end - first < least_trees_in_lanes ? first + 1 : end;
}

// Within what there is. Every lane in use is written before it is read; those that are not are cleared.
void make_room(RigidScene& scene, const FigureBundle& bundle, std::uint32_t bodies) {
    if (bundle.end - bundle.first == tree_lanes) {
        scene.wide_bodies.extend_reserved(bodies);
        scene.wide_joints.extend_reserved(bodies - 1);
    } else {
        static_cast<void>(scene.wide_bodies.resize(bundle.first_body + bodies));
        static_cast<void>(scene.wide_joints.resize(bundle.first_joint + bodies - 1));
    }
}

} // namespace

void find_bundles(RigidScene& scene) {
    scene.figure_bundles.clear();
    scene.wide_bodies.clear();
    scene.wide_joints.clear();
    const auto count = static_cast<std::uint32_t>(scene.figure_ranges.size());
    for (std::uint32_t first = 0; first < count;) {
        const std::uint32_t end =
            scene.tree_kernels().solve != nullptr ? end_of_bundle(scene, first) : first + 1;
        const FigureBundle bundle{first, end, static_cast<std::uint32_t>(scene.wide_bodies.size()),
                                  static_cast<std::uint32_t>(scene.wide_joints.size())};
        scene.figure_bundles.push_reserved(bundle);
        if (bundle.is_wide()) {
            const std::uint32_t bodies = body_count(*only_tree(scene, scene.figure_ranges[first]));
            make_room(scene, bundle, bodies);
            WideTrees(scene, bundle).set_shape();
        }
        first = end;
    }
}

void factor_bundle(RigidScene& scene, const FigureBundle& bundle) {
    WideTrees(scene, bundle).factor();
}

void solve_bundle(RigidScene& scene, const FigureBundle& bundle) {
    WideTrees(scene, bundle).solve();
}

void hand_out_factors(RigidScene& scene, const FigureBundle& bundle, std::uint32_t lane) {
    WideTrees(scene, bundle).hand_out_factors(lane);
}

void undo_bundle(RigidScene& scene, const FigureBundle& bundle) {
    WideTrees(scene, bundle).undo();
}

} // namespace lks
