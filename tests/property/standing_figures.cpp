// Figures that stand by their own strength.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "support/bodies.h"
#include "support/builders.h"
#include "support/sanitised.h"

using namespace support;

namespace {

// With its muscles at the rest pose.
struct Figure {
    Figure(World& in, bool spider) : world(in), count(spider ? LKS_SPIDER_BONES : LKS_HUMANOID_BONES) {
        REQUIRE((spider ? lks_spider(bones, shapes) : lks_humanoid(bones, shapes)) == LKS_OK);
        def.bone_count = count;
        def.bones = bones;
    }
    Figure(const Figure&) = delete;
    Figure& operator=(const Figure&) = delete;

    void add(double strength, double response) {
        bodies.resize(count);
        joints.resize(count - 1);
        REQUIRE(lks_world_add_ragdoll(world, &def, bodies.data(), joints.data()) == LKS_OK);
        pose.resize(count);
        REQUIRE(lks_ragdoll_pose(world, bodies.data(), count, pose.data()) == LKS_OK);
        drive(strength, response);
    }
    void drive(double strength, double response) {
        REQUIRE(lks_ragdoll_drive(world, &def, joints.data(), pose.data(), fixed(strength),
                                  fixed(response)) == LKS_OK);
    }
    // The most that an axis of a bone is turned in its parent from where the pose has it: degrees.
    double bent() const {
        const auto in_parent = [](const lks_rotation& parent, const lks_rotation& bone, const Vector& axis) {
            return rotate(conjugate(parent), rotate(bone, axis));
        };
        double most = 0;
        for (std::uint32_t i = 1; i < count; ++i) {
            const std::uint32_t parent = bones[i].parent;
            for (const Vector& axis : {Vector{1, 0, 0}, Vector{0, 1, 0}}) {
                const Vector now = in_parent(state_of(world, bodies[parent]).rotation,
                                             state_of(world, bodies[i]).rotation, axis);
                const Vector meant = in_parent(pose[parent].rotation, pose[i].rotation, axis);
                const double apart = std::hypot(now.x - meant.x, now.y - meant.y, now.z - meant.z);
                most = std::max(most, 2 * std::asin(apart / 2) * 180 / std::acos(-1.0));
            }
        }
        return most;
    }
    // The bone's joint to its parent, by five degrees.
    bool is_within_limits(std::uint32_t bone) const {
        lks_fixed swing = 0, twist = 0;
        REQUIRE(lks_joint_angles(world, joints[bone - 1], &swing, &twist) == LKS_OK);
        const lks_bone& b = bones[bone];
        return metres(swing) < metres(b.swing_limit) - 5 && metres(twist) > metres(b.twist_min) + 5 &&
               metres(twist) < metres(b.twist_max) - 5;
    }
    double apart() const {
        double most = 0;
        for (const lks_joint_id joint : joints) {
            most = std::max(most, error_of(world, joint));
        }
        return most;
    }
    double height() const { return state_of(world, bodies[0]).position.y; }

    World& world;
    std::uint32_t count;
    lks_bone bones[LKS_SPIDER_BONES]{};
    lks_body_shape shapes[LKS_SPIDER_BONES]{};
    lks_ragdoll_def def = lks_default_ragdoll_def();
    std::vector<lks_body_id> bodies;
    std::vector<lks_joint_id> joints;
    std::vector<lks_transform> pose;
};

} // namespace

// Before, whatever their strength, humanoids fell over at 4 and 8 substeps, and the spider sank by 3 cm at 8
// and to the ground at 4.
TEST_CASE("figures stand as their muscles hold them, and fall asleep") {
    for (const bool spider : {false, true}) {
        for (const double strength : {1., 5., 100.}) {
            for (const double response : {0., 0.05}) {
                for (const std::uint32_t substeps : {4u, 8u, 20u}) {
                    if (sanitised && (substeps != 8 || strength != 5)) {
                        continue;
                    }
                    World world(world_def(60, substeps));
                    add_ground(world);
                    Figure figure(world, spider);
                    figure.def.transform.position.y = fixed(0.01);
                    figure.add(strength, response);
                    world.step(420);
                    INFO((spider ? "spider" : "human")
                         << ", strength " << strength << ", response " << response << ", " << substeps
                         << " substeps: " << figure.height() << " m, bent by " << figure.bent() << "°");
                    CHECK(lks_world_awake_body_count(world) == 0);
                    CHECK(std::abs(figure.height() - (spider ? 0.22 : 0.99)) < 2e-4);
                    CHECK(figure.bent() < 0.05);
                    CHECK(figure.apart() < 1e-5);
                }
            }
        }
    }
}

