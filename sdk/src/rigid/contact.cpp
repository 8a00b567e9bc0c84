#include "rigid/contact.h"

#include <algorithm>

#include "collide/saturation.h"
#include "kernels/bounded.h"
#include "rigid/contact_points.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::Vec3;

// Overlaps up to this stay: half a millimetre.
constexpr std::int64_t allowed_overlap = (std::int64_t{1} << world_fraction_bits) / 2000;
// Of jointed bodies, what is deeper than this is undone without speed: a centimetre.
constexpr std::int64_t deep_overlap = (std::int64_t{1} << world_fraction_bits) / 100;
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

// By an impulse along the normal.
void accelerate(const Contact& contact, const ContactRows& rows, std::int64_t p,
                const ContactBodies& bodies) {
    accelerate(bodies.a, rows.a.rows[normal_row], contact.shares.a, rows.a.turn_shift, contact.normal(), p,
               -1);
    accelerate(bodies.b, rows.b.rows[normal_row], contact.shares.b, rows.b.turn_shift, contact.normal(), p,
               1);
}

// Nobody normalises behind it. What does not move may be others' too, at the same time.
void undo(Body& body, const Move& move, std::int32_t share) {
    if (share != 0) {
        apply(body, move);
        body.orientation = normalise(body.orientation);
    }
}

std::int64_t closing_speed(const Contact& contact, const Levers& levers, const ContactSpeeds& speeds) {
    return -fixed::dot(contact.normal(), velocity_at(speeds.b, levers.b) - velocity_at(speeds.a, levers.a));
}

std::int64_t closing_speed(const Contact& contact, const Levers& levers, const Body& a, const Body& b) {
    return closing_speed(contact, levers, {a.speeds(), b.speeds()});
}

bool has_struck(const ContactPoint& point, std::int64_t least_approach) {
    return point.active && point.push.normal != 0 && point.approach > least_approach;
}

// Gives back speed at a contact's points, so that each of them parts as restitution wants it to where it
// pushes, and pushes nothing where it parts faster: what it pushed may be taken back, no more. So the work of
// all of them is what of it restitution does not give back.
class Restoring {
public:
    Restoring(Contact& contact, const ContactBodies& bodies, const ContactSpeeds& predicted,
              std::int64_t least_approach, std::int64_t substeps_per_second)
        : contact_(contact), bodies_(bodies) {
        const fixed::Matrix3 turned_a = fixed::to_matrix(narrow(bodies.a.predicted_orientation));
        const fixed::Matrix3 turned_b = fixed::to_matrix(narrow(bodies.b.predicted_orientation));
        for (std::uint32_t i = 0; i < contact.count; ++i) {
            const ContactPoint& point = contact.points[i];
            if (!point.active) {
                continue;
            }
            const bool struck = has_struck(point, least_approach);
            struck_count_ += struck ? 1u : 0u;
            // Where it was when its rows were made: only so does what is given back do as much work as what
            // was taken.
            const Levers levers = surfaces_of(
                contact, {fixed::rotate(turned_a, point.core_a), fixed::rotate(turned_b, point.core_b)});
            const std::int64_t parting =
                struck ? fixed::multiply_shift(closing_speed(contact, levers, predicted), contact.restitution,
                                               world_fraction_bits)
                       : -closing_speed(contact, levers, now());
            points_[count_++] = {
                i, struck, levers, parting, -fixed::multiply_shift(point.push.normal, substeps_per_second, 0),
                0};
        }
    }

    bool any_struck() const { return struck_count_ > 0; }

    void run() {
        // What all points owe alike is given at their middle: one after the other they turn what comes down
        // flat.
        if (struck_count_ > 1 && struck_count_ == count_) {
            give_alike();
        }
        constexpr int most_rounds = 16;
        for (int round = 0; round < most_rounds && give_each(); ++round) {}
    }

private:
    struct Point {
        std::uint32_t index;
        bool struck;
        Levers levers;
        std::int64_t parting; // World m/s: how fast it is to part
        std::int64_t least;   // what it may be given: less than nothing where it has pushed
        std::int64_t given;
    };

