// Contacts of the rigid reference solver. The same rows in the same order as sdk/src/rigid/contact.h.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

#include "reference/rigid_body.h"
#include "reference/rigid_manifold.h"

namespace reference {

template <typename Scalar>
struct ContactPoint {
    using Vec = Vector3<Scalar>;

    std::uint32_t feature = 0;
    Vec core_a, core_b; // in the frames of the bodies
    // kg·m: carried from substep to substep.
    Scalar push = 0;
    std::array<Scalar, 2> rub{};
    Vec rubbed; // the same in the world
    // Of the substep.
    Vec material_a, material_b; // of the surfaces, in the frames of the bodies
    Vec start, core_start;      // b's against a's at its beginning
    Scalar separation = 0;
    Scalar allowed = 0; // how far the surfaces may close; less than nothing: have to part
    Scalar approach = 0;
    bool active = false;
    PushRow<Scalar> along;
    std::array<PushRow<Scalar>, 2> across;
    // Of an iteration: how far the surfaces have parted, less what was open, and how far they have slid.
    Scalar gap = 0;
    std::array<Scalar, 2> slip{};
};

template <typename Scalar>
class BodyContact {
public:
    using Vec = Vector3<Scalar>;
    using Body = MovingBody<Scalar>;
    using Point = ContactPoint<Scalar>;
    using Move = BodyMove<Scalar>;

    std::size_t a = 0, b = 0; // bodies, colliders behind them
    std::size_t shape_a = 0, shape_b = 0;
    Scalar radius_a = 0, radius_b = 0;
    Scalar static_friction = 0, dynamic_friction = 0, restitution = 0;
    bool fast = false;          // one may pass the middle of the other in a tick
    bool jointed = false;       // joints hold one of the bodies
    bool every_substep = false; // its points are looked for in each, not once a tick
    Vec normal;                 // from a to b
    std::vector<Point> points;

    auto key() const { return std::tuple(a, b, shape_a, shape_b); }
    bool pushes() const {
        return std::any_of(points.begin(), points.end(),
                           [](const Point& point) { return point.active && point.push != 0; });
    }
    bool is_of_same_bodies(const BodyContact& other) const { return a == other.a && b == other.b; }

    // `manifold` is relative to a's centre of mass.
    void take_manifold(const Manifold<Scalar>& manifold, const Body& body_a, const Body& body_b,
                       const std::vector<Point>& old) {
        normal = manifold.normal;
        span();
        points.clear();
        for (const ManifoldPoint<Scalar>& from : manifold.points) {
            Point point;
            point.feature = from.feature;
            point.core_a = body_a.rotation.back(from.core_a);
            point.core_b = body_b.rotation.back(from.core_b - (body_b.position - body_a.position));
            points.push_back(point);
        }
        take_pushes(old);
    }
    // Of its points, those that count in the next tick: what pushed, and what sticks in the other.
    std::vector<Point> memory(bool keeps_side) const {
        std::vector<Point> kept;
        for (const Point& point : points) {
            if (point.push != 0 || (keeps_side && point.separation < -sticking_depth)) {
                kept.push_back(point);
            }
        }
        return kept;
    }
    static constexpr Scalar sticking_depth = Scalar(0.005);

    void begin(const Body& body_a, const Body& body_b, Scalar rate) {
        span();
        for (Point& point : points) {
            const Levers levers = levers_now(point, body_a, body_b);
            point.material_a = body_a.rotation.back(levers.a);
            point.material_b = body_b.rotation.back(levers.b);
            point.start = apart(body_a, point.material_a, body_b, point.material_b);
            point.core_start = apart(body_a, point.core_a, body_b, point.core_b);
            point.separation = normal.dot(body_b.position - body_a.position + levers.b - levers.a);
            point.allowed = allowed_motion(point.separation, rate);
            point.approach = closing_speed(levers, body_a, body_b);
            point.active = false;
        }
    }

