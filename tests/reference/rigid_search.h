// Where bodies of the rigid reference solver touch: once a tick, with room for the tick's motion, and in each
// substep what is fast or sticks in the other (sdk/src/rigid/contact_search.cpp, shape_touch.cpp).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "reference/rigid_contact.h"
#include "reference/rigid_meeting.h"

namespace reference {

template <typename Scalar>
class ContactSearch {
public:
    using Vec = Vector3<Scalar>;
    using Body = MovingBody<Scalar>;
    using Contact = BodyContact<Scalar>;
    using Point = ContactPoint<Scalar>;

    explicit ContactSearch(const RigidModel& model) : model_(model) {}

    void add(const RigidCollider& collider) { model_.colliders.push_back(collider); }

    // `bodies`: the model's, and its colliders behind them. In ascending order of pairs of bodies and of
    // their shapes; those that pushed in the tick before go on with it.
    std::vector<Contact> find(const std::vector<Body>& bodies, Scalar tick_rate, Scalar substep_rate,
                              const std::vector<Contact>& before) const {
        std::vector<Contact> found;
        std::size_t next = 0; // of those before
        for (std::size_t a = 0; a < model_.bodies.size(); ++a) {
            for (std::size_t b = a + 1; b < bodies.size(); ++b) {
                if (!may_touch(a, b)) {
                    continue;
                }
                for (std::size_t shape_a = 0; shape_a < shape_count(a); ++shape_a) {
                    for (std::size_t shape_b = 0; shape_b < shape_count(b); ++shape_b) {
                        Contact contact;
                        contact.a = a;
                        contact.b = b;
                        contact.shape_a = shape_a;
                        contact.shape_b = shape_b;
                        while (next < before.size() && before[next].key() < contact.key()) {
                            ++next;
                        }
                        const bool known = next < before.size() && before[next].key() == contact.key();
                        if (touches(contact, bodies, tick_rate, substep_rate,
                                    known ? &before[next] : nullptr)) {
                            found.push_back(std::move(contact));
                        }
                    }
                }
            }
        }
        return found;
    }

    // At the beginning of a substep: where its bodies are now, with what it pushed before.
    void look_again(Contact& contact, const std::vector<Body>& bodies, Scalar substep_rate) const {
        find_points(contact, bodies, substep_rate, contact.points.empty() ? Vec{} : contact.normal);
    }

private:
    bool is_collider(std::size_t b) const { return b >= model_.bodies.size(); }
    const RigidCollider& collider(std::size_t b) const { return model_.colliders[b - model_.bodies.size()]; }
    std::size_t shape_count(std::size_t i) const {
        return is_collider(i) ? 1 : model_.bodies[i].shapes.size();
    }

    bool may_touch(std::size_t a, std::size_t b) const {
        const RigidBody& body = model_.bodies[a];
        if (is_collider(b)) {
            return body.touches_colliders && body.mass > 0;
        }
        const RigidBody& other = model_.bodies[b];
        const auto holds = [&](const RigidJoint& joint) {
            return (joint.a == a && joint.b == b) || (joint.a == b && joint.b == a);
        };
        return body.touches_bodies && other.touches_bodies && (body.mass > 0 || other.mass > 0) &&
               std::none_of(model_.joints.begin(), model_.joints.end(), holds);
    }

    // Two figures part the shorter way.
    static bool keeps_side(const Body& a, const Body& b) { return !a.jointed || !b.jointed; }

    // Whether what they do on their way counts: joints turn the ways of two bones, and draw what is fast.
    static bool follows_way(const Body& a, const Body& b, bool fast) {
        return fast ? !a.jointed && !b.jointed : keeps_side(a, b);
    }