TEST_CASE("no muscle turns with more than it has") {
    for (const double strength : {0.02, 0.05, 0.1, 0.5}) {
        for (const std::uint32_t substeps : {4u, 8u, 20u}) {
            World world(world_def(60, substeps));
            add_ground(world);
            Figure figure(world, true);
            figure.def.transform.position.y = fixed(0.02);
            figure.add(strength, 0.05);
            double most = 0;
            for (int tick = 0; tick < 180; ++tick) {
                world.step();
                for (std::uint32_t i = 1; i < figure.count; ++i) {
                    if (figure.is_within_limits(i)) { // these turn beside it
                        lks_vec3 torque{};
                        REQUIRE(lks_joint_load(world, figure.joints[i - 1], nullptr, &torque) == LKS_OK);
                        most =
                            std::max(most, std::hypot(metres(torque.x), metres(torque.y), metres(torque.z)) /
                                               (strength * metres(figure.bones[i].motor_torque)));
                    }
                }
            }
            INFO("strength " << strength << ", " << substeps << " substeps: " << most << " of it");
            CHECK(most < 1.001);
            CHECK(most > 0.3);
        }
    }
}

TEST_CASE("figures that are too weak sink down") {
    for (const std::uint32_t substeps : {4u, 8u, 20u}) {
        World world(world_def(60, substeps));
        add_ground(world);
        Figure figure(world, true);
        figure.add(0.02, 0.05);
        world.step(300);
        CHECK(figure.height() < 0.12);
    }
}

TEST_CASE("a figure that stands goes limp, and stretches again where it lies") {
    World world(world_def(60, 8));
    add_ground(world);
    Figure figure(world, false);
    figure.add(1, 0.05);
    world.step(60);
    CHECK(figure.height() > 0.98);
    figure.drive(0, 0.05);
    const lks_vec3 at_chest = lks_vec3(fixed(0, 1.4, 0));
    REQUIRE(lks_body_apply_impulse(world, figure.bodies[LKS_HUMANOID_CHEST], fixed(0, 0, -20), at_chest) ==
            LKS_OK);
    world.step(240);
    CHECK(figure.height() < 0.4);
    CHECK(figure.bent() > 10);
    figure.drive(1, 0.3);
    world.step(300);
    CHECK(figure.bent() < 5);
}

// Nothing of it throws limbs about: they move at most a little faster than they fall.
TEST_CASE("figures of any strength come down in any way") {
    for (std::uint64_t seed = 1; seed <= (sanitised ? 4 : 40); ++seed) {
        for (const bool spider : {false, true}) {
            for (const std::uint32_t substeps : {4u, 8u}) {
                Random random(seed);
                const auto any = [&random](double most) {
                    return most * 1e-6 * static_cast<double>(random.between(-1000000, 1000000));
                };
                World world(world_def(60, substeps));
                add_ground(world);
                Figure figure(world, spider);
                figure.def.transform.position.y = fixed(0.3 + std::abs(any(1)));
                figure.def.transform.rotation = about(any(1), any(1), any(1), any(60));
                figure.def.velocity = fixed(any(4), any(3), any(4));
                figure.add(std::pow(10, any(1.5)), seed % 2 == 0 ? 0 : 0.05);
                double fastest = 0, apart = 0;
                for (int tick = 0; tick < 300; ++tick) {
                    world.step();
                    for (const lks_body_id body : figure.bodies) {
                        const auto v = state_of(world, body).velocity;
                        fastest = std::max(fastest, std::hypot(v.x, v.y, v.z));
                    }
                    apart = std::max(apart, figure.apart());
                }
                INFO((spider ? "spider " : "human ") << seed << ", " << substeps << " substeps");
                CHECK(fastest < 20);
                CHECK(apart < 5e-3);
            }
        }
    }
}

