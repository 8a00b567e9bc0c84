// The hash of a world sees every part of its bodies, joints, attachments and contacts, and who sleeps.
#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <vector>

#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

struct Parts {
    lks_body_shape shape = box_shape(0.2, 0.1, 0.3);
    lks_body_def body = lks_default_body_def();
    lks_joint_def joint = lks_default_joint_def();
    lks_limits limits{};
    lks_motor motor{fixed(2), fixed(0.1), {0, 0, 0, LKS_ROTATION_ONE}};
    lks_attachment_def attachment = lks_default_attachment_def();
    std::uint32_t rope_solver = LKS_ROPE_SWEPT;
    int ticks = 3;
};

struct Hashes {
    std::uint64_t whole, local;
};

// A body on the ground, one that hangs from it on a joint with a motor, and a rope at that.
Hashes hashes_of(const Parts& parts, const std::function<void(World&)>& change = {}) {
    World world(world_def(60, 8));
    add_ground(world);
    Chain chain;
    chain.segments = 4;
    const lks_object_id rope = world.add(chain.build(), at(3, 2, 0));
    const lks_body_id first = add_body(world, parts.shape, parts.body.transform.position, parts.body);
    const lks_body_id second = add_body(world, box_shape(0.1, 0.2, 0.1), fixed(0.5, 1, 0));
    const lks_joint_id joint = add_joint(world, parts.joint, first, second);
    REQUIRE(lks_joint_set_motor(world, joint, &parts.motor) == LKS_OK);
    lks_attachment_def hold = parts.attachment;
    hold.object = rope;
    hold.body = second;
    lks_attachment_id held{};
    REQUIRE(lks_world_add_attachment(world, &hold, &held) == LKS_OK);
    world.step(parts.ticks);
    if (change) {
        change(world);
    }
    return {world.hash(), world.local_hash()};
}

Parts standing() {
    Parts parts;
    parts.body.transform.position = fixed(0, 0.1, 0);
    parts.joint.frame_a.position = fixed(0.25, 0.5, 0);
    parts.joint.frame_b.position = fixed(-0.25, -0.4, 0);
    parts.joint.compliance = fixed(0.001);
    parts.joint.limit_compliance = fixed(0.01);
    parts.joint.swing_limit = fixed(40);
    parts.joint.twist_min = fixed(-30);
    parts.joint.twist_max = fixed(30);
    parts.attachment.compliance = fixed(0.001);
    return parts;
}

// Each of these must differ from all others.
class Variants {
public:
    void add(const char* name, const std::function<void(Parts&)>& change) {
        Parts parts = standing();
        change(parts);
        keep(name, hashes_of(parts));
    }
    void after(const char* name, const std::function<void(World&)>& change) {
        keep(name, hashes_of(standing(), change));
    }
    void check() const {
        for (std::size_t i = 0; i < names_.size(); ++i) {
            for (std::size_t j = i + 1; j < names_.size(); ++j) {
                INFO(names_[i] << " and " << names_[j]);
                CHECK(hashes_[i].whole != hashes_[j].whole);
            }
        }
    }

private:
    void keep(const char* name, const Hashes& hashes) {
        names_.emplace_back(name);
        hashes_.push_back(hashes);
    }

    std::vector<std::string> names_;
    std::vector<Hashes> hashes_;
};

constexpr lks_body_id the_first{0, 1};
constexpr lks_body_id the_second{1, 1};
constexpr lks_joint_id the_joint{0, 1};

} // namespace

