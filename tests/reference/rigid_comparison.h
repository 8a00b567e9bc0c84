// The SDK, the double-precision twin of its rigid solver and the float32 one run the same scene; how far do
// they get from each other?
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "reference/rigid_model.h"
#include "reference/xpbd.h"
#include "support/builders.h"
#include "support/handles.h"

namespace reference {

// From the double-precision twin, over all bodies and ticks.
struct RigidDistance {
    double metres = 0;  // of a centre of mass or a particle
    double radians = 0; // between orientations
};

struct RigidDeviation {
    RigidDistance fixed_point;
    RigidDistance single;
};

class RigidScene {
public:
    // What is led in a tick, before it: lead_body() and lead_collider().
    using Leading = std::function<void(RigidScene& scene, int tick)>;

    explicit RigidScene(const Settings& settings);

    // Bodies that are added from now on touch colliders, and, if they are to, each other.
    void add_collider(const lks_collider_def& def, bool bodies_touch);
    // A plane through the origin that is turned so.
    void add_ground(double static_friction, double dynamic_friction, bool bodies_touch,
                    const lks_rotation& rotation = lks_transform_identity().rotation);
    std::size_t add(const std::vector<lks_body_shape>& shapes, lks_body_def def);
    std::size_t add(const lks_body_shape& shape, const lks_body_def& def);
    std::size_t add_anchor(const lks_vec3& position);
    void join(const lks_joint_def& def, std::size_t a, std::size_t b);

    // Objects of particles, which touch nothing.
    std::size_t add_rope(const support::Chain& chain, const lks_vec3& position);
    std::size_t add_points(const std::vector<support::Vector>& points, const std::vector<double>& masses);
    void pin(std::size_t object, std::uint32_t particle);
    // `def`: the particle, and where and how it is held.
    void attach(lks_attachment_def def, std::size_t object, std::size_t body);
    void attach_to_particle(lks_attachment_def def, std::size_t object, std::size_t other);

    // Joints by the order in which they were added.
    void drive(std::size_t joint, const lks_motor& motor);

    // What is kinematic is to be there at the end of the next tick; colliders by the order in which they were
    // added.
    void lead_body(std::size_t body, const lks_transform& target);
    void lead_collider(std::size_t collider, const lks_transform& target);

    // The greatest until each of these ticks, in ascending order. Once a scene.
    std::vector<RigidDeviation> run(const std::vector<int>& ticks, const Leading& leading = {});

    const Settings& settings() const { return settings_; }
    const RigidModel& model() const { return model_; } // as it begins
    support::World& world() { return world_; }
    const support::World& world() const { return world_; }
    std::size_t size() const { return ids_.size(); }
    lks_body_id id(std::size_t body) const { return ids_[body]; }
    const std::vector<lks_joint_id>& joints() const { return joints_; }

private:
    std::size_t add(const support::Asset& asset, const lks_vec3& position, const std::vector<double>& masses,
                    const Materials& materials, bool directly);
    void attach(const lks_attachment_def& def, const RigidAttachment& attachment);

    struct Target {
        bool of_collider;
        std::size_t index;
        support::Vector position; // of a body's centre of mass
        Rotation orientation;
    };

    Settings settings_;
    support::World world_;
    bool touches_colliders_ = false;
    bool touches_bodies_ = false;
    std::vector<lks_body_id> ids_;
    std::vector<lks_joint_id> joints_;
    std::vector<lks_collider_id> colliders_;
    std::vector<lks_object_id> objects_;
    std::vector<Target> targets_; // of the next tick
    RigidModel model_;
};

} // namespace reference