    // False: not in this tick.
    bool touches(Contact& contact, const std::vector<Body>& bodies, Scalar tick_rate, Scalar substep_rate,
                 const Contact* before) const {
        const Body& body_a = bodies[contact.a];
        const Body& body_b = bodies[contact.b];
        const Scalar turning =
            turned_in_tick(contact.a, bodies, tick_rate) + turned_in_tick(contact.b, bodies, tick_rate);
        const Scalar motion = sum(body_b.velocity - body_a.velocity) / tick_rate + turning;
        const Piece<Scalar> piece_a = piece_of(contact.a, contact.shape_a, body_a, body_a.position);
        const Piece<Scalar> piece_b = piece_of(contact.b, contact.shape_b, body_b, body_a.position);
        const bool keeps = keeps_side(body_a, body_b);
        // Where they may be turned to by what they hit on their way.
        const Scalar aside = keeps ? (motion - turning) / 4 : 0;
        const Vec way = (body_b.velocity - body_a.velocity) * (1 / tick_rate);
        if (pass_by(piece_a, piece_b, way, turning + aside)) {
            return false;
        }
        const bool fast = motion > thickness(piece_a) + thickness(piece_b);
        Manifold<Scalar> manifold =
            Meeting<Scalar>(piece_a, piece_b, follows_way(body_a, body_b, fast) ? way : Vec{}, motion + near,
                            {})
                .found();
        // Boxes beside each other show no points, and may yet meet at their edges.
        const bool unclear = fast && manifold.points.empty();
        // Of the motion only what closes the gap counts.
        const Scalar closing =
            std::max(Scalar(0), -manifold.normal.dot(body_b.velocity - body_a.velocity) / tick_rate);
        std::erase_if(manifold.points, [&](const ManifoldPoint<Scalar>& point) {
            return point.separation > near + closing + turning;
        });
        if (manifold.points.empty() && !unclear) {
            return false;
        }
        contact.fast = fast;
        contact.jointed = body_a.jointed || body_b.jointed;
        contact.radius_a = piece_a.radius;
        contact.radius_b = piece_b.radius;
        set_surface(contact);
        const std::vector<Point> old = before != nullptr ? before->memory(keeps) : std::vector<Point>{};
        const Vec side = keeps && !old.empty() ? before->normal : Vec{};
        const bool passed = is_against(manifold.normal, side);
        const auto sticks = [](const ManifoldPoint<Scalar>& point) {
            return point.separation < -Contact::sticking_depth;
        };
        contact.every_substep = fast || passed ||
                                std::any_of(manifold.points.begin(), manifold.points.end(), sticks) ||
                                (keeps && normal_turns(piece_a, piece_b, manifold, way, contact.jointed));
        contact.take_manifold(manifold, body_a, body_b, old);
        if (passed) {
            find_points(contact, bodies, substep_rate, side);
        }
        return true;
    }

    static bool is_round(const Piece<Scalar>& piece) {
        return piece.kind == LKS_SHAPE_SPHERE || piece.kind == LKS_SHAPE_CAPSULE;
    }
    // Of round surfaces by more than a 64th in this tick unless joints hold them, of what is about to meet a
    // box by more than a 16th.
    template <typename Found>
    static bool normal_turns(const Piece<Scalar>& a, const Piece<Scalar>& b, const Found& manifold,
                             const Vec& way, bool jointed) {
        if (b.kind == LKS_SHAPE_PLANE) {
            return false;
        }
        const Scalar aside = sum(way - manifold.normal * manifold.normal.dot(way));
        if (is_round(a) && is_round(b)) {
            return !jointed && aside > (a.radius + b.radius) / 64;
        }
        Scalar gap = std::numeric_limits<Scalar>::max();
        for (const auto& point : manifold.points) {
            gap = std::min(gap, point.separation);
        }
        return !manifold.points.empty() && gap > Scalar(0.001) && aside > (a.radius + b.radius + gap) / 16;
    }

    void find_points(Contact& contact, const std::vector<Body>& bodies, Scalar substep_rate,
                     const Vec& side) const {
        const Body& a = bodies[contact.a];
        const Body& b = bodies[contact.b];
        const Piece<Scalar> piece_a = piece_of(contact.a, contact.shape_a, a, a.position);
        const Piece<Scalar> piece_b = piece_of(contact.b, contact.shape_b, b, a.position);
        const Scalar turning =
            turning_speed(contact.a, bodies) +
            (is_collider(contact.b) ? sum(b.spin) * reach(piece_b) : turning_speed(contact.b, bodies));
        const Scalar margin = (sum(a.velocity) + sum(b.velocity) + turning) / substep_rate + near;
        Manifold<Scalar> manifold(margin, 0);
        manifold.normal = contact.normal;
        const Scalar aside = keeps_side(a, b) ? sum(b.velocity - a.velocity) / 4 : 0;
        const Vec way = (b.velocity - a.velocity) * (1 / substep_rate);
        if (!pass_by(piece_a, piece_b, way, (turning + aside) / substep_rate)) {
            manifold = Meeting<Scalar>(piece_a, piece_b, follows_way(a, b, contact.fast) ? way : Vec{},
                                       margin, keeps_side(a, b) ? side : Vec{})
                           .found();
        }
        contact.take_manifold(manifold, a, b, std::vector<Point>(contact.points));
    }