namespace {

lks_body_id add_crate(World& world, double height, double half_height, double mass,
                      const lks_vec3& velocity = {}) {
    lks_body_def def = lks_default_body_def();
    def.mass = fixed(mass);
    def.velocity = velocity;
    return add_body(world, box_shape(0.8, half_height, 0.6), fixed(0, height, 0), def);
}

Vector momentum_of(const World& world) {
    Vector sum{};
    for (std::uint32_t i = 0; i < lks_world_body_count(world); ++i) {
        lks_body_id body{};
        REQUIRE(lks_world_body_at(world, i, &body) == LKS_OK);
        sum = sum + Vector(state_of(world, body).velocity) * mass_of(world, body);
    }
    return sum;
}

} // namespace

// Before, whatever the crate weighed, humanoids fell over at 4 and 8 substeps.
TEST_CASE("figures stand on crates of any mass, and on stacks of them") {
    for (const bool spider : {false, true}) {
        for (const double mass : {5., 50., 2000.}) {
            for (const int crates : {1, 3}) {
                for (const std::uint32_t substeps : {4u, 8u, 20u}) {
                    if (sanitised && (substeps != 8 || mass != 50)) {
                        continue;
                    }
                    World world(world_def(60, substeps));
                    add_ground(world);
                    for (int i = 0; i < crates; ++i) {
                        add_crate(world, 0.1 + 0.2 * i, 0.1, mass);
                    }
                    Figure figure(world, spider);
                    figure.def.transform.position.y = fixed(0.2 * crates + 0.005);
                    figure.add(1, 0.05);
                    world.step(480);
                    const double above = figure.height() - 0.2 * crates;
                    INFO((spider ? "spider" : "human")
                         << " on " << crates << " of " << mass << " kg, " << substeps
                         << " substeps: " << above << " m above, bent by " << figure.bent() << "°");
                    CHECK(lks_world_awake_body_count(world) == 0);
                    CHECK(std::abs(above - (spider ? 0.22 : 0.99)) < (crates == 1 ? 5e-4 : 5e-3));
                    CHECK(figure.bent() < 0.1);
                    CHECK(figure.apart() < 1e-5);
                }
            }
        }
    }
}

TEST_CASE("two humanoids stand on one crate, and one with a foot on each of two") {
    for (const bool apart : {false, true}) {
        for (const std::uint32_t substeps : {4u, 8u, 20u}) {
            if (sanitised && substeps != 8) {
                continue;
            }
            World world(world_def(60, substeps));
            add_ground(world);
            std::vector<std::unique_ptr<Figure>> figures;
            lks_body_def def = lks_default_body_def();
            def.mass = fixed(apart ? 3 : 60);
            for (const double x : {-0.13, 0.13}) {
                if (apart) {
                    add_body(world, box_shape(0.1, 0.1, 0.25), fixed(x, 0.1, 0.05), def);
                } else if (x < 0) {
                    add_body(world, box_shape(1.2, 0.1, 0.5), fixed(0, 0.1, 0), def);
                }
            }
            for (const double x : apart ? std::vector<double>{0} : std::vector<double>{-0.6, 0.6}) {
                figures.push_back(std::make_unique<Figure>(world, false));
                figures.back()->def.transform.position = fixed(x, 0.205, 0);
                figures.back()->add(1, 0.05);
            }
            world.step(480);
            INFO((apart ? "two crates, " : "one crate, ") << substeps << " substeps");
            for (const auto& figure : figures) {
                CHECK(std::abs(figure->height() - 1.19) < 5e-4);
            }
            CHECK(lks_world_awake_body_count(world) == 0);
        }
    }
}