TEST_CASE("the hash sees every field of a body's definition, one unit of it") {
    Variants all;
    all.add("as it is", [](Parts&) {});
    // Nothing has moved yet that these would change: it is the definition that is seen.
    const auto at_once = [&](const char* name, const std::function<void(Parts&)>& change) {
        all.add(name, [&](Parts& p) {
            p.ticks = 0;
            change(p);
        });
    };
    at_once("at once", [](Parts&) {});
    at_once("kind", [](Parts& p) { p.body.kind = LKS_BODY_KINEMATIC; });
    at_once("position", [](Parts& p) { p.body.transform.position.x += 1; });
    at_once("rotation", [](Parts& p) { p.body.transform.rotation = about(0, 1, 0, 1e-3); });
    at_once("velocity", [](Parts& p) { p.body.velocity.z = 1; });
    at_once("spin", [](Parts& p) { p.body.angular_velocity.y = 1; });
    at_once("never_sleeps", [](Parts& p) { p.body.never_sleeps = 1; });
    at_once("mass", [](Parts& p) { p.body.mass = fixed(24); });
    at_once("mass more", [](Parts& p) { p.body.mass = fixed(24) + 1; });
    at_once("gravity_factor", [](Parts& p) { p.body.gravity_factor += 1; });
    at_once("linear_damping", [](Parts& p) { p.body.linear_damping += 1; });
    at_once("angular_damping", [](Parts& p) { p.body.angular_damping += 1; });
    at_once("static_friction", [](Parts& p) { p.body.static_friction += 1; });
    at_once("dynamic_friction", [](Parts& p) { p.body.dynamic_friction -= 1; });
    at_once("restitution", [](Parts& p) { p.body.restitution += 1; });
    at_once("category", [](Parts& p) { p.body.filter.category = 3; });
    at_once("mask", [](Parts& p) { p.body.filter.mask -= 1; });
    at_once("group", [](Parts& p) { p.body.filter.group = 1; });
    at_once("shape", [](Parts& p) { p.shape.shape = LKS_SHAPE_SPHERE; });
    at_once("radius", [](Parts& p) {
        p.shape.shape = LKS_SHAPE_SPHERE;
        p.shape.radius += 1;
    });
    at_once("capsule", [](Parts& p) { p.shape.shape = LKS_SHAPE_CAPSULE; });
    at_once("half_length", [](Parts& p) {
        p.shape.shape = LKS_SHAPE_CAPSULE;
        p.shape.half_length += 1;
    });
    at_once("half extent x", [](Parts& p) { p.shape.half_extents.x += 1; });
    at_once("half extent y", [](Parts& p) { p.shape.half_extents.y += 1; });
    at_once("half extent z", [](Parts& p) { p.shape.half_extents.z += 1; });
    at_once("density", [](Parts& p) { p.shape.density += 1; });
    at_once("shape's place", [](Parts& p) { p.shape.transform.position.y += 1; });
    at_once("shape's turn", [](Parts& p) { p.shape.transform.rotation = about(0, 1, 0, 1); });
    all.check();
}

TEST_CASE("the hash sees every field of a joint and of an attachment, one unit of it") {
    Variants all;
    const auto at_once = [&](const char* name, const std::function<void(Parts&)>& change) {
        all.add(name, [&](Parts& p) {
            p.ticks = 0;
            change(p);
        });
    };
    at_once("as it is", [](Parts&) {});
    at_once("frame a", [](Parts& p) { p.joint.frame_a.position.x += 1; });
    at_once("frame b", [](Parts& p) { p.joint.frame_b.position.z += 1; });
    at_once("turn a", [](Parts& p) { p.joint.frame_a.rotation = about(0, 0, 1, 1); });
    at_once("turn b", [](Parts& p) { p.joint.frame_b.rotation = about(0, 0, 1, 1); });
    at_once("bodies_collide", [](Parts& p) { p.joint.bodies_collide = 1; });
    at_once("swing_limit", [](Parts& p) { p.joint.swing_limit += 1 << 16; });
    at_once("swing_limit_z", [](Parts& p) { p.joint.swing_limit_z = fixed(20); });
    at_once("twist_min", [](Parts& p) { p.joint.twist_min += 1 << 16; });
    at_once("twist_max", [](Parts& p) { p.joint.twist_max -= 1 << 16; });
    at_once("compliance", [](Parts& p) { p.joint.compliance += 1; });
    at_once("damping", [](Parts& p) { p.joint.damping += 1; });
    at_once("angular_damping", [](Parts& p) { p.joint.angular_damping += 1; });
    at_once("limit_compliance", [](Parts& p) { p.joint.limit_compliance += 1; });
    at_once("limit_damping", [](Parts& p) { p.joint.limit_damping += 1; });
    at_once("friction", [](Parts& p) { p.joint.friction += 1; });
    at_once("break_force", [](Parts& p) { p.joint.break_force = fixed(7000) + 1; });
    at_once("break_force less", [](Parts& p) { p.joint.break_force = fixed(7000); });
    at_once("break_torque", [](Parts& p) { p.joint.break_torque = fixed(7000); });
    at_once("max_torque", [](Parts& p) { p.motor.max_torque += 1; });
    at_once("response", [](Parts& p) { p.motor.response += 1 << 16; });
    at_once("target", [](Parts& p) { p.motor.target = about(0, 0, 1, 1); });
    at_once("vertex", [](Parts& p) { p.attachment.vertex = 1; });
    at_once("point", [](Parts& p) { p.attachment.point.x += 1; });
    at_once("attachment's compliance", [](Parts& p) { p.attachment.compliance += 1; });
    at_once("attachment's damping", [](Parts& p) { p.attachment.damping += 1; });
    at_once("attachment's break_force", [](Parts& p) { p.attachment.break_force = fixed(7000); });
    at_once("hinge", [](Parts& p) {
        p.joint.kind = LKS_JOINT_HINGE;
        p.joint.swing_limit = fixed(180);
    });
    at_once("angular_compliance", [](Parts& p) {
        p.joint.kind = LKS_JOINT_HINGE;
        p.joint.swing_limit = fixed(180);
        p.joint.angular_compliance = 1;
    });
    all.check();
}

