#include "rigid/contact.h"

#include <algorithm>

#include "collide/saturation.h"
#include "fixed/formats.h"
#include "rigid/contact_points.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::Vec3;

// Overlaps up to this stay: half a millimetre.
constexpr std::int64_t allowed_overlap = world_one / 2000;
// Of jointed bodies, what is deeper than this is undone without speed: a centimetre.
constexpr std::int64_t deep_overlap = world_one / 100;
// How fast the rest parts at most: 0.4 m/s.
constexpr std::int64_t greatest_parting = (std::int64_t{2} << world_fraction_bits) / 5;

// n, and two directions across it and across each other.
void span(const Direction& n, Direction (&directions)[3]) {
    fixed::NormalisedVector way{};
    fixed::normalise(fixed::some_across(n), way);
    directions[normal_row] = n;
    directions[1] = way.direction;
    const Vec3 second = fixed::cross(n, way.direction);
    const auto part = [](std::int64_t c) {
        return static_cast<std::int32_t>(
            std::clamp<std::int64_t>(fixed::shift_right_rounded(c, 30), -direction_one, direction_one));
    };
    directions[2] = {part(second.x), part(second.y), part(second.z)};
}

// Nobody normalises behind it. What does not move may be others' too, at the same time.
void undo(Body& body, const Move& move, std::int32_t share) {
    if (share != 0) {
        apply(body, move);
        body.orientation = normalise(body.orientation);
        body.follow_orientation();
    }
}

// What the points of a contact pushed before, to be handed on.
class OldPushes {
public:
    explicit OldPushes(std::span<const ContactPush> pushes)
        : count_(static_cast<std::uint32_t>(pushes.size())) {
        std::copy(pushes.begin(), pushes.end(), pushes_);
    }

    // What rubbed across one normal rubs along these directions now.
    void follow(const Direction& normal, const Direction (&directions)[3]) {
        Direction before[3];
        span(normal, before);
        for (std::uint32_t i = 0; i < count_; ++i) {
            std::int64_t(&across)[2] = pushes_[i].across;
            const Vec3 rubbed = fixed::scale(before[1], across[0]) + fixed::scale(before[2], across[1]);
            across[0] = fixed::dot(directions[1], rubbed);
            across[1] = fixed::dot(directions[2], rubbed);
        }
    }

    bool take_feature(std::uint32_t feature, ContactPush& to) {
        for (std::uint32_t i = 0; i < count_; ++i) {
            if (pushes_[i].feature == feature) {
                take(i, to);
                return true;
            }
        }
        return false;
    }

    void take_nearest(ContactPush& to) {
        constexpr std::int64_t near = world_one / 10;
        std::uint32_t best = count_;
        std::int64_t least = near;
        for (std::uint32_t i = 0; i < count_; ++i) {
            const std::int64_t distance = sum_of_magnitudes(pushes_[i].place - to.place);
            if (distance < least) {
                least = distance;
                best = i;
            }
        }
        if (best < count_) {
            take(best, to);
        }
    }

private:
    void take(std::uint32_t i, ContactPush& to) {
        to.normal = pushes_[i].normal;
        to.across[0] = pushes_[i].across[0];
        to.across[1] = pushes_[i].across[1];
        pushes_[i] = pushes_[--count_];
    }

    ContactPush pushes_[greatest_point_count];
    std::uint32_t count_;
};

} // namespace

// Less than nothing: they have to part, by fifteen times what is to be undone a second, at most a
// thirty-second of it at once.
std::int64_t allowed_motion(std::int64_t separation, bool jointed, const MotionRate& rate) {
    if (separation >= -allowed_overlap || !jointed) {
        return std::max<std::int64_t>(separation, 0);
    }
    constexpr std::int64_t deepest = 32 * greatest_parting; // from here on all three are at their most
    const std::int64_t depth = std::min(-(separation + allowed_overlap), deepest);
    const std::int64_t n = rate.substeps_per_second;
    return -std::min({depth / 32, depth * 15 / n, greatest_parting / n});
}

std::uint32_t combined_friction(std::int64_t a, std::int64_t b) {
    const std::uint64_t root = // World
        a == b ? fixed::magnitude(a)
               : fixed::square_root(fixed::multiply_unsigned(fixed::magnitude(a), fixed::magnitude(b)));
    return static_cast<std::uint32_t>(
        fixed::shift_right_rounded(root, world_fraction_bits - friction_fraction_bits));
}

