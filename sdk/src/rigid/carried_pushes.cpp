#include "rigid/carried_pushes.h"

#include <algorithm>

#include "collide/saturation.h"
#include "rigid/body_motion.h"
#include "rigid/contact_search.h"
#include "rigid/figures.h"
#include "rigid/held_tree.h"
#include "rigid/substep_motion.h"

namespace lks {
namespace {

using fixed::Int128;
using fixed::UInt128;
using fixed::Vec3;

Motion motion_since(const Body& body, const Vec3& position, const Quaternion& orientation) {
    const fixed::Rotation q =
        fixed::multiply(fixed::conjugate(narrow(orientation)), narrow(body.orientation));
    const Vec3 half_turn = q.w < 0 ? Vec3{-q.x, -q.y, -q.z} : Vec3{q.x, q.y, q.z};
    return {to_motion(body.position - position), to_turn_motion(body, half_turn, 30)};
}

// What everything that was carried on has done to it.
Motion motion_by_pushes(const Body& body) {
    return motion_since(body, body.uncarried_position, body.uncarried_orientation);
}

Motion motion_of_move(const Body& body, const Move& move) {
    return {to_motion(move.shift),
            to_turn_motion(body, fixed::rotate_transposed(body.rotation, move.half_turn),
                           half_turn_fraction_bits)};
}

// How what is kinematic would move a body in this substep if it held it.
Motion motion_with(const Body& holder, const Body& body, const MotionRate& rate) {
    constexpr int bits = 52;
    constexpr int down = turn_fraction_bits - bits;
    const std::int64_t n = rate.substeps_per_second;
    const Vec3 velocity =
        velocity_at(holder, saturating_subtract(body.start_position, holder.start_position));
    const Vec3 half_turn = to_half_turn(holder.angular_velocity, rate);
    const Vec3 turn{half_turn.x >> down, half_turn.y >> down, half_turn.z >> down};
    return {to_motion({velocity.x / n, velocity.y / n, velocity.z / n}),
            to_turn_motion(body, fixed::rotate_transposed(body.rotation, turn), bits)};
}

// How much of the pushes is to be added, 30 fraction bits: −G/Q.
std::int32_t missing_share(const Int128& g, const Int128& q) {
    const UInt128 size = fixed::abs(g);
    const UInt128 whole = fixed::abs(q);
    std::uint64_t share = std::uint64_t{1} << 30;
    if (size < whole) {
        const int down = std::max(0, 128 - fixed::leading_zeros(whole) - 33);
        share = ((size >> down).lo << 30) / (whole >> down).lo;
    }
    const auto signed_share = static_cast<std::int32_t>(std::min(share, std::uint64_t{1} << 30));
    return g.hi < 0 ? signed_share : -signed_share;
}

void measure_motion(RigidScene& scene, std::uint32_t index) {
    const Body& body = scene.bodies[index];
    scene.substep_motions[index] = motion_since(body, body.start_position, body.start_orientation);
}

class Figure {
public:
    Figure(RigidScene& scene, const FigureRange& range) : scene_(scene), range_(range) {}

    std::int32_t share_to_add(const MotionRate& rate, std::int64_t least_motion) {
        for_each(Part::body, [this](std::uint32_t i) { add_body(i); });
        add_neighbours();
        for_each_acting(scene_, range_, Part::contact,
                        [&](std::uint32_t i) { move_with_holder(scene_.contacts[i], rate); });
        for_each(Part::attachment, [this](std::uint32_t i) {
            if (!scene_.attachments[i].holds_in_tree) {
                add_attachment(scene_.attachments[i]);
            }
        });
        if (q_ == Int128{0, 0}) {
            return 0;
        }
        const std::int32_t share = missing_share(g_, q_);
        const auto size = static_cast<std::uint64_t>(share < 0 ? -share : share);
        // G²/Q, twice the energy that is to be gained, against a slow motion of all of it.
        const UInt128 high = fixed::abs(g_) >> 30;
        const UInt128 gain = fixed::multiply_unsigned(high.hi != 0 ? UINT64_MAX : high.lo, size);
        const auto least = static_cast<std::uint64_t>(least_motion);
        return size < least_share || gain < fixed::multiply_unsigned(least * least, mass_) ? 0 : share;
    }