    void set_surface(Contact& contact) const {
        const RigidSurface& from = model_.bodies[contact.a].surface;
        const RigidSurface& other =
            is_collider(contact.b) ? collider(contact.b).surface : model_.bodies[contact.b].surface;
        const auto mean = [](double p, double q) { return static_cast<Scalar>(std::sqrt(p * q)); };
        contact.static_friction = mean(from.static_friction, other.static_friction);
        contact.dynamic_friction = mean(from.dynamic_friction, other.dynamic_friction);
        contact.restitution = static_cast<Scalar>(std::max(from.restitution, other.restitution));
    }

    // Relative to a place.
    Piece<Scalar> piece_of(std::size_t i, std::size_t number, const Body& body, const Vec& place) const {
        const RigidShape& shape = is_collider(i) ? collider(i).shape : model_.bodies[i].shapes[number];
        const bool turned = !(shape.orientation == Rotation{});
        Piece<Scalar> piece{shape.kind,
                            static_cast<Scalar>(shape.radius),
                            static_cast<Scalar>(shape.half_length),
                            Vec(shape.half_extents),
                            body.position - place + body.rotation * Vec(shape.position),
                            turned ? body.rotation * quaternion_of<Scalar>(shape.orientation).matrix()
                                   : body.rotation};
        if (shape.kind == LKS_SHAPE_PLANE) {
            // Its nearest point.
            const Vec up = piece.axes.column(1);
            piece.centre = up * up.dot(piece.centre);
        }
        return piece;
    }

    static Scalar reach(const Piece<Scalar>& piece) {
        return piece.radius + piece.half_length + sum(piece.half_extents);
    }
    // Half its size along the axes of the world.
    static Vec extent(const Piece<Scalar>& piece) {
        const Vec half = piece.half_extents + Vec{0, piece.half_length, 0};
        const Vec along[3] = {piece.axes.column(0) * half.x, piece.axes.column(1) * half.y,
                              piece.axes.column(2) * half.z};
        return {piece.radius + std::abs(along[0].x) + std::abs(along[1].x) + std::abs(along[2].x),
                piece.radius + std::abs(along[0].y) + std::abs(along[1].y) + std::abs(along[2].y),
                piece.radius + std::abs(along[0].z) + std::abs(along[1].z) + std::abs(along[2].z)};
    }
    // Outside of each other along an axis of the world while b goes this way, and both turn by so much.
    static bool pass_by(const Piece<Scalar>& a, const Piece<Scalar>& b, const Vec& way, Scalar turning) {
        if (b.kind == LKS_SHAPE_PLANE) {
            return false;
        }
        const Vec between = b.centre - a.centre;
        const Vec room = extent(a) + extent(b);
        const auto outside = [&](Scalar begin, Scalar change, Scalar half) {
            const Scalar end = begin + change;
            const Scalar most = half + turning + near;
            return std::min(begin, end) > most || std::max(begin, end) < -most;
        };
        return outside(between.x, way.x, room.x) || outside(between.y, way.y, room.y) ||
               outside(between.z, way.z, room.z);
    }

    static Scalar sum(const Vec& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

    // Of a body's farthest point.
    Scalar turning_speed(std::size_t i, const std::vector<Body>& bodies) const {
        return sum(bodies[i].spin) * static_cast<Scalar>(model_.bodies[i].radius);
    }
    // How far it takes that in a tick; a collider that turns, by a quarter at most.
    Scalar turned_in_tick(std::size_t i, const std::vector<Body>& bodies, Scalar tick_rate) const {
        if (!is_collider(i)) {
            return turning_speed(i, bodies) / tick_rate;
        }
        if (bodies[i].orientation == bodies[i].target_orientation) {
            return 0;
        }
        const RigidShape& shape = collider(i).shape;
        return 2 * static_cast<Scalar>(shape.kind == LKS_SHAPE_PLANE ? 64 : radius_of(shape));
    }

    static constexpr Scalar near = Scalar(0.02);

    RigidModel model_;
};

} // namespace reference
