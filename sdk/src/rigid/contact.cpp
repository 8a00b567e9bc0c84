#include "rigid/contact.h"

#include <algorithm>

#include "collide/saturation.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::Vec3;

// Overlaps up to this stay: half a millimetre.
constexpr std::int64_t allowed_overlap = (std::int64_t{1} << world_fraction_bits) / 2000;
// Beyond a push of a quarter of a metre friction grows no more.
constexpr std::int64_t greatest_gripping_push = std::int64_t{1} << (world_fraction_bits - 2);

Vec3 cross(const Vec3& spin, const Vec3& lever) {
    // World · World, spins to 22 bits behind the point and levers to 24; a collider's lever may be very long.
    const auto m = [](std::int64_t a, std::int64_t b) {
        return fixed::saturate_to_int64(fixed::multiply_signed(a >> 18, b >> 16) >> 6);
    };
    return {m(spin.y, lever.z) - m(spin.z, lever.y), m(spin.z, lever.x) - m(spin.x, lever.z),
            m(spin.x, lever.y) - m(spin.y, lever.x)};
}

Vec3 velocity_at(const Body& body, const Vec3& lever) {
    return body.velocity + cross(body.angular_velocity, lever);
}

// Two directions across n, and across each other.
void span(const Direction& n, Direction (&across)[2]) {
    fixed::NormalisedVector way{};
    fixed::normalise(fixed::some_across(n), way);
    across[0] = way.direction;
    const Vec3 second = fixed::cross(n, across[0]);
    const auto part = [](std::int64_t c) {
        return static_cast<std::int32_t>(
            std::clamp<std::int64_t>(fixed::shift_right_rounded(c, 30), -direction_one, direction_one));
    };
    across[1] = {part(second.x), part(second.y), part(second.z)};
}

// From a point of a to a point of b, in world axes.
Vec3 distance_now(const Body& a, const Vec3& on_a, const Body& b, const Vec3& on_b) {
    return (b.position - a.position) + fixed::rotate(b.rotation, on_b) - fixed::rotate(a.rotation, on_a);
}

// How much the surfaces have parted along the normal in this substep, less what was open at its beginning.
// Round surfaces part as their cores do, however they turn.
std::int64_t gap_now(const Contact& contact, const ContactPoint& point, const Body& a, const Body& b) {
    const Vec3 motion = distance_now(a, point.core_a, b, point.core_b) - point.core_start;
    return fixed::dot(contact.normal, motion) + std::max<std::int64_t>(point.separation, 0);
}

Inverse make_row(const ContactBodies& bodies, const PairShares& shares, const Direction& direction,
                 const Vec3& lever_a, const Vec3& lever_b, RowSide& side_a, RowSide& side_b) {
    std::int64_t weight = 0;
    side_a = push_side(bodies.a, shares.a, direction, lever_a, weight);
    side_b = push_side(bodies.b, shares.b, direction, lever_b, weight);
    return invert(weight);
}

// Pushes along rows' directions, b forward and a back, applied together.
class Pushes {
public:
    void add(const RowSide& a, const RowSide& b, const Direction& direction, std::int64_t p) {
        if (p != 0) {
            const Vec3 along = fixed::scale(direction, p);
            add_push(a_, a, along, p, -1);
            add_push(b_, b, along, p, 1);
        }
    }
    // What does not move may be others' too, at the same time.
    void apply_to(ContactBodies bodies) const {
        if (bodies.a.is_awake()) {
            apply(bodies.a, a_);
        }
        if (bodies.b.is_awake()) {
            apply(bodies.b, b_);
        }
    }

private:
    Move a_;
    Move b_;
};

// Calls use(side of a, side of b, direction, push) for what a point pushes in all three directions.
template <typename Use>
void for_each_row(const Contact& contact, const ContactPoint& point, const ContactPush& push,
                  const Use& use) {
    if (push.normal != 0) {
        use(point.normal_a, point.normal_b, contact.normal, push.normal);
        use(point.across_a[0], point.across_b[0], contact.across[0], push.across[0]);
        use(point.across_a[1], point.across_b[1], contact.across[1], push.across[1]);
    }
}

