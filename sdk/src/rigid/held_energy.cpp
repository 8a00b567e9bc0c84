#include "rigid/held_energy.h"

#include <algorithm>

#include "collide/saturation.h"
#include "rigid/contact_search.h"
#include "rigid/energy_factor.h"
#include "rigid/figure_pushes.h"
#include "rigid/figures.h"
#include "rigid/joint_distance.h"
#include "rigid/joint_drive.h"
#include "rigid/joint_limits.h"
#include "rigid/rope_loads.h"
#include "rigid/substep_motion.h"

namespace lks {
namespace {

using fixed::Int128;
using fixed::Vec3;

// Bodies that move alike hold together.
bool move_alike(const Body& a, const Body& b) {
    const Vec3 none{0, 0, 0};
    return &a == &b || (a.velocity == b.velocity && a.angular_velocity == none && b.angular_velocity == none);
}

// What a joint's springs have done, as work_of_turning has it: their pushes times the motion.
std::int64_t work_of_springs(const Joint& joint, const Body& a, const Body& b) {
    const JointConstants& c = joint.constants;
    std::int64_t work = 0;
    if (c.points.softness != 0) {
        const Vec3 push = to_motion(joint.push);
        const Vec3 way = to_motion(joint_offset(joint, a, b) - joint.begin);
        work = push.x * way.x + push.y * way.y + push.z * way.z;
    }
    if (c.angular_softness != 0) {
        work += work_of_turning(joint, a, b, joint.turn);
    }
    if (c.limits.softness != 0) {
        work += work_of_turning(joint, a, b, limit_push(joint, a, b));
    }
    return work;
}

// What a body has moved in the substep, less what its holder would have moved it.
class Beside {
public:
    Beside(const Body& holder, const Body& body, const MotionRate& rate)
        : body_(body), axes_(fixed::to_matrix(narrow(body.start_orientation))),
          half_turn_(to_half_turn(holder.angular_velocity, rate)) {
        const Vec3 lever = saturating_subtract(body.start_position, holder.start_position);
        const Vec3 velocity = velocity_at(holder, lever);
        const std::int64_t n = rate.substeps_per_second;
        place_ = saturating_add(body.start_position, {velocity.x / n, velocity.y / n, velocity.z / n});
    }

    // Where it is now.
    Motion motion(const Vec3& position, const Quaternion& orientation) const {
        constexpr int bits = 52;
        constexpr int down = turn_fraction_bits - bits;
        const Vec3 turn = half_turn_between(body_.start_orientation, orientation) - half_turn_;
        const Vec3 own =
            fixed::rotate_transposed(axes_, Vec3{turn.x >> down, turn.y >> down, turn.z >> down});
        return {to_motion(saturating_subtract(position, place_)), to_turn_motion(body_, own, bits)};
    }

private:
    const Body& body_;
    fixed::Matrix3 axes_;
    Vec3 half_turn_; // of the holder
    Vec3 place_;     // where it would have moved it
};

// Twice the energy of its motion in the substep, masses as shares of one.
Int128 twice_energy(const Object& object, const InverseMass& mass) {
    constexpr int down = coordinate_fraction_bits - motion_fraction_bits;
    Int128 sum{0, 0};
    for (std::uint32_t i = 0; i < object.count(); ++i) {
        const InverseMass own = particle_inverse_mass(object, i);
        if (own.mantissa == 0) {
            continue;
        }
        std::int64_t squared = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const std::int64_t moved =
                fixed::wrapping_subtract(object.axis(axis)[i], object.start_axis(axis)[i]) >> down;
            const std::int64_t limited = std::clamp(moved, -greatest_motion, greatest_motion);
            squared += limited * limited;
        }
        sum = sum + fixed::multiply_signed(squared, share_in_greater(mass, own));
    }
    return sum;
}

// The awake figure of a body.
const FigureRange& figure_range(const RigidScene& scene, std::uint32_t body) {
    return *std::lower_bound(
        scene.figure_ranges.begin(), scene.figure_ranges.end(), scene.figures[body],
        [&scene](const FigureRange& figure, std::uint32_t name) { return name_of(scene, figure) < name; });
}

// Its particles by the factor.
void slow_down(Object& object, std::int64_t factor) {
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t* const x = object.axis(axis);
        std::int64_t* const start = object.start_axis(axis);
        for (std::uint32_t i = 0; i < object.count(); ++i) {
            start[i] = x[i] - fixed::multiply_shift(fixed::wrapping_subtract(x[i], start[i]), factor,
                                                    factor_fraction_bits);
        }
    }
}

// A rigid one only pushes where a substep has moved it; what it has to do without speed it does elsewhere.
bool is_soft_distance(const Joint& joint) {
    return is_distance(joint) && joint.constants.points.softness != 0;
}

