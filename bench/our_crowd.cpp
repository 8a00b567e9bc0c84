#include "our_crowd.h"

namespace lks_bench {

OurCrowd::OurCrowd(const Crowd& crowd, std::uint32_t substeps, std::uint32_t iterations,
                   std::uint32_t workers) {
    lks_world_def def = lks_default_world_def();
    def.substeps = substeps;
    def.iterations = iterations;
    def.worker_count = workers;
    lks_world_create(&def, &world_);
    lks_collider_def ground = lks_default_collider_def();
    ground.shape = LKS_SHAPE_PLANE;
    lks_collider_id collider{};
    lks_world_add_collider(world_, &ground, &collider);
    for (const CrowdWall& wall : crowd.walls) {
        lks_collider_def def = lks_default_collider_def();
        def.shape = LKS_SHAPE_BOX;
        def.half_extents = wall.half_extents;
        def.transform.position = wall.position;
        lks_world_add_collider(world_, &def, &collider);
    }
    lks_ragdoll_def ragdoll = lks_default_ragdoll_def();
    ragdoll.bones = crowd.bones;
    ragdoll.bone_count = crowd.bone_count;
    ragdoll.velocity = crowd.velocity;
    for (const lks_transform& place : crowd.places) {
        ragdoll.transform = place;
        lks_body_id bodies[LKS_HUMANOID_BONES];
        lks_joint_id joints[LKS_HUMANOID_BONES - 1];
        lks_world_add_ragdoll(world_, &ragdoll, bodies, joints);
        bodies_.insert(bodies_.end(), bodies, bodies + crowd.bone_count);
        joints_.insert(joints_.end(), joints, joints + crowd.bone_count - 1);
        bones_.insert(bones_.end(), crowd.bones + 1, crowd.bones + crowd.bone_count);
    }
    for (const lks_body_id body : bodies_) {
        lks_fixed mass = 0;
        lks_body_mass(world_, body, &mass);
        masses_.push_back(lks_fixed_to_double(mass));
    }
}

std::vector<double> OurCrowd::joint_errors() const {
    std::vector<double> errors;
    for (const lks_joint_id joint : joints_) {
        lks_fixed error = 0;
        lks_joint_error(world_, joint, &error);
        errors.push_back(lks_fixed_to_double(error));
    }
    return errors;
}

std::vector<double> OurCrowd::limit_errors() const {
    std::vector<double> errors;
    for (std::size_t i = 0; i < joints_.size(); ++i) {
        lks_fixed swing = 0;
        lks_fixed twist = 0;
        lks_joint_angles(world_, joints_[i], &swing, &twist);
        errors.push_back(degrees_beyond(bones_[i], lks_fixed_to_double(swing), lks_fixed_to_double(twist)));
    }
    return errors;
}

double OurCrowd::energy() const {
    lks_fixed kinetic = 0;
    lks_world_kinetic_energy(world_, &kinetic);
    double sum = lks_fixed_to_double(kinetic);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        lks_transform transform;
        lks_body_transform(world_, bodies_[i], &transform);
        sum += masses_[i] * 9.81 * lks_fixed_to_double(transform.position.y);
    }
    return sum;
}

} // namespace lks_bench