TEST_CASE("the hash sees what a game does between ticks") {
    Variants all;
    all.after("nothing", [](World&) {});
    all.after("a tick", [](World& w) { w.step(); });
    all.after("velocity", [](World& w) {
        lks_vec3 velocity{};
        lks_vec3 spin{};
        REQUIRE(lks_body_velocity(w, the_second, &velocity, &spin) == LKS_OK);
        velocity.x += 1;
        REQUIRE(lks_body_set_velocity(w, the_second, velocity, spin) == LKS_OK);
    });
    all.after("kind",
              [](World& w) { REQUIRE(lks_body_set_kind(w, the_second, LKS_BODY_KINEMATIC) == LKS_OK); });
    all.after("kind and target", [](World& w) {
        REQUIRE(lks_body_set_kind(w, the_second, LKS_BODY_KINEMATIC) == LKS_OK);
        REQUIRE(lks_body_move_to(w, the_second, at(0.5, 1.5, 0)) == LKS_OK);
    });
    // Put where it is: its contacts push nothing on.
    all.after("put", [](World& w) {
        lks_transform transform{};
        REQUIRE(lks_body_transform(w, the_first, &transform) == LKS_OK);
        REQUIRE(lks_body_set_transform(w, the_first, transform) == LKS_OK);
    });
    all.after("limits", [](World& w) {
        lks_limits limits{};
        REQUIRE(lks_joint_limits(w, the_joint, &limits) == LKS_OK);
        limits.twist_max += 1 << 16;
        REQUIRE(lks_joint_set_limits(w, the_joint, &limits) == LKS_OK);
    });
    all.after("motor", [](World& w) {
        const lks_motor off{};
        lks_motor motor = off;
        motor.target.w = LKS_ROTATION_ONE;
        REQUIRE(lks_joint_set_motor(w, the_joint, &motor) == LKS_OK);
    });
    all.after("without the joint", [](World& w) { REQUIRE(lks_world_remove_joint(w, the_joint) == LKS_OK); });
    all.after("without the attachment", [](World& w) {
        REQUIRE(lks_world_remove_attachment(w, {0, 1}) == LKS_OK);
    });
    all.after("without the body", [](World& w) { REQUIRE(lks_world_remove_body(w, the_second) == LKS_OK); });
    all.after("another generation", [](World& w) {
        REQUIRE(lks_world_remove_body(w, add_body(w, ball_shape(0.1), fixed(9, 9, 9))) == LKS_OK);
    });
    all.check();
}

TEST_CASE("the hash sees who sleeps, and for how long others have rested") {
    // Boxes in the same place at rest: one awake, one asleep; one that was just woken where it is.
    World world(world_def(60, 8));
    add_ground(world);
    const lks_body_id box = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(0, 0.2, 0));
    while (lks_body_is_awake(world, box) == 1) {
        world.step();
        REQUIRE(world.tick() < 300);
    }
    const BodyState asleep_at = state_of(world, box);
    const std::uint64_t asleep = world.hash();
    const std::uint64_t asleep_local = world.local_hash();
    REQUIRE(lks_body_wake(world, box) == LKS_OK);
    CHECK((state_of(world, box).position - asleep_at.position).length() == 0);
    CHECK(world.hash() != asleep);
    CHECK(world.local_hash() != asleep_local);
    // Two worlds of the same tick that differ by how long the box has rested: one sleeps first.
    World early(world_def(60, 8));
    World late(world_def(60, 8));
    for (World* one : {&early, &late}) {
        add_ground(*one);
        const lks_body_id resting = add_body(*one, box_shape(0.2, 0.2, 0.2), fixed(0, 0.2, 0));
        one->step(10);
        if (one == &late) {
            REQUIRE(lks_body_wake(*one, resting) == LKS_OK); // begins to count again
        }
    }
    const lks_body_id resting{0, 1};
    CHECK((state_of(early, resting).position - state_of(late, resting).position).length() == 0);
    CHECK(early.hash() != late.hash());
    while (lks_body_is_awake(early, resting) == 1) {
        early.step();
        late.step();
    }
    CHECK(lks_body_is_awake(late, resting) == 1);
}
