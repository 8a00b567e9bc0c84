#include "rigid/held_tree.h"

#include <algorithm>

#include "rigid/articulation.h"
#include "rigid/articulation_algebra.h"
#include "rigid/articulation_joint.h"
#include "rigid/articulation_walk.h"
#include "rigid/body_motion.h"
#include "rigid/exchange.h"
#include "rigid/joint_limits.h"
#include "rigid/joint_turns.h"
#include "rigid/uneven_tree.h"

namespace lks {
namespace {

using namespace tree_detail;
using fixed::Vec3;

// What a limit may be exceeded by for that it need not push.
constexpr std::int64_t nearly_nothing = world_one / 1000000;

// Where masses are uneven, what turns a body by more about an axis, an eighth of a radian, is left to rows.
constexpr std::int64_t greatest_uneven_half_turn = std::int64_t{1} << (half_turn_fraction_bits - 4);

using Algebra = RowAlgebra<CoarseRows>;

class HeldTree : public ArticulationWalk {
public:
    HeldTree(RigidScene& scene, const ArticulatedTree& range, bool in_substep)
        : ArticulationWalk(scene, range), in_substep_(in_substep) {}

    // False: points are further apart than a step undoes.
    bool find_rows() {
        bool near = true;
        for_each_held([&](const ArticulatedJoint& part, Joint& joint, HeldJoint& held) {
            const Body& a = body_a(joint);
            const Body& b = body_b(joint);
            held.row_count = turn_rows(joint, a, b, in_substep_, held.rows);
            held.row_count = limit_rows(joint, a, b, in_substep_, held.rows, held.row_count);
            for (std::uint32_t i = 0; i < held.row_count; ++i) {
                HeldRow& row = held.rows[i];
                row.error = std::clamp(row.error, -most_turned_back, most_turned_back);
                held.pushes[i] = !row.is_limit() || row.error < 0 || row.push > 0;
                held.child_axes[i] = axis_in_units(part.child, joint, row.axis);
                held.parent_axes[i] = axis_in_units(part.parent, joint, row.axis);
                const std::int64_t by_child =
                    part.child_moves ? own_turn_about(part.child, held.child_axes[i]) : 0;
                held.softness[i] = plus(by_child, own_turn_about(part.parent, held.parent_axes[i])) >> 20;
            }
            Vec3 apart = points_apart(joint, a, b, in_substep_);
            if (in_substep_ && has_soft_points(joint.constants)) {
                apart = left_of_points(joint, a, b);
            } else {
                const Vec3 whole = apart;
                clamp_vector(apart, greatest_step);
                near = near && apart == whole;
            }
            held.error = part.child_is_a ? -apart : apart;
        });
        return near;
    }

    // By more than rows that go in turn should have to undo.
    bool is_far_turned() {
        bool far = false;
        for_each_joint([&](const ArticulatedJoint&, const Joint& joint) {
            const Body& a = body_a(joint);
            const Body& b = body_b(joint);
            far = far || turned_away(joint, a, b, false) > far_turned ||
                  exceeded_limits(joint, a, b, false) > far_turned;
        });
        return far;
    }

    // False: masses are uneven and somebody would turn far, and nothing was done.
    bool solve() {
        exchange_rows(
            [this] {
                factor();
                find_pushes();
            },
            [this] { return count_wrong(); }, [this](std::uint32_t count) { turn_round(count); });
        if (range_.is_uneven && turns_far()) {
            return false;
        }
        push();
        return true;
    }