    // An impact of single points, before the prediction. True where there was one.
    bool strike(Body& body_a, Body& body_b, Scalar least_approach, Scalar rate) {
        if (restitution == 0 || points.size() != 1) {
            return false;
        }
        const Levers levers = levers_now(points[0], body_a, body_b);
        const Scalar approach = closing_speed(levers, body_a, body_b);
        if (approach <= least_approach || points[0].separation > approach / rate) {
            return false;
        }
        const PushRow<Scalar> row(normal, body_a, levers.a, body_b, levers.b);
        const Scalar impulse = row.push_for(approach * (1 + restitution));
        row.accelerate(impulse, body_a, body_b);
        rub_at_once(levers, impulse, body_a, body_b);
        return true;
    }

    void make_rows(const Body& body_a, const Body& body_b) {
        Levers sum;
        active_count_ = 0;
        for (Point& point : points) {
            point.active = point.push != 0 || gap_now(point, body_a, body_b) < Scalar(0.01);
            if (!point.active) {
                point.push = 0;
                set_rub(point, {});
                continue;
            }
            const Levers levers = levers_now(point, body_a, body_b);
            sum = {sum.a + levers.a, sum.b + levers.b};
            ++active_count_;
            point.along = PushRow<Scalar>(normal, body_a, levers.a, body_b, levers.b);
            for (std::size_t t = 0; t < 2; ++t) {
                point.across[t] = PushRow<Scalar>(across_[t], body_a, levers.a, body_b, levers.b);
            }
        }
        if (active_count_ > 1) {
            const Scalar share = 1 / static_cast<Scalar>(active_count_);
            middle_ = PushRow<Scalar>(normal, body_a, sum.a * share, body_b, sum.b * share);
        }
    }

    // What its pushes do to one of its bodies.
    void add_pushes(bool to_a, Move& move) const {
        for (const Point& point : points) {
            if (point.active && point.push != 0) {
                add_rows(point, 1, to_a, move);
            }
        }
    }

    void carry_more(Body& body_a, Body& body_b, Scalar share) {
        Move to_a, to_b;
        for (Point& point : points) {
            if (point.active && point.push != 0) {
                add_rows(point, share, true, to_a);
                add_rows(point, share, false, to_b);
                point.push += point.push * share;
                set_rub(point, {point.rub[0] * (1 + share), point.rub[1] * (1 + share)});
            }
        }
        to_a.apply_to(body_a);
        to_b.apply_to(body_b);
    }

    // Before the sweeps of an iteration, in which bodies stay where they are.
    void measure(const Body& body_a, const Body& body_b) {
        middle_gap_ = 0;
        for (Point& point : points) {
            if (point.active) {
                point.gap = gap_now(point, body_a, body_b);
                middle_gap_ += point.gap / static_cast<Scalar>(active_count_);
                const Vec slid = apart(body_a, point.material_a, body_b, point.material_b) - point.start;
                point.slip = {across_[0].dot(slid), across_[1].dot(slid)};
            }
        }
    }

    // `to_a`, `to_b`: what contacts have done to the bodies in these sweeps. What slips further than
    // `slow_slip` slides.
    void project(Move& to_a, Move& to_b, bool back, Scalar slow_slip) {
        if (active_count_ > 1) {
            push_middle(to_a, to_b);
        }
        for (std::size_t k = 0; k < points.size(); ++k) {
            Point& point = points[back ? points.size() - 1 - k : k];
            if (!point.active) {
                continue;
            }
            const Scalar gap = point.gap + point.along.parted(to_a, to_b);
            const Scalar wanted = std::max(point.push - point.along.push_for(gap), Scalar(0));
            point.along.add(wanted - point.push, to_a, to_b);
            point.push = wanted;
            if (wanted != 0 || point.rub[0] != 0 || point.rub[1] != 0) {
                rub(point, to_a, to_b, slow_slip);
            }
        }
    }

    // Whether an impact that gives back speed is due in this substep.
    bool is_about_to_strike(const Body& body_a, const Body& body_b, Scalar least_approach,
                            Scalar rate) const {
        return restitution != 0 && std::any_of(points.begin(), points.end(), [&](const Point& point) {
                   const Scalar approach = closing_speed(levers_now(point, body_a, body_b), body_a, body_b);
                   return approach > least_approach && point.separation <= approach / rate;
               });
    }

