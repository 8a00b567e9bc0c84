#include "reference/rigid_comparison.h"

#include <doctest/doctest.h>

#include <cmath>

#include "reference/asset_model.h"
#include "reference/rigid_xpbd.h"
#include "support/bodies.h"

namespace reference {
namespace {

lks_world_def world_def(const Settings& settings) {
    lks_world_def def = support::world_def(static_cast<std::uint32_t>(settings.tick_rate_hz),
                                           static_cast<std::uint32_t>(settings.substeps),
                                           static_cast<std::uint32_t>(settings.iterations));
    def.gravity = support::fixed(settings.gravity.x, settings.gravity.y, settings.gravity.z);
    return def;
}

support::Vector centre_of(const support::World& world, lks_body_id body) {
    lks_vec3 centre{};
    REQUIRE(lks_body_centre_of_mass(world, body, &centre) == LKS_OK);
    return support::metres(centre);
}

// The angle between two rotations.
double angle_between(const Rotation& a, const Rotation& b) {
    const Quaternion<double> d = quaternion_of<double>(a).conjugate() * quaternion_of<double>(b);
    return 2 * std::atan2(d.vector().length(), std::abs(d.w));
}

template <typename Definition>
Definition without_particles(Definition def) {
    def.filter.mask &= ~LKS_CATEGORY_PARTICLES;
    return def;
}

// Also where it is no number.
void keep_greatest(double& greatest, double value) {
    if (!(value <= greatest)) {
        greatest = value;
    }
}

void compare(RigidDistance& distance, const RigidSolver<double>& expected, std::size_t body,
             const support::Vector& position, const Rotation& orientation) {
    keep_greatest(distance.metres, (position - expected.position(body)).length());
    keep_greatest(distance.radians, angle_between(orientation, expected.orientation(body)));
}

void compare_particles(RigidDeviation& worst, const RigidSolver<double>& expected,
                       const RigidSolver<float>& single, std::size_t object,
                       const std::vector<support::Vector>& positions) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const support::Vector there = expected.particle(object, i);
        keep_greatest(worst.fixed_point.metres, (positions[i] - there).length());
        keep_greatest(worst.single.metres, (single.particle(object, i) - there).length());
    }
}

} // namespace

RigidScene::RigidScene(const Settings& settings) : settings_(settings), world_(world_def(settings)) {}

void RigidScene::add_collider(const lks_collider_def& def, bool bodies_touch) {
    colliders_.push_back(world_.add(without_particles(def)));
    model_.colliders.push_back(rigid_collider(def));
    touches_colliders_ = true;
    touches_bodies_ = bodies_touch;
}

void RigidScene::add_ground(double static_friction, double dynamic_friction, bool bodies_touch,
                            const lks_rotation& rotation) {
    lks_collider_def def = lks_default_collider_def();
    def.shape = LKS_SHAPE_PLANE;
    def.static_friction = support::fixed(static_friction);
    def.dynamic_friction = support::fixed(dynamic_friction);
    def.transform.rotation = rotation;
    add_collider(def, bodies_touch);
}

std::size_t RigidScene::add(const std::vector<lks_body_shape>& shapes, lks_body_def def) {
    def.never_sleeps = 1;
    if (!touches_colliders_) {
        def.filter.mask = 0;
    }
    def.filter.group = touches_bodies_ ? 0 : -1;
    def = without_particles(def);
    def.shapes = shapes.data();
    def.shape_count = static_cast<std::uint32_t>(shapes.size());
    lks_body_id id{};
    REQUIRE(lks_world_add_body(world_, &def, &id) == LKS_OK);
    ids_.push_back(id);
    RigidBody body = rigid_body(def, support::mass_of(world_, id));
    REQUIRE((body.centre - centre_of(world_, id)).length() < 1e-11);
    body.touches_colliders = touches_colliders_;
    body.touches_bodies = touches_bodies_;
    model_.bodies.push_back(std::move(body));
    return ids_.size() - 1;
}

std::size_t RigidScene::add(const lks_body_shape& shape, const lks_body_def& def) {
    return add(std::vector<lks_body_shape>{shape}, def);
}

std::size_t RigidScene::add_anchor(const lks_vec3& position) {
    lks_body_def def = lks_default_body_def();
    def.kind = LKS_BODY_KINEMATIC;
    def.transform.position = position;
    return add(support::ball_shape(0.05), def);
}

void RigidScene::join(const lks_joint_def& def, std::size_t a, std::size_t b) {
    joints_.push_back(support::add_joint(world_, def, ids_[a], ids_[b]));
    RigidJoint joint = rigid_joint(def, a, b);
    joint.point_a = joint.point_a - model_.bodies[a].centre;
    joint.point_b = joint.point_b - model_.bodies[b].centre;
    model_.joints.push_back(joint);
}

