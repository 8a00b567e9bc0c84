// Figures that overlap are moved apart, in the rigid reference solver (sdk/src/rigid/figure_overlaps.h).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "reference/model.h"
#include "reference/rigid_parts.h"

namespace reference {

// Once a tick: as wholes, by the contacts of the last substep; what hangs on an anchor or
// is attached stays.
template <typename Scalar>
void part_figures(RigidParts<Scalar>& parts, const Settings& settings) {
    using Vec = Vector3<Scalar>;
    std::vector<Scalar> masses(parts.bodies.size());
    std::vector<Vec> shifts(parts.bodies.size());
    for (std::size_t i = 0; i < parts.bodies.size(); ++i) {
        masses[parts.figures[i]] += parts.bodies[i].moves ? parts.bodies[i].mass : 0;
    }
    std::vector<Scalar> weights(parts.bodies.size());
    for (std::size_t i = 0; i < parts.bodies.size(); ++i) {
        weights[i] = masses[i] > 0 ? 1 / masses[i] : 0;
    }
    for (const HeldJoint<Scalar>& joint : parts.joints) {
        if (!parts.bodies[joint.a].moves || !parts.bodies[joint.b].moves) {
            weights[parts.figures[joint.a]] = weights[parts.figures[joint.b]] = 0;
        }
    }
    for (std::size_t i = 0; i < parts.bodies.size(); ++i) {
        weights[parts.figures[i]] = parts.bodies[i].attached ? 0 : weights[parts.figures[i]];
    }
    const bool gentle = settings.tick_rate_hz * settings.substeps >= 400;
    std::vector<Scalar> pushed(parts.contacts.size());
    const auto part = [&](std::size_t k) {
        const BodyContact<Scalar>& contact = parts.contacts[k];
        const std::size_t a = parts.figures[contact.a];
        const std::size_t b = parts.figures[contact.b];
        const Scalar weight = weights[a] + weights[b];
        Scalar apart = 0;
        if (a == b || weight == 0 ||
            !contact.wants_apart(Scalar(gentle ? 0.07 : 0.4) / static_cast<Scalar>(settings.tick_rate_hz),
                                 apart)) {
            return;
        }
        const Scalar missing = apart - contact.normal.dot(shifts[b] - shifts[a]);
        const Scalar gently = std::max(apart > 0 ? (4 * missing - pushed[k]) / 5 : missing, -pushed[k]);
        const Scalar push = gentle ? gently : std::max(missing, Scalar(0));
        pushed[k] += push;
        shifts[a] = shifts[a] - contact.normal * (push * weights[a] / weight);
        shifts[b] = shifts[b] + contact.normal * (push * weights[b] / weight);
    };
    for (int sweep = 0; sweep < 4; ++sweep) {
        for (std::size_t k = 0; k < parts.contacts.size(); ++k) {
            part(k);
        }
        for (std::size_t k = parts.contacts.size(); k-- > 0;) {
            part(k);
        }
    }
    for (std::size_t i = 0; i < parts.bodies.size(); ++i) {
        if (parts.bodies[i].moves) {
            parts.bodies[i].position = parts.bodies[i].position + shifts[parts.figures[i]];
        }
    }
}

} // namespace reference
