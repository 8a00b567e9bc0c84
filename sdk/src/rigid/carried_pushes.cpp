#include "rigid/carried_pushes.h"

#include <algorithm>

#include "rigid/body_roots.h"
#include "rigid/contact_search.h"

namespace lks {
namespace {

using fixed::Int128;
using fixed::UInt128;
using fixed::Vec3;

// What belongs to a figure, in the order of its work.
enum class Part : std::uint64_t { body, joint, contact, attachment };

constexpr std::uint64_t name_part(std::uint32_t figure, Part kind, std::size_t index) {
    return std::uint64_t{figure} << 34 | static_cast<std::uint64_t>(kind) << 32 | index;
}
constexpr std::uint32_t figure_of(std::uint64_t part) {
    return static_cast<std::uint32_t>(part >> 34);
}
constexpr Part kind_of(std::uint64_t part) {
    return static_cast<Part>(part >> 32 & 3);
}
constexpr std::uint32_t index_of(std::uint64_t part) {
    return static_cast<std::uint32_t>(part);
}

// Motions of a substep in six dimensions: metres of 26 fraction bits, up to 8 m. Turns are in the body's axes
// and count at the body's unit of length (rigid/inertia.h).
constexpr int motion_fraction_bits = 26;
constexpr std::int64_t greatest_motion = std::int64_t{1} << (motion_fraction_bits + 3);

struct Motion {
    Vec3 shift;
    Vec3 turn;
};

Vec3 limited(const Vec3& v) {
    const auto part = [](std::int64_t c) { return std::clamp(c, -greatest_motion, greatest_motion); };
    return {part(v.x), part(v.y), part(v.z)};
}

Vec3 to_motion(const Vec3& world) {
    constexpr int down = world_fraction_bits - motion_fraction_bits;
    return limited({world.x >> down, world.y >> down, world.z >> down});
}

// Half turns of so many fraction bits.
Vec3 to_turn(const Body& body, const Vec3& half_turn, int fraction_bits) {
    const int up = body.scale + 1 + motion_fraction_bits - fraction_bits;
    const auto part = [up](std::int64_t c) {
        return up >= 0 ? c * (std::int64_t{1} << up) : c >> std::min(-up, 63);
    };
    return limited({part(half_turn.x), part(half_turn.y), part(half_turn.z)});
}

Motion motion_since(const Body& body, const Vec3& position, const Quaternion& orientation) {
    const fixed::Rotation q =
        fixed::multiply(fixed::conjugate(narrow(orientation)), narrow(body.orientation));
    const Vec3 half_turn = q.w < 0 ? Vec3{-q.x, -q.y, -q.z} : Vec3{q.x, q.y, q.z};
    return {to_motion(body.position - position), to_turn(body, half_turn, 30)};
}

Motion motion_of_substep(const Body& body) {
    return motion_since(body, body.start_position, body.start_orientation);
}

// What everything that was carried on has done to it.
Motion motion_by_pushes(const Body& body) {
    return motion_since(body, body.uncarried_position, body.uncarried_orientation);
}

Motion motion_of_move(const Body& body, const Move& move) {
    return {to_motion(move.shift),
            to_turn(body, fixed::rotate_transposed(body.rotation, move.half_turn), half_turn_fraction_bits)};
}

// Of one kilogram, 52 fraction bits.
std::int64_t product(const SymmetricMatrix& inertia, const Motion& p, const Motion& q) {
    const Vec3 turn = multiply(inertia, q.turn);
    return p.shift.x * q.shift.x + p.shift.y * q.shift.y + p.shift.z * q.shift.z + p.turn.x * turn.x +
           p.turn.y * turn.y + p.turn.z * turn.z;
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

class Figure {
public:
    Figure(RigidScene& scene, const std::uint64_t* parts, std::size_t count)
        : scene_(scene), parts_(parts), kinds_(split(parts, count)), heaviest_(heaviest()) {}

    std::int32_t share_to_add(std::int64_t least_motion) {
        for_each(Part::body, [this](std::uint32_t i) { add_body(i); });
        add_neighbours();
        for_each(Part::attachment, [this](std::uint32_t i) { add_attachment(scene_.attachments[i]); });
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
            carry_more(joint, scene_.bodies[joint.description.body_a],
                       scene_.bodies[joint.description.body_b], share);
        });
        for_each(Part::contact, [&](std::uint32_t i) {
            Contact& contact = scene_.contacts[i];
            carry_more(contact, {scene_.bodies[contact.key.body_a], other_body(scene_, contact.key.other)},
                       share);
        });
    }

private:
    // An eighth.
    static constexpr std::uint64_t least_share = std::uint64_t{1} << 27;

    // Where the parts of each kind begin.
    struct Kinds {
        std::size_t begins[5];
    };
    static Kinds split(const std::uint64_t* parts, std::size_t count) {
        Kinds kinds{};
        std::size_t i = 0;
        for (std::size_t kind = 0; kind < 4; ++kind) {
            kinds.begins[kind] = i;
            while (i < count && static_cast<std::size_t>(kind_of(parts[i])) == kind) {
                ++i;
            }
        }
        kinds.begins[4] = count;
        return kinds;
    }

    template <typename Use>
    void for_each(Part kind, const Use& use) const {
        const auto k = static_cast<std::size_t>(kind);
        for (std::size_t i = kinds_.begins[k]; i < kinds_.begins[k + 1]; ++i) {
            use(index_of(parts_[i]));
        }
    }

