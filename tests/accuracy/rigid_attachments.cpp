// How far bodies and the particles that are attached to them get from the same method in double precision,
// and float32 beside it.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "reference/rigid_bounds.h"

using namespace support;
using namespace reference;

namespace {

lks_attachment_def attachment(std::uint32_t vertex, const lks_vec3& point, double compliance = 0,
                              double damping = 0) {
    lks_attachment_def def = lks_default_attachment_def();
    def.vertex = vertex;
    def.point = point;
    def.compliance = fixed(compliance);
    def.damping = fixed(damping);
    return def;
}

// Level along x, held at one end by a pinned particle.
void add_held_rod(RigidScene& scene, double compliance, double damping) {
    const std::size_t points = scene.add_points({{0, 3, 0}, {0, 3.5, 0}}, {1, 1});
    scene.pin(points, 0);
    scene.pin(points, 1);
    lks_body_def def = at_rest(fixed(0.5, 3, 0));
    def.transform.rotation = about(0, 0, 1, 90);
    def.angular_velocity = fixed(2, 1, 0);
    def.velocity = fixed(0, 0, -0.5);
    const std::size_t rod = scene.add(capsule_shape(0.1, 0.4), def);
    scene.attach(attachment(0, fixed(0, 0.5, 0), compliance, damping), points, rod);
}

// Of ten centimetres a segment.
Chain rope(std::uint32_t segments, const Vector& direction, std::uint32_t solver) {
    Chain chain;
    chain.segments = segments;
    chain.length = 0.1 * segments;
    chain.particle_mass = 0.2;
    chain.direction = direction;
    chain.solver = solver;
    return chain;
}

} // namespace

TEST_CASE("a rod that a pinned particle holds, rigidly or softly, is within 1.2e-6 m after a second, 4e-5 m "
          "after ten") {
    for (const int substeps : {8, 20}) {
        {
            RigidScene scene(with_substeps(substeps));
            add_held_rod(scene, 0, 0);
            check_run("held rod" + substeps_name(substeps), scene, {1.2e-6, 1e-5, 300}, {1.2e-5, 8e-4, 100});
        }
        {
            RigidScene scene(with_substeps(substeps));
            add_held_rod(scene, 1.0 / 4096, 0);
            check_run("softly held rod" + substeps_name(substeps), scene, {5e-7, 2.5e-5, 500},
                      {1.2e-5, 5e-4, 300});
        }
        {
            RigidScene scene(with_substeps(substeps));
            add_held_rod(scene, 1.0 / 4096, 50);
            check_run("damped held rod" + substeps_name(substeps), scene, {5e-7, 8e-6, 1000},
                      {4e-5, 6e-4, 100});
        }
    }
}

TEST_CASE("a box that flies with two weights is within 1.5e-5 m after a second, 8e-5 m after two") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        const std::size_t points = scene.add_points({{0.1, 1.2, 0.1}, {-0.2, 0.9, 0}}, {2, 0.5});
        lks_body_def def = at_rest(fixed(0, 1, 0));
        def.velocity = fixed(1, 5, -1);
        def.angular_velocity = fixed(1, 3, 2);
        const std::size_t box = scene.add(box_shape(0.1, 0.2, 0.1), def);
        scene.attach(attachment(0, fixed(0.1, 0.2, 0.1)), points, box);
        scene.attach(attachment(1, fixed(-0.1, -0.1, 0), 1.0 / 1024, 5), points, box);
        const std::vector<RigidDeviation> d = scene.run({second, 2 * second});
        check("box with weights" + substeps_name(substeps) + ", 1 s", d[0], {1.5e-5, 1.5e-4, 100});
        check("box with weights" + substeps_name(substeps) + ", 2 s", d[1], {8e-5, 4e-4, 300});
    }
}

TEST_CASE("a ball that hangs on a rope is within 2e-7 m after a second, 7e-7 m after ten") {
    for (const std::uint32_t solver : {LKS_ROPE_SWEPT, LKS_ROPE_DIRECT}) {
        const std::string kind = solver == LKS_ROPE_SWEPT ? ", swept" : ", direct";
        for (const int substeps : {8, 20}) {
            RigidScene scene(with_substeps(substeps));
            const std::size_t line = scene.add_rope(rope(6, {1, -1, 0}, solver), fixed(0, 3, 0));
            scene.pin(line, 0);
            const double end = 0.6 / std::sqrt(2.0);
            const std::size_t ball = scene.add(ball_shape(0.1), at_rest(fixed(end, 2.9 - end, 0.03)));
            scene.attach(attachment(6, fixed(0, 0.1, -0.03)), line, ball);
            check_run("ball on a rope" + kind + substeps_name(substeps), scene, {2e-7, 5e-6, 5000},
                      {7e-7, 1.2e-4, 20000});
        }
    }
}

TEST_CASE(
    "a box that a hand pulls over the ground by a rope is within 6e-6 m after a second, 4e-4 m after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        scene.add_ground(0.5, 0.5, true);
        const std::size_t line = scene.add_rope(rope(5, {1, 0, 0}, LKS_ROPE_SWEPT), fixed(0.2, 0.2, 0.05));
        const std::size_t hand = scene.add_anchor(fixed(0.7, 0.2, 0.05));
        lks_body_def def = at_rest(fixed(0, 0.1, 0));
        def.static_friction = def.dynamic_friction = fixed(0.3);
        const std::size_t box = scene.add(box_shape(0.2, 0.1, 0.15), def);
        scene.attach(attachment(0, fixed(0.2, 0.1, 0.05)), line, box);
        scene.attach(attachment(5, {}), line, hand);
        const auto pull = [hand](RigidScene& s, int tick) {
            const double t = (tick + 1) / double(second);
            lks_transform target = lks_transform_identity();
            target.position = fixed(0.7 + 0.5 * t, 0.2 + 0.1 * std::sin(t), 0.05 + 0.2 * std::sin(t));
            s.lead_body(hand, target);
        };
        check_run("box on a rope" + substeps_name(substeps), scene, {6e-6, 3e-5, 10}, {4e-4, 8e-4, 5}, pull);
    }
}