    ContactSpeeds now() const { return {bodies_.a.speeds(), bodies_.b.speeds()}; }

    std::int64_t owed(const Point& point) const {
        return point.parting + closing_speed(contact_, point.levers, now());
    }

    void give_alike() {
        std::int64_t sum = 0;
        for (std::uint32_t i = 0; i < count_; ++i) {
            sum += owed(points_[i]);
        }
        const std::int64_t speed = sum / static_cast<std::int64_t>(count_);
        if (speed > 0) {
            const std::int64_t p = divide(speed, contact_.middle.inverses[normal_row]);
            accelerate(contact_, contact_.middle, p, bodies_);
            for (std::uint32_t i = 0; i < count_; ++i) {
                points_[i].given = p / count_;
            }
            contact_.given_speed = fixed::saturating_add(contact_.given_speed, p);
        }
    }

    // Whether anybody was given anything that is worth another round.
    bool give_each() {
        constexpr std::int64_t little = std::int64_t{1} << (world_fraction_bits - 14);
        constexpr std::int64_t most_given = std::int64_t{1} << 60;
        bool more = false;
        for (std::uint32_t i = 0; i < count_; ++i) {
            Point& point = points_[i];
            const ContactRows& rows = contact_.points[point.index].rows;
            const std::int64_t speed = owed(point);
            const std::int64_t wanted =
                fixed::saturating_add(point.given, divide(speed, rows.inverses[normal_row]));
            const std::int64_t most = point.struck ? most_given : 0;
            const std::int64_t p = std::clamp(wanted, point.least, most) - point.given;
            if (p != 0) {
                accelerate(contact_, rows, p, bodies_);
                point.given += p;
                contact_.given_speed = fixed::saturating_add(contact_.given_speed, p);
                more = more || !within(speed, little);
            }
        }
        return more;
    }

    Contact& contact_;
    const ContactBodies& bodies_;
    Point points_[greatest_point_count];
    std::uint32_t count_ = 0;
    std::uint32_t struck_count_ = 0;
};

// What the points of a contact pushed before, to be handed on.
class OldPushes {
public:
    explicit OldPushes(std::span<const ContactPush> pushes)
        : count_(static_cast<std::uint32_t>(pushes.size())) {
        std::copy(pushes.begin(), pushes.end(), pushes_);
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
    return static_cast<std::uint32_t>(fixed::shift_right_rounded(root, world_fraction_bits - 18));
}

void take_manifold(Contact& contact, std::span<const ContactPush> old_pushes, const Manifold& manifold,
                   const Body& a, const Body& b) {
    OldPushes old(old_pushes);
    contact.count = manifold.count;
    span(manifold.normal, contact.directions);
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

bool strike(Contact& contact, ContactBodies bodies, std::int64_t least_approach, const MotionRate& rate) {
    if (contact.restitution == 0 || contact.count != 1) {
        return false;
    }
    const ContactPoint& point = contact.points[0];
    const Levers levers = surfaces_of(contact, cores_now(point, bodies.a, bodies.b));
    const std::int64_t approach = closing_speed(contact, levers, bodies.a, bodies.b);
    if (approach <= least_approach || point.separation > approach / rate.substeps_per_second) {
        return false;
    }
    ContactRows rows;
    fill_rows(contact, bodies, levers, 1, rows);
    const std::int64_t back = fixed::multiply_shift(approach, contact.restitution, world_fraction_bits);
    const std::int64_t p = divide(approach + back, rows.inverses[normal_row]);
    contact.given_speed = fixed::saturating_add(contact.given_speed, p);
    accelerate(contact, rows, p, bodies);
    return true;
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

void restore_speed(Contact& contact, ContactBodies bodies, const ContactSpeeds& predicted,
                   std::int64_t least_approach, const MotionRate& rate) {
    if (contact.restitution == 0) {
        return;
    }
    Restoring restoring(contact, bodies, predicted, least_approach, rate.substeps_per_second);
    if (restoring.any_struck()) {
        restoring.run();
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
