#include "rigid/held_energy.h"

#include <algorithm>

#include "collide/saturation.h"
#include "rigid/contact_search.h"
#include "rigid/figures.h"
#include "rigid/substep_motion.h"

namespace lks {
namespace {

using fixed::Int128;
using fixed::UInt128;
using fixed::Vec3;

// Further from its holder nothing is: a kilometre, World.
constexpr std::int64_t farthest = std::int64_t{1} << (world_fraction_bits + 10);
constexpr int factor_fraction_bits = 30;

// Both World, or b in radians of World.
Vec3 cross_world(const Vec3& a, const Vec3& b) {
    const auto m = [](std::int64_t p, std::int64_t q) {
        return fixed::multiply_shift(p, q, world_fraction_bits);
    };
    return {m(a.y, b.z) - m(a.z, b.y), m(a.z, b.x) - m(a.x, b.z), m(a.x, b.y) - m(a.y, b.x)};
}

// How what holds a figure moves in this substep, and would move all of it.
class Holder {
public:
    explicit Holder(const Body& body) : body_(body) {
        if (!body.is_dynamic()) { // else it is asleep
            shift_ = saturating_subtract(body.position, body.start_position);
            half_turn_ = half_turn_between(body.start_orientation, body.orientation);
        }
    }

    // Bodies that move alike hold together.
    bool moves_as(const Holder& other) const {
        return &body_ == &other.body_ || (shift_ == other.shift_ && !turns() && !other.turns());
    }
    bool stands() const { return shift_ == Vec3{0, 0, 0} && !turns(); }
    const Vec3& half_turn() const { return half_turn_; }

    // In the substep, of what is there at its beginning; and at its end.
    Vec3 shift_at(const Vec3& place) const {
        const Vec3& here = body_.is_dynamic() ? body_.position : body_.start_position;
        return saturating_add(shift_, cross_world(angle(), way(here, place)));
    }
    Vec3 velocity_at(const Vec3& place) const {
        return body_.velocity + cross_world(body_.angular_velocity, way(body_.position, place));
    }
    const Vec3& angular_velocity() const { return body_.angular_velocity; }

private:
    bool turns() const { return !(half_turn_ == Vec3{0, 0, 0}); }
    Vec3 angle() const {
        constexpr int down = turn_fraction_bits - world_fraction_bits - 1;
        return {half_turn_.x >> down, half_turn_.y >> down, half_turn_.z >> down};
    }
    static Vec3 way(const Vec3& from, const Vec3& to) {
        Vec3 difference = saturating_subtract(to, from);
        clamp_vector(difference, farthest);
        return difference;
    }

    const Body& body_;
    Vec3 shift_{0, 0, 0};
    Vec3 half_turn_{0, 0, 0};
};

// √(a/b), 30 fraction bits; b > a ≥ 0.
std::int64_t root_of_ratio(const Int128& a, const Int128& b) {
    const UInt128 whole = fixed::abs(b);
    const int down = std::max(0, 64 - fixed::leading_zeros(whole));
    const UInt128 part = UInt128{(fixed::abs(a) >> down).lo, 0} >> (64 - 2 * factor_fraction_bits);
    const std::uint64_t ratio = fixed::divide(part, (whole >> down).lo).quotient.lo;
    return static_cast<std::int64_t>(fixed::square_root(ratio));
}

class HeldFigure {
public:
    HeldFigure(RigidScene& scene, const FigureRange& range, const MotionRate& rate)
        : scene_(scene), range_(range), rate_(rate), heaviest_(heaviest_of(scene, range)) {}

    void take_out_gain() {
        const Body* holder = nullptr;
        bool together = true;
        for_each(Part::joint, [&](std::uint32_t i) {
            const JointDescription& joint = scene_.joints[i].description;
            for (const std::uint32_t index : {joint.body_a, joint.body_b}) {
                const Body& body = scene_.bodies[index];
                if (!body.is_awake()) {
                    together = together && (holder == nullptr || Holder(*holder).moves_as(Holder(body)));
                    holder = &body;
                }
            }
        });
        if (holder != nullptr && together) {
            take_out_gain(Holder(*holder));
        }
    }

private:
    template <typename Use>
    void for_each(Part kind, const Use& use) const {
        for_each_part(scene_, range_, kind, use);
    }

    void take_out_gain(const Holder& holder) {
        Int128 before{0, 0};
        Int128 after{0, 0};
        for_each(Part::body, [&](std::uint32_t i) {
            const Body& body = scene_.bodies[i];
            const SymmetricMatrix& inertia = scene_.descriptions[i].properties.inertia;
            const std::int64_t mass = mass_in(heaviest_, body);
            const auto twice_energy = [&](const Vec3& position, const Quaternion& orientation) {
                const Motion motion = beside(holder, body, position, orientation);
                return fixed::multiply_signed(product(inertia, motion, motion), mass);
            };
            before = before + twice_energy(body.predicted_position, body.predicted_orientation);
            after = after + twice_energy(body.position, body.orientation);
        });
        if (!is_much_more(after, before) || !is_pushed_from_within(holder)) {
            return;
        }
        for_each(Part::joint, [&](std::uint32_t i) { before = before + motor_work(scene_.joints[i]); });
        if (is_much_more(after, before)) {
            slow_down(holder, root_of_ratio(before, after));
        }
    }

