// Figures that nothing outside pushes keep their angular momentum, and gain nothing, in the rigid reference
// solver (sdk/src/rigid/free_figure.h): once a tick, or, with masses of 1 : 100, once a substep.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "reference/rigid_parts.h"

namespace reference {

template <typename Scalar>
class FreeFigures {
public:
    using Vec = Vector3<Scalar>;
    using Body = MovingBody<Scalar>;
    using Joint = HeldJoint<Scalar>;

    FreeFigures(RigidParts<Scalar>& parts, const Vec& gravity, Scalar rate, int substeps)
        : parts_(parts), gravity_(gravity * (1 / rate)), rate_(rate), substeps_(substeps) {}

    // 1 .. substeps
    void begin_substep(int substep) {
        if (substep == 1) {
            find();
        }
        for (Figure& figure : figures_) {
            if (figure.passive && (substep == 1 || figure.each_substep)) {
                figure.energy = energy(figure);
            }
        }
    }

    // Once velocities are known. `predicted_velocity` and `predicted_spin` are those of the prediction.
    void finish_substep(int substep) {
        for (Figure& figure : figures_) {
            if (!figure.free) {
                continue;
            }
            if (is_pushed_from_outside(figure) || (figure.has_pivot && figure.held_by->limits.pushes())) {
                figure.free = figure.each_substep;
                figure.lost = {};
                continue;
            }
            figure.lost = figure.lost + lost_momentum(figure);
            figure.energy += work_of_gravity(figure);
            if (figure.each_substep || substep == substeps_) {
                keep_momentum(figure);
                figure.lost = {};
            }
        }
    }

private:
    struct Figure {
        std::size_t name = 0;
        std::vector<std::size_t> bodies{};
        bool free = true, passive = true, each_substep = false;
        bool has_pivot = false, has_axis = false;
        const Joint* held_by = nullptr;
        Vec pivot{}, axis{}, lost{};
        Scalar energy = 0;
    };
    struct Centre {
        Vec position, velocity;
    };

    Body& body(std::size_t i) { return parts_.bodies[i]; }

    void find() {
        figures_.clear();
        for (std::size_t i = 0; i < parts_.bodies.size(); ++i) {
            if (!body(i).moves) {
                continue;
            }
            const std::size_t name = parts_.figures[i];
            auto at = std::find_if(figures_.begin(), figures_.end(),
                                   [name](const Figure& figure) { return figure.name == name; });
            if (at == figures_.end()) {
                at = figures_.insert(at, Figure{name});
            }
            at->bodies.push_back(i);
            at->free = at->free && !body(i).attached;
        }
        for (Figure& figure : figures_) {
            Scalar heaviest = 0, lightest = 0;
            for (const std::size_t i : figure.bodies) {
                heaviest = std::max(heaviest, body(i).mass);
                lightest = lightest == 0 ? body(i).mass : std::min(lightest, body(i).mass);
            }
            figure.each_substep = heaviest >= 100 * lightest;
            const bool held = parts_.held[figure.name];
            figure.has_pivot = held && !figure.each_substep && find_pivot(figure);
            figure.free = figure.free && (figure.has_pivot || (!held && figure.bodies.size() > 1));
            figure.passive = figure.free && !figure.has_pivot;
            for (const Joint& joint : parts_.joints) {
                figure.passive =
                    figure.passive && !(parts_.figure_of(joint) == figure.name && joint.does_work());
            }
        }
    }

    bool find_pivot(Figure& figure) {
        int holders = 0;
        bool found = true;
        for (const Joint& joint : parts_.joints) {
            const bool a_moves = body(joint.a).moves;
            if (parts_.figure_of(joint) != figure.name) {
                continue;
            }
            found = found && joint.turns_freely();
            const bool is_inner = a_moves && body(joint.b).moves;
            found = found && (!joint.limits.any() || (!is_inner && joint.is_hinge()));
            if (is_inner) {
                continue;
            }
            ++holders;
            const Body& holder = body(a_moves ? joint.b : joint.a);
            found = found && greatest(holder.velocity) == 0 && greatest(holder.spin) == 0;
            figure.held_by = &joint;
            figure.pivot = holder.position + joint.point_of(holder, !a_moves);
            figure.has_axis = joint.is_hinge();
            figure.axis = joint.axis_of(holder, !a_moves);
        }
        const auto sum = [](const Vec& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); };
        const Vec step = gravity_ * body(figure.bodies.front()).gravity_factor;
        Vec lever = centre_of(figure).position - figure.pivot;
        if (figure.has_axis) {
            lever = lever - figure.axis * figure.axis.dot(lever);
        }
        return holders == 1 && found && sum(lever) >= 256 * sum(step) / rate_;
    }

    // With g what a substep of gravity has made a velocity v, v² was 2·g·v − g² less.
    Scalar work_of_gravity(const Figure& figure) {
        Scalar sum = 0, mass = 0;
        Vec moved, pull;
        const auto work = [](const Vec& gravity, const Vec& v) { return gravity.dot(v * 2 - gravity); };
        for (const std::size_t i : figure.bodies) {
            const Body& b = body(i);
            const Vec gravity = gravity_ * b.gravity_factor;
            sum += b.mass * work(gravity, b.predicted_velocity);
            moved = moved + b.predicted_velocity * b.mass;
            pull = pull + gravity * b.mass;
            mass += b.mass;
        }
        return sum - mass * work(pull * (1 / mass), moved * (1 / mass));
    }