TEST_CASE("an arm that holds a weight by two ropes tied together is within 2.5e-6 m after a second, 8e-5 m "
          "after two") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        std::size_t above = scene.add_anchor(fixed(0, 3, 0));
        for (int i = 0; i < 2; ++i) {
            lks_body_def def = at_rest(fixed(0.2 + 0.4 * i, 3, 0));
            def.transform.rotation = about(0, 0, 1, 90);
            const std::size_t bone = scene.add(capsule_shape(0.05, 0.15), def);
            scene.join(joint(i == 0 ? LKS_JOINT_BALL : LKS_JOINT_HINGE, fixed(0, i == 0 ? 0 : -0.2, 0),
                             fixed(0, 0.2, 0)),
                       above, bone);
            above = bone;
        }
        const std::size_t upper = scene.add_rope(rope(3, {0, -1, 0}, LKS_ROPE_SWEPT), fixed(0.8, 3, 0));
        const std::size_t lower = scene.add_rope(rope(3, {0, -1, 0}, LKS_ROPE_DIRECT), fixed(0.8, 2.7, 0));
        const std::size_t weight = scene.add(box_shape(0.05, 0.05, 0.05), at_rest(fixed(0.8, 2.35, 0.02)));
        scene.attach(attachment(0, fixed(0, -0.2, 0)), upper, above);
        lks_attachment_def tie = attachment(3, {});
        tie.other_vertex = 0;
        scene.attach_to_particle(tie, upper, lower);
        scene.attach(attachment(3, fixed(0, 0.05, -0.02)), lower, weight);
        const std::vector<RigidDeviation> d = scene.run({second, 2 * second});
        check("arm with a weight" + substeps_name(substeps) + ", 1 s", d[0], {2.5e-6, 8e-5, 5000});
        check("arm with a weight" + substeps_name(substeps) + ", 2 s", d[1], {8e-5, 8e-4, 3000});
    }
}

// What is tied is not lifted out of the ground as a whole.
TEST_CASE("two bones that lie deep in the ground and are tied are within 6e-7 m after half a second") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        scene.add_ground(0.5, 0.5, true);
        const std::size_t point = scene.add_points({{-0.25, 0.3, 0}, {0, 1, 0}}, {1, 1});
        scene.pin(point, 0);
        std::size_t bones[2];
        for (int i = 0; i < 2; ++i) {
            lks_body_def def = at_rest(fixed(0.4 * i, 0.046, 0));
            def.transform.rotation = about(0, 0, 1, 90);
            bones[i] = scene.add(capsule_shape(0.05, 0.15), def);
        }
        scene.join(joint(LKS_JOINT_BALL, fixed(0, -0.2, 0), fixed(0, 0.2, 0)), bones[0], bones[1]);
        scene.attach(attachment(0, fixed(0, 0.2, 0), 1.0 / 64, 5), point, bones[0]);
        check("tied bones" + substeps_name(substeps) + ", 0.5 s", scene.run({30}).back(), {6e-7, 3e-6, 1000});
    }
}

// Solved with the tree of its joints.
TEST_CASE("three bones between two pinned particles, one of them soft, are within 6e-6 m after a second") {
    for (const int substeps : {8, 20}) {
        for (const bool second_is_soft : {false, true}) {
            RigidScene scene(with_substeps(substeps));
            const std::size_t points = scene.add_points({{0, 2, 0}, {0.8, 1.8, 0}}, {0.1, 0.1});
            scene.pin(points, 0);
            scene.pin(points, 1);
            std::size_t bones[3];
            for (int i = 0; i < 3; ++i) {
                // Two lie level, and the last one hangs from their end.
                lks_body_def def = at_rest(i < 2 ? fixed(0.2 + 0.4 * i, 2, 0) : fixed(0.8, 1.8, 0));
                def.transform.rotation = about(0, 0, 1, i < 2 ? 90 : 0);
                def.velocity = fixed(0, 0, i);
                bones[i] = scene.add(capsule_shape(0.05, 0.15), def);
                if (i > 0) {
                    scene.join(
                        joint(i == 1 ? LKS_JOINT_HINGE : LKS_JOINT_BALL, fixed(0, -0.2, 0), fixed(0, 0.2, 0)),
                        bones[i - 1], bones[i]);
                }
            }
            scene.attach(attachment(0, fixed(0, 0.2, 0)), points, bones[0]);
            scene.attach(second_is_soft ? attachment(1, fixed(0, 0, 0), 1.0 / 4096, 5)
                                        : attachment(1, fixed(0, 0, 0)),
                         points, bones[2]);
            const std::string name =
                (second_is_soft ? "pinned bones, softly" : "pinned bones") + substeps_name(substeps);
            const std::vector<RigidDeviation> d = scene.run({second, 10 * second});
            check(name + ", 1 s", d[0], {6e-6, 3e-3, 100});
            check(name + ", 10 s", d[1], {4e-4, 0.2, 100});
        }
    }
}
