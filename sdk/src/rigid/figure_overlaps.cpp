#include "rigid/figure_overlaps.h"

#include <algorithm>
#include <bit>

#include "rigid/contact_search.h"

namespace lks {
namespace {

using fixed::Vec3;

// Overlaps up to this are left to the contacts: a millimetre.
constexpr std::int64_t left_to_contacts = world_one / 1000;
// Of the rest so much is undone in a tick, at 7 cm/s at most: what is lifted faster than that falls back as
// fast, and a heap goes on falling into the ground and being lifted out of it.
constexpr std::int64_t share_a_tick = 3; // the third part
constexpr std::int64_t gentle_lift = (std::int64_t{7} << world_fraction_bits) / 100;
// Pairs that want opposite things meet between them: each asks for less by a quarter of what it has pushed.
constexpr std::int64_t firmness = 4;
// In longer substeps than these what gives way comes to lie deep: there nobody does, at 0.4 m/s at most.
constexpr std::uint64_t gentle_rate = 400;
constexpr std::int64_t firm_lift = (std::int64_t{2} << world_fraction_bits) / 5;
constexpr int sweeps = 4; // forward and back

// All masses together: 1/m divided by how many times m they are, 30 fraction bits, at least one.
InverseMass divide_mass(const InverseMass& mass, std::uint64_t times) {
    const int zeros = std::countl_zero(times);
    const std::uint64_t quotient = (std::uint64_t{mass.mantissa} << 32) / (times << zeros >> 32);
    const int down = quotient >> 32 != 0 ? 1 : 0;
    return {static_cast<std::uint32_t>(quotient >> down), mass.exponent + zeros - 34 + down};
}

class Parting {
public:
    Parting(RigidScene& scene, const StepRate& rate)
        : scene_(scene), gentle_(rate.substeps_per_second >= gentle_rate),
          most_((gentle_ ? gentle_lift : firm_lift) / rate.ticks_per_second) {}

    void run() {
        if (!any_overlaps()) {
            return;
        }
        weigh_figures();
        gather();
        Array<FigurePair>& pairs = scene_.figure_pairs;
        for (int i = 0; i < sweeps; ++i) {
            for (std::size_t k = 0; k < pairs.size(); ++k) {
                part(pairs[k]);
            }
            for (std::size_t k = pairs.size(); k-- > 0;) {
                part(pairs[k]);
            }
        }
        for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
            Body& body = scene_.bodies[i];
            if (body.is_awake()) {
                body.position = body.position + scene_.figure_shifts[scene_.figures[i]].shift;
            }
        }
    }

private:
    bool is_jointed(const Contact& contact) const {
        const ContactKey& key = contact.key;
        return scene_.bodies[key.body_a].jointed ||
               (key.other < other_is_collider && scene_.bodies[key.other].jointed);
    }

    bool any_overlaps() const {
        return std::any_of(scene_.contacts.begin(), scene_.contacts.end(), [this](const Contact& contact) {
            return is_jointed(contact) && is_deeper(contact, left_to_contacts);
        });
    }