    // Ropes that pulled in this substep hold their bodies' points on from moving away.
    void find_taut() {
        for (std::uint32_t i = range_.first_body; i < range_.body_end; ++i) {
            const std::uint32_t index = scene_.tree_bodies[i];
            const std::uint32_t load_index = scene_.articulated[index].rope_load;
            if (load_index == no_rope_load) {
                continue;
            }
            RopeLoad& load = scene_.rope_loads[load_index];
            const Attachment& attachment = scene_.attachments[load.attachment];
            load.taut = load.anchored && load.motion > 0 && fixed::dot(load.along, attachment.push) > 0;
            load.lever = lever_in_units(scene_.bodies[index], attachment.description.point);
        }
    }

private:
    std::int64_t greatest_point_push() const {
        return range_.is_uneven ? greatest_push_of(range_) : greatest_push;
    }
    static Vec3 direction_32(const RopeLoad& load) {
        constexpr std::int64_t up = std::int64_t{1} << (tree_fraction_bits - direction_fraction_bits);
        return {load.along.x * up, load.along.y * up, load.along.z * up};
    }
    static Wrench pull_of(const RopeLoad& load) {
        return {direction_32(load), cross_32(load.lever, direction_32(load))};
    }
    // use(load, body)
    template <typename Use>
    void for_each_taut(const Use& use) {
        for (std::uint32_t i = range_.first_body; i < range_.body_end; ++i) {
            ArticulatedBody& body = scene_.articulated[scene_.tree_bodies[i]];
            if (body.rope_load != no_rope_load && scene_.rope_loads[body.rope_load].taut) {
                use(scene_.rope_loads[body.rope_load], body);
            }
        }
    }

    bool turns_far() {
        bool far = false;
        for_each_body([&](const Body& body, const ArticulatedBody& part) {
            const Vec3 turn = move_of(body, part.share, part).half_turn;
            for (const std::int64_t c : {turn.x, turn.y, turn.z}) {
                far = far || c > greatest_uneven_half_turn || c < -greatest_uneven_half_turn;
            }
        });
        return far;
    }

    // use(part, joint, held), from the root on.
    template <typename Use>
    void for_each_held(const Use& use) {
        for_each_joint([&](ArticulatedJoint& part, Joint& joint) { use(part, joint, held_of(part)); });
    }
    template <typename Use>
    void for_each_held_back(const Use& use) {
        for_each_joint_back([&](ArticulatedJoint& part, Joint& joint) { use(part, joint, held_of(part)); });
    }
    HeldJoint& held_of(const ArticulatedJoint& part) {
        return scene_.held_joints[static_cast<std::size_t>(&part - scene_.tree_joints.begin())];
    }

    Vec3 axis_in_units(std::uint32_t body, const Joint& joint, const fixed::Direction& axis) {
        return shifted({axis.x, axis.y, axis.z}, tree_fraction_bits - direction_fraction_bits +
                                                     joint.constants.reach - scene_.bodies[body].scale);
    }

    // use(row of the system, row of the joint)
    template <typename Use>
    static void for_each_pushing(const HeldJoint& held, const Use& use) {
        int row = point_rows;
        for (std::uint32_t i = 0; i < held.row_count; ++i) {
            if (held.pushes[i]) {
                use(row++, i);
            }
        }
    }

    // Of a unit push, row by row; how many.
    static int find_wrenches(const HeldJoint& held, const Vec3& lever, const Vec3 (&axes)[most_held_rows],
                             Wrench (&wrenches)[most_rows]) {
        Algebra::find_point_wrenches(lever, wrenches);
        int count = point_rows;
        for_each_pushing(held, [&](int row, std::uint32_t i) {
            wrenches[row] = {{0, 0, 0}, axes[i]};
            count = row + 1;
        });
        return count;
    }

    void factor() {
        for_each_body(
            [](Body& body, ArticulatedBody& part) { part.inverse = own_inverse(body, part.share); });
        for_each_taut([](RopeLoad& load, ArticulatedBody& body) {
            const Wrench pull = pull_of(load);
            Algebra::respond(body.inverse, pull, load.column_shift, load.column_turn);
            load.inverse = invert_pivot(Algebra::along(pull, load.column_shift, load.column_turn));
            Algebra::take_out(body.inverse, load.column_shift, load.column_turn, load.inverse);
        });
        for_each_held_back([this](const ArticulatedJoint& part, const Joint& joint, HeldJoint& held) {
            factor_joint(part, joint, held);
            if (&part != &scene_.tree_joints[range_.first_joint]) {
                Algebra::fold_in(scene_.articulated[part.parent].inverse, held);
            }
        });
    }

