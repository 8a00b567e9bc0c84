// Of one figure with loops (rigid/closures.h): what its joints hold beside the trees' points and turns, as
// rows of one system.
#pragma once

#include "rigid/closure_system.h"
#include "rigid/closure_tree.h"
#include "rigid/contact.h"
#include "rigid/foot_rows.h"
#include "rigid/joint_distance.h"

namespace lks {

class ClosureRows {
public:
    ClosureRows(RigidScene& scene, ClosureRange& range, bool in_substep)
        : scene_(scene), range_(range), in_substep_(in_substep) {}

    // Where they are, as far as there is room: of what closes loops all, and of limits those that may be
    // reached, or that push.
    void place();

    // What each is to bring to zero. False: one has turned so far that its factors say nothing.
    bool measure(ClosureUnknown (&unknowns)[most_closure_rows]);

    // What each has pushed more, in its scale.
    void keep_pushes(const ClosureUnknown (&unknowns)[most_closure_rows]);

    // What is undone strains no spring.
    void hold_springs();

    std::uint32_t count() const { return range_.row_count; }
    // use(closure, row, number)
    template <typename Use>
    void for_each_row(const Use& use) {
        for_each([&](Closure& closure) {
            for (std::uint32_t i = 0; i < closure.row_count; ++i) {
                const std::uint32_t number = closure.first_row + i;
                use(closure, scene_.closure_rows[range_.first_row + number], number);
            }
        });
    }
    // use(side, push at its lever): of each point that pushed in the substep before, in the body's own unit.
    template <typename Use>
    void for_each_foot_push(const Use& use) {
        for_each([&](Closure& closure) {
            for (std::uint32_t i = 0; i < feet_points(closure); ++i) {
                const Contact& contact = contact_of(closure);
                if (contact.points[i].active && contact.points[i].push.normal != 0) {
                    place_levers_of_foot(closure, i);
                    const fixed::Vec3 push = pushed_at(contact, contact.points[i]);
                    for_each_side(closure, [&](const ClosureSide& side, bool is_a) {
                        use(side, is_a ? -fixed::scaled(contact.shares.a, push)
                                       : fixed::scaled(contact.shares.b, push));
                    });
                }
            }
        });
    }
    // use(side that moves, whether it is a's)
    template <typename Use>
    static void for_each_side(const Closure& closure, const Use& use) {
        for (const ClosureSide* side : {&closure.a, &closure.b}) {
            if (side->tree != no_tree) {
                use(*side, side == &closure.a);
            }
        }
    }
    // Of a unit push in the row, in the tree's unit, or of one along the way that a distance has by now.
    static Wrench push_of(const ClosureRow& row, bool is_a);
    Wrench push_of(const ClosureSide& side, const ClosureRow& row, std::uint32_t number, bool is_a) const;
    // By a push of one in the figure's unit: what its bodies by themselves give way by, and what a spring
    // does.
    std::int64_t own_give(const Closure& closure, const ClosureRow& row) const;
    std::int64_t spring_give(const Closure& closure, const ClosureRow& row) const;

    std::int64_t in_tree(const ClosureSide& side, std::int64_t push) const {
        return multiply_32(scene_.trees[side.tree].figure_share, push);
    }

private:
    template <typename Use>
    void for_each(const Use& use) const {
        for (std::uint32_t i = range_.first; i < range_.end; ++i) {
            use(scene_.closures[i]);
        }
    }
    const Body& body_a(const Closure& closure) const { return scene_.bodies[closure.a.body]; }
    const Body& body_b(const Closure& closure) const { return scene_.bodies[closure.b.body]; }
    Joint& joint_of(const Closure& closure) const { return scene_.joints[closure.index]; }
    Attachment& pin_of(const Closure& closure) const { return scene_.attachments[closure.index]; }
    Contact& contact_of(const Closure& closure) const { return scene_.contacts[closure.index]; }
    ContactBodies foot_bodies(const Closure& closure) const;
    std::uint32_t feet_points(const Closure& closure) const {
        return closure.kind == Closure::Kind::foot ? contact_of(closure).count : 0;
    }
    void place_levers_of_foot(Closure& closure, std::uint32_t point) const;
    bool is_near_point(const Closure& closure, std::uint32_t point) const;

    std::uint32_t rows_to_close(const Closure& closure) const;
    std::int64_t find_margin(std::uint32_t room);
    static bool is_of_joint(const Closure& closure) {
        return closure.kind == Closure::Kind::closing || closure.kind == Closure::Kind::limits;
    }
    bool is_driven(const Joint& joint) const;
    std::uint32_t limits_of(const Closure& closure, HeldRow (&limits)[most_held_rows]) const;
    void place_joint(Closure& closure);
    void place_pin(Closure& closure);
    void add_points(Closure& closure);
    void place_foot(Closure& closure);
    void place_limits(Closure& closure, std::int64_t margin, std::uint32_t room);
    ClosureRow& add(Closure& closure, ClosureRow::Kind kind, const fixed::Direction& along);
    DistanceError distance_error_of(const Closure& closure) const;
    fixed::Vec3 left_apart_of(const Closure& closure) const;
    fixed::Vec3 left_of_pin(const Closure& closure) const;
    struct Measured {
        fixed::Vec3 apart;
        fixed::Vec3 turned;
        std::uint32_t limit_count;
        HeldRow limits[most_held_rows];
    };
    Measured measure(const Closure& closure) const;
    bool measure(const Closure& closure, const Measured& measured, const ClosureRow& row,
                 std::uint32_t number, ClosureUnknown& unknown);
    bool measure_joint(const Closure& closure, const Measured& measured, const ClosureRow& row,
                       std::uint32_t number, ClosureUnknown& unknown);
    void measure_foot(const Closure& closure, const ClosureRow& row, ClosureUnknown& unknown) const;
    void keep_push(const Closure& closure, const ClosureRow& row, std::uint32_t number,
                   const ClosureUnknown& unknown);

    RigidScene& scene_;
    ClosureRange& range_;
    bool in_substep_;
    fixed::Direction ways_[most_closure_rows]; // of distances, by now
};

// Of a joint that closes a loop: what it holds.
std::uint32_t closing_rows(const Joint& joint);

// value · 2^up, within 2^58.
std::int64_t scaled_by(std::int64_t value, int up);

} // namespace lks