class HeldFigure {
public:
    HeldFigure(RigidScene& scene, const FigureRange& range, const MotionRate& rate)
        : scene_(scene), range_(range), rate_(rate) {}

    void take_out_gain_on_ropes(lks_world& world) {
        if (!hangs_on_what_rests(world)) {
            return;
        }
        for_each_own_rope([&](std::uint32_t object) {
            before_ = before_ + scene_.rope_loads_of(object).front().predicted;
            after_ = after_ + twice_energy(*world.objects[object].object, range_.heaviest);
        });
        const std::int64_t factor = take_out_gain(Body{});
        if (factor != one_factor) {
            for_each_own_rope(
                [&](std::uint32_t object) { lks::slow_down(*world.objects[object].object, factor); });
        }
    }

    void take_out_gain() {
        const Body* holder = nullptr;
        bool together = true;
        for_each(Part::joint, [&](std::uint32_t i) {
            const JointDescription& joint = scene_.joints[i].description;
            for (const std::uint32_t index : {joint.body_a, joint.body_b}) {
                const Body& body = scene_.bodies[index];
                if (!body.is_awake()) {
                    together = together && (holder == nullptr || move_alike(*holder, body));
                    holder = &body;
                }
            }
        });
        if (holder != nullptr && together) {
            take_out_gain(*holder);
        } else if (holder == nullptr && is_pushed_from_outside(scene_, range_)) {
            take_out_gain(Body{});
        }
    }

private:
    template <typename Use>
    void for_each(Part kind, const Use& use) const {
        for_each_part(scene_, range_, kind, use);
    }

    // use(object)
    template <typename Use>
    void for_each_own_rope(const Use& use) const {
        for_each_loaded_rope(scene_, [&](std::uint32_t object) {
            if (is_own(object)) {
                use(object);
            }
        });
    }

    bool is_part(std::uint32_t body) const { return is_bone_of(scene_, range_, body); }
    bool is_own(std::uint32_t object) const {
        return any_rope_load(scene_, object, [this](std::uint32_t body) { return is_part(body); });
    }

    // Nothing but gravity does any work on it and its ropes.
    bool hangs_on_what_rests(const lks_world& world) const {
        bool rests = !range_.is_held;
        for (const ColliderSlot& slot : world.colliders) {
            rests = rests && !(slot.used && slot.collider.moves());
        }
        for_each_own_rope([&](std::uint32_t index) {
            const Object& object = *world.objects[index].object;
            rests = rests && object.coefficients().chain.soft_part.is_zero();
            for (std::size_t i = 0; i < object.pins().size(); ++i) {
                const Coordinates& to = object.pins()[i].target;
                const Coordinates& from = object.pin_starts[i];
                rests = rests && to.x == from.x && to.y == from.y && to.z == from.z;
            }
            for (std::size_t i = 0; i < scene_.attachments.size(); ++i) {
                rests = rests && (!scene_.attachment_slots[i].used ||
                                  !is_held_otherwise(scene_.attachments[i], index));
            }
            for (const std::uint64_t pair : scene_.object_pairs) {
                const auto body = static_cast<std::uint32_t>(pair);
                rests = rests && (pair >> 32 != index || is_part(body) ||
                                  (!scene_.bodies[body].is_dynamic() && !scene_.bodies[body].is_moving()));
            }
        });
        return rests;
    }

    bool is_held_otherwise(const Attachment& attachment, std::uint32_t object) const {
        const AttachmentDescription& d = attachment.description;
        if (d.kind == LKS_ATTACHMENT_TO_VERTEX) {
            return d.object == object || d.other == object;
        }
        const Body& body = scene_.bodies[d.other];
        return d.object == object && !is_part(d.other) &&
               (!attachment.loads_rope || body.is_dynamic() || body.is_moving());
    }

    // Returns what velocities beside the holder's were multiplied by.
    std::int64_t take_out_gain(const Body& holder) {
        Int128 before = before_;
        Int128 after = after_;
        for_each(Part::body, [&](std::uint32_t i) {
            const Body& body = scene_.bodies[i];
            const SymmetricMatrix& inertia = scene_.descriptions[i].properties.inertia;
            const std::int64_t mass = scene_.figure_masses[i];
            const Beside beside(holder, body, rate_);
            const auto twice_energy = [&](const Vec3& position, const Quaternion& orientation) {
                const Motion motion = beside.motion(position, orientation);
                return fixed::multiply_signed(product(inertia, motion, motion), mass);
            };
            before = before + twice_energy(body.predicted_position, body.predicted_orientation);
            after = after + twice_energy(body.position, body.orientation);
        });
        if (!is_much_more(after, before) || !is_pushed_from_within(holder)) {
            return one_factor;
        }
        for_each(Part::joint, [&](std::uint32_t i) { before = before + twice_work(scene_.joints[i]); });
        if (before.hi < 0) {
            before = {0, 0}; // springs have taken more than there was
        }
        if (!is_much_more(after, before + unseen_work())) {
            return one_factor;
        }
        const std::int64_t factor = energy_factor(before, after);
        slow_down(holder, factor);
        return factor;
    }

