// Heavy and light side by side: along ropes, and across joints.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "reference/rigid_xpbd.h"
#include "stability/support/table.h"
#include "stability/support/trial.h"
#include "support/bodies.h"

using namespace support;
using namespace stability;

namespace {

constexpr double ratios[] = {10, 1e3, 1e6};

std::string ratio_name(double ratio) {
    return named("1:", ratio);
}

// A rope of 2 m, held at one end and let go when it is level.
void swing(const std::string& scene, const std::vector<double>& masses, double stretch, double end_stretch) {
    std::vector<double> points;
    for (std::size_t i = 0; i < masses.size(); ++i) {
        points.insert(points.end(),
                      {2.0 * static_cast<double>(i) / static_cast<double>(masses.size() - 1), 0, 0});
    }
    lks_rope_def def = lks_default_rope_def();
    def.segments = 0;
    def.length = 0;
    def.point_count = static_cast<std::uint32_t>(masses.size());
    def.points = points.data();
    def.mass = 0;
    def.linear_density = 0;
    def.vertex_masses = masses.data();
    def.stretch = stiff();
    def.bend = off;
    const Asset rope(def);
    Subject subject;
    subject.asset = &rope;
    subject.masses = masses;
    subject.materials = {stiff(), off, off};
    Trial trial(subject);
    trial.pin(0);
    trial.run(300);
    expect_stretch_at_most(scene, trial, stretch);
    expect_last_stretch_at_most(scene, trial, end_stretch);
    expect_gain_at_most(scene, trial, 0.1);
    expect_nothing_clamped(trial);
}

std::vector<double> alike(std::size_t count, double mass) {
    return std::vector<double>(count, mass);
}

// Capsules of 30 cm in a level chain, the last of them heavier.
struct JointChain {
    reference::RigidModel model;
    World world{world_def(60, 20)};
    std::vector<lks_body_id> bodies;
    std::vector<lks_joint_id> joints;

    JointChain(std::uint32_t links, double ratio) {
        lks_body_def anchor = lks_default_body_def();
        anchor.kind = LKS_BODY_KINEMATIC;
        add(ball_shape(0.05), anchor, 0);
        for (std::uint32_t i = 0; i < links; ++i) {
            lks_body_def def = lks_default_body_def();
            def.transform = turned(at(0.15 + 0.3 * i, 0, 0), 0, 0, 1, -90);
            const double mass = i + 1 == links ? ratio * 0.1 : 0.1;
            def.mass = support::fixed(mass);
            add(capsule_shape(0.03, 0.12), def, mass);
            lks_joint_def joint = lks_default_joint_def();
            joint.frame_a.position = support::fixed(0, i == 0 ? 0 : 0.15, 0);
            joint.frame_b.position = support::fixed(0, -0.15, 0);
            joints.push_back(add_joint(world, joint, bodies[i], bodies[i + 1]));
            model.joints.push_back(reference::rigid_joint(joint, i, i + 1));
        }
    }

    void add(const lks_body_shape& shape, lks_body_def def, double mass) {
        def.never_sleeps = 1;
        def.filter.mask = 0;
        def.shapes = &shape;
        def.shape_count = 1;
        lks_body_id id{};
        REQUIRE(lks_world_add_body(world, &def, &id) == LKS_OK);
        bodies.push_back(id);
        model.bodies.push_back(reference::rigid_body(def, shape, mass));
    }

    double gap() const {
        double greatest = 0;
        for (const lks_joint_id joint : joints) {
            lks_fixed error = 0;
            REQUIRE(lks_joint_error(world, joint, &error) == LKS_OK);
            greatest = std::max(greatest, metres(error));
        }
        return greatest;
    }

    template <typename Solver>
    double gap_of(const Solver& solver) const {
        const auto end = [&](std::size_t body, const Vector& point) {
            const reference::Rotation q = solver.orientation(body);
            const reference::Matrix<double> m = reference::quaternion_of<double>(q).matrix();
            return solver.position(body) + (m * reference::Vector3<double>(point)).widened();
        };
        double greatest = 0;
        for (const reference::RigidJoint& joint : model.joints) {
            const double apart = (end(joint.a, joint.point_a) - end(joint.b, joint.point_b)).length();
            if (!(apart <= greatest)) {
                greatest = apart;
            }
        }
        return greatest;
    }

    // Of all bodies, with height: nothing may come from nowhere.
    double energy() const {
        double sum = energy_of(world);
        for (std::size_t i = 1; i < bodies.size(); ++i) {
            sum += model.bodies[i].mass * 9.81 * state_of(world, bodies[i]).position.y;
        }
        return sum;
    }
};

void swing_joints(double ratio, double gap) {
    JointChain chain(8, ratio);
    reference::RigidSolver<float> twin(chain.model, reference::Settings{});
    const double start = chain.energy();
    double worst = 0, worst_twin = 0, kinetic = 0, highest = start;
    for (int tick = 0; tick < 300; ++tick) {
        chain.world.step();
        twin.tick();
        worst = std::max(worst, chain.gap());
        const double apart = chain.gap_of(twin);
        worst_twin = apart <= worst_twin ? worst_twin : apart;
        kinetic = std::max(kinetic, energy_of(chain.world));
        highest = std::max(highest, chain.energy());
    }
    const std::string scene = "8 links jointed, " + ratio_name(ratio) + " at the end";
    expect_at_most(scene, "joints apart, worst", "mm", gap, 1000 * worst, 1000 * worst_twin);
    expect_at_most(scene, "energy gained, of the greatest motion", "%", 0.1,
                   100 * (highest - start) / kinetic);
}

} // namespace

TEST_CASE("ropes with a heavy end hold it, as well as their solver can") {
    // The lightest is swept, the others are solved at once.
    const double worst[] = {10, 1e-4, 1e-3};
    const double at_end[] = {1, 1e-4, 1e-3};
    for (int i = 0; i < 3; ++i) {
        std::vector<double> masses = alike(21, 0.01);
        masses.back() *= ratios[i];
        swing("rope of 20, " + ratio_name(ratios[i]) + " at the end", masses, worst[i], at_end[i]);
    }
}

TEST_CASE("ropes with a light end, and with heavy and light in turn, hold") {
    const double worst[] = {0.1, 0.2, 0.05};
    for (int k = 0; k < 3; ++k) {
        const double ratio = ratios[k];
        std::vector<double> masses = alike(21, 0.01 * ratio);
        masses.back() = 0.01;
        swing("rope of 20, " + ratio_name(ratio) + ", the end light", masses, 0.02, 0.02);
        masses = alike(21, 0.01);
        for (std::size_t i = 1; i < masses.size(); i += 2) {
            masses[i] *= ratio;
        }
        swing("rope of 20, " + ratio_name(ratio) + " in turn", masses, worst[k], 1e-3);
    }
}

TEST_CASE("a rope of 99 whose masses are 1 : 10^6 at random holds") {
    Random random(5);
    std::vector<double> masses = alike(100, 0.01);
    for (double& mass : masses) {
        mass *= random.between(0, 4) < 2 ? ratios[2] : 1;
    }
    swing("rope of 99, " + ratio_name(ratios[2]) + " at random", masses, 0.2, 0.1);
}

TEST_CASE("a chain of jointed bodies holds a heavy end") {
    swing_joints(ratios[0], 1e-4);
    swing_joints(ratios[1], 1e-4);
    swing_joints(ratios[2], 0.2);
}