    // Once velocities are known, of all contacts: each point that has struck parts as restitution has it, and
    // no point that pushed pulls.
    void begin_impact(const Body& body_a, const Body& body_b, Scalar least_approach, Scalar rate) {
        owed_.clear();
        std::size_t struck_count = 0;
        for (Point& point : points) {
            if (restitution == 0 || !point.active) {
                continue;
            }
            const Levers levers = levers_at_prediction(point, body_a, body_b);
            const bool struck = point.push != 0 && point.approach > least_approach;
            const Scalar before = closing(levers, body_a.predicted_velocity, body_a.predicted_spin,
                                          body_b.predicted_velocity, body_b.predicted_spin);
            const Scalar parting = struck ? before * restitution : -closing_speed(levers, body_a, body_b);
            owed_.push_back({&point, levers, struck, parting, -point.push * rate, 0});
            struck_count += struck ? 1 : 0;
        }
        all_struck_ = struck_count == owed_.size();
        if (struck_count == 0) {
            owed_.clear();
        }
    }
    // What all owe alike is given at their middle first.
    void give_alike(Body& body_a, Body& body_b) {
        if (all_struck_ && owed_.size() > 1) {
            give_alike(owed_, body_a, body_b);
        }
    }
    bool give_each(Body& body_a, Body& body_b) { return give_each(owed_, body_a, body_b); }
    void rub_by_impact(Body& body_a, Body& body_b) const {
        for (const Owed& one : owed_) {
            if (one.given > 0) {
                rub_at_once(one.levers, one.given, body_a, body_b);
            }
        }
    }

    // Overlaps beyond half a millimetre, or a centimetre of jointed bodies: a quarter a substep, at most
    // three metres a second.
    void undo_overlap(Body& body_a, Body& body_b, Scalar rate) const {
        const Scalar allowed = jointed ? Scalar(0.01) : allowed_overlap;
        Move to_a, to_b;
        bool any = false;
        for (const Point& point : points) {
            if (point.active && point.separation < -allowed) {
                const Scalar depth = std::min((-point.separation - allowed) / 4, 3 / rate);
                point.along.add(point.along.push_for(depth), to_a, to_b);
                any = true;
            }
        }
        if (any) {
            to_a.apply_to(body_a);
            to_b.apply_to(body_b);
            body_a.settle();
            body_b.settle();
        }
    }

    // How far figures have to part at the end of a tick, or, less than nothing, may close: a third of what
    // goes beyond a millimetre. False: nothing is near.
    bool wants_apart(Scalar most, Scalar& apart) const {
        bool any = false;
        for (const Point& point : points) {
            if (point.active) {
                const Scalar beyond = -point.separation - Scalar(0.001);
                const Scalar own = jointed && beyond > 0 ? std::min(beyond / 3, most)
                                                         : std::min(-point.separation, Scalar(0));
                apart = any ? std::max(apart, own) : own;
                any = true;
            }
        }
        return any;
    }

private:
    // From the centres of mass to where the surfaces meet, in world axes.
    struct Levers {
        Vec a, b;
    };

    // What restitution wants of a point: how fast it is to part, and the impulse it may be given at least and
    // has been given.
    struct Owed {
        const Point* point;
        Levers levers;
        bool struck;
        Scalar parting, least, given;
    };

    void give_alike(std::vector<Owed>& owed, Body& body_a, Body& body_b) const {
        Scalar sum = 0;
        for (const Owed& one : owed) {
            sum += one.parting + closing_speed(one.levers, body_a, body_b);
        }
        const auto count = static_cast<Scalar>(owed.size());
        if (sum > 0) {
            const Scalar impulse = middle_.push_for(sum / count);
            middle_.accelerate(impulse, body_a, body_b);
            for (Owed& one : owed) {
                one.given = impulse / count;
            }
        }
    }
    // Whether another round is worth it.
    bool give_each(std::vector<Owed>& owed, Body& body_a, Body& body_b) const {
        bool more = false;
        for (Owed& one : owed) {
            const Scalar speed = one.parting + closing_speed(one.levers, body_a, body_b);
            const Scalar wanted = std::max(one.given + one.point->along.push_for(speed), one.least);
            const Scalar impulse = (one.struck ? wanted : std::min(wanted, Scalar(0))) - one.given;
            if (impulse != 0) {
                one.point->along.accelerate(impulse, body_a, body_b);
                one.given += impulse;
                more = more || std::abs(speed) > Scalar(0x1p-14);
            }
        }
        return more;
    }