    bool is_pushed_from_outside(const Figure& figure) const {
        return std::any_of(parts_.contacts.begin(), parts_.contacts.end(), [&](const auto& contact) {
            const auto own = [&](std::size_t i) {
                return parts_.bodies[i].moves && parts_.figures[i] == figure.name;
            };
            return parts_.belongs_to(contact, figure.name) && !(own(contact.a) && own(contact.b)) &&
                   contact.pushes();
        });
    }

    Centre centre_of(const Figure& figure) {
        if (figure.has_pivot) {
            return {figure.pivot, Vec{}};
        }
        Centre sum;
        Scalar mass = 0;
        for (const std::size_t i : figure.bodies) {
            sum.position = sum.position + body(i).position * body(i).mass;
            sum.velocity = sum.velocity + body(i).velocity * body(i).mass;
            mass += body(i).mass;
        }
        return {sum.position * (1 / mass), sum.velocity * (1 / mass)};
    }

    static Vec own_momentum(const Body& body) {
        return body.rotation * (body.inertia * body.rotation.back(body.spin));
    }
    Vec predicted_own_momentum(const Body& body) const {
        const Matrix<Scalar> rotation = body.predicted_orientation.matrix();
        const Vec spin = rotation.back(body.predicted_spin);
        const Vec middle = body.inertia * spin;
        const bool constant = body.round || greatest(body.predicted_spin) < Scalar(1) / 1024;
        return rotation * (constant ? middle : middle + cross(middle, spin * (Scalar(0.5) / rate_)));
    }

    Vec lost_momentum(const Figure& figure) {
        const Vec origin = figure.has_pivot ? figure.pivot : body(figure.bodies.front()).position;
        Vec lost;
        for (const std::size_t i : figure.bodies) {
            const Body& b = body(i);
            const Vec moved = b.position - b.predicted_position;
            lost = lost + cross(b.predicted_velocity - (b.position - origin) * rate_, moved) * b.mass;
            if (!(b.orientation == b.predicted_orientation)) {
                lost = lost + predicted_own_momentum(b) - own_momentum(b);
            }
        }
        return lost;
    }

    Vec momentum(const Figure& figure, const Centre& centre) {
        Vec sum;
        for (const std::size_t i : figure.bodies) {
            const Body& b = body(i);
            sum = sum + cross(b.position - centre.position, b.velocity - centre.velocity) * b.mass +
                  own_momentum(b);
        }
        return sum;
    }

    Matrix<Scalar> inertia(const Figure& figure, const Centre& centre) {
        Matrix<Scalar> sum = diagonal(Vec{});
        for (const std::size_t i : figure.bodies) {
            const Body& b = body(i);
            const Vec r = b.position - centre.position;
            const Matrix<Scalar> own = b.rotation.around(b.inertia);
            const Scalar squared = r.dot(r);
            const Vec point[3] = {Vec{squared, 0, 0} - r * r.x, Vec{0, squared, 0} - r * r.y,
                                  Vec{0, 0, squared} - r * r.z};
            for (int k = 0; k < 3; ++k) {
                sum.rows[k] = sum.rows[k] + own.rows[k] + point[k] * b.mass;
            }
        }
        return sum;
    }

    // Twice that of all motion about the centre of mass.
    Scalar energy(const Figure& figure) {
        const Centre centre = centre_of(figure);
        Scalar sum = 0;
        for (const std::size_t i : figure.bodies) {
            const Body& b = body(i);
            const Vec velocity = b.velocity - centre.velocity;
            sum += b.mass * velocity.dot(velocity) + b.spin.dot(own_momentum(b));
        }
        return sum;
    }

    // About the hinge's axis, or any.
    Vec lost_spin(const Figure& figure, const Matrix<Scalar>& inertia) const {
        const Vec& axis = figure.axis;
        return figure.has_axis ? axis * (axis.dot(figure.lost) / axis.dot(inertia * axis))
                               : inverse_of(inertia) * figure.lost;
    }

    void keep_momentum(const Figure& figure) {
        if (figure.lost.dot(figure.lost) == 0) {
            return;
        }
        const Centre centre = centre_of(figure);
        const Vec spin = lost_spin(figure, inertia(figure, centre));
        for (const std::size_t i : figure.bodies) {
            Body& b = body(i);
            b.velocity = b.velocity + cross(spin, b.position - centre.position);
            b.spin = b.spin + spin;
        }
        if (figure.passive) {
            take_out_gain(figure);
        }
    }

    void take_out_gain(const Figure& figure) {
        const Centre centre = centre_of(figure);
        const Scalar now = energy(figure);
        const Scalar allowed = std::max(figure.energy, Scalar(0));
        if (now <= allowed) {
            return;
        }
        Vec spin;
        Scalar beside = 1, together = 1;
        if (now - allowed <= allowed / 256) {
            together = std::sqrt(allowed / now);
        } else {
            const Vec whole = momentum(figure, centre);
            spin = inverse_of(inertia(figure, centre)) * whole;
            const Scalar least = whole.dot(spin);
            beside = allowed > least ? std::sqrt((allowed - least) / (now - least)) : Scalar(0);
            together = allowed < least ? std::sqrt(allowed / least) : Scalar(1);
        }
        for (const std::size_t i : figure.bodies) {
            Body& b = body(i);
            const Vec turning = cross(spin, b.position - centre.position);
            const Vec own = b.velocity - centre.velocity - turning;
            b.velocity = centre.velocity + (turning + own * beside) * together;
            b.spin = (spin + (b.spin - spin) * beside) * together;
        }
    }

    RigidParts<Scalar>& parts_;
    Vec gravity_; // that a substep adds
    Scalar rate_;
    int substeps_;
    std::vector<Figure> figures_;
};

} // namespace reference
