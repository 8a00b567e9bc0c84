#include "bullet_peer.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyInternals.h>

#include "peer_check.h"
#include "spheres.h"

namespace lks_bench {
namespace {

struct Settings {
    std::uint32_t substeps, iterations;
    double damping = 0;    // share of velocity that is lost a second
    double hardness = 0.1; // share of a depth that one iteration of a contact undoes; this is Bullet's own
};

class Bullet final : public Variant {
public:
    // As many bodies as there are lists of what each of them meets.
    Bullet(const FloatCloth& shape, const std::vector<std::vector<FloatSphere>>& met,
           const Settings& settings)
        : substeps_(settings.substeps), iterations_(settings.iterations) {
        info_.m_gravity = btVector3(0, btScalar(-9.81), 0);
        info_.air_density = 0;
        info_.m_sparsesdf.Initialize();
        // Bullet's own contact, by a field of distances: as fine as leaves it a tenth of a millimetre.
        info_.m_sparsesdf.m_defaultVoxelsz = btScalar(0.02);
        info_.m_sparsesdf.Reset();
        for (const std::vector<FloatSphere>& spheres : met) {
            bodies_.push_back(make_body(shape));
            bodies_.back()->m_cfg.kDP = btScalar(settings.damping / (60 * substeps_));
            bodies_.back()->m_cfg.kKHR = btScalar(settings.hardness);
            std::vector<std::unique_ptr<btCollisionObject>>& balls = balls_.emplace_back();
            for (const FloatSphere& sphere : spheres) {
                balls.push_back(make_ball(sphere));
            }
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
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            btSoftBody* const body = bodies_[i].get();
            for (std::uint32_t substep = 0; substep < substeps_; ++substep) {
                body->predictMotion(btScalar(1) / btScalar(60 * substeps_));
                for (const std::unique_ptr<btCollisionObject>& ball : balls_[i]) {
                    const btCollisionObjectWrapper wrapper(nullptr, ball->getCollisionShape(), ball.get(),
                                                           ball->getWorldTransform(), -1, -1);
                    body->defaultCollisionHandler(&wrapper);
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
    // One shape a radius: a field belongs to a shape, and balls of one shape share it.
    btSphereShape* shape_of(float radius) {
        for (const std::unique_ptr<btSphereShape>& shape : ball_shapes_) {
            if (shape->getRadius() == btScalar(radius)) {
                return shape.get();
            }
        }
        return ball_shapes_.emplace_back(std::make_unique<btSphereShape>(btScalar(radius))).get();
    }

    std::unique_ptr<btCollisionObject> make_ball(const FloatSphere& sphere) {
        auto ball = std::make_unique<btCollisionObject>();
        ball->setCollisionShape(shape_of(sphere.radius));
        btTransform place = btTransform::getIdentity();
        place.setOrigin(btVector3(btScalar(sphere.x), btScalar(sphere.y), btScalar(sphere.z)));
        ball->setWorldTransform(place);
        ball->setFriction(0);
        return ball;
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
    std::vector<std::unique_ptr<btSphereShape>> ball_shapes_;
    std::vector<std::vector<std::unique_ptr<btCollisionObject>>> balls_; // that each body meets
    std::vector<std::unique_ptr<btSoftBody>> bodies_;
};

void demand_masses(const lks_asset& asset) {
    FloatCloth shape = make_float_cloth(asset, {}, EdgeOrder::by_colour);
    put_out_of_place(shape);
    Bullet body(shape, {{}}, {.substeps = 1, .iterations = 1});
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
    FloatCloth shape = make_float_cloth(*asset.get(), asset.pinned(), EdgeOrder::by_colour);
    if (workload.colliders) {
        lay_level(shape);
    }
    // As hard as can be: with Bullet's own hardness cloths sink in by a centimetre.
    const Settings settings{workload.substeps, workload.iterations, 0, 1};
    auto bullet = std::make_unique<Bullet>(shape, spheres_of(workload), settings);
    for (std::uint32_t i = 0; i < workload.warm_ticks; ++i) {
        bullet->tick();
    }
    return bullet;
}

std::unique_ptr<Variant> make_bullet_body(const FloatCloth& shape, std::uint32_t substeps,
                                          std::uint32_t iterations, double damping,
                                          const std::vector<FloatSphere>& met) {
    const std::vector<std::vector<FloatSphere>> one_body{met};
    return std::make_unique<Bullet>(shape, one_body, Settings{substeps, iterations, damping});
}

} // namespace lks_bench
