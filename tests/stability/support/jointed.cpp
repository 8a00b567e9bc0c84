#include "stability/support/jointed.h"

#include <algorithm>

using namespace support;

namespace stability {

namespace {

reference::Settings settings_of(const lks_world_def& def) {
    reference::Settings settings;
    settings.tick_rate_hz = def.tick_rate_hz;
    settings.substeps = static_cast<int>(def.substeps);
    settings.iterations = static_cast<int>(def.iterations);
    settings.gravity = metres(def.gravity);
    return settings;
}

} // namespace

Jointed::Jointed(const lks_world_def& settings) : RigidScene(settings_of(settings)) {}

void Jointed::add_later(const lks_collider_def& collider) {
    world().add(collider);
    twin().add(reference::rigid_collider(collider));
}

void Jointed::add_chain(std::uint32_t links, double ratio, double damping) {
    std::size_t above = add_anchor({});
    for (std::uint32_t i = 0; i < links; ++i) {
        lks_body_def def = lks_default_body_def();
        def.transform = turned(at(0.15 + 0.3 * i, 0, 0), 0, 0, 1, -90);
        def.mass = fixed(i + 1 == links ? ratio * 0.1 : 0.1);
        def.linear_damping = def.angular_damping = fixed(damping);
        const std::size_t link = add(capsule_shape(0.03, 0.12), def);
        lks_joint_def joint = lks_default_joint_def();
        joint.frame_a.position = fixed(0, i == 0 ? 0 : 0.15, 0);
        joint.frame_b.position = fixed(0, -0.15, 0);
        join(joint, above, link);
        above = link;
    }
}

void Jointed::follow_motors() {
    for (std::size_t i = 0; i < joints().size(); ++i) {
        lks_motor motor{};
        REQUIRE(lks_joint_motor(world(), joints()[i], &motor) == LKS_OK);
        twin().drive(i, reference::rigid_motor(motor));
    }
}

void Jointed::step(int ticks) {
    for (int i = 0; i < ticks; ++i) {
        world().step();
        twin().tick();
    }
}

reference::RigidSolver<float>& Jointed::twin() const {
    if (twin_ == nullptr) {
        twin_ = std::make_unique<reference::RigidSolver<float>>(model(), settings());
    }
    return *twin_;
}

double Jointed::gap() const {
    double greatest = 0;
    for (const lks_joint_id joint : joints()) {
        lks_fixed error = 0;
        REQUIRE(lks_joint_error(world(), joint, &error) == LKS_OK);
        greatest = std::max(greatest, metres(error));
    }
    return greatest;
}

double Jointed::twin_gap() const {
    const auto end = [&](std::size_t body, const Vector& point) {
        const reference::Quaternion<double> q = reference::quaternion_of<double>(twin().orientation(body));
        return twin().position(body) + (q.matrix() * reference::Vector3<double>(point)).widened();
    };
    double greatest = 0;
    for (const reference::RigidJoint& joint : model().joints) {
        const double apart = (end(joint.a, joint.point_a) - end(joint.b, joint.point_b)).length();
        if (!(apart <= greatest)) {
            greatest = apart;
        }
    }
    return greatest;
}

double Jointed::energy() const {
    double sum = kinetic_energy();
    for (std::size_t i = 0; i < size(); ++i) {
        sum -= model().bodies[i].mass * settings().gravity.dot(position(i));
    }
    return sum;
}

double Jointed::twin_energy() const {
    double sum = twin_kinetic_energy();
    for (std::size_t i = 0; i < size(); ++i) {
        sum -= model().bodies[i].mass * settings().gravity.dot(twin_position(i));
    }
    return sum;
}

JointCourse run(Jointed& scene, int ticks) {
    JointCourse course;
    const double start = scene.energy();
    const double twin_start = scene.twin_energy();
    Worst kinetic, gained;
    for (int tick = 0; tick < ticks; ++tick) {
        scene.step();
        course.gap.add(scene.gap(), scene.twin_gap());
        kinetic.add(scene.kinetic_energy(), scene.twin_kinetic_energy());
        gained.add(scene.energy() - start, scene.twin_energy() - twin_start);
    }
    course.gained_share = {gained.fixed / kinetic.fixed, gained.single / kinetic.single};
    return course;
}

} // namespace stability