    void factor_joint(const ArticulatedJoint& part, const Joint& joint, HeldJoint& held) {
        std::int64_t d[most_rows][most_rows] = {};
        Wrench wrenches[most_rows];
        if (part.child_moves) {
            held.system.count = find_wrenches(held, part.child_lever, held.child_axes, wrenches);
            Algebra::add_motions(scene_.articulated[part.child].inverse, wrenches, held, d);
        }
        held.system.count = find_wrenches(held, part.parent_lever, held.parent_axes, wrenches);
        Algebra::add_motions(scene_.articulated[part.parent].inverse, wrenches, held, d);
        // Where two rows ask for the same, or for what nothing is left to move for, neither pushes without
        // bounds: by a millionth of what their bones by themselves give way they are soft.
        for_each_pushing(
            held, [&](int row, std::uint32_t i) { d[row][row] = plus(d[row][row], held.softness[i]); });
        if (in_substep_) {
            const std::int64_t give = points_give(joint, part.pair_share);
            for (int row = 0; row < point_rows; ++row) {
                d[row][row] = plus(d[row][row], give);
            }
        }
        Algebra::factor_rows(d, held);
    }

    // How a torque about an axis turns the body by itself, about that axis.
    std::int64_t own_turn_about(std::uint32_t body, const Vec3& axis) const {
        return dot_32(axis, own_turn(scene_.bodies[body], scene_.articulated[body].share, axis));
    }

    // A turning push about the axis of a row, b against a, on the child and the parent.
    void add_torque(const ArticulatedJoint& part, const HeldJoint& held, std::uint32_t row,
                    std::int64_t push) {
        Vec3& parent = scene_.articulated[part.parent].torque;
        parent = parent - multiply_32(push, held.parent_axes[row]);
        if (part.child_moves) {
            Vec3& child = scene_.articulated[part.child].torque;
            child = child + multiply_32(push, held.child_axes[row]);
        }
    }

    // From b against a to child against parent, and back.
    static std::int64_t of_child(const ArticulatedJoint& part, std::int64_t value) {
        return part.child_is_a ? -value : value;
    }
    // What the row has pushed until now, in the tree's unit; and a push there, as the joint has it.
    static std::int64_t pushed(const ArticulatedJoint& part, const Joint& joint, const HeldRow& row) {
        return divide(lks::shifted(row.push, joint.constants.reach), invert_pivot(part.pair_share));
    }
    static std::int64_t joint_push(const ArticulatedJoint& part, const Joint& joint, std::int64_t push) {
        return lks::shifted(lks::multiply_32(part.pair_share, of_child(part, push)), -joint.constants.reach);
    }
    static std::int64_t row_error(const ArticulatedJoint& part, const Joint& joint, const HeldRow& row) {
        return of_child(part, lks::shifted(row.error, joint.constants.reach));
    }

