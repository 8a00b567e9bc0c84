// Motors whose target is beyond their joint's limits go to what is next to it within them
// (sdk/src/rigid/motor_aim.h).
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/bodies.h"

using namespace support;

namespace {

constexpr double degree = std::numbers::pi / 180;

// First a twist about y, then a swing of y towards an azimuth, which is measured from x to z: degrees.
lks_rotation turn_of(double swing, double azimuth, double twist) {
    const double sine = std::sin(swing / 2 * degree);
    const double x = std::sin(azimuth * degree) * sine;
    const double z = -std::cos(azimuth * degree) * sine;
    const double w = std::cos(swing / 2 * degree);
    const double t_y = std::sin(twist / 2 * degree);
    const double t_w = std::cos(twist / 2 * degree);
    const auto part = [](double c) { return static_cast<std::int32_t>(std::lround(c * LKS_ROTATION_ONE)); };
    return {part(x * t_w - z * t_y), part(w * t_y), part(z * t_w + x * t_y), part(w * t_w)};
}

double degrees_between(const lks_rotation& a, const lks_rotation& b) {
    // By the sine, which tells small angles.
    const double x = 1.0 * a.w * b.x - 1.0 * a.x * b.w - 1.0 * a.y * b.z + 1.0 * a.z * b.y;
    const double y = 1.0 * a.w * b.y - 1.0 * a.y * b.w - 1.0 * a.z * b.x + 1.0 * a.x * b.z;
    const double z = 1.0 * a.w * b.z - 1.0 * a.z * b.w - 1.0 * a.x * b.y + 1.0 * a.y * b.x;
    const double w = 1.0 * a.x * b.x + 1.0 * a.y * b.y + 1.0 * a.z * b.z + 1.0 * a.w * b.w;
    return 2 * std::atan2(Vector{x, y, z}.length(), std::abs(w)) / degree;
}

// A limb without weight on a post, both frames at rest: how it is turned is how the joint is.
struct Limb {
    explicit Limb(const lks_joint_def& def, std::uint32_t substeps = 8) : world(weightless(substeps)) {
        limb = add_body(world, capsule_shape(0.05, 0.2), fixed(0, 0.25, 0));
        lks_joint_def joint_def = def;
        joint_def.frame_b.position = fixed(0, -0.25, 0);
        joint = add_joint(world, joint_def, add_anchor(world, {}), limb);
    }
    void aim(const lks_rotation& target, double torque = 50) {
        const lks_motor motor{fixed(torque), fixed(0.05), target};
        REQUIRE(lks_joint_set_motor(world, joint, &motor) == LKS_OK);
    }
    lks_rotation rotation() const { return state_of(world, limb).rotation; }

    World world;
    lks_body_id limb{};
    lks_joint_id joint{};
};

lks_joint_def limited(double swing_x, double swing_z, double twist_min, double twist_max) {
    lks_joint_def def = lks_default_joint_def();
    def.swing_limit = fixed(swing_x);
    def.swing_limit_z = fixed(swing_z);
    def.twist_min = fixed(twist_min);
    def.twist_max = fixed(twist_max);
    return def;
}

// Degrees towards x and z.
struct OnPlane {
    double x, z;
};

// Of an ellipse, by trying.
OnPlane nearest_on_edge(double half_x, double half_z, const OnPlane& p) {
    OnPlane best{};
    double least = 1e9;
    for (int i = 0; i < 36000; ++i) {
        const OnPlane e{half_x * std::cos(i * 0.01 * degree), half_z * std::sin(i * 0.01 * degree)};
        const double apart = std::hypot(p.x - e.x, p.z - e.z);
        best = apart < least ? e : best;
        least = std::min(least, apart);
    }
    return best;
}

// A humanoid in flight, one of whose joints aims so far beyond its limits; bones don't collide.
struct Flight {
    Flight(int bone, const lks_rotation& target, std::uint32_t substeps) : world(weightless(substeps)) {
        Humanoid human;
        for (lks_bone& each : human.bones) {
            each.body.never_sleeps = 1;
            each.body.linear_damping = each.body.angular_damping = 0;
        }
        human.def.group = -1;
        lks_body_id bodies[LKS_HUMANOID_BONES];
        lks_joint_id joints[LKS_HUMANOID_BONES - 1];
        REQUIRE(human.add(world, bodies, joints) == LKS_OK);
        moved = human.bones[bone];
        joint = joints[bone - 1];
        aim(target);
    }
    void aim(const lks_rotation& target) {
        const lks_motor motor{moved.motor_torque, fixed(0.05), target};
        REQUIRE(lks_joint_set_motor(world, joint, &motor) == LKS_OK);
    }