    void add(std::int32_t share) {
        for_each(Part::joint, [&](std::uint32_t i) {
            Joint& joint = scene_.joints[i];
            Body& a = scene_.bodies[joint.description.body_a];
            Body& b = scene_.bodies[joint.description.body_b];
            if (joint.carries_torque) {
                carry_torque(scene_, joint, add_to_carried_turn(joint, a, b, share));
            } else {
                carry_more(joint, a, b, share);
            }
        });
        for (const Part kind : {Part::contact, Part::shared_contact}) {
            for_each_acting(scene_, range_, kind, [&](std::uint32_t i) {
                Contact& contact = scene_.contacts[i];
                carry_more(contact,
                           {scene_.bodies[contact.key.body_a], other_body(scene_, contact.key.other)}, share);
            });
        }
        measure_moved();
    }

    // It has been added to: what others had in mind with it has to be thought over.
    void mark_changed() {
        scene_.figures_changed[figure()] = 1;
        for_each(Part::shared_contact,
                 [this](std::uint32_t i) { scene_.figures_changed[neighbour_of(i)] = 1; });
    }
    bool knows_changed() const {
        bool any = scene_.figures_changed[figure()] != 0;
        for_each(Part::shared_contact,
                 [&](std::uint32_t i) { any = any || scene_.figures_changed[neighbour_of(i)] != 0; });
        return any;
    }

private:
    // An eighth.
    static constexpr std::uint64_t least_share = std::uint64_t{1} << 27;

    template <typename Use>
    void for_each(Part kind, const Use& use) const {
        for_each_part(scene_, range_, kind, use);
    }

    // What it has added to: its own bodies, and those that they push.
    void measure_moved() {
        for_each(Part::body, [this](std::uint32_t i) { measure_motion(scene_, i); });
        for_each_acting(scene_, range_, Part::shared_contact,
                        [this](std::uint32_t i) { measure_motion(scene_, neighbouring_body(i)); });
    }

    std::uint32_t figure() const { return name_of(scene_, range_); }
    std::uint32_t neighbouring_body(std::uint32_t contact) const {
        const ContactKey& key = scene_.contacts[contact].key;
        return scene_.figures[key.body_a] == figure() ? key.other : key.body_a;
    }
    std::uint32_t neighbour_of(std::uint32_t contact) const {
        return scene_.figures[neighbouring_body(contact)];
    }

    void add_products(std::uint32_t index, std::int32_t mass, const Motion& by_pushes, const Motion& motion) {
        const SymmetricMatrix& inertia = scene_.descriptions[index].properties.inertia;
        g_ = g_ + fixed::multiply_signed(product(inertia, by_pushes, motion), mass);
        q_ = q_ + fixed::multiply_signed(product(inertia, by_pushes, by_pushes), mass);
    }

    void add_body(std::uint32_t index) {
        const Body& body = scene_.bodies[index];
        const std::int32_t mass = scene_.figure_masses[index];
        mass_ += static_cast<std::uint64_t>(mass);
        add_products(index, mass, motion_by_pushes(body), scene_.substep_motions[index]);
    }

    // What a kinematic body, or a collider, pushes counts in its frame.
    void move_with_holder(const Contact& contact, const MotionRate& rate) {
        const ContactKey& key = contact.key;
        const Body& other = other_body(scene_, key.other);
        const bool pushes_a = scene_.bodies[key.body_a].is_awake();
        const Body& holder = pushes_a ? other : scene_.bodies[key.body_a];
        if (holder.is_dynamic() || !holder.is_moving()) {
            return;
        }
        const std::uint32_t index = pushes_a ? key.body_a : key.other;
        const Body& body = scene_.bodies[index];
        const Motion by_push = motion_of_move(body, pushes_a ? contact.carried_a : contact.carried_b);
        g_ = g_ - fixed::multiply_signed(product(scene_.descriptions[index].properties.inertia, by_push,
                                                 motion_with(holder, body, rate)),
                                         scene_.figure_masses[index]);
    }