    // Of all rows that push. Limits that don't take back what they have pushed.
    void find_pushes() {
        for_each_body([](Body&, ArticulatedBody& part) { part.force = part.torque = {0, 0, 0}; });
        for_each_held([this](const ArticulatedJoint& part, const Joint& joint, const HeldJoint& held) {
            for (std::uint32_t i = 0; i < held.row_count; ++i) {
                if (!held.pushes[i] && held.rows[i].push != 0) {
                    add_torque(part, held, i, of_child(part, -pushed(part, joint, held.rows[i])));
                }
            }
        });
        for_each_body([](const Body& body, ArticulatedBody& part) {
            part.shift = {0, 0, 0};
            part.carried_torque = part.torque;
            part.turn = own_turn(body, part.share, part.torque);
            part.torque = {0, 0, 0};
        });
        for_each_taut([](RopeLoad& load, ArticulatedBody& body) {
            load.push = divide(minus(0, Algebra::along(pull_of(load), body.shift, body.turn)), load.inverse);
            body.shift = body.shift + multiply_32(load.push, load.column_shift);
            body.turn = body.turn + multiply_32(load.push, load.column_turn);
        });
        for_each_held_back([this](const ArticulatedJoint& part, const Joint& joint, HeldJoint& held) {
            fold_errors(part, joint, held);
        });
        for_each_held(
            [this](const ArticulatedJoint& part, const Joint&, HeldJoint& held) { hand_down(part, held); });
        for_each_taut([](RopeLoad& load, ArticulatedBody& body) {
            const std::int64_t more =
                plus(dot_32(load.column_shift, body.force), dot_32(load.column_turn, body.torque));
            load.push =
                std::clamp(minus(load.push, divide(more, load.inverse)), -greatest_push, greatest_push);
            add_force(body, load.lever, multiply_32(load.push, direction_32(load)));
        });
        for_each_body([](const Body& body, ArticulatedBody& part) {
            part.torque = part.torque + part.carried_torque;
            part.carried_torque = {0, 0, 0};
            part.shift = rounded_share(part.share, part.force);
            part.turn = own_turn(body, part.share, part.torque);
        });
    }

    // How far a row of turning moves by what its bodies have been done.
    std::int64_t turned(const ArticulatedJoint& part, const HeldJoint& held, std::uint32_t row) const {
        const std::int64_t by_child =
            part.child_moves ? dot_32(held.child_axes[row], scene_.articulated[part.child].turn) : 0;
        return minus(by_child, dot_32(held.parent_axes[row], scene_.articulated[part.parent].turn));
    }

    void fold_errors(const ArticulatedJoint& part, const Joint& joint, HeldJoint& held) {
        ArticulatedBody& parent = scene_.articulated[part.parent];
        Vec3 points = held.error - point_motion(parent, part.parent_lever);
        if (part.child_moves) {
            points = points + point_motion(scene_.articulated[part.child], part.child_lever);
        }
        std::int64_t left[most_rows] = {points.x, points.y, points.z};
        for_each_pushing(held, [&](int row, std::uint32_t i) {
            left[row] = plus(row_error(part, joint, held.rows[i]), turned(part, held, i));
        });
        Algebra::fold_rows(left, greatest_point_push(), held, parent);
    }

    // With what the joints towards the root push the parent.
    void hand_down(const ArticulatedJoint& part, HeldJoint& held) {
        ArticulatedBody& parent = scene_.articulated[part.parent];
        Algebra::push_more(greatest_point_push(), held, parent);
        const Vec3 push = point_push(held);
        add_force(parent, part.parent_lever, -push);
        if (part.child_moves) {
            add_force(scene_.articulated[part.child], part.child_lever, push);
        }
        for_each_pushing(held, [&](int row, std::uint32_t i) { add_torque(part, held, i, held.push[row]); });
    }

    static Vec3 point_push(const HeldJoint& held) { return {held.push[0], held.push[1], held.push[2]}; }

    // use(held, row): limits that pull, or that don't push and are exceeded.
    template <typename Use>
    void for_each_wrong(const Use& use) {
        for_each_held_back([&](const ArticulatedJoint& part, const Joint& joint, HeldJoint& held) {
            bool wrong[most_held_rows] = {};
            for_each_pushing(held, [&](int row, std::uint32_t i) {
                wrong[i] = held.rows[i].is_limit() &&
                           held.rows[i].push + joint_push(part, joint, held.push[row]) < 0;
            });
            for (std::uint32_t i = 0; i < held.row_count; ++i) {
                if (!held.pushes[i]) {
                    const std::int64_t error =
                        plus(row_error(part, joint, held.rows[i]), turned(part, held, i));
                    wrong[i] = of_child(part, error) < -lks::shifted(nearly_nothing, joint.constants.reach);
                }
                if (wrong[i]) {
                    use(held, i);
                }
            }
        });
    }