TEST_CASE("figures keep their feet on crates that fall, and that slide") {
    for (const std::uint32_t substeps : {4u, 8u, 20u}) {
        for (const double fall : {0.1, 1., 5.}) {
            World world(world_def(60, substeps));
            add_ground(world);
            add_crate(world, 0.1 + fall, 0.1, 50);
            Figure figure(world, false);
            figure.def.transform.position.y = fixed(0.2 + fall);
            figure.add(1, 0.05);
            world.step(480);
            INFO(fall << " m, " << substeps << " substeps");
            CHECK(std::abs(figure.height() - 1.19) < 1e-3);
        }
        World world(world_def(60, substeps));
        add_ground(world);
        const lks_body_id crate = add_crate(world, 0.1, 0.1, 50, fixed(1.5, 0, 0));
        Figure figure(world, false);
        figure.def.transform.position.y = fixed(0.203);
        figure.add(1, 0.05);
        world.step(480);
        CHECK(std::abs(figure.height() - 1.19) < 5e-3);
        CHECK(state_of(world, crate).position.x > 0.04);
    }
}

TEST_CASE("who stands on a crate in flight moves it as much as it moves itself") {
    for (const std::uint32_t substeps : {4u, 8u, 20u}) {
        World world(world_def(60, substeps));
        add_crate(world, 0.1, 0.1, 20, fixed(0, 4, 0));
        Figure figure(world, false);
        figure.def.transform.position.y = fixed(0.2);
        figure.def.velocity = fixed(0, 2, 0); // it is struck from below
        figure.add(1, 0.05);
        const Vector start = momentum_of(world);
        for (int tick = 1; tick <= 30; ++tick) {
            world.step();
            const Vector now = momentum_of(world);
            INFO("tick " << tick << ", " << substeps << " substeps");
            CHECK(std::abs(now.x - start.x) < 0.02);
            CHECK(std::abs(now.y - start.y + 98 * 9.81 * tick / 60) < 0.1);
            CHECK(std::abs(now.z - start.z) < 0.02);
        }
        CHECK(start.y > 230);
    }
}

// Whether they hold or not.
TEST_CASE("a figure may step on what is thin, long, tiny, light or heavy") {
    const lks_body_shape shapes[] = {box_shape(20, 0.005, 0.05), box_shape(0.15, 0.002, 0.15),
                                     box_shape(30, 0.002, 30),   capsule_shape(0.01, 25),
                                     ball_shape(0.01),           ball_shape(15)};
    for (const lks_body_shape& shape : shapes) {
        for (const double mass : {0.001, 1., 1e5}) {
            for (const std::uint32_t substeps : {4u, 20u}) {
                if (sanitised && substeps != 4) {
                    continue;
                }
                World world(world_def(60, substeps));
                add_ground(world);
                lks_body_def def = lks_default_body_def();
                def.mass = fixed(mass);
                const double half =
                    shape.shape == LKS_SHAPE_BOX ? metres(shape.half_extents.y) : metres(shape.radius);
                def.transform.rotation =
                    shape.shape == LKS_SHAPE_CAPSULE ? about(0, 0, 1, 90) : about(0, 1, 0, 0);
                add_body(world, shape, fixed(0.095, half, 0.05), def);
                Figure figure(world, false);
                figure.def.transform.position = fixed(0, 2 * half + 0.01, 0);
                figure.add(1, 0.05);
                double fastest = 0;
                for (int tick = 0; tick < 120; ++tick) {
                    world.step();
                    for (const lks_body_id body : figure.bodies) {
                        const auto v = state_of(world, body).velocity;
                        fastest = std::max(fastest, std::hypot(v.x, v.y, v.z));
                    }
                }
                INFO("shape " << shape.shape << ", " << half << " m, " << mass << " kg, " << substeps
                              << " substeps: " << fastest << " m/s, " << 1e3 * figure.apart() << " mm apart");
                CHECK(fastest < 25);
                CHECK(figure.apart() < 1e-2);
            }
        }
    }
}

TEST_CASE("figures that stand go on as they were saved") {
    for (const bool spider : {false, true}) {
        World world(world_def(60, 8));
        add_ground(world);
        Figure figure(world, spider);
        figure.def.transform.position.y = fixed(0.05);
        figure.add(0.5, 0.05);
        world.step(8);
        const Image image = world.save();
        world.step(200);
        World other(world_def(60, 8));
        add_ground(other);
        Figure same(other, spider);
        same.add(0.5, 0.05);
        REQUIRE(lks_world_load(other, image.data(), image.size()) == LKS_OK);
        other.step(200);
        CHECK(other.hash() == world.hash());
    }
}
