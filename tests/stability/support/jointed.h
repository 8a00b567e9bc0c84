// Bodies on joints and on the ground in a world of the SDK, and the float32 twin of them beside it. The twin
// knows no bodies that touch each other (but spheres), no motors and no damping.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "reference/rigid_xpbd.h"
#include "support/bodies.h"

namespace stability {

class Jointed {
public:
    explicit Jointed(const lks_world_def& settings);
    Jointed(const Jointed&) = delete;

    // A plane through the origin, for the bodies that are added from now on; those before touch nothing.
    void add_ground(double friction);
    // One shape with the body's own axes; none sleeps.
    std::size_t add(const lks_body_shape& shape, lks_body_def def);
    std::size_t add_anchor(const lks_vec3& position);
    void join(const lks_joint_def& def, std::size_t a, std::size_t b);
    // `links` capsules of 30 cm in a level chain on an anchor, the last of them so many times as heavy. What
    // damps them, 1/s, the twin does not know.
    void add_chain(std::uint32_t links, double ratio, double damping = 0);

    void step(int ticks = 1);

    const support::World& world() const { return world_; }
    std::size_t size() const { return ids_.size(); }
    lks_body_id id(std::size_t body) const { return ids_[body]; }
    // How far points that a joint holds together are apart, the most of all joints, metres.
    double gap() const;
    double twin_gap() const;
    // Joules: kinetic, and with height.
    double kinetic_energy() const { return support::energy_of(world_); }
    double energy() const;
    double twin_kinetic_energy() const { return twin().kinetic_energy(); }
    double twin_energy() const;
    support::Vector position(std::size_t body) const { return state_of(world_, ids_[body]).position; }
    support::Vector twin_position(std::size_t body) const { return twin().position(body); }

private:
    const reference::RigidSolver<float>& twin() const;

    reference::Settings settings_;
    support::World world_;
    bool touches_ground_ = false;
    reference::RigidModel model_;
    std::vector<lks_body_id> ids_;
    std::vector<lks_joint_id> joints_;
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
