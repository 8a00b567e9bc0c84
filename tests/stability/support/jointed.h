// Bodies on joints and on the ground in a world of the SDK, and the float32 twin of them beside it.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "reference/rigid_comparison.h"
#include "reference/rigid_xpbd.h"
#include "support/bodies.h"

namespace stability {

class Jointed : public reference::RigidScene {
public:
    explicit Jointed(const lks_world_def& settings);
    Jointed(const Jointed&) = delete;

    using RigidScene::add_ground;
    void add_ground(double friction, bool bodies_touch = false) {
        add_ground(friction, friction, bodies_touch);
    }
    // Once it runs.
    void add_later(const lks_collider_def& collider);
    // `links` capsules of 30 cm in a level chain on an anchor, the last of them so many times as heavy; what
    // damps them, 1/s.
    void add_chain(std::uint32_t links, double ratio, double damping = 0);

    // Once it runs: the twin's motors are what the world's are now.
    void follow_motors();

    void step(int ticks = 1);

    // How far points that a joint holds together are apart, the most of all joints, metres.
    double gap() const;
    double twin_gap() const;
    // Joules: kinetic, and with height.
    double kinetic_energy() const { return support::energy_of(world()); }
    double energy() const;
    double twin_kinetic_energy() const { return twin().kinetic_energy(); }
    double twin_energy() const;
    support::Vector position(std::size_t body) const { return state_of(world(), id(body)).position; }
    support::Vector twin_position(std::size_t body) const { return twin().position(body); }
    support::Vector twin_velocity(std::size_t body) const { return twin().velocity(body); }

private:
    reference::RigidSolver<float>& twin() const;

    mutable std::unique_ptr<reference::RigidSolver<float>> twin_; // once all is there
};

// The worst of what is asked for after every tick, of both.
struct Worst {
    double fixed = 0, single = 0;

    void add(double fixed_now, double single_now) {
        fixed = fixed_now <= fixed ? fixed : fixed_now;
        single = single_now <= single ? single : single_now;
    }
};

// How far joints were apart and how much energy they gained, of the greatest motion, in so many ticks.
struct JointCourse {
    Worst gap, gained_share;
};
JointCourse run(Jointed& scene, int ticks);

} // namespace stability
