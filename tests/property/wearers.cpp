// A figure that only wears something, as a cape, is solved, stands and moves as one that wears nothing.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/attachments.h"
#include "support/bodies.h"
#include "support/builders.h"
#include "support/ragdolls.h"
#include "support/sanitised.h"

using namespace support;

namespace {

struct Apart {
    double joints = 0; // m, at the most
    double seams = 0;
};

// With a net of 12 × 12 points at its back, whose upper edge its chest holds and which touches nothing.
class Wearer {
public:
    Wearer(World& world, double height, double mass) : world_(world) {
        human_.let_particles_through();
        human_.def.transform.position = fixed(0, height, 0);
        REQUIRE(human_.add(world, bodies_, joints_) == LKS_OK);
        Net net;
        net.side = 12;
        net.width = 0.4;
        net.particle_mass = mass / 144;
        const lks_body_id chest = bodies_[LKS_HUMANOID_CHEST];
        const Vector at_chest = state_of(world, chest).position;
        const Asset asset = net.build();
        const lks_object_id cape = world.add(asset, at(0, at_chest.y - 0.1, -0.16));
        for (std::uint32_t vertex = 0; vertex < 12; ++vertex) {
            const Vector place = metres(world.positions(cape)[vertex]) - at_chest;
            seams_.push_back(attach(world, to_body(cape, vertex, chest, fixed(place.x, place.y, place.z))));
        }
    }
    Wearer(const Wearer&) = delete;
    Wearer& operator=(const Wearer&) = delete;

    // Towards how it stands now.
    void tense(double strength) {
        lks_transform pose[LKS_HUMANOID_BONES];
        REQUIRE(lks_ragdoll_pose(world_, bodies_, LKS_HUMANOID_BONES, pose) == LKS_OK);
        REQUIRE(lks_ragdoll_drive(world_, &human_.def, joints_, pose, fixed(strength), fixed(0.05)) ==
                LKS_OK);
    }
    void step(int ticks) {
        for (int i = 0; i < ticks; ++i) {
            world_.step();
            for (const lks_joint_id joint : joints_) {
                apart_.joints = std::max(apart_.joints, error_of(world_, joint));
            }
            for (const lks_attachment_id seam : seams_) {
                lks_fixed off = 0;
                REQUIRE(lks_attachment_error(world_, seam, &off) == LKS_OK);
                apart_.seams = std::max(apart_.seams, metres(off));
            }
        }
    }
    const Apart& apart() const { return apart_; }
    lks_body_id bone(std::uint32_t index) const { return bodies_[index]; }

private:
    World& world_;
    Humanoid human_;
    lks_body_id bodies_[LKS_HUMANOID_BONES];
    lks_joint_id joints_[humanoid_joints];
    std::vector<lks_attachment_id> seams_;
    Apart apart_;
};

} // namespace

// Swept, it fell over at 1 to 8 substeps whatever it weighed, with joints 1 to 25 mm apart.
TEST_CASE("who stands by its own strength stands in a cape of any weight") {
    for (const double mass : {0.1, 1., 5., 20.}) {
        for (const std::uint32_t substeps : {1u, 2u, 4u, 8u, 20u}) {
            if (sanitised && (substeps != 8 || mass != 1)) {
                continue;
            }
            World world(world_def(60, substeps));
            add_ground(world);
            Wearer wearer(world, 0.01, mass);
            wearer.tense(1);
            wearer.step(300);
            const double height = state_of(world, wearer.bone(LKS_HUMANOID_CHEST)).position.y;
            INFO(mass << " kg, " << substeps << " substeps: " << height << " m, "
                      << 1e3 * wearer.apart().joints << " and " << 1e3 * wearer.apart().seams << " mm apart");
            CHECK(std::abs(height - 1.285) < 3e-3);
            CHECK(wearer.apart().joints < 1e-6);
            // As far as the net falls in a substep, by its share in the mass.
            CHECK(wearer.apart().seams < 1e-5 + 6e-4 * std::max(mass / 20, 0.1) / substeps);
            CHECK(energy_of(world) < 1e-3 * mass);
        }
    }
}

TEST_CASE("who whirls through the air in a cape stays together, and gains nothing") {
    for (const double mass : {0.5, 5., 30.}) {
        for (const std::uint32_t substeps : {4u, 8u, 20u}) {
            if (sanitised && (substeps != 8 || mass != 5)) {
                continue;
            }
            World world(world_def(60, substeps));
            REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
            Wearer wearer(world, 0, mass);
            REQUIRE(lks_body_apply_impulse(world, wearer.bone(LKS_HUMANOID_HEAD), fixed(30, 40, 20),
                                           lks_vec3(fixed(0, 1.6, 0.2))) == LKS_OK);
            world.step();
            const double start = energy_of(world);
            double most = 0;
            for (int tick = 0; tick < 240; ++tick) {
                wearer.step(1);
                most = std::max(most, energy_of(world));
            }
            INFO(mass << " kg, " << substeps << " substeps: " << most << " of " << start << " J, "
                      << 1e3 * wearer.apart().joints << " and " << 1e3 * wearer.apart().seams << " mm apart");
            CHECK(most < start);
            CHECK(wearer.apart().joints < (substeps == 4 ? 1e-4 : 3e-5)); // swept 3, 1.9 and 0.2 mm
            CHECK(wearer.apart().seams < 2e-3);
        }
    }
}
