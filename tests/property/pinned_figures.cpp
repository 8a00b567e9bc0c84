// Figures that hang on pinned vertices, and are led by them.
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

// Its hands are attached to a vertex each, which is pinned where it is.
class Hung {
public:
    Hung(World& world, int hands, double compliance = 0, double damping = 0) : world_(world) {
        human_.let_particles_through();
        for (lks_bone& bone : human_.bones) {
            bone.body.linear_damping = bone.body.angular_damping = fixed(damping);
        }
        human_.def.transform.position = fixed(0, 1.2, 0);
        REQUIRE(human_.add(world, bodies_, joints_) == LKS_OK);
        std::vector<Vector> places;
        for (int i = 0; i < 2; ++i) {
            places_[i] = state_of(world, hand(i)).position;
            places.push_back(places_[i]);
        }
        const Asset asset = loose_points(places, {0.05, 0.05});
        points_ = world.add(asset, at(0, 0, 0));
        for (int i = 0; i < hands; ++i) {
            world.pin(points_, static_cast<std::uint32_t>(i));
            lks_attachment_def def = to_body(points_, static_cast<std::uint32_t>(i), hand(i));
            def.compliance = fixed(compliance);
            holds_.push_back(attach(world, def));
        }
        start_ = energy();
    }
    Hung(const Hung&) = delete;
    Hung& operator=(const Hung&) = delete;

    // Both pins on by so much.
    void lead(const Vector& way) {
        for (std::uint32_t i = 0; i < holds_.size(); ++i) {
            places_[i] = places_[i] + way;
            REQUIRE(lks_object_set_pin_target(world_, points_, i,
                                              fixed(places_[i].x, places_[i].y, places_[i].z)) == LKS_OK);
        }
    }
    void step(int ticks) {
        for (int i = 0; i < ticks; ++i) {
            world_.step();
            for (std::size_t j = 0; j < humanoid_joints; ++j) {
                apart_ = std::max(apart_, error_of(world_, joints_[j]));
                beyond_ = std::max(beyond_, degrees_beyond(world_, human_.bones[j + 1], joints_[j]));
            }
            for (const lks_attachment_id hold : holds_) {
                lks_fixed off = 0;
                REQUIRE(lks_attachment_error(world_, hold, &off) == LKS_OK);
                off_ = std::max(off_, metres(off));
            }
            gained_ = std::max(gained_, energy() - start_);
        }
    }
    // Newtons, upwards.
    double pull() const {
        double sum = 0;
        for (const lks_attachment_id hold : holds_) {
            lks_vec3 force{};
            REQUIRE(lks_attachment_force(world_, hold, &force) == LKS_OK);
            sum += metres(force).y;
        }
        return sum;
    }
    double energy() const { return whole_energy(world_, bodies_, LKS_HUMANOID_BONES); }
    double apart() const { return apart_; } // metres, at the most
    double beyond() const { return beyond_; }
    double off() const { return off_; }
    double gained() const { return gained_; }
    lks_object_id points() const { return points_; }
    const std::vector<lks_attachment_id>& holds() const { return holds_; }

private:
    lks_body_id hand(int i) const {
        return bodies_[i == 0 ? LKS_HUMANOID_HAND_LEFT : LKS_HUMANOID_HAND_RIGHT];
    }

    World& world_;
    Humanoid human_;
    lks_body_id bodies_[LKS_HUMANOID_BONES];
    lks_joint_id joints_[humanoid_joints];
    lks_object_id points_{};
    std::vector<lks_attachment_id> holds_;
    Vector places_[2];
    double start_ = 0;
    double apart_ = 0;
    double beyond_ = 0;
    double off_ = 0;
    double gained_ = 0;
};

} // namespace

// Swept, joints came 18 m apart at one substep, and 9 cm at 8 and 20.
TEST_CASE("a humanoid that hangs by one hand, or both, on pinned vertices stays together") {
    for (const int hands : {1, 2}) {
        for (const std::uint32_t substeps : {1u, 2u, 4u, 8u, 20u}) {
            if (sanitised && substeps != 8) {
                continue;
            }
            World world(world_def(60, substeps));
            Hung hung(world, hands);
            hung.step(600);
            INFO(hands << " hands, " << substeps << " substeps: " << 1e3 * hung.apart() << " and "
                       << 1e3 * hung.off() << " mm apart, " << hung.beyond() << "°, " << hung.gained()
                       << " J, " << hung.pull() << " N");
            CHECK(hung.apart() < (substeps == 1 ? 1e-2 : substeps < 8 ? 1e-3 : 1e-4));
            CHECK(hung.off() < (substeps == 1 ? 1e-3 : 1e-4));
            CHECK(hung.beyond() < (substeps < 4 ? 15 : 5));
            CHECK(hung.gained() < (substeps < 4 ? 20 : 2));
        }
    }
}

