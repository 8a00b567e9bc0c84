#include "bullet_peer.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyInternals.h>

#include "peer_check.h"

namespace lks_bench {
namespace {

class Bullet final : public Variant {
public:
    Bullet(const FloatCloth& shape, std::uint32_t objects, std::uint32_t substeps, std::uint32_t iterations,
           double damping, const BulletBall& ball)
        : substeps_(substeps), iterations_(iterations) {
        info_.m_gravity = btVector3(0, btScalar(-9.81), 0);
        info_.air_density = 0;
        info_.m_sparsesdf.Initialize();
        if (ball.radius > 0) {
            add_ball(ball);
        }
        for (std::uint32_t i = 0; i < objects; ++i) {
            bodies_.push_back(make_body(shape));
            bodies_.back()->m_cfg.kDP = btScalar(damping / (60 * substeps));
        }
    }

    void project() override {
        for (const std::unique_ptr<btSoftBody>& body : bodies_) {
            for (std::uint32_t pass = 0; pass < substeps_ * iterations_; ++pass) {
                btSoftBody::PSolve_Links(body.get(), 1, 0);
            }
        }
    }
    void tick() override {
        for (const std::unique_ptr<btSoftBody>& body : bodies_) {
            for (std::uint32_t substep = 0; substep < substeps_; ++substep) {
                body->predictMotion(btScalar(1) / btScalar(60 * substeps_));
                if (ball_shape_ != nullptr) {
                    const btCollisionObjectWrapper ball(nullptr, ball_shape_.get(), &ball_,
                                                        ball_.getWorldTransform(), -1, -1);
                    body->defaultCollisionHandler(&ball);
                }
                body->solveConstraints();
                body->integrateMotion();
            }
        }
    }
    std::vector<Point> points() const override {
        std::vector<Point> found;
        const btSoftBody& body = *bodies_.front();
        for (int i = 0; i < body.m_nodes.size(); ++i) {
            const btVector3& x = body.m_nodes[i].m_x;
            found.push_back({x.x(), x.y(), x.z()});
        }
        return found;
    }

private:
    // Bullet's own contact, by a field of distances: as fine as leaves it a tenth of a millimetre.
    void add_ball(const BulletBall& ball) {
        info_.m_sparsesdf.m_defaultVoxelsz = btScalar(0.02);
        info_.m_sparsesdf.Reset();
        ball_shape_ = std::make_unique<btSphereShape>(btScalar(ball.radius));
        ball_.setCollisionShape(ball_shape_.get());
        btTransform place = btTransform::getIdentity();
        place.setOrigin(btVector3(btScalar(ball.centre.x), btScalar(ball.centre.y), btScalar(ball.centre.z)));
        ball_.setWorldTransform(place);
        ball_.setFriction(0);
    }

    std::unique_ptr<btSoftBody> make_body(const FloatCloth& shape) {
        std::vector<btVector3> places;
        std::vector<btScalar> masses;
        for (const FloatParticle& particle : shape.particles) {
            places.emplace_back(particle.x, particle.y, particle.z);
            masses.push_back(particle.inverse_mass > 0 ? 1 / particle.inverse_mass : 0);
        }
        auto body = std::make_unique<btSoftBody>(&info_, static_cast<int>(places.size()), places.data(),
                                                 masses.data());
        for (const FloatEdge& edge : shape.edges) {
            body->appendLink(static_cast<int>(edge.a), static_cast<int>(edge.b));
        }
        for (int i = 0; i < body->m_links.size(); ++i) {
            body->m_links[i].m_rl = shape.edges[static_cast<std::size_t>(i)].rest;
        }
        body->updateLinkConstants();
        for (int i = 0; i < body->m_links.size(); ++i) {
            body->m_links[i].m_c1 = body->m_links[i].m_rl * body->m_links[i].m_rl;
        }
        body->m_cfg.piterations = static_cast<int>(iterations_);
        // Particles are points.
        body->getCollisionShape()->setMargin(0);
        return body;
    }

    std::uint32_t substeps_;
    std::uint32_t iterations_;
    btSoftBodyWorldInfo info_;
    std::unique_ptr<btSphereShape> ball_shape_;
    btCollisionObject ball_;
    std::vector<std::unique_ptr<btSoftBody>> bodies_;
};

void demand_masses(const lks_asset& asset) {
    FloatCloth shape = make_float_cloth(asset, {}, EdgeOrder::by_colour);
    put_out_of_place(shape);
    Bullet body(shape, 1, 1, 1, 0, BulletBall{});
    body.project();
    demand_centre_kept(asset, bullet_name, points_of(shape), body.points());
}

} // namespace

bool has_bullet() {
    return true;
}

std::unique_ptr<Variant> make_bullet_peer(const Workload& workload) {
    const WorkloadAsset asset(workload);
    demand_masses(*asset.get());
    const FloatCloth shape = make_float_cloth(*asset.get(), asset.pinned(), EdgeOrder::by_colour);
    auto bullet = std::make_unique<Bullet>(shape, workload.objects, workload.substeps, workload.iterations, 0,
                                           BulletBall{});
    for (std::uint32_t i = 0; i < workload.warm_ticks; ++i) {
        bullet->tick();
    }
    return bullet;
}

std::unique_ptr<Variant> make_bullet_body(const FloatCloth& shape, std::uint32_t substeps,
                                          std::uint32_t iterations, double damping, const BulletBall& ball) {
    return std::make_unique<Bullet>(shape, 1, substeps, iterations, damping, ball);
}

} // namespace lks_bench
