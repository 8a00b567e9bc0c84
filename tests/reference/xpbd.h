// The method as the papers write it, in floating point: what the integer solver is measured against.
//
// Scalar = double is the reference; Scalar = float is the twin that shows what the usual format would have
// given. Both take the same constraints in the same order, the same substeps, the same clamp and one
// multiplier a constraint, and differ from the SDK in nothing but the numbers. The coefficients are those of
// docs/numbers.md: c, r, γ' and s in [0, 1], and the multiplier carried as a length Λ = D·λ.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "reference/chain.h"
#include "reference/model.h"

namespace reference {

template <typename Scalar>
struct Vector3 {
    Scalar x = 0, y = 0, z = 0;

    Vector3() = default;
    Vector3(Scalar x_, Scalar y_, Scalar z_) : x(x_), y(y_), z(z_) {}
    explicit Vector3(const support::Vector& v)
        : x(static_cast<Scalar>(v.x)), y(static_cast<Scalar>(v.y)), z(static_cast<Scalar>(v.z)) {}

    Vector3 operator+(const Vector3& b) const { return {x + b.x, y + b.y, z + b.z}; }
    Vector3 operator-(const Vector3& b) const { return {x - b.x, y - b.y, z - b.z}; }
    Vector3 operator*(Scalar f) const { return {x * f, y * f, z * f}; }
    Scalar dot(const Vector3& b) const { return x * b.x + y * b.y + z * b.z; }
    Scalar length() const { return std::sqrt(dot(*this)); }
    support::Vector widened() const { return {x, y, z}; }
};

// Puts what is inside of the ball on its surface, at the nearest place.
template <typename Scalar>
void leave_ball(const Vector3<Scalar>& centre, Scalar radius, const std::vector<Scalar>& inverse_masses,
                std::vector<Vector3<Scalar>>& positions) {
    if (!(radius > 0)) {
        return;
    }
    for (std::size_t p = 0; p < positions.size(); ++p) {
        const Vector3<Scalar> from_centre = positions[p] - centre;
        const Scalar distance = from_centre.length();
        if (distance < radius && distance > 0 && inverse_masses[p] != 0) {
            positions[p] = centre + from_centre * (radius / distance);
        }
    }
}

struct Settings {
    double tick_rate_hz = 60;
    int substeps = 20;
    int iterations = 1;
    support::Vector gravity{0, -9.81, 0};
    double linear_damping = 0;
};

template <typename Scalar>
class Solver {
public:
    using Vec = Vector3<Scalar>;

    // `place` moves the scene away from the origin, where float32 has fewer bits left.
    Solver(const Model& model, const Settings& settings, const support::Vector& place = {})
        : settings_(settings), h_(static_cast<Scalar>(1 / (settings.tick_rate_hz * settings.substeps))),
          place_(place), edges_(model.edges), centre_(model.ball.centre + place),
          radius_(static_cast<Scalar>(model.ball.radius)), chain_(model.chain), tethers_(model.tethers) {
        for (std::size_t i = 0; i < model.positions.size(); ++i) {
            positions_.push_back(Vec(model.positions[i] + place));
            velocities_.emplace_back();
            inverse_masses_.push_back(static_cast<Scalar>(1 / model.masses[i]));
        }
        masses_ = model.masses;
        multipliers_.resize(edges_.size());
        previous_ = positions_;
        targets_ = positions_;
        for (const std::uint32_t particle : model.pins) {
            pin(particle);
        }
    }

    void pin(std::size_t particle) {
        inverse_masses_[particle] = 0;
        targets_[particle] = positions_[particle];
    }
    void unpin(std::size_t particle) {
        inverse_masses_[particle] = static_cast<Scalar>(1 / masses_[particle]);
    }
    void set_target(std::size_t particle, const support::Vector& target) {
        targets_[particle] = Vec(target + place_);
    }
    void set_velocity(std::size_t particle, const support::Vector& velocity) {
        velocities_[particle] = Vec(velocity);
    }

    // Called for each free particle at the end of each iteration, with where it is, where the substep began
    // for it, and how much of the tick is over at the substep's start and at its end.
    using Contact = std::function<void(Vec& position, Vec& start, Scalar from, Scalar to)>;
    void set_contact(Contact contact) { contact_ = std::move(contact); }

    void tick(int count = 1) {
        for (int i = 0; i < count; ++i) {
            begin_tick();
            for (int substep = 1; substep <= settings_.substeps; ++substep) {
                begin_substep(substep);
                for (int iteration = 0; iteration < settings_.iterations; ++iteration) {
                    project();
                    leave_ball(centre_, radius_, inverse_masses_, positions_);
                    if (contact_) {
                        collide(substep);
                    }
                }
                finish_substep();
            }
        }
    }