std::int64_t grip(std::int64_t push, std::uint32_t friction) {
    return (std::min(push, greatest_gripping_push) * std::int64_t{friction}) >> 18;
}

// What the points of a contact pushed before, to be handed on.
class OldPushes {
public:
    void add(const ContactPush& push) { pushes_[count_++] = push; }

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
        constexpr std::int64_t near = (std::int64_t{1} << world_fraction_bits) / 10;
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
    std::uint32_t count_ = 0;
};

// Both rows across the normal at once, within the circle that the normal's push allows.
void project_friction(Contact& contact, ContactPoint& point, ContactBodies bodies) {
    const Vec3 motion = distance_now(bodies.a, point.material_a, bodies.b, point.material_b) - point.start;
    std::int64_t wanted[2];
    for (int i = 0; i < 2; ++i) {
        wanted[i] =
            point.push.across[i] - divide(fixed::dot(contact.across[i], motion), point.across_inverse[i]);
    }
    const std::int64_t most = grip(point.push.normal, contact.static_friction);
    fixed::NormalisedVector size{};
    if (fixed::normalise(Vec3{wanted[0], wanted[1], 0}, size) && size.length > most) {
        const std::int64_t sliding = grip(point.push.normal, contact.dynamic_friction);
        wanted[0] = fixed::scale_component(size.direction.x, sliding);
        wanted[1] = fixed::scale_component(size.direction.y, sliding);
    }
    Pushes pushes;
    for (int i = 0; i < 2; ++i) {
        const std::int64_t more = wanted[i] - point.push.across[i];
        point.push.across[i] = wanted[i];
        pushes.add(point.across_a[i], point.across_b[i], contact.across[i], more);
    }
    pushes.apply_to(bodies);
}

// Where the surfaces meet now, from each centre of mass in world axes. A round surface has turned away under
// that place: the material point there at the beginning would give the push an arm that it hasn't got.
struct Levers {
    Vec3 a, b;
};

Levers levers_now(const Contact& contact, const ContactPoint& point, const Body& a, const Body& b) {
    return {fixed::rotate(a.rotation, point.core_a) + fixed::scale(contact.normal, contact.radius_a),
            fixed::rotate(b.rotation, point.core_b) - fixed::scale(contact.normal, contact.radius_b)};
}

// What all points need alike: one after the other they would turn a body that only has to be lifted.
void project_middle(Contact& contact, ContactBodies bodies) {
    std::int64_t sum = 0;
    std::int64_t least = greatest_push;
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        const ContactPoint& point = contact.points[i];
        if (point.active) {
            sum += gap_now(contact, point, bodies.a, bodies.b);
            least = std::min(least, point.push.normal);
        }
    }
    const auto n = static_cast<std::int64_t>(contact.active_count);
    const std::int64_t wanted = -divide(sum / n, contact.middle_inverse) / n;
    const std::int64_t more = std::clamp<std::int64_t>(wanted, -least, greatest_push);
    if (more == 0) {
        return;
    }
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        ContactPoint& point = contact.points[i];
        if (point.active) {
            point.push.normal = std::min(point.push.normal + more, greatest_push);
        }
    }
    Pushes pushes;
    pushes.add(contact.middle_a, contact.middle_b, contact.normal, n * more);
    pushes.apply_to(bodies);
}

} // namespace

std::uint32_t combined_friction(std::int64_t a, std::int64_t b) {
    const std::uint64_t root = // World
        a == b ? fixed::magnitude(a)
               : fixed::square_root(fixed::multiply_unsigned(fixed::magnitude(a), fixed::magnitude(b)));
    return static_cast<std::uint32_t>(fixed::shift_right_rounded(root, world_fraction_bits - 18));
}

void take_manifold(Contact& contact, const Manifold& manifold, const Body& a, const Body& b) {
    OldPushes old;
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        old.add(contact.points[i].push);
    }
    contact.normal = manifold.normal;
    contact.count = manifold.count;
    span(contact.normal, contact.across);
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