std::size_t RigidScene::add(const support::Asset& asset, const lks_vec3& position,
                            const std::vector<double>& masses, const Materials& materials, bool directly) {
    lks_transform place = lks_transform_identity();
    place.position = position;
    objects_.push_back(world_.add(asset, place));
    Model model = model_of(world_, objects_.back(), asset, {}, masses, materials);
    if (directly) {
        model.chain = segments_of(model.edges);
    }
    model_.objects.push_back(std::move(model));
    return objects_.size() - 1;
}

std::size_t RigidScene::add_rope(const support::Chain& chain, const lks_vec3& position) {
    REQUIRE(chain.solver != LKS_ROPE_AUTOMATIC);
    return add(chain.build(), position, chain.masses(), {chain.stretch, support::off, chain.bend},
               chain.solver == LKS_ROPE_DIRECT);
}

std::size_t RigidScene::add_points(const std::vector<support::Vector>& points,
                                   const std::vector<double>& masses) {
    return add(support::loose_points(points, masses), {}, masses, {support::off, support::off, support::off},
               false);
}

void RigidScene::pin(std::size_t object, std::uint32_t particle) {
    world_.pin(objects_[object], particle);
    model_.objects[object].pins.push_back(particle);
}

void RigidScene::attach(lks_attachment_def def, std::size_t object, std::size_t body) {
    def.kind = LKS_ATTACHMENT_TO_BODY;
    def.object = objects_[object];
    def.body = ids_[body];
    attach(def, {object, def.vertex, true, body, 0, support::metres(def.point) - model_.bodies[body].centre,
                 support::metres(def.compliance), support::metres(def.damping)});
}

void RigidScene::attach_to_particle(lks_attachment_def def, std::size_t object, std::size_t other) {
    def.kind = LKS_ATTACHMENT_TO_VERTEX;
    def.object = objects_[object];
    def.other_object = objects_[other];
    attach(def, {object,
                 def.vertex,
                 false,
                 other,
                 def.other_vertex,
                 {},
                 support::metres(def.compliance),
                 support::metres(def.damping)});
}

void RigidScene::attach(const lks_attachment_def& def, const RigidAttachment& attachment) {
    lks_attachment_id id{};
    REQUIRE(lks_world_add_attachment(world_, &def, &id) == LKS_OK);
    model_.attachments.push_back(attachment);
}

void RigidScene::drive(std::size_t joint, const lks_motor& motor) {
    REQUIRE(lks_joint_set_motor(world_, joints_[joint], &motor) == LKS_OK);
    model_.joints[joint].motor = rigid_motor(motor);
}

void RigidScene::lead_body(std::size_t body, const lks_transform& target) {
    REQUIRE(lks_body_move_to(world_, ids_[body], target) == LKS_OK);
    const Rotation orientation = rotation_of(target.rotation);
    const Vector3<double> centre(model_.bodies[body].centre);
    targets_.push_back(
        {false, body,
         support::metres(target.position) + (quaternion_of<double>(orientation).matrix() * centre).widened(),
         orientation});
}

void RigidScene::lead_collider(std::size_t collider, const lks_transform& target) {
    REQUIRE(lks_collider_move_to(world_, colliders_[collider], target) == LKS_OK);
    targets_.push_back({true, collider, support::metres(target.position), rotation_of(target.rotation)});
}

std::vector<RigidDeviation> RigidScene::run(const std::vector<int>& ticks, const Leading& leading) {
    RigidSolver<double> expected(model_, settings_);
    RigidSolver<float> single(model_, settings_);
    const auto lead = [](auto& solver, const Target& target) {
        if (target.of_collider) {
            solver.lead_collider(target.index, target.position, target.orientation);
        } else {
            solver.lead_body(target.index, target.position, target.orientation);
        }
    };
    std::vector<RigidDeviation> deviations;
    RigidDeviation worst;
    int tick = 0;
    for (const int end : ticks) {
        for (; tick < end; ++tick) {
            targets_.clear();
            if (leading) {
                leading(*this, tick);
            }
            for (const Target& target : targets_) {
                lead(expected, target);
                lead(single, target);
            }
            world_.step();
            expected.tick();
            single.tick();
            for (std::size_t object = 0; object < objects_.size(); ++object) {
                compare_particles(worst, expected, single, object,
                                  world_.positions_from(objects_[object], {}));
            }
            for (std::size_t i = 0; i < ids_.size(); ++i) {
                const support::BodyState state = support::state_of(world_, ids_[i]);
                const support::Vector centre = support::rotate(state.rotation, centre_of(world_, ids_[i]));
                compare(worst.fixed_point, expected, i, state.position + centre, rotation_of(state.rotation));
                compare(worst.single, expected, i, single.position(i), single.orientation(i));
            }
        }
        deviations.push_back(worst);
    }
    REQUIRE(world_.counters().speed_clamps == 0);
    REQUIRE(world_.counters().lost_contacts == 0);
    return deviations;
}

} // namespace reference