    // A tick in parts, for who has something to do in between.
    void begin_tick() {
        prepare();
        tick_start_ = positions_;
    }
    // 1 .. substeps
    void begin_substep(int substep) {
        predict(tick_start_, static_cast<Scalar>(substep) / static_cast<Scalar>(settings_.substeps));
        std::fill(multipliers_.begin(), multipliers_.end(), Scalar(0));
    }
    void project() {
        hold_by_tethers();
        for (std::size_t edge = 0; edge < edges_.size(); ++edge) {
            if (chain_.empty() || edges_[edge].family != LKS_CONSTRAINT_STRETCH) {
                project(edge);
            }
        }
        if (!chain_.empty()) {
            solve_chain();
        }
    }
    void finish_substep() {
        for (std::size_t p = 0; p < positions_.size(); ++p) {
            velocities_[p] = (positions_[p] - previous_[p]) * (1 / h_);
        }
    }
    Vec& place_of(std::size_t particle) { return positions_[particle]; }
    const Vec& place_of(std::size_t particle) const { return positions_[particle]; }
    // Of a pinned one 0.
    Scalar inverse_mass(std::size_t particle) const { return inverse_masses_[particle]; }

    // In metres, with the place taken off again.
    support::Vector position(std::size_t particle) const { return positions_[particle].widened() - place_; }
    support::Vector velocity(std::size_t particle) const { return velocities_[particle].widened(); }
    std::size_t size() const { return positions_.size(); }

    double kinetic_energy() const {
        double energy = 0;
        for (std::size_t p = 0; p < positions_.size(); ++p) {
            const support::Vector v = velocities_[p].widened();
            energy += inverse_masses_[p] == 0 ? 0 : 0.5 * masses_[p] * v.dot(v);
        }
        return energy;
    }

    // The largest |length / rest - 1|; infinite as soon as a number is none.
    double worst_stretch() const {
        double worst = 0;
        for (const Edge& edge : edges_) {
            const double length = (positions_[edge.a].widened() - positions_[edge.b].widened()).length();
            const double stretch = std::abs(length / edge.rest - 1);
            if (!std::isfinite(stretch)) {
                return std::numeric_limits<double>::infinity();
            }
            worst = std::max(worst, stretch);
        }
        return worst;
    }

    // Newtons, tension positive: -λ/h² of the last substep.
    double force(std::size_t edge) const {
        return -static_cast<double>(multipliers_[edge] / (coefficients_[edge].d * h_ * h_));
    }

private:
    struct Coefficients {
        Scalar c, r, damping, s_a, s_b, d;
    };

    // XPBD eq. 26 with every coefficient in [0, 1]. Anew each tick, since pins change the masses.
    void prepare() {
        coefficients_.clear();
        greatest_damping_ = 0;
        for (const Edge& edge : edges_) {
            const Scalar w_a = inverse_masses_[edge.a];
            const Scalar w_b = inverse_masses_[edge.b];
            const Scalar compliance = static_cast<Scalar>(edge.compliance) / (h_ * h_);
            const Scalar gamma =
                static_cast<Scalar>(edge.compliance) * static_cast<Scalar>(edge.damping) / h_;
            const Scalar d = w_a + w_b + compliance / (1 + gamma);
            Coefficients k{};
            k.c = 1 / (1 + gamma);
            k.damping = gamma / (1 + gamma);
            k.d = d;
            if (d > 0) {
                k.r = compliance / ((1 + gamma) * d);
                k.s_a = w_a / d;
                k.s_b = w_b / d;
            }
            coefficients_.push_back(k);
            greatest_damping_ = std::max(greatest_damping_, k.damping);
        }
    }

    void predict(const std::vector<Vec>& start, Scalar share) {
        previous_ = positions_;
        const Vec gravity = Vec(settings_.gravity) * (h_ * h_);
        const Scalar kept = 1 - static_cast<Scalar>(settings_.linear_damping) * h_;
        for (std::size_t p = 0; p < positions_.size(); ++p) {
            if (inverse_masses_[p] == 0) {
                positions_[p] = start[p] + (targets_[p] - start[p]) * share;
            } else {
                positions_[p] = positions_[p] + velocities_[p] * (h_ * kept) + gravity;
            }
        }
    }

    void collide(int substep) {
        const auto substeps = static_cast<Scalar>(settings_.substeps);
        for (std::size_t p = 0; p < positions_.size(); ++p) {
            if (inverse_masses_[p] != 0) {
                contact_(positions_[p], previous_[p], static_cast<Scalar>(substep - 1) / substeps,
                         static_cast<Scalar>(substep) / substeps);
            }
        }
    }

    void project(std::size_t index) {
        const Edge& edge = edges_[index];
        const Coefficients& k = coefficients_[index];
        const Vec difference = positions_[edge.a] - positions_[edge.b];
        const Scalar length = difference.length();
        if (!(length > 0) || !(k.d > 0)) {
            return;
        }
        Scalar change = -k.c * (length - static_cast<Scalar>(edge.rest)) - k.r * multipliers_[index];
        if (k.damping > 0) {
            const Vec moved = difference - (previous_[edge.a] - previous_[edge.b]);
            change -= k.damping * difference.dot(moved) / length;
        }
        // An edge near zero length may at most double per projection.
        const Scalar relative = std::clamp(change / length, Scalar(-1), Scalar(1));
        multipliers_[index] += relative * length;
        positions_[edge.a] = positions_[edge.a] + difference * (k.s_a * relative);
        positions_[edge.b] = positions_[edge.b] - difference * (k.s_b * relative);
    }