    Levers levers_at_prediction(const Point& point, const Body& body_a, const Body& body_b) const {
        return levers_at(point, body_a.predicted_orientation.matrix(), body_b.predicted_orientation.matrix());
    }
    Scalar closing(const Levers& levers, const Vec& velocity_a, const Vec& spin_a, const Vec& velocity_b,
                   const Vec& spin_b) const {
        return -normal.dot(velocity_b + cross(spin_b, levers.b) - velocity_a - cross(spin_a, levers.a));
    }

    static constexpr Scalar allowed_overlap = Scalar(0.0005);

    // Beyond that jointed bodies have to part: by fifteen times that a second, at most a thirty-second at
    // once and 0.4 m/s.
    Scalar allowed_motion(Scalar separation, Scalar rate) const {
        const Scalar depth = -separation - allowed_overlap;
        return depth <= 0 || !jointed ? std::max(separation, Scalar(0))
                                      : -std::min({depth / 32, depth * 15 / rate, Scalar(0.4) / rate});
    }

    // Points take over old pushes: of the same feature, or else of the nearest one that is left.
    void take_pushes(std::vector<Point> old) {
        std::vector<bool> known;
        for (Point& point : points) {
            const auto same = [&](const Point& p) { return p.feature == point.feature; };
            known.push_back(take(old, std::find_if(old.begin(), old.end(), same), point));
        }
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!known[i]) {
                take_nearest(old, points[i]);
            }
        }
    }
    bool take(std::vector<Point>& old, typename std::vector<Point>::iterator from, Point& to) const {
        if (from == old.end()) {
            return false;
        }
        to.push = from->push;
        set_rub(to, {across_[0].dot(from->rubbed), across_[1].dot(from->rubbed)});
        *from = old.back();
        old.pop_back();
        return true;
    }
    void take_nearest(std::vector<Point>& old, Point& to) const {
        const auto distance = [&](const Point& p) {
            const Vec d = p.core_a - to.core_a;
            return std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
        };
        const auto nearest = std::min_element(old.begin(), old.end(), [&](const Point& p, const Point& q) {
            return distance(p) < distance(q);
        });
        if (nearest != old.end() && distance(*nearest) < Scalar(0.1)) {
            take(old, nearest, to);
        }
    }

    void set_rub(Point& point, const std::array<Scalar, 2>& rub) const {
        point.rub = rub;
        point.rubbed = across_[0] * rub[0] + across_[1] * rub[1];
    }

    // Two directions across the normal, and across each other.
    void span() {
        across_[0] = some_across(normal);
        across_[1] = cross(normal, across_[0]);
    }

    Levers levers_now(const Point& point, const Body& body_a, const Body& body_b) const {
        return levers_at(point, body_a.rotation, body_b.rotation);
    }
    Levers levers_at(const Point& point, const Matrix<Scalar>& turned_a,
                     const Matrix<Scalar>& turned_b) const {
        return {turned_a * point.core_a + normal * radius_a, turned_b * point.core_b - normal * radius_b};
    }
    static Vec apart(const Body& body_a, const Vec& on_a, const Body& body_b, const Vec& on_b) {
        return body_b.position - body_a.position + body_b.rotation * on_b - body_a.rotation * on_a;
    }
    Scalar gap_now(const Point& point, const Body& body_a, const Body& body_b) const {
        const Vec motion = apart(body_a, point.core_a, body_b, point.core_b) - point.core_start;
        return normal.dot(motion) + point.allowed;
    }
    Scalar closing_speed(const Levers& levers, const Body& body_a, const Body& body_b) const {
        return closing(levers, body_a.velocity, body_a.spin, body_b.velocity, body_b.spin);
    }

    void add_rows(const Point& point, Scalar share, bool to_a, Move& move) const {
        point.along.add(point.push * share, to_a, move);
        point.across[0].add(point.rub[0] * share, to_a, move);
        point.across[1].add(point.rub[1] * share, to_a, move);
    }

    // What all points need alike, at their middle.
    void push_middle(Move& to_a, Move& to_b) {
        Scalar least = std::numeric_limits<Scalar>::max();
        for (const Point& point : points) {
            least = point.active ? std::min(least, point.push) : least;
        }
        const Scalar n = static_cast<Scalar>(active_count_);
        const Scalar gap = middle_gap_ + middle_.parted(to_a, to_b);
        const Scalar more = std::max(-middle_.push_for(gap) / n, -least);
        for (Point& point : points) {
            point.push += point.active ? more : 0;
        }
        middle_.add(n * more, to_a, to_b);
    }

    // Friction of an impulse along the normal: against the way that it slips.
    void rub_at_once(const Levers& levers, Scalar normal_impulse, Body& body_a, Body& body_b) const {
        const Vec relative =
            body_b.velocity + cross(body_b.spin, levers.b) - body_a.velocity - cross(body_a.spin, levers.a);
        const Vec slip = relative - normal * normal.dot(relative);
        const Scalar speed = slip.length();
        if (speed == 0) {
            return;
        }
        const PushRow<Scalar> row(slip * (1 / speed), body_a, levers.a, body_b, levers.b);
        row.accelerate(-std::min(row.push_for(speed), normal_impulse * dynamic_friction), body_a, body_b);
    }

    // The push in the circle that is nearest to the wanted one, weighed by the rows' weights: what still
    // slips slips against it (sdk/src/rigid/contact_sweep.cpp).
    static std::array<Scalar, 2> in_circle(const std::array<Scalar, 2>& inverse, std::array<Scalar, 2> wanted,
                                           Scalar size, Scalar most) {
        const std::size_t heavy = inverse[0] <= inverse[1] ? 0 : 1;
        const std::size_t light = 1 - heavy;
        const Scalar q = inverse[heavy] / inverse[light];
        if (q < Scalar(63) / 64) {
            const Scalar a = most / size;
            const auto part = [&](Scalar t) {
                std::array<Scalar, 2> p;
                p[heavy] = wanted[heavy] * (a * q + t);
                p[light] = wanted[light] * q * (a + t);
                return p;
            };
            const auto reach = [&](Scalar t) {
                return (a + t) * (a * q + t) * size / std::hypot(part(t)[0], part(t)[1]);
            };
            const Scalar low = (1 - a) * q;
            const Scalar high = 1 - a;
            const Scalar least = reach(low);
            const Scalar greatest = reach(high);
            const Scalar share =
                greatest > least ? std::clamp((1 - least) / (greatest - least), Scalar(0), Scalar(1)) : 0;
            wanted = part(low + (high - low) * share);
        }
        const Scalar length = std::hypot(wanted[0], wanted[1]);
        return length > 0 ? std::array<Scalar, 2>{wanted[0] * most / length, wanted[1] * most / length}
                          : std::array<Scalar, 2>{};
    }

    // Coulomb's cone: both directions across at once.
    void rub(Point& point, Move& to_a, Move& to_b, Scalar slow_slip) {
        std::array<Scalar, 2> wanted;
        for (std::size_t i = 0; i < 2; ++i) {
            const Scalar slip = point.slip[i] + point.across[i].parted(to_a, to_b);
            wanted[i] = point.rub[i] - point.across[i].push_for(slip);
        }
        const bool slides = std::hypot(point.slip[0], point.slip[1]) > slow_slip;
        const Scalar most = point.push * (slides ? dynamic_friction : static_friction);
        const Scalar size = std::hypot(wanted[0], wanted[1]);
        if (size > most) {
            wanted =
                in_circle({point.across[0].push_for(1), point.across[1].push_for(1)}, wanted, size, most);
        }
        for (std::size_t i = 0; i < 2; ++i) {
            point.across[i].add(wanted[i] - point.rub[i], to_a, to_b);
        }
        set_rub(point, wanted);
    }

    std::vector<Owed> owed_; // of an impact
    bool all_struck_ = false;
    std::array<Vec, 2> across_;
    PushRow<Scalar> middle_;
    Scalar middle_gap_ = 0;
    int active_count_ = 0;
};

} // namespace reference