    const InverseMass& heaviest() const {
        const InverseMass* best = &scene_.bodies[index_of(parts_[0])].inverse_mass;
        for_each(Part::body, [&](std::uint32_t i) {
            const InverseMass& other = scene_.bodies[i].inverse_mass;
            best = heavier(other, *best) ? &other : best;
        });
        return *best;
    }

    // In the heaviest one's, 30 fraction bits; at most one.
    std::int32_t mass_of(const Body& body) const { return pair_shares(heaviest_, body.inverse_mass).a; }

    void add_products(std::uint32_t index, std::int32_t mass, const Motion& by_pushes, const Motion& motion) {
        const SymmetricMatrix& inertia = scene_.descriptions[index].properties.inertia;
        g_ = g_ + fixed::multiply_signed(product(inertia, by_pushes, motion), mass);
        q_ = q_ + fixed::multiply_signed(product(inertia, by_pushes, by_pushes), mass);
    }

    void add_body(std::uint32_t index) {
        const Body& body = scene_.bodies[index];
        const std::int32_t mass = mass_of(body);
        mass_ += static_cast<std::uint64_t>(mass);
        add_products(index, mass, motion_by_pushes(body), motion_of_substep(body));
    }

    // What the contacts with other figures do to these; those of the same two bodies stand together.
    void add_neighbours() {
        const std::uint32_t own = figure_of(parts_[0]);
        Move move;
        std::uint32_t a = UINT32_MAX;
        std::uint32_t other = UINT32_MAX;
        const auto finish = [&] {
            if (a != UINT32_MAX) {
                const std::uint32_t neighbour = scene_.figures[a] == own ? other : a;
                const Body& body = scene_.bodies[neighbour];
                add_products(neighbour, mass_of(body), motion_of_move(body, move), motion_of_substep(body));
            }
        };
        for_each(Part::contact, [&](std::uint32_t i) {
            const Contact& contact = scene_.contacts[i];
            const ContactKey& key = contact.key;
            if (key.other >= other_is_collider || !scene_.bodies[key.other].is_awake() ||
                !scene_.bodies[key.body_a].is_awake() ||
                scene_.figures[key.body_a] == scene_.figures[key.other]) {
                return;
            }
            if (key.body_a != a || key.other != other) {
                finish();
                a = key.body_a;
                other = key.other;
                move = {};
            }
            add_pushes(contact, scene_.figures[key.body_a] != own, move);
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
                                         mass_of(body));
    }

    RigidScene& scene_;
    const std::uint64_t* parts_;
    Kinds kinds_;
    const InverseMass& heaviest_;
    Int128 g_{0, 0};
    Int128 q_{0, 0};
    std::uint64_t mass_ = 0; // 30 fraction bits
};

} // namespace

void find_figures(RigidScene& scene) {
    BodyRoots roots(scene, scene.figures);
    roots.join_by_joints();
    scene.figure_parts.clear();
    const auto add = [&](std::uint32_t body, Part kind, std::size_t index) {
        if (scene.bodies[body].is_awake()) {
            scene.figure_parts.push_reserved(name_part(roots.root(body), kind, index));
        }
    };
    for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
        scene.figures[i] = roots.root(i);
        if (scene.body_slots[i].used) {
            add(i, Part::body, i);
        }
    }
    for (std::size_t i = 0; i < scene.joints.size(); ++i) {
        if (scene.joint_slots[i].used) {
            const JointDescription& joint = scene.joints[i].description;
            add(scene.bodies[joint.body_a].is_awake() ? joint.body_a : joint.body_b, Part::joint, i);
        }
    }
    for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
        const ContactKey& key = scene.contacts[i].key;
        add(key.body_a, Part::contact, i);
        if (key.other < other_is_collider &&
            (roots.root(key.other) != roots.root(key.body_a) || !scene.bodies[key.body_a].is_awake())) {
            add(key.other, Part::contact, i);
        }
    }
    for (std::size_t i = 0; i < scene.attachments.size(); ++i) {
        const AttachmentDescription& d = scene.attachments[i].description;
        if (scene.attachment_slots[i].used && d.kind == LKS_ATTACHMENT_TO_BODY) {
            add(d.other, Part::attachment, i);
        }
    }
    std::sort(scene.figure_parts.begin(), scene.figure_parts.end());
}

bool scale_carried_pushes(RigidScene& scene, const MotionRate& rate, std::int64_t least_speed) {
    const std::int64_t least_motion =
        std::min(least_speed / rate.substeps_per_second >> (world_fraction_bits - motion_fraction_bits),
                 greatest_motion);
    const Array<std::uint64_t>& parts = scene.figure_parts;
    bool any = false;
    std::size_t end = 0;
    for (std::size_t begin = 0; begin < parts.size(); begin = end) {
        bool pushed = false;
        for (end = begin; end < parts.size() && figure_of(parts[end]) == figure_of(parts[begin]); ++end) {
            pushed = pushed || kind_of(parts[end]) == Part::joint || kind_of(parts[end]) == Part::contact;
        }
        if (!pushed) {
            continue;
        }
        Figure figure(scene, &parts[begin], end - begin);
        const std::int32_t share = figure.share_to_add(least_motion);
        if (share != 0) {
            figure.add(share);
            any = true;
        }
    }
    return any;
}

} // namespace lks