    std::uint32_t count_wrong() {
        std::uint32_t count = 0;
        for_each_wrong([&](HeldJoint&, std::uint32_t) { ++count; });
        return count;
    }

    // The first `count` of them.
    void turn_round(std::uint32_t count) {
        for_each_wrong([&](HeldJoint& held, std::uint32_t i) {
            if (count > 0) {
                held.pushes[i] = !held.pushes[i];
                --count;
            }
        });
    }

    void push() {
        for_each_body(
            [](Body& body, const ArticulatedBody& part) { apply(body, move_of(body, part.share, part)); });
        if (in_substep_) {
            for_each_held([this](const ArticulatedJoint& part, Joint& joint, const HeldJoint& held) {
                keep_pushes(part, joint, held);
            });
            for_each_taut([this](const RopeLoad& load, const ArticulatedBody& body) {
                Attachment& attachment = scene_.attachments[load.attachment];
                const std::int64_t push =
                    fixed::multiply_divide(load.push, body.share, std::int64_t{attachment.side.share} << 2);
                add_push(attachment, fixed::scale(load.along, push));
            });
        }
    }

    void keep_pushes(const ArticulatedJoint& part, Joint& joint, const HeldJoint& held) {
        const Vec3 push = point_push(held);
        add_tree_push(joint, multiply_32(part.pair_share, part.child_is_a ? -push : push), range_.is_uneven);
        for (std::uint32_t i = 0; i < held.row_count; ++i) {
            if (!held.pushes[i]) {
                set_limit_push(joint, held.rows[i], 0);
            }
        }
        for_each_pushing(held, [&](int row, std::uint32_t i) {
            const std::int64_t more = joint_push(part, joint, held.push[row]);
            if (held.rows[i].is_limit()) {
                set_limit_push(joint, held.rows[i],
                               std::clamp<std::int64_t>(held.rows[i].push + more, 0, greatest_push));
            } else {
                joint.turn = joint.turn + fixed::scale(held.rows[i].axis, more);
                clamp_vector(joint.turn, greatest_push);
            }
        });
    }

    bool in_substep_;
};

} // namespace

void carry_torque(RigidScene& scene, const Joint& joint, const Vec3& push) {
    ArticulatedBody& a = scene.articulated[joint.description.body_a];
    ArticulatedBody& b = scene.articulated[joint.description.body_b];
    const Body& body_a = scene.bodies[joint.description.body_a];
    const Body& body_b = scene.bodies[joint.description.body_b];
    const std::int64_t share = std::max(body_a.is_awake() ? a.share : 0, body_b.is_awake() ? b.share : 0);
    const Inverse inverse = invert_pivot(share);
    const auto torque = [&](const Body& body) {
        const Vec3 own = shifted(push, 2 * joint.constants.reach - body.scale);
        return Vec3{divide(own.x, inverse), divide(own.y, inverse), divide(own.z, inverse)};
    };
    if (body_a.is_awake()) {
        a.carried_torque = a.carried_torque - torque(body_a);
    }
    if (body_b.is_awake()) {
        b.carried_torque = b.carried_torque + torque(body_b);
    }
}

bool solve_held_tree(RigidScene& scene, const ArticulatedTree& tree) {
    stiffen_further(scene, tree);
    HeldTree held(scene, tree, true);
    held.find_taut();
    return held.find_rows() && held.solve();
}

bool undo_held_tree(RigidScene& scene, const ArticulatedTree& tree) {
    constexpr int most_rounds = 3;
    HeldTree held(scene, tree, false);
    held.find_taut();
    bool done = false;
    for (int round = 0; round < most_rounds && held.is_far_turned() && held.find_rows() && held.solve();
         ++round) {
        done = true;
    }
    if (done) {
        held.make_units();
    }
    return done;
}

} // namespace lks