    // What sleeps, what hangs on something kinematic and what is tied to something stays where it is.
    void weigh_figures() {
        Array<FigureShift>& shifts = scene_.figure_shifts;
        const Array<Body>& bodies = scene_.bodies;
        shifts.clear();
        static_cast<void>(shifts.resize(bodies.size() + 1)); // within its room; colliders have the last one
        std::fill(shifts.begin(), shifts.end(), FigureShift{});
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            InverseMass& heaviest = shifts[scene_.figures[i]].inverse_mass;
            if (bodies[i].is_awake() &&
                (heaviest.mantissa == 0 || heavier(bodies[i].inverse_mass, heaviest))) {
                heaviest = bodies[i].inverse_mass;
            }
        }
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            if (bodies[i].is_awake()) {
                FigureShift& figure = shifts[scene_.figures[i]];
                figure.masses +=
                    static_cast<std::uint64_t>(pair_shares(figure.inverse_mass, bodies[i].inverse_mass).a);
            }
        }
        for (FigureShift& figure : shifts) {
            if (figure.masses != 0) {
                figure.inverse_mass = divide_mass(figure.inverse_mass, figure.masses);
            }
        }
        const auto hold = [&](std::uint32_t body) { shifts[scene_.figures[body]].inverse_mass = {0, 0}; };
        for (std::size_t i = 0; i < scene_.joints.size(); ++i) {
            const JointDescription& joint = scene_.joints[i].description;
            if (scene_.joint_slots[i].used &&
                (!bodies[joint.body_a].is_dynamic() || !bodies[joint.body_b].is_dynamic())) {
                hold(joint.body_a);
                hold(joint.body_b);
            }
        }
        for (std::size_t i = 0; i < scene_.attachments.size(); ++i) {
            const AttachmentDescription& d = scene_.attachments[i].description;
            if (scene_.attachment_slots[i].used && d.kind == LKS_ATTACHMENT_TO_BODY) {
                hold(d.other);
            }
        }
    }

    void gather() {
        const auto nobody = static_cast<std::uint32_t>(scene_.bodies.size());
        scene_.figure_pairs.clear();
        for (const Contact& contact : scene_.contacts) {
            const ContactKey& key = contact.key;
            FigurePair pair{};
            pair.a = scene_.figures[key.body_a];
            pair.b = key.other < other_is_collider ? scene_.figures[key.other] : nobody;
            pair.shares = pair_shares(scene_.figure_shifts[pair.a].inverse_mass,
                                      scene_.figure_shifts[pair.b].inverse_mass);
            if (pair.a != pair.b && (pair.shares.a != 0 || pair.shares.b != 0) &&
                wanted(contact, pair.parted)) {
                pair.normal = contact.normal();
                scene_.figure_pairs.push_reserved(pair);
            }
        }
    }

    // How far they have to part, or, less than nothing, may close. False: nothing is near.
    bool wanted(const Contact& contact, std::int64_t& parted) const {
        const bool jointed = is_jointed(contact);
        bool any = false;
        for (std::uint32_t i = 0; i < contact.count; ++i) {
            const ContactPoint& point = contact.points[i];
            if (!point.active) {
                continue;
            }
            const std::int64_t own =
                jointed && point.separation < -left_to_contacts
                    ? std::min(-(point.separation + left_to_contacts) / share_a_tick, most_)
                    : -std::max<std::int64_t>(point.separation, 0);
            parted = any ? std::max(parted, own) : own;
            any = true;
        }
        return any;
    }

    // What it is to push more; less where others have made its push needless.
    std::int64_t push_for(const FigurePair& pair, std::int64_t missing) const {
        if (!gentle_) {
            return std::max<std::int64_t>(missing, 0);
        }
        const std::int64_t wanted =
            pair.parted > 0 ? (firmness * missing - pair.pushed) / (firmness + 1) : missing;
        return std::max(wanted, -pair.pushed);
    }

    void part(FigurePair& pair) {
        FigureShift& a = scene_.figure_shifts[pair.a];
        FigureShift& b = scene_.figure_shifts[pair.b];
        const std::int64_t missing = pair.parted - fixed::dot(pair.normal, b.shift - a.shift);
        const std::int64_t push = push_for(pair, missing);
        if (push == 0) {
            return;
        }
        pair.pushed += push;
        const std::int64_t weight = std::int64_t{pair.shares.a} + pair.shares.b;
        const auto along = [&](std::int32_t share) {
            return fixed::scale(pair.normal, fixed::multiply_divide(push, share, weight));
        };
        a.shift = a.shift - along(pair.shares.a);
        b.shift = b.shift + along(pair.shares.b);
    }

    RigidScene& scene_;
    bool gentle_;
    std::int64_t most_;
};

} // namespace

void part_figures(RigidScene& scene, const StepRate& rate) {
    Parting(scene, rate).run();
}

} // namespace lks
