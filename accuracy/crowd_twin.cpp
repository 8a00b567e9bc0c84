#include "crowd_twin.h"

#include "our_crowd.h"
#include "reference/rigid_xpbd.h"

namespace lks_accuracy {
namespace {

reference::RigidModel model_of(const lks_bench::Crowd& crowd) {
    const lks_bench::OurCrowd ours(crowd, 1);
    reference::RigidModel model;
    lks_collider_def collider = lks_default_collider_def();
    collider.shape = LKS_SHAPE_PLANE;
    model.colliders.push_back(reference::rigid_collider(collider));
    collider.shape = LKS_SHAPE_BOX;
    for (const lks_bench::CrowdWall& wall : crowd.walls) {
        collider.half_extents = wall.half_extents;
        collider.transform.position = wall.position;
        model.colliders.push_back(reference::rigid_collider(collider));
    }
    for (std::size_t i = 0; i < ours.bodies().size(); ++i) {
        const auto index = static_cast<std::uint32_t>(i % crowd.bone_count);
        const lks_bone& bone = crowd.bones[index];
        lks_body_def def = bone.body;
        lks_fixed mass = 0;
        lks_body_transform(ours.world(), ours.bodies()[i], &def.transform);
        lks_body_velocity(ours.world(), ours.bodies()[i], &def.velocity, &def.angular_velocity);
        lks_body_mass(ours.world(), ours.bodies()[i], &mass);
        def.shapes = &crowd.shapes[index];
        def.shape_count = 1;
        model.bodies.push_back(reference::rigid_body(def, lks_fixed_to_double(mass)));
        model.bodies.back().touches_colliders = model.bodies.back().touches_bodies = true;
        if (bone.parent != LKS_NO_PARENT) {
            model.joints.push_back(reference::rigid_joint(reference::joint_of_bone(crowd.bones, index),
                                                          i - index + bone.parent, i));
        }
    }
    return model;
}

template <typename Scalar>
class TwinOf final : public CrowdTwin {
public:
    TwinOf(const reference::RigidModel& model, const reference::Settings& settings)
        : model_(model), settings_(settings), solver_(model, settings) {}

    void tick() override { solver_.tick(); }
    std::vector<double> joint_errors() const override {
        std::vector<double> errors;
        for (const reference::RigidJoint& joint : model_.joints) {
            errors.push_back((end(joint.a, joint.point_a) - end(joint.b, joint.point_b)).length());
        }
        return errors;
    }
    std::vector<support::Vector> positions() const override {
        std::vector<support::Vector> positions;
        for (std::size_t i = 0; i < solver_.size(); ++i) {
            positions.push_back(solver_.position(i));
        }
        return positions;
    }
    double energy() const override {
        double sum = solver_.kinetic_energy();
        for (std::size_t i = 0; i < model_.bodies.size(); ++i) {
            sum -= model_.bodies[i].mass * settings_.gravity.dot(solver_.position(i));
        }
        return sum;
    }

private:
    support::Vector end(std::size_t body, const support::Vector& point) const {
        const reference::Quaternion<double> q = reference::quaternion_of<double>(solver_.orientation(body));
        return solver_.position(body) + (q.matrix() * reference::Vector3<double>(point)).widened();
    }

    reference::RigidModel model_;
    reference::Settings settings_;
    reference::RigidSolver<Scalar> solver_;
};

} // namespace

std::unique_ptr<CrowdTwin> make_crowd_twin(const lks_bench::Crowd& crowd, const reference::Schedule& schedule,
                                           bool single) {
    reference::Settings settings;
    settings.substeps = schedule.substeps;
    settings.iterations = schedule.iterations;
    const reference::RigidModel model = model_of(crowd);
    if (single) {
        return std::make_unique<TwinOf<float>>(model, settings);
    }
    return std::make_unique<TwinOf<double>>(model, settings);
}

} // namespace lks_accuracy