    World world;
    lks_bone moved;
    lks_joint_id joint{};
};

} // namespace

TEST_CASE("a motor that aims beyond its joint's limits turns no figure in flight") {
    struct Aim {
        int bone;
        double swing, azimuth, twist;
    };
    // A foot by 120 degrees, and so on.
    for (const Aim& aim : {Aim{LKS_HUMANOID_FOOT_LEFT, 150, 90, 0}, Aim{LKS_HUMANOID_FOOT_RIGHT, 150, 200, 0},
                           Aim{LKS_HUMANOID_FOOT_LEFT, 0, 0, 135}, Aim{LKS_HUMANOID_HAND_LEFT, 150, 30, 60},
                           Aim{LKS_HUMANOID_CHEST, 90, 45, -90}, Aim{LKS_HUMANOID_UPPER_LEG_LEFT, 120, 0, 0},
                           Aim{LKS_HUMANOID_LOWER_LEG_RIGHT, 0, 0, 230}}) {
        for (const std::uint32_t substeps : {1u, 4u, 8u, 20u}) {
            CAPTURE(aim.bone);
            CAPTURE(aim.swing);
            CAPTURE(substeps);
            Flight flight(aim.bone, turn_of(aim.swing, aim.azimuth, aim.twist), substeps);
            double beyond = 0;
            for (int tick = 0; tick < 300; ++tick) {
                flight.world.step();
                beyond = std::max(beyond, degrees_beyond(flight.world, flight.moved, flight.joint));
            }
            // A knee of 200 N·m that bends by 140 degrees at once leaves that much.
            CHECK(energy_of(flight.world) < (aim.bone == LKS_HUMANOID_LOWER_LEG_RIGHT ? 0.1 : 0.001));
            CHECK(beyond < 0.6);
        }
    }
}

TEST_CASE("a motor whose shortest way leads out of its limits goes along them") {
    for (const std::uint32_t substeps : {4u, 8u, 20u}) {
        CAPTURE(substeps);
        // The shortest way is swung by up to 144 degrees.
        Limb limb(limited(120, -1, -180, 180), substeps);
        limb.aim(turn_of(115, 0, 0));
        limb.world.step(120);
        limb.aim(turn_of(115, 140, 0));
        double beyond = 0;
        for (int tick = 0; tick < 300; ++tick) {
            limb.world.step();
            lks_fixed swing = 0;
            REQUIRE(lks_joint_angles(limb.world, limb.joint, &swing, nullptr) == LKS_OK);
            beyond = std::max(beyond, metres(swing) - 120);
        }
        CHECK(beyond < 0.1);
        CHECK(degrees_between(limb.rotation(), turn_of(115, 140, 0)) < 0.01);
    }
}

TEST_CASE("a shoulder that can't get to where it aims turns no figure in flight") {
    for (const std::uint32_t substeps : {4u, 8u, 20u}) {
        CAPTURE(substeps);
        Flight flight(LKS_HUMANOID_UPPER_ARM_LEFT, turn_of(92, 10, 50), substeps);
        flight.world.step(120);
        flight.aim(turn_of(92, 188, -50));
        flight.world.step(300);
        CHECK(energy_of(flight.world) < 0.1);
    }
}

TEST_CASE("a ball joint's motor that aims beyond a cone and its twist ends at their edges") {
    for (const double swing : {50.0, 100.0, 150.0, 179.9}) {
        for (const double azimuth : {0.0, 70.0, 135.0, 250.0}) {
            for (const double twist : {-110.0, 5.0, 80.0}) {
                CAPTURE(swing);
                CAPTURE(azimuth);
                CAPTURE(twist);
                Limb limb(limited(40, -1, -20, 30));
                limb.aim(turn_of(swing, azimuth, twist));
                limb.world.step(120);
                const lks_rotation nearest = turn_of(40, azimuth, std::clamp(twist, -20.0, 30.0));
                CHECK(degrees_between(limb.rotation(), nearest) < 0.01);
            }
        }
    }
}