    // What the contacts with other figures do to these; those of the same two bodies stand together.
    void add_neighbours() {
        Move move;
        std::uint32_t a = UINT32_MAX;
        std::uint32_t other = UINT32_MAX;
        const auto finish = [&] {
            if (a != UINT32_MAX) {
                const std::uint32_t neighbour = scene_.figures[a] == figure() ? other : a;
                const Body& body = scene_.bodies[neighbour];
                add_products(neighbour, mass_in(range_.heaviest, body), motion_of_move(body, move),
                             scene_.substep_motions[neighbour]);
            }
        };
        for_each_acting(scene_, range_, Part::shared_contact, [&](std::uint32_t i) {
            const Contact& contact = scene_.contacts[i];
            const ContactKey& key = contact.key;
            if (key.body_a != a || key.other != other) {
                finish();
                a = key.body_a;
                other = key.other;
                move = {};
            }
            add_move(scene_.figures[key.body_a] != figure() ? contact.carried_a : contact.carried_b, move);
        });
        finish();
    }

    // It begins each substep from nothing: what it will do is about what it did.
    void add_attachment(const Attachment& attachment) {
        const std::uint32_t index = attachment.description.other;
        const Body& body = scene_.bodies[index];
        const Motion expected = motion_of_move(body, move_of(body, attachment.side, attachment.expected, 1));
        g_ = g_ + fixed::multiply_signed(product(scene_.descriptions[index].properties.inertia,
                                                 motion_by_pushes(body), expected),
                                         scene_.figure_masses[index]);
    }

    RigidScene& scene_;
    const FigureRange& range_;
    Int128 g_{0, 0};
    Int128 q_{0, 0};
    std::uint64_t mass_ = 0; // 30 fraction bits
};

std::int64_t least_motion_of(const MotionRate& rate, std::int64_t least_speed) {
    return std::min(least_speed / rate.substeps_per_second >> (world_fraction_bits - motion_fraction_bits),
                    greatest_motion);
}

bool is_pushed(const FigureRange& range) {
    return range.count(Part::joint) != 0 || range.count(Part::contact) != 0 ||
           range.count(Part::shared_contact) != 0;
}

} // namespace

void measure_motions(RigidScene& scene, const FigureRange& range) {
    if (is_pushed(range)) {
        for_each_part(scene, range, Part::body, [&](std::uint32_t i) { measure_motion(scene, i); });
    }
}

std::int32_t share_to_add(RigidScene& scene, const FigureRange& range, const MotionRate& rate,
                          std::int64_t least_speed) {
    return is_pushed(range) && !stands_on_light_feet(scene, range)
               ? Figure(scene, range).share_to_add(rate, least_motion_of(rate, least_speed))
               : 0;
}

bool scale_carried_pushes(RigidScene& scene, const MotionRate& rate, std::int64_t least_speed) {
    bool any = false;
    for (std::size_t i = 0; i < scene.figure_ranges.size(); ++i) {
        const FigureRange& range = scene.figure_ranges[i];
        if (!is_pushed(range) || stands_on_light_feet(scene, range)) {
            continue;
        }
        if (any && Figure(scene, range).knows_changed()) {
            scene.figure_shares[i] = share_to_add(scene, range, rate, least_speed);
        }
        const std::int32_t share = scene.figure_shares[i];
        if (share != 0) {
            if (!any) {
                static_cast<void>(scene.figures_changed.resize(scene.bodies.size())); // within its room
                std::fill(scene.figures_changed.begin(), scene.figures_changed.end(), std::uint8_t{0});
            }
            any = true;
            Figure figure(scene, range);
            figure.add(share);
            figure.mark_changed();
        }
    }
    return any;
}

} // namespace lks