    // Twice what springs may have done that is lost in the rounding of their pushes: what its heaviest body
    // has that moves at a millimetre a second.
    Int128 unseen_work() const {
        bool any = false;
        for_each(Part::joint, [&](std::uint32_t i) { any = any || has_spring(scene_.joints[i].constants); });
        const std::int64_t motion =
            (std::int64_t{1} << motion_fraction_bits) / (1000 * rate_.substeps_per_second);
        return any ? fixed::multiply_signed(motion * motion + 1, one_factor) : Int128{0, 0};
    }

    static bool is_much_more(const Int128& after, const Int128& before) {
        return after - before > (before >> 8);
    }

    // By nothing else that may do work on it.
    bool is_pushed_from_within(const Body& holder) const {
        bool within = !is_near_particles();
        for_each(Part::joint, [&](std::uint32_t i) {
            const Joint& joint = scene_.joints[i];
            within = within && (joint.constants.limits.softness == 0 || joint.turns_in_tree) &&
                     (range_.is_loaded ? joint.in_tree : !is_soft_distance(joint) || joint.closes_loop);
        });
        for (const Part kind : {Part::contact, Part::shared_contact}) {
            for_each(kind, [&](std::uint32_t i) {
                within = within && (!pushes(scene_.contacts[i]) || may_touch(scene_.contacts[i], holder));
            });
        }
        return within;
    }

    // Bones of its own, and what stands as its holder does.
    bool may_touch(const Contact& contact, const Body& holder) const {
        const ContactKey& key = contact.key;
        const Body& a = scene_.bodies[key.body_a];
        const Body& b = other_body(scene_, key.other);
        return a.is_awake() && b.is_awake() ? scene_.figures[key.body_a] == scene_.figures[key.other]
                                            : !holder.is_moving() && !(a.is_awake() ? b : a).is_moving();
    }

    bool is_near_particles() const {
        return is_near_objects(
            scene_, range_, [this](std::uint32_t object) { return !(range_.is_loaded && is_own(object)); });
    }

    // What a motor, or friction, has given, and what is soft has given or taken.
    Int128 twice_work(const Joint& joint) const {
        const Body& a = scene_.bodies[joint.description.body_a];
        const Body& b = scene_.bodies[joint.description.body_b];
        const std::int64_t work = std::max<std::int64_t>(work_of_turning(joint, a, b, joint.grip), 0) +
                                  work_of_springs(joint, a, b);
        const Body& lighter = heavier(b.effective_inverse_mass(), a.effective_inverse_mass()) ? a : b;
        return fixed::multiply_signed(2 * work, mass_in(range_.heaviest, lighter));
    }

    void slow_down(const Body& holder, std::int64_t factor) {
        const auto between = [factor](const Vec3& from, const Vec3& to) {
            const auto part = [factor](std::int64_t a, std::int64_t b) {
                return a + fixed::multiply_shift(b - a, factor, factor_fraction_bits);
            };
            return Vec3{part(from.x, to.x), part(from.y, to.y), part(from.z, to.z)};
        };
        for_each(Part::body, [&](std::uint32_t i) {
            Body& body = scene_.bodies[i];
            body.velocity = between(velocity_at(holder, saturating_subtract(body.position, holder.position)),
                                    body.velocity);
            body.angular_velocity = between(holder.angular_velocity, body.angular_velocity);
            clamp_vector(body.velocity, rate_.speed_limit);
            clamp_vector(body.angular_velocity, rate_.spin_limit);
        });
    }

    RigidScene& scene_;
    const FigureRange& range_;
    const MotionRate& rate_;
    // Of what it hangs on.
    Int128 before_{0, 0};
    Int128 after_{0, 0};
};

} // namespace

void measure_predicted(lks_world& world, std::uint32_t object) {
    RigidScene& scene = world.rigid;
    const std::span<RopeLoad> loads = scene.rope_loads_of(object);
    for (const RopeLoad& load : loads) {
        const std::uint32_t body = scene.attachments[load.attachment].description.other;
        if (!scene.bodies[body].is_awake()) {
            continue;
        }
        if (const FigureRange& figure = figure_range(scene, body); figure.is_loaded) {
            loads.front().predicted = twice_energy(*world.objects[object].object, figure.heaviest);
            return;
        }
    }
}

void take_out_gain_on_ropes(lks_world& world, const FigureRange& figure, const MotionRate& rate) {
    HeldFigure(world.rigid, figure, rate).take_out_gain_on_ropes(world);
}

void take_out_gain(RigidScene& scene, const FigureRange& figure, const MotionRate& rate) {
    HeldFigure(scene, figure, rate).take_out_gain();
}

} // namespace lks
