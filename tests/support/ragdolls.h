// Several humanoids and what is seen of them while they fall: their joints, limits, energy and overlaps.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/bodies.h"
#include "support/overlaps.h"

namespace support {

inline lks_transform turned_about_x(double x, double y, double z, double degrees) {
    return {fixed(x, y, z), about(1, 0, 0, degrees)};
}

inline constexpr std::uint32_t humanoid_joints = LKS_HUMANOID_BONES - 1;

class Ragdolls {
public:
    explicit Ragdolls(World& world) : world_(world) {}

    void add(const lks_transform& transform, const lks_vec3& velocity = {}) {
        human_.def.transform = transform;
        human_.def.velocity = velocity;
        lks_joint_id joints[humanoid_joints];
        lks_body_id bodies[LKS_HUMANOID_BONES];
        REQUIRE(human_.add(world_, bodies, joints) == LKS_OK);
        bodies_.insert(bodies_.end(), bodies, bodies + LKS_HUMANOID_BONES);
        joints_.insert(joints_.end(), joints, joints + humanoid_joints);
    }

    // Five a layer above a pit, face down and abreast, layers across each other, and each aside by what
    // `aside()` gives, metres.
    template <typename Aside>
    void add_pile(int layers, const Aside& aside) {
        for (int layer = 0; layer < layers; ++layer) {
            for (int i = 0; i < 5; ++i) {
                const bool across = layer % 2 == 1;
                const double beside = 0.56 * (i - 2) + 0.04 * layer - 0.1 + aside();
                const double along = 0.03 * i - 0.9 + aside();
                const double height = 0.9 + 1.15 * layer + 0.09 * i;
                lks_transform place =
                    turned_about_x(across ? along : beside, height, across ? beside : along, 90);
                if (across) {
                    place.rotation = {1 << 29, 1 << 29, -(1 << 29), 1 << 29}; // and by a quarter turn about y
                }
                add(place);
            }
        }
    }

    void step() {
        world_.step();
        limit_now_ = 0;
        for (std::size_t i = 0; i < joints_.size(); ++i) {
            const double error = error_of(world_, joints_[i]);
            sum_ += error;
            worst_ = std::max(worst_, error);
            ++count_;
            limit_now_ = std::max(limit_now_,
                                  degrees_beyond(world_, human_.bones[1 + i % humanoid_joints], joints_[i]));
        }
        limit_ = std::max(limit_, limit_now_);
    }

    // No friction in the joints of those that are added from now on, and nobody sleeps.
    void slip() {
        for (lks_bone& bone : human_.bones) {
            bone.friction = 0;
            bone.body.never_sleeps = 1;
        }
    }

    // Kinetic and potential.
    double energy() const { return whole_energy(world_, bodies_.data(), bodies_.size()); }

    // How deep any of them is in another, or in what stands about, now. Neighbours share their joint's place.
    double overlap() const {
        std::vector<Solid> solids;
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            solids.push_back(solid_of(human_.shapes[i % LKS_HUMANOID_BONES], state_of(world_, bodies_[i])));
        }
        double deepest = 0;
        for (std::size_t i = 0; i < solids.size(); ++i) {
            deepest = std::max(deepest, overlap_with_colliders(solids[i]));
            for (std::size_t j = 0; j < i; ++j) {
                const double apart = (solids[i].centre - solids[j].centre).length();
                if (apart < solids[i].reach() + solids[j].reach() && !are_neighbours(i, j)) {
                    deepest = std::max(deepest, -gap_between(solids[i], solids[j]));
                }
            }
        }
        return deepest;
    }

    const std::vector<lks_body_id>& bodies() const { return bodies_; }
    double mean() const { return sum_ / count_; }
    double worst() const { return worst_; }
    double limit() const { return limit_; }
    double limit_now() const { return limit_now_; }

private:
    // Of balls along capsules' axes and of boxes' corners: what stands about has faces.
    double overlap_with_colliders(const Solid& solid) const {
        double deepest = 0;
        for (int i = 0; i < 8; ++i) {
            const Vector corner = solid.axes[0] * (i & 1 ? solid.half.x : -solid.half.x) +
                                  solid.axes[1] * (i & 2 ? solid.half.y : -solid.half.y) +
                                  solid.axes[2] * (i & 4 ? solid.half.z : -solid.half.z);
            const Vector on_axis = solid.axes[1] * (solid.half_length * (2 * i / 7.0 - 1));
            deepest = std::max(deepest, solid.radius -
                                            nearest_collider(solid.centre + (solid.box ? corner : on_axis)));
        }
        return deepest;
    }

    // Metres from a point.
    double nearest_collider(const Vector& point) const {
        lks_query query = lks_default_query();
        query.kinds = LKS_HIT_BIT(LKS_HIT_COLLIDER);
        query.radius = fixed(0.3);
        lks_hit hits[16];
        std::uint32_t count = 0;
        REQUIRE(lks_world_overlap(world_, &query, fixed(point.x, point.y, point.z), hits, 16, &count) ==
                LKS_OK);
        REQUIRE(count <= 16);
        double least = 1;
        for (std::uint32_t i = 0; i < count; ++i) {
            least = std::min(least, metres(hits[i].distance));
        }
        return least;
    }

    // Bodies have the indices in which they were added.
    bool are_neighbours(std::size_t a, std::size_t b) const {
        const std::size_t root = a - a % LKS_HUMANOID_BONES;
        const auto parent = [&](std::size_t i) { return root + human_.bones[i % LKS_HUMANOID_BONES].parent; };
        return b / LKS_HUMANOID_BONES == a / LKS_HUMANOID_BONES &&
               ((a != root && parent(a) == b) || (b != root && parent(b) == a));
    }

    World& world_;
    Humanoid human_;
    std::vector<lks_body_id> bodies_;
    std::vector<lks_joint_id> joints_;
    double sum_ = 0;
    double count_ = 0;
    double worst_ = 0;
    double limit_ = 0;
    double limit_now_ = 0;
};

// Four walls about 3.4 by 3.4 metres of ground.
inline void add_pit(World& world) {
    add_ground(world);
    for (const double side : {-1.9, 1.9}) {
        add_box(world, fixed(2.1, 0.45, 0.2), fixed(0, 0.45, side));
        add_box(world, fixed(0.2, 0.45, 1.7), fixed(side, 0.45, 0));
    }
}

} // namespace support