void take_manifold(Contact& contact, const OldContact& old_contact, const Manifold& manifold, const Body& a,
                   const Body& b) {
    OldPushes old(old_contact.pushes);
    contact.count = manifold.count;
    span(manifold.normal, contact.directions);
    if (!old_contact.pushes.empty() && !(old_contact.normal == manifold.normal)) {
        old.follow(old_contact.normal, contact.directions);
    }
    bool known[greatest_point_count];
    for (std::uint32_t i = 0; i < manifold.count; ++i) {
        const ManifoldPoint& from = manifold.points[i];
        ContactPoint& to = contact.points[i];
        // Manifolds are relative to a's centre of mass.
        to.core_a = fixed::rotate_transposed(a.rotation, from.core_a);
        to.core_b = fixed::rotate_transposed(b.rotation, from.core_b - (b.position - a.position));
        to.push = {from.feature, 0, to.core_a, 0, {0, 0}};
        known[i] = old.take_feature(from.feature, to.push);
    }
    for (std::uint32_t i = 0; i < manifold.count; ++i) {
        if (!known[i]) {
            old.take_nearest(contact.points[i].push);
        }
    }
}

void begin_substep(Contact& contact, const Body& a, const Body& b, const MotionRate& rate) {
    const Vec3 between = b.position - a.position;
    const bool jointed = a.jointed || b.jointed;
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        ContactPoint& point = contact.points[i];
        const Levers cores = cores_now(point, a, b);
        const Levers levers = surfaces_of(contact, cores);
        point.material_a = fixed::rotate_transposed(a.rotation, levers.a);
        point.material_b = fixed::rotate_transposed(b.rotation, levers.b);
        point.start = distance_now(a, point.material_a, b, point.material_b);
        point.core_start = between + cores.b - cores.a;
        point.separation = fixed::dot(contact.normal(), between + levers.b - levers.a);
        point.approach = contact.restitution == 0 ? 0 : closing_speed(contact, levers, a, b);
        begin_point(point, jointed, rate);
    }
}

void add_up_pushes(Contact& contact, const MotionRate& rate) {
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        if (contact.points[i].active) {
            contact.given_speed = fixed::saturating_add(
                contact.given_speed,
                fixed::multiply_shift(contact.points[i].push.normal, rate.substeps_per_second, 0));
        }
    }
}

std::int64_t speed_to_come(const Contact& contact, const ContactBodies& bodies) {
    Vec3 a{0, 0, 0};
    Vec3 b{0, 0, 0};
    const ContactRows* rows = &contact.middle;
    std::int64_t count = 0;
    bool pushes = false;
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        const ContactPoint& point = contact.points[i];
        if (point.active) {
            const Levers levers = surfaces_of(contact, cores_now(point, bodies.a, bodies.b));
            a = a + levers.a;
            b = b + levers.b;
            rows = count == 0 ? &point.rows : &contact.middle;
            pushes = pushes || point.push.normal != 0;
            ++count;
        }
    }
    if (!pushes) {
        return 0;
    }
    const auto share = [count](const Vec3& v) { return Vec3{v.x / count, v.y / count, v.z / count}; };
    const std::int64_t closing = closing_speed(contact, {share(a), share(b)}, bodies.a, bodies.b);
    return closing > 0 ? divide(closing, rows->inverses[normal_row]) : 0;
}

void undo_overlap(const Contact& contact, ContactBodies bodies, const MotionRate& rate) {
    // At most three metres a second, and a quarter of what is left.
    const std::int64_t most = LKS_FIXED(3) / rate.substeps_per_second;
    const std::int64_t left = bodies.a.jointed || bodies.b.jointed ? deep_overlap : allowed_overlap;
    Move move_a;
    Move move_b;
    bool any = false;
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        const ContactPoint& point = contact.points[i];
        if (!point.active || point.separation >= -left) {
            continue;
        }
        const std::int64_t depth = std::min((-point.separation - left) / 4, most);
        const std::int64_t p = divide(depth, point.rows.inverses[normal_row]);
        const Vec3 along = fixed::scale(contact.normal(), p);
        const auto add = [&](Move& move, const ContactRowSide& side, std::int32_t share, int sign) {
            add_push(move, side.rows[normal_row], share, side.turn_shift, along, p, sign);
        };
        add(move_a, point.rows.a, contact.shares.a, -1);
        add(move_b, point.rows.b, contact.shares.b, 1);
        any = true;
    }
    if (any) {
        undo(bodies.a, move_a, contact.shares.a);
        undo(bodies.b, move_b, contact.shares.b);
    }
}

bool is_deeper(const Contact& contact, std::int64_t depth) {
    return std::any_of(contact.points, contact.points + contact.count, [depth](const ContactPoint& point) {
        return point.active && point.separation < -depth;
    });
}

} // namespace lks