    static bool is_much_more(const Int128& after, const Int128& before) {
        return after - before > (before >> 8);
    }

    // What it has moved there in the substep, less what its holder would have moved it.
    static Motion beside(const Holder& holder, const Body& body, const Vec3& position,
                         const Quaternion& orientation) {
        constexpr int bits = 52;
        const Vec3 turn = half_turn_between(body.start_orientation, orientation) - holder.half_turn();
        constexpr int down = turn_fraction_bits - bits;
        const fixed::Matrix3 axes = fixed::to_matrix(narrow(body.start_orientation));
        const Vec3 own = fixed::rotate_transposed(axes, Vec3{turn.x >> down, turn.y >> down, turn.z >> down});
        return {to_motion(saturating_subtract(saturating_subtract(position, body.start_position),
                                              holder.shift_at(body.start_position))),
                to_turn_motion(body, own, bits)};
    }

    // By nothing else that may do work on it.
    bool is_pushed_from_within(const Holder& holder) const {
        bool within = !is_near_particles();
        for_each(Part::joint, [&](std::uint32_t i) {
            const Joint& joint = scene_.joints[i];
            within = within && joint.in_held_tree && joint.constants.limits.softness == 0;
        });
        for (const Part kind : {Part::contact, Part::shared_contact}) {
            for_each(kind, [&](std::uint32_t i) {
                within = within && (!pushes(scene_.contacts[i]) || may_touch(scene_.contacts[i], holder));
            });
        }
        return within;
    }

    static bool pushes(const Contact& contact) {
        return std::any_of(contact.points, contact.points + contact.count,
                           [](const ContactPoint& point) { return point.active && point.push.normal != 0; });
    }

    // Bones of its own, and what stands as its holder does.
    bool may_touch(const Contact& contact, const Holder& holder) const {
        const ContactKey& key = contact.key;
        const Body& a = scene_.bodies[key.body_a];
        const Body& b = other_body(scene_, key.other);
        return a.is_awake() && b.is_awake() ? scene_.figures[key.body_a] == scene_.figures[key.other]
                                            : holder.stands() && !(a.is_awake() ? b : a).is_moving();
    }

    bool is_near_particles() const {
        return std::any_of(scene_.object_pairs.begin(), scene_.object_pairs.end(),
                           [this](std::uint64_t pair) {
                               const auto body = static_cast<std::uint32_t>(pair);
                               return scene_.figures[body] == figure_of(scene_.figure_parts[range_.begin()]);
                           });
    }

    // Twice what a motor, or friction, has given.
    Int128 motor_work(const Joint& joint) const {
        const Body& a = scene_.bodies[joint.description.body_a];
        const Body& b = scene_.bodies[joint.description.body_b];
        const Vec3 turn = turned(b) - turned(a);
        const int reach = joint.constants.reach;
        const Vec3 push = to_motion(shifted_by(joint.grip, reach));
        const Vec3 way =
            to_motion(shifted_by({turn.x >> angle_down, turn.y >> angle_down, turn.z >> angle_down}, reach));
        const std::int64_t work = push.x * way.x + push.y * way.y + push.z * way.z;
        const Body& lighter = heavier(b.effective_inverse_mass(), a.effective_inverse_mass()) ? a : b;
        return work <= 0 ? Int128{0, 0} : fixed::multiply_signed(2 * work, mass_in(heaviest_, lighter));
    }
    static constexpr int angle_down = turn_fraction_bits - world_fraction_bits - 1;
    static Vec3 turned(const Body& body) {
        return body.is_dynamic() && !body.is_awake()
                   ? Vec3{0, 0, 0}
                   : half_turn_between(body.start_orientation, body.orientation);
    }
    static Vec3 shifted_by(const Vec3& v, int shift) {
        return {shifted(v.x, shift), shifted(v.y, shift), shifted(v.z, shift)};
    }

    void slow_down(const Holder& holder, std::int64_t factor) {
        const auto between = [factor](const Vec3& from, const Vec3& to) {
            const auto part = [factor](std::int64_t a, std::int64_t b) {
                return a + fixed::multiply_shift(b - a, factor, factor_fraction_bits);
            };
            return Vec3{part(from.x, to.x), part(from.y, to.y), part(from.z, to.z)};
        };
        for_each(Part::body, [&](std::uint32_t i) {
            Body& body = scene_.bodies[i];
            body.velocity = between(holder.velocity_at(body.position), body.velocity);
            body.angular_velocity = between(holder.angular_velocity(), body.angular_velocity);
            clamp_vector(body.velocity, rate_.speed_limit);
            clamp_vector(body.angular_velocity, rate_.spin_limit);
        });
    }

    RigidScene& scene_;
    const FigureRange& range_;
    const MotionRate& rate_;
    const InverseMass& heaviest_;
};

} // namespace

void take_out_gain(RigidScene& scene, const FigureRange& figure, const MotionRate& rate) {
    HeldFigure(scene, figure, rate).take_out_gain();
}

} // namespace lks
