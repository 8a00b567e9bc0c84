#include "bullet_crowd.h"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>

namespace lks_bench {
namespace {

btVector3 vector(const lks_vec3& v) {
    return {btScalar(lks_fixed_to_double(v.x)), btScalar(lks_fixed_to_double(v.y)),
            btScalar(lks_fixed_to_double(v.z))};
}

btTransform transform(const lks_transform& t) {
    const btScalar unit = btScalar(1) / btScalar(LKS_ROTATION_ONE);
    return btTransform(btQuaternion(btScalar(t.rotation.x) * unit, btScalar(t.rotation.y) * unit,
                                    btScalar(t.rotation.z) * unit, btScalar(t.rotation.w) * unit),
                       vector(t.position));
}

btScalar radians(lks_fixed degrees) {
    return btScalar(lks_fixed_to_double(degrees) * std::acos(-1.0) / 180);
}

// The axis of a joint's frame, local y, as Bullet's cone-twist (x) and hinge (z) have theirs.
btTransform with_axis(const btTransform& frame, bool hinge) {
    const btQuaternion turn = hinge ? btQuaternion(btVector3(1, 0, 0), btScalar(-SIMD_HALF_PI))
                                    : btQuaternion(btVector3(0, 0, 1), btScalar(SIMD_HALF_PI));
    return frame * btTransform(turn);
}

class BulletCrowd final : public CrowdWorld {
public:
    BulletCrowd(const Crowd& crowd, int steps)
        : steps_(steps), dispatcher_(&configuration_),
          world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
        world_.setGravity(btVector3(0, btScalar(-9.81), 0));
        add(std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(0)), 0,
            btTransform::getIdentity());
        for (const CrowdWall& wall : crowd.walls) {
            add(std::make_unique<btBoxShape>(vector(wall.half_extents)), 0,
                btTransform(btQuaternion::getIdentity(), vector(wall.position)));
        }
        for (const lks_transform& place : crowd.places) {
            add_humanoid(crowd, transform(place));
        }
        for (const std::unique_ptr<btRigidBody>& body : bodies_) {
            if (body->getMass() > 0) {
                body->setLinearVelocity(vector(crowd.velocity));
            }
        }
    }
    ~BulletCrowd() override {
        for (const std::unique_ptr<btTypedConstraint>& joint : joints_) {
            world_.removeConstraint(joint.get());
        }
        for (const std::unique_ptr<btRigidBody>& body : bodies_) {
            world_.removeRigidBody(body.get());
        }
    }

    void tick() override {
        for (int i = 0; i < steps_; ++i) {
            world_.stepSimulation(btScalar(1) / btScalar(60 * steps_), 0);
        }
    }
    std::vector<double> joint_errors() const override {
        std::vector<double> errors;
        for (const std::unique_ptr<btTypedConstraint>& joint : joints_) {
            btVector3 a, b;
            if (joint->getConstraintType() == CONETWIST_CONSTRAINT_TYPE) {
                const auto* cone = static_cast<const btConeTwistConstraint*>(joint.get());
                a = cone->getAFrame().getOrigin();
                b = cone->getBFrame().getOrigin();
            } else {
                auto* hinge = static_cast<btHingeConstraint*>(joint.get());
                a = hinge->getAFrame().getOrigin();
                b = hinge->getBFrame().getOrigin();
            }
            errors.push_back((joint->getRigidBodyA().getWorldTransform() * a -
                              joint->getRigidBodyB().getWorldTransform() * b)
                                 .length());
        }
        return errors;
    }

    std::vector<double> limit_errors() const override {
        std::vector<double> errors;
        for (std::size_t i = 0; i < joints_.size(); ++i) {
            const Limited& limited = limited_[i];
            const btTransform a = joints_[i]->getRigidBodyA().getWorldTransform() * limited.in_parent;
            const btTransform b = joints_[i]->getRigidBodyB().getWorldTransform() * limited.in_child;
            const btQuaternion between = (a.inverse() * b).getRotation();
            const double along = double(between.y()) * between.y() + double(between.w()) * between.w();
            const double swing = 2 * std::atan2(std::sqrt(std::max(0.0, 1 - along)), std::sqrt(along));
            double twist = 2 * std::atan2(double(between.y()), double(between.w()));
            twist = std::remainder(twist, 2 * std::acos(-1.0));
            errors.push_back(degrees_beyond(limited.bone, degrees(swing), degrees(twist)));
        }
        return errors;
    }