TEST_CASE("who hangs on pinned vertices at rest pulls with its weight, rigidly and softly") {
    for (const double compliance : {0., 1e-4}) {
        World world(world_def(60, 8));
        Hung hung(world, 2, compliance, 0.5);
        world.step(2400);
        CHECK(energy_of(world) < 0.5);
        CHECK(std::abs(hung.pull() / (78 * 9.81) - 1) < 5e-3);
        for (const lks_attachment_id hold : hung.holds()) {
            lks_fixed off = 0;
            lks_vec3 force{};
            REQUIRE(lks_attachment_error(world, hold, &off) == LKS_OK);
            REQUIRE(lks_attachment_force(world, hold, &force) == LKS_OK);
            CHECK(std::abs(metres(off) - compliance * metres(force).length()) < 1e-3 * metres(off) + 1e-6);
        }
    }
}

// Swept, 30 cm at 8 substeps and 10 m/s, 3.6 m at 60.
TEST_CASE("a humanoid whose hand a pinned vertex leads stays together at any speed") {
    for (const double speed : {1., 10., 60.}) {
        for (const std::uint32_t substeps : {4u, 8u, 20u}) {
            if (sanitised && substeps != 8) {
                continue;
            }
            World world(world_def(60, substeps));
            REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
            Hung hung(world, 1);
            for (int tick = 0; tick < 50; ++tick) {
                hung.lead({speed / 60, 0, 0});
                hung.step(1);
            }
            INFO(speed << " m/s, " << substeps << " substeps: " << 1e3 * hung.apart() << " and "
                       << 1e3 * hung.off() << " mm apart, " << hung.beyond() << "°");
            CHECK(hung.apart() < (substeps == 4 ? 2e-4 : 5e-5));
            CHECK(hung.beyond() < 5);
            CHECK(energy_of(world) < 1.5 * 39 * speed * speed);
            // Let go, it flies on.
            const double flying = energy_of(world);
            REQUIRE(lks_object_unpin(world, hung.points(), 0) == LKS_OK);
            world.step(30);
            CHECK(energy_of(world) < 1.001 * flying);
        }
    }
}

TEST_CASE("a humanoid on more pinned vertices than are solved at once stays together, too") {
    for (const std::size_t count : {3u, 8u, 20u}) {
        World world(world_def(60, 8));
        Humanoid human;
        human.let_particles_through();
        human.def.transform.position = fixed(0, 1, 0);
        lks_body_id bodies[LKS_HUMANOID_BONES];
        lks_joint_id joints[humanoid_joints];
        REQUIRE(human.add(world, bodies, joints) == LKS_OK);
        const Vector chest = state_of(world, bodies[LKS_HUMANOID_CHEST]).position;
        std::vector<Vector> places;
        for (std::size_t i = 0; i < count; ++i) {
            places.push_back({-0.1 + 0.2 * static_cast<double>(i) / static_cast<double>(count), 0.1, 0.1});
        }
        std::vector<Vector> there;
        for (const Vector& place : places) {
            there.push_back(chest + place);
        }
        const Asset asset = loose_points(there, std::vector<double>(count, 0.05));
        const lks_object_id points = world.add(asset, at(0, 0, 0));
        for (std::uint32_t i = 0; i < count; ++i) {
            world.pin(points, i);
            attach(world, to_body(points, i, bodies[LKS_HUMANOID_CHEST],
                                  fixed(places[i].x, places[i].y, places[i].z)));
        }
        double apart = 0;
        for (int tick = 0; tick < 300; ++tick) {
            world.step();
            for (const lks_joint_id joint : joints) {
                apart = std::max(apart, error_of(world, joint));
            }
        }
        INFO(count << " pins: " << 1e3 * apart << " mm apart");
        CHECK(apart < 1e-5);
        CHECK((state_of(world, bodies[LKS_HUMANOID_CHEST]).position - chest).length() < 0.15);
    }
}

TEST_CASE("who hangs on pinned vertices goes on as it was saved") {
    World world(world_def(60, 8));
    Hung hung(world, 2);
    world.step(7);
    const Image image = world.save();
    world.step(100);
    World other(world_def(60, 8));
    Hung same(other, 2);
    REQUIRE(lks_world_load(other, image.data(), image.size()) == LKS_OK);
    other.step(100);
    CHECK(other.hash() == world.hash());
}
