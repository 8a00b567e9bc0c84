// Where bodies of the rigid reference solver touch: spheres, capsules and boxes on planes, spheres on each
// other; once a tick, with room for the tick's motion.
#pragma once

#include <cmath>
#include <vector>

#include "reference/rigid_contact.h"

namespace reference {

template <typename Scalar>
class ContactSearch {
public:
    using Vec = Vector3<Scalar>;
    using Body = MovingBody<Scalar>;
    using Contact = BodyContact<Scalar>;
    using Point = ContactPoint<Scalar>;

    explicit ContactSearch(const RigidModel& model) : model_(model) {}

    // `bodies`: the model's, and its planes behind them. In ascending order of pairs; those that pushed in
    // the tick before go on with it.
    std::vector<Contact> find(const std::vector<Body>& bodies, Scalar tick_rate,
                              const std::vector<Contact>& before) const {
        std::vector<Contact> found;
        for (std::size_t a = 0; a < model_.bodies.size(); ++a) {
            for (std::size_t b = a + 1; b < bodies.size(); ++b) {
                if (may_touch(a, b)) {
                    Contact contact = touch(a, b, bodies);
                    drop_what_stays_apart(contact, bodies, tick_rate);
                    if (!contact.points.empty()) {
                        contact.take_pushes(pushes_of(before, a, b));
                        found.push_back(contact);
                    }
                }
            }
        }
        return found;
    }

private:
    bool is_plane(std::size_t b) const { return b >= model_.bodies.size(); }

    bool may_touch(std::size_t a, std::size_t b) const {
        const RigidBody& body = model_.bodies[a];
        if (is_plane(b)) {
            return body.touches_planes && body.mass > 0;
        }
        const RigidBody& other = model_.bodies[b];
        return body.touches_bodies && other.touches_bodies && (body.mass > 0 || other.mass > 0);
    }

    static std::vector<Point> pushes_of(const std::vector<Contact>& before, std::size_t a, std::size_t b) {
        std::vector<Point> pushes;
        for (const Contact& contact : before) {
            for (const Point& point : contact.points) {
                if (contact.a == a && contact.b == b && point.push != 0) {
                    pushes.push_back(point);
                }
            }
        }
        return pushes;
    }

    Contact touch(std::size_t a, std::size_t b, const std::vector<Body>& bodies) const {
        const RigidBody& from = model_.bodies[a];
        const RigidSurface& other =
            is_plane(b) ? model_.planes[b - model_.bodies.size()].surface : model_.bodies[b].surface;
        Contact contact;
        contact.a = a;
        contact.b = b;
        const auto mean = [](double p, double q) { return static_cast<Scalar>(std::sqrt(p * q)); };
        contact.static_friction = mean(from.surface.static_friction, other.static_friction);
        contact.dynamic_friction = mean(from.surface.dynamic_friction, other.dynamic_friction);
        contact.restitution = static_cast<Scalar>(std::max(from.surface.restitution, other.restitution));
        contact.radius_a = static_cast<Scalar>(from.shape.radius);
        if (is_plane(b)) {
            touch_plane(contact, bodies[a], bodies[b]);
        } else {
            const Vec way = bodies[b].position - bodies[a].position;
            contact.radius_b = static_cast<Scalar>(model_.bodies[b].shape.radius);
            contact.normal = way * (1 / way.length());
            add(contact, {}, {}, 0);
        }
        return contact;
    }

    static void add(Contact& contact, const Vec& core_a, const Vec& core_b, std::uint32_t feature) {
        Point point;
        point.feature = feature;
        point.core_a = core_a;
        point.core_b = core_b;
        contact.points.push_back(point);
    }

    void touch_plane(Contact& contact, const Body& body, const Body& plane) const {
        const RigidShape& shape = model_.bodies[contact.a].shape;
        const Vec up = plane.rotation.column(1);
        contact.normal = up * Scalar(-1);
        const auto add_local = [&](const Vec& local, std::uint32_t feature) {
            const Vec point = body.position + body.rotation * local;
            const Vec below = point - up * up.dot(point - plane.position);
            add(contact, local, plane.rotation.back(below - plane.position), feature);
        };
        if (shape.kind != LKS_SHAPE_BOX) {
            const auto half = static_cast<Scalar>(shape.half_length);
            add_local({0, half, 0}, 0);
            if (half != 0) {
                add_local({0, -half, 0}, 1);
            }
            return;
        }
        // The corners of the face that looks most against the plane's normal.
        const Vec local_up = body.rotation.back(up);
        const Scalar parts[3] = {local_up.x, local_up.y, local_up.z};
        const Scalar extents[3] = {static_cast<Scalar>(shape.half_extents.x),
                                   static_cast<Scalar>(shape.half_extents.y),
                                   static_cast<Scalar>(shape.half_extents.z)};
        int face = 0;
        for (int i = 1; i < 3; ++i) {
            face = std::abs(parts[i]) > std::abs(parts[face]) ? i : face;
        }
        for (std::uint32_t corner = 0; corner < 4; ++corner) {
            const bool first = (corner & 1u) != 0;
            const bool second = (corner & 2u) != 0;
            bool positive[3];
            positive[face] = parts[face] < 0;
            positive[(face + 1) % 3] = first;
            positive[(face + 2) % 3] = second;
            const auto at = [&](int i) { return positive[i] ? extents[i] : -extents[i]; };
            const std::uint32_t feature =
                (positive[0] ? 1u : 0u) | (positive[1] ? 2u : 0u) | (positive[2] ? 4u : 0u);
            add_local({at(0), at(1), at(2)}, feature);
        }
    }

    // Of what may come to touch within the tick.
    void drop_what_stays_apart(Contact& contact, const std::vector<Body>& bodies, Scalar tick_rate) const {
        const Body& a = bodies[contact.a];
        const Body& b = bodies[contact.b];
        const auto sum = [](const Vec& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); };
        const auto turning = [&](std::size_t i) {
            return is_plane(i) ? Scalar(0) : sum(bodies[i].spin) * reach(model_.bodies[i].shape) / tick_rate;
        };
        const Scalar closing = std::max(Scalar(0), -contact.normal.dot(b.velocity - a.velocity) / tick_rate);
        const Scalar most = Scalar(0.02) + closing + turning(contact.a) + turning(contact.b);
        const auto stays_apart = [&](const Point& point) {
            const Vec way = b.position - a.position + b.rotation * point.core_b - a.rotation * point.core_a;
            return contact.normal.dot(way) - contact.radius_a - contact.radius_b > most;
        };
        std::erase_if(contact.points, stays_apart);
    }

    static Scalar reach(const RigidShape& shape) {
        const support::Vector& e = shape.half_extents;
        return static_cast<Scalar>(shape.kind == LKS_SHAPE_BOX ? e.length()
                                                               : shape.radius + shape.half_length);
    }

    RigidModel model_;
};

} // namespace reference