TEST_CASE("a motor that aims beyond an ellipse ends where its edge is next") {
    for (const OnPlane& half : {OnPlane{60, 20}, OnPlane{20, 60}, OnPlane{0, 45}}) {
        for (const OnPlane& aim : {OnPlane{70, 40}, OnPlane{-30, 50}, OnPlane{15, -19}, OnPlane{-40, 100}}) {
            CAPTURE(half.x);
            CAPTURE(half.z);
            CAPTURE(aim.x);
            Limb limb(limited(half.x, half.z, -180, 180));
            limb.aim(turn_of(std::hypot(aim.x, aim.z), std::atan2(aim.z, aim.x) / degree, 0));
            limb.world.step(240);
            const double x = std::max(half.x, 0.05); // as thin as a limit gets
            const double z = std::max(half.z, 0.05);
            const bool within = std::pow(aim.x / x, 2) + std::pow(aim.z / z, 2) < 1;
            const OnPlane end = within ? aim : nearest_on_edge(x, z, aim);
            const lks_rotation expected =
                turn_of(std::hypot(end.x, end.z), std::atan2(end.z, end.x) / degree, 0);
            CHECK(degrees_between(limb.rotation(), expected) < 0.05);
        }
    }
}

TEST_CASE("a hinge's motor that aims beyond its limits goes to the nearer one") {
    struct Way {
        double least, most, target, ends;
    };
    for (const Way& way :
         {Way{-140, 0, 30, 0}, Way{-140, 0, -160, -140}, Way{-140, 0, 170, -140}, Way{0, 180, -80, 0},
          Way{0, 180, -100, 180}, Way{-170, 170, 175, 170}, Way{90, 175, -176, 175}, Way{40, 40, 100, 40}}) {
        CAPTURE(way.least);
        CAPTURE(way.target);
        lks_joint_def def = limited(180, -1, way.least, way.most);
        def.kind = LKS_JOINT_HINGE;
        Limb limb(def);
        REQUIRE(lks_body_set_transform(limb.world, limb.limb,
                                       {fixed(0, 0.25, 0), about(0, 1, 0, (way.least + way.most) / 2)}) ==
                LKS_OK);
        limb.aim(about(0, 1, 0, way.target));
        limb.world.step(120);
        CHECK(degrees_between(limb.rotation(), about(0, 1, 0, way.ends)) < 0.01);
    }
}

TEST_CASE("a motor keeps its target, and goes on to it where limits open") {
    Limb limb(limited(40, -1, -20, 20));
    const lks_rotation target = turn_of(100, 30, 50);
    limb.aim(target);
    limb.world.step(120);
    CHECK(degrees_between(limb.rotation(), turn_of(40, 30, 20)) < 0.01);
    lks_motor motor{};
    REQUIRE(lks_joint_motor(limb.world, limb.joint, &motor) == LKS_OK);
    CHECK(degrees_between(motor.target, target) < 1e-6);
    lks_limits limits{};
    REQUIRE(lks_joint_limits(limb.world, limb.joint, &limits) == LKS_OK);
    limits.swing_limit = fixed(70);
    limits.twist_max = fixed(90);
    REQUIRE(lks_joint_set_limits(limb.world, limb.joint, &limits) == LKS_OK);
    limb.world.step(120);
    CHECK(degrees_between(limb.rotation(), turn_of(70, 30, 50)) < 0.01);
    // Other limits from an image.
    std::size_t size = 0;
    REQUIRE(lks_world_save_size(limb.world, &size) == LKS_OK);
    Image image(size);
    REQUIRE(lks_world_save(limb.world, image.data(), image.size(), &size) == LKS_OK);
    Limb narrow(limited(10, -1, -5, 5));
    narrow.aim(target);
    narrow.world.step(10);
    REQUIRE(lks_world_load(narrow.world, image.data(), image.size()) == LKS_OK);
    limb.world.step(10);
    narrow.world.step(10);
    CHECK(narrow.world.hash() == limb.world.hash());
    limits.swing_limit = fixed(180);
    REQUIRE(lks_joint_set_limits(limb.world, limb.joint, &limits) == LKS_OK);
    limb.world.step(120);
    CHECK(degrees_between(limb.rotation(), target) < 0.01);
}

TEST_CASE("into soft limits a motor pushes with its torque") {
    lks_joint_def def = limited(40, -1, -180, 180);
    def.limit_compliance = fixed(0.02);
    def.limit_damping = fixed(1);
    Limb limb(def, 20);
    limb.aim(turn_of(120, 30, 0), 5);
    limb.world.step(300);
    const double bent = 0.02 * 5 / degree;
    CHECK(degrees_between(limb.rotation(), turn_of(40 + bent, 30, 0)) < 0.1 * bent);
}
