#include "stability/support/jointed.h"

#include <algorithm>

using namespace support;

namespace stability {

Jointed::Jointed(const lks_world_def& settings) : world_(settings) {
    settings_.tick_rate_hz = settings.tick_rate_hz;
    settings_.substeps = static_cast<int>(settings.substeps);
    settings_.iterations = static_cast<int>(settings.iterations);
    settings_.gravity = metres(settings.gravity);
}

void Jointed::add_ground(double friction) {
    lks_collider_def def = lks_default_collider_def();
    def.shape = LKS_SHAPE_PLANE;
    def.static_friction = def.dynamic_friction = fixed(friction);
    world_.add(def);
    model_.planes.push_back(reference::rigid_plane(def));
    touches_ground_ = true;
}

std::size_t Jointed::add(const lks_body_shape& shape, lks_body_def def) {
    def.never_sleeps = 1;
    // Of one group, they don't touch each other.
    def.filter.group = -1;
    if (!touches_ground_) {
        def.filter.mask = 0;
    }
    ids_.push_back(add_body(world_, shape, def.transform.position, def));
    model_.bodies.push_back(reference::rigid_body(def, shape, mass_of(world_, ids_.back())));
    model_.bodies.back().touches_planes = touches_ground_;
    return ids_.size() - 1;
}

std::size_t Jointed::add_anchor(const lks_vec3& position) {
    lks_body_def def = lks_default_body_def();
    def.kind = LKS_BODY_KINEMATIC;
    def.transform.position = position;
    return add(ball_shape(0.05), def);
}

void Jointed::join(const lks_joint_def& def, std::size_t a, std::size_t b) {
    joints_.push_back(add_joint(world_, def, ids_[a], ids_[b]));
    model_.joints.push_back(reference::rigid_joint(def, a, b));
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

void Jointed::step(int ticks) {
    twin();
    for (int i = 0; i < ticks; ++i) {
        world_.step();
        twin_->tick();
    }
}

const reference::RigidSolver<float>& Jointed::twin() const {
    if (twin_ == nullptr) {
        twin_ = std::make_unique<reference::RigidSolver<float>>(model_, settings_);
    }
    return *twin_;
}

double Jointed::gap() const {
    double greatest = 0;
    for (const lks_joint_id joint : joints_) {
        lks_fixed error = 0;
        REQUIRE(lks_joint_error(world_, joint, &error) == LKS_OK);
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
    for (const reference::RigidJoint& joint : model_.joints) {
        const double apart = (end(joint.a, joint.point_a) - end(joint.b, joint.point_b)).length();
        if (!(apart <= greatest)) {
            greatest = apart;
        }
    }
    return greatest;
}

double Jointed::energy() const {
    double sum = kinetic_energy();
    for (std::size_t i = 0; i < ids_.size(); ++i) {
        sum -= model_.bodies[i].mass * settings_.gravity.dot(position(i));
    }
    return sum;
}

double Jointed::twin_energy() const {
    double sum = twin_kinetic_energy();
    for (std::size_t i = 0; i < ids_.size(); ++i) {
        sum -= model_.bodies[i].mass * settings_.gravity.dot(twin_position(i));
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