void begin_substep(Contact& contact, const Body& a, const Body& b) {
    const Vec3 between = b.position - a.position;
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        ContactPoint& point = contact.points[i];
        const Levers levers = levers_now(contact, point, a, b);
        point.material_a = fixed::rotate_transposed(a.rotation, levers.a);
        point.material_b = fixed::rotate_transposed(b.rotation, levers.b);
        point.start = distance_now(a, point.material_a, b, point.material_b);
        point.core_start = distance_now(a, point.core_a, b, point.core_b);
        point.separation = fixed::dot(contact.normal, between + levers.b - levers.a);
        point.approach =
            contact.restitution == 0
                ? 0
                : -fixed::dot(contact.normal, velocity_at(b, levers.b) - velocity_at(a, levers.a));
        point.active = false;
    }
}

bool strike(Contact& contact, ContactBodies bodies, std::int64_t least_approach, const MotionRate& rate) {
    if (contact.restitution == 0 || contact.count != 1) {
        return false;
    }
    const ContactPoint& point = contact.points[0];
    const Levers levers = levers_now(contact, point, bodies.a, bodies.b);
    const std::int64_t approach =
        -fixed::dot(contact.normal, velocity_at(bodies.b, levers.b) - velocity_at(bodies.a, levers.a));
    if (approach <= least_approach || point.separation > approach / rate.substeps_per_second) {
        return false;
    }
    RowSide side_a{};
    RowSide side_b{};
    const Inverse inverse =
        make_row(bodies, contact.shares, contact.normal, levers.a, levers.b, side_a, side_b);
    const std::int64_t back = fixed::multiply_shift(approach, contact.restitution, world_fraction_bits);
    const std::int64_t p = divide(approach + back, inverse);
    contact.given_speed = fixed::saturating_add(contact.given_speed, p);
    accelerate(bodies.a, side_a, contact.normal, p, -1);
    accelerate(bodies.b, side_b, contact.normal, p, 1);
    return true;
}

void make_rows(Contact& contact, ContactBodies bodies) {
    Levers middle{{0, 0, 0}, {0, 0, 0}};
    contact.active_count = 0;
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        ContactPoint& point = contact.points[i];
        const std::int64_t gap = gap_now(contact, point, bodies.a, bodies.b);
        // Another body may still push them together: what is further away than that is not looked at.
        constexpr std::int64_t near = (std::int64_t{1} << world_fraction_bits) / 100;
        point.active = point.push.normal != 0 || gap < near;
        if (!point.active) {
            point.push = {point.push.feature, 0, point.push.place, 0, {0, 0}};
            continue;
        }
        const Levers levers = levers_now(contact, point, bodies.a, bodies.b);
        middle = {middle.a + levers.a, middle.b + levers.b};
        ++contact.active_count;
        point.normal_inverse = make_row(bodies, contact.shares, contact.normal, levers.a, levers.b,
                                        point.normal_a, point.normal_b);
        for (int t = 0; t < 2; ++t) {
            point.across_inverse[t] = make_row(bodies, contact.shares, contact.across[t], levers.a, levers.b,
                                               point.across_a[t], point.across_b[t]);
        }
    }
    const auto n = static_cast<std::int64_t>(contact.active_count);
    if (n > 1) {
        const auto share = [n](const Vec3& v) { return Vec3{v.x / n, v.y / n, v.z / n}; };
        contact.middle_inverse = make_row(bodies, contact.shares, contact.normal, share(middle.a),
                                          share(middle.b), contact.middle_a, contact.middle_b);
    }
}

void push_again(const Contact& contact, Body& body, bool is_a) {
    if (body.is_awake()) {
        Move move;
        add_pushes(contact, is_a, move);
        apply(body, move);
    }
}