    void hold_by_tethers() {
        const std::map<std::uint32_t, double> scales = scales_of_anchors();
        for (const Tether& tether : tethers_) {
            if (inverse_masses_[tether.anchor] != 0 || inverse_masses_[tether.particle] == 0) {
                continue;
            }
            const Vec difference = positions_[tether.particle] - positions_[tether.anchor];
            const Scalar length = difference.length();
            const Scalar error = static_cast<Scalar>(tether.length * scales.at(tether.anchor)) / length - 1;
            if (error < 0) {
                const Vec start = previous_[tether.particle] - previous_[tether.anchor];
                const Scalar growth =
                    std::max(difference.dot(difference - start) / (length * length), Scalar(0));
                const Scalar damped = (1 - greatest_damping_) * error - greatest_damping_ * growth;
                positions_[tether.particle] =
                    positions_[tether.particle] + difference * std::max(error, damped);
            }
        }
    }

    // Two pins that are further apart than their two tethers of some particle are long together give way.
    std::map<std::uint32_t, double> scales_of_anchors() const {
        std::map<std::uint32_t, double> scales;
        for (std::size_t i = 0; i < tethers_.size(); ++i) {
            scales.emplace(tethers_[i].anchor, 1);
            for (std::size_t j = i + 1; j < tethers_.size() && tethers_[j].particle == tethers_[i].particle;
                 ++j) {
                const std::uint32_t a = tethers_[i].anchor;
                const std::uint32_t b = tethers_[j].anchor;
                if (inverse_masses_[a] == 0 && inverse_masses_[b] == 0) {
                    const double apart = (positions_[a].widened() - positions_[b].widened()).length();
                    const double scale = apart / (tethers_[i].length + tethers_[j].length);
                    for (const std::uint32_t anchor : {a, b}) {
                        scales.emplace(anchor, 1);
                        scales[anchor] = std::max(scales[anchor], scale);
                    }
                }
            }
        }
        return scales;
    }

    void solve_chain() {
        for (int solves = 1; solve_chain_once() && solves < 32; ++solves) {}
    }

    // Particles stand in the order of the rope, as vertices do. True: it is to be solved again.
    bool solve_chain_once() {
        ChainSystem<Scalar, Vec> system(inverse_masses_, positions_);
        const std::vector<double> taut = tautness();
        for (std::size_t j = 0; j < chain_.size(); ++j) {
            const Edge& edge = edges_[chain_[j]];
            const Coefficients& k = coefficients_[chain_[j]];
            const Vec difference = positions_[j + 1] - positions_[j];
            const Scalar length = difference.length();
            auto& segment = system.segment(j);
            segment.rest = static_cast<Scalar>(edge.rest);
            segment.softness = k.r * k.d;
            segment.multiplier = k.d > 0 ? multipliers_[chain_[j]] / k.d : 0;
            segment.change = 0;
            if (length > 0) {
                const Vec moved = difference - (previous_[j + 1] - previous_[j]);
                segment.change =
                    k.c * std::clamp(static_cast<Scalar>(edge.rest * taut[j]) - length, -length, length) -
                    segment.softness * segment.multiplier - k.damping * system.direction(j).dot(moved);
            }
        }
        const std::vector<Scalar> change = system.solve();
        const std::vector<Vec> movements = system.movements(change);
        for (std::size_t j = 0; j < chain_.size(); ++j) {
            multipliers_[chain_[j]] += change[j] * coefficients_[chain_[j]].d;
        }
        for (std::size_t p = 0; p < positions_.size(); ++p) {
            positions_[p] = positions_[p] + movements[p];
        }
        return system.is_off();
    }

    // What rest lengths are multiplied by between two pins that are further apart, but for 2^-24, than the
    // rope between them is long.
    std::vector<double> tautness() const {
        std::vector<double> result(chain_.size(), 1);
        std::size_t pin = positions_.size();
        double length = 0;
        for (std::size_t i = 0; i < positions_.size(); ++i) {
            if (inverse_masses_[i] == 0) {
                if (pin < i) {
                    const double apart = (positions_[i].widened() - positions_[pin].widened()).length();
                    for (std::size_t j = pin; j < i; ++j) {
                        result[j] = std::max(1.0, apart / length + std::ldexp(1, -24));
                    }
                }
                pin = i;
                length = 0;
            }
            length += i < chain_.size() ? edges_[chain_[i]].rest : 0;
        }
        return result;
    }

    Settings settings_;
    Scalar h_;
    support::Vector place_;
    std::vector<Edge> edges_;
    Vec centre_;
    Scalar radius_;
    std::vector<std::size_t> chain_; // the edges of a rope that is solved directly
    std::vector<Tether> tethers_;
    std::vector<double> masses_;
    std::vector<Scalar> inverse_masses_;
    std::vector<Vec> positions_, previous_, velocities_, targets_;
    std::vector<Vec> tick_start_;
    std::vector<Scalar> multipliers_;
    std::vector<Coefficients> coefficients_;
    Scalar greatest_damping_ = 0; // γ' of a tether
    Contact contact_;
};

} // namespace reference