    std::size_t contacts() const override {
        std::size_t count = 0;
        for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
            count += touch(*dispatcher_.getManifoldByIndexInternal(i)) ? 1 : 0;
        }
        return count;
    }

    double energy() const override {
        double sum = 0;
        for (const std::unique_ptr<btRigidBody>& body : bodies_) {
            if (body->getMass() > 0) {
                const btVector3 spin =
                    body->getWorldTransform().getBasis().transpose() * body->getAngularVelocity();
                const btVector3 momentum = spin / body->getInvInertiaDiagLocal();
                sum += body->getMass() * (body->getLinearVelocity().length2() / 2 +
                                          btScalar(9.81) * body->getWorldTransform().getOrigin().y()) +
                       spin.dot(momentum) / 2;
            }
        }
        return sum;
    }

private:
    // A joint's bone, and its frames as we have them.
    struct Limited {
        lks_bone bone;
        btTransform in_parent;
        btTransform in_child;
    };

    static double degrees(double radians) { return radians * 180 / std::acos(-1.0); }

    static bool touch(const btPersistentManifold& manifold) {
        for (int i = 0; i < manifold.getNumContacts(); ++i) {
            if (manifold.getContactPoint(i).getDistance() <= 0) {
                return true;
            }
        }
        return false;
    }

    btRigidBody* add(std::unique_ptr<btCollisionShape> shape, btScalar mass, const btTransform& place) {
        btVector3 inertia(0, 0, 0);
        if (mass > 0) {
            shape->calculateLocalInertia(mass, inertia);
        }
        btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape.get(), inertia);
        info.m_startWorldTransform = place;
        info.m_friction = std::sqrt(btScalar(0.5)); // it multiplies two bodies' coefficients
        shapes_.push_back(std::move(shape));
        bodies_.push_back(std::make_unique<btRigidBody>(info));
        bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
        world_.addRigidBody(bodies_.back().get());
        return bodies_.back().get();
    }

    static std::unique_ptr<btCollisionShape> shape_of(const lks_body_shape& shape) {
        if (shape.shape == LKS_SHAPE_BOX) {
            return std::make_unique<btBoxShape>(vector(shape.half_extents));
        }
        return std::make_unique<btCapsuleShape>(btScalar(lks_fixed_to_double(shape.radius)),
                                                btScalar(2 * lks_fixed_to_double(shape.half_length)));
    }

    void add_humanoid(const Crowd& crowd, const btTransform& place) {
        btRigidBody* bodies[LKS_HUMANOID_BONES];
        for (std::uint32_t i = 0; i < crowd.bone_count; ++i) {
            const lks_bone& bone = crowd.bones[i];
            bodies[i] = add(shape_of(*bone.body.shapes), btScalar(lks_fixed_to_double(bone.body.mass)),
                            place * transform(bone.body.transform));
            if (i > 0) {
                add_joint(bone, place, *bodies[bone.parent], *bodies[i]);
            }
        }
    }

    void add_joint(const lks_bone& bone, const btTransform& place, btRigidBody& parent, btRigidBody& child) {
        const bool hinge = bone.joint_kind == LKS_JOINT_HINGE;
        const btTransform frame = with_axis(place * transform(bone.joint_frame), hinge);
        const btTransform in_parent = parent.getWorldTransform().inverse() * frame;
        const btTransform in_child = child.getWorldTransform().inverse() * frame;
        if (hinge) {
            auto joint = std::make_unique<btHingeConstraint>(parent, child, in_parent, in_child);
            // It measures how a is turned in b.
            joint->setLimit(-radians(bone.twist_max), -radians(bone.twist_min));
            joints_.push_back(std::move(joint));
        } else {
            auto joint = std::make_unique<btConeTwistConstraint>(parent, child, in_parent, in_child);
            joint->setLimit(radians(bone.swing_limit), radians(bone.swing_limit), radians(bone.twist_max));
            joints_.push_back(std::move(joint));
        }
        world_.addConstraint(joints_.back().get(), true);
        const btTransform ours = place * transform(bone.joint_frame);
        limited_.push_back(
            {bone, parent.getWorldTransform().inverse() * ours, child.getWorldTransform().inverse() * ours});
    }

    int steps_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_;
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
    std::vector<std::unique_ptr<btTypedConstraint>> joints_;
    std::vector<Limited> limited_; // beside them
};

} // namespace

std::unique_ptr<CrowdWorld> make_bullet_crowd(const Crowd& crowd, int steps) {
    return std::make_unique<BulletCrowd>(crowd, steps);
}

} // namespace lks_bench