void add_pushes(const Contact& contact, bool to_a, Move& move) {
    const int sign = to_a ? -1 : 1;
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        const ContactPoint& point = contact.points[i];
        if (!point.active) {
            continue;
        }
        for_each_row(contact, point, point.push,
                     [&](const RowSide& a, const RowSide& b, const Direction& direction, std::int64_t p) {
                         if (p != 0) {
                             add_push(move, to_a ? a : b, fixed::scale(direction, p), p, sign);
                         }
                     });
    }
}

void carry_more(Contact& contact, ContactBodies bodies, std::int32_t share) {
    Pushes pushes;
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        ContactPoint& point = contact.points[i];
        if (!point.active || point.push.normal == 0) {
            continue;
        }
        ContactPush more = point.push;
        const auto take = [share](std::int64_t& total, std::int64_t& part) {
            part = fixed::scale_component(share, part);
            total += part;
        };
        take(point.push.normal, more.normal);
        take(point.push.across[0], more.across[0]);
        take(point.push.across[1], more.across[1]);
        for_each_row(contact, point, more,
                     [&](const RowSide& a, const RowSide& b, const Direction& direction, std::int64_t p) {
                         pushes.add(a, b, direction, p);
                     });
    }
    pushes.apply_to(bodies);
}

void project(Contact& contact, ContactBodies bodies, bool back) {
    if (contact.active_count > 1) {
        project_middle(contact, bodies);
    }
    for (std::uint32_t k = 0; k < contact.count; ++k) {
        const std::uint32_t i = back ? contact.count - 1 - k : k;
        ContactPoint& point = contact.points[i];
        if (!point.active) {
            continue;
        }
        const std::int64_t gap = gap_now(contact, point, bodies.a, bodies.b);
        const std::int64_t wanted =
            std::clamp<std::int64_t>(point.push.normal - divide(gap, point.normal_inverse), 0, greatest_push);
        const std::int64_t more = wanted - point.push.normal;
        point.push.normal = wanted;
        if (more != 0) {
            Pushes pushes;
            pushes.add(point.normal_a, point.normal_b, contact.normal, more);
            pushes.apply_to(bodies);
        }
        if (wanted != 0 || point.push.across[0] != 0 || point.push.across[1] != 0) {
            project_friction(contact, point, bodies);
        }
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

void restore_speed(const Contact& contact, ContactBodies bodies, std::int64_t least_approach) {
    if (contact.restitution == 0) {
        return;
    }
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        const ContactPoint& point = contact.points[i];
        if (!point.active || point.push.normal == 0 || point.approach <= least_approach) {
            continue;
        }
        const Levers levers = levers_now(contact, point, bodies.a, bodies.b);
        const Vec3 apart = velocity_at(bodies.b, levers.b) - velocity_at(bodies.a, levers.a);
        const std::int64_t wanted =
            fixed::multiply_shift(point.approach, contact.restitution, world_fraction_bits);
        const std::int64_t missing = wanted - fixed::dot(contact.normal, apart);
        if (missing > 0) {
            const std::int64_t p = divide(missing, point.normal_inverse);
            accelerate(bodies.a, point.normal_a, contact.normal, p, -1);
            accelerate(bodies.b, point.normal_b, contact.normal, p, 1);
        }
    }
}

void undo_overlap(const Contact& contact, ContactBodies bodies, const MotionRate& rate) {
    // At most three metres a second, and an eighth of what is left.
    const std::int64_t most = LKS_FIXED(3) / rate.substeps_per_second;
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        const ContactPoint& point = contact.points[i];
        if (point.active && point.separation < -allowed_overlap) {
            const std::int64_t depth = std::min((-point.separation - allowed_overlap) >> 3, most);
            Pushes pushes;
            pushes.add(point.normal_a, point.normal_b, contact.normal, divide(depth, point.normal_inverse));
            pushes.apply_to(bodies);
            // Nobody does so behind it.
            for (Body* body : {&bodies.a, &bodies.b}) {
                if (body->is_awake()) {
                    body->orientation = normalise(body->orientation);
                }
            }
        }
    }
}

} // namespace lks
