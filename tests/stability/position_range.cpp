// At the ends of what positions can be: of an object, ±64 m, and of the world, ±8,388 km.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "stability/support/jointed.h"
#include "stability/support/nets.h"
#include "stability/support/table.h"
#include "stability/support/trial.h"
#include "support/bodies.h"

using namespace support;
using namespace stability;

namespace {

constexpr double edge = 8388000; // the greatest position of an object

Net small_net() {
    return kilogram_net(12, 1);
}

} // namespace

TEST_CASE("a cloth in the last corner of the world falls as everywhere") {
    const Net net = small_net();
    const Asset asset = net.build();
    std::vector<Vector> expected, twin_expected;
    for (const double place : {0.0, edge - 10, -edge + 10}) {
        Subject subject = subject_of(net, asset);
        subject.transform = turned(at(place, place, place), 1, 0, 0, 90);
        subject.twin_place = {place, place, place};
        Trial trial(subject);
        trial.pin(0);
        trial.pin(11);
        lks_collider_def ball = lks_default_collider_def();
        ball.radius = fixed(0.3);
        ball.transform.position = fixed(place, place, place) + fixed(0, -0.4, 0);
        trial.add(ball);
        trial.run(180);
        const std::string scene =
            named("cloth on a ball, ", place / 1000, " km from the origin on each axis");
        expect_stretch_at_most(scene, trial, 10);
        expect_depth_at_most(scene, trial, 1e-5);
        if (expected.empty()) {
            expected = trial.positions();
            twin_expected = trial.twin_positions();
        }
        expect_at_most(scene, "off what it does at the origin", "m", 0, farthest(trial.positions(), expected),
                       farthest(trial.twin_positions(), twin_expected));
        expect_nothing_clamped(trial);
    }
}

TEST_CASE("a cloth that is stretched to the corners of its range comes back") {
    const Net net = small_net();
    const Asset asset = net.build();
    Trial trial(subject_of(net, asset));
    std::vector<Vector> start = trial.positions();
    const std::uint32_t corners[] = {0, 11, 132, 143};
    for (const std::uint32_t corner : corners) {
        trial.pin(corner);
    }
    const double far = 63.9;
    trial.set_target(0, {-far, far, far});
    trial.set_target(11, {far, far, -far});
    trial.set_target(132, {-far, -far, -far});
    trial.set_target(143, {far, -far, far});
    trial.run(60);
    const std::string scene = "cloth 12 × 12 stretched to the corners of ±64 m";
    expect_worst_stretch_at_most(scene, trial, 2e5);
    for (const std::uint32_t corner : corners) {
        trial.set_target(corner, start[corner]);
    }
    trial.begin();
    trial.run(600);
    expect_recovery_within(scene + ", brought back", trial, 1);
    expect_last_stretch_at_most(scene + ", brought back", trial, 5);
}

TEST_CASE("a cloth whose particles fly apart at the speed limit is clamped, counted, and comes back") {
    const Net net = small_net();
    const Asset asset = net.build();
    Subject subject = subject_of(net, asset);
    subject.world.gravity = {};
    Trial trial(subject);
    Random random(3);
    for (std::uint32_t i = 0; i < trial.size(); ++i) {
        const auto axis = [&] { return random.next() % 2 == 0 ? -1000.0 : 1000.0; };
        trial.set_velocity(i, {axis(), axis(), axis()});
    }
    trial.begin();
    trial.run(600);
    const std::string scene = "cloth 12 × 12, every particle at ±1000 m/s on each axis";
    expect_worst_stretch_at_most(scene, trial, 70);
    expect_recovery_within(scene, trial, 0.5);
    expect_last_stretch_at_most(scene, trial, 1);
    expect_gain_at_most(scene, trial, 1e-6);
    tell(scene, "speeds clamped", "", static_cast<double>(trial.world().counters().speed_clamps),
         "it clamps nothing");
}

TEST_CASE("loose points that leave their object's range stay at its edge") {
    const Asset points = loose_points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {1, 1, 1});
    lks_world_def def = world_def(60, 20);
    def.gravity = {};
    World world(def);
    const lks_object_id object = world.add(points, at(0, 0, 0));
    REQUIRE(lks_object_set_velocity(world, object, 0, fixed(1000, 1000, 1000)) == LKS_OK);
    REQUIRE(lks_object_set_velocity(world, object, 1, fixed(-1000, -1000, -1000)) == LKS_OK);
    world.step(300);
    double reach = 0;
    for (const lks_raw_position& p : world.raw_positions(object)) {
        for (const std::int64_t axis : {p.x, p.y, p.z}) {
            reach = std::max(reach, std::abs(raw_metres(axis)));
        }
    }
    const std::string scene = "points that fly apart at 1000 m/s for 5 s";
    expect_at_most(scene, "from the object's origin", "m", 64, reach, "its space has no edge");
    expect_at_least(scene, "positions clamped", "", 1, static_cast<double>(world.counters().position_clamps),
                    "its space has no edge");
}

TEST_CASE("bodies thrown at the edge of the world stay inside, and jointed ones together") {
    lks_world_def settings = world_def(60, 20);
    settings.gravity = {};
    Jointed scene(settings);
    const World& world = scene.world();
    lks_body_def def = lks_default_body_def();
    def.velocity = support::fixed(320, 320, 320);
    def.transform.position = support::fixed(edge - 50, edge - 50, edge - 50);
    const std::size_t a = scene.add(box_shape(0.2, 0.3, 0.4), def);
    def.transform.position = def.transform.position + support::fixed(1, 0, 0);
    const std::size_t b = scene.add(ball_shape(0.2), def);
    lks_joint_def joint = lks_default_joint_def();
    joint.frame_a.position = support::fixed(0.5, 0, 0);
    joint.frame_b.position = support::fixed(-0.5, 0, 0);
    scene.join(joint, a, b);
    scene.step(120);
    const auto reach = [&] {
        double farthest = 0;
        for (const std::size_t body : {a, b}) {
            const Vector p = scene.position(body);
            farthest = std::max({farthest, p.x, p.y, p.z});
        }
        return farthest;
    };
    const char* const no_edge = "its space has no edge";
    const std::string name = "two jointed bodies thrown at the world's corner";
    expect_at_most(name, "from the origin on an axis", "m", edge + 1, reach(), no_edge);
    // The twin flies on, where a float has half a metre.
    expect_at_most(name, "joint apart there", "m", 1e-3, scene.gap(), scene.twin_gap());
    for (const std::size_t body : {a, b}) {
        REQUIRE(lks_body_set_velocity(world, scene.id(body), support::fixed(-20, -20, -20), {}) == LKS_OK);
    }
    scene.step(300);
    expect_at_most(name, "joint apart, 5 s after it was taken away", "m", 1e-6, scene.gap(), no_edge);
    expect_at_most(name, "from the origin on an axis, taken away", "m", edge - 50, reach(), no_edge);
}

TEST_CASE("jointed bodies that are as far apart as the world is wide come together, not apart") {
    lks_joint_def ball = lks_default_joint_def();
    lks_joint_def soft = ball;
    soft.compliance = support::fixed(1e-4);
    lks_joint_def rod = ball;
    rod.kind = LKS_JOINT_DISTANCE;
    rod.distance_min = rod.distance_max = support::fixed(1);
    for (const auto& kind : {std::pair{"ball joint", ball}, {"soft joint", soft}, {"rod", rod}}) {
        for (const double side : {1.0, -1.0}) {
            World world(weightless(20));
            const lks_body_id held = add_anchor(world, support::fixed(side * edge, 0, -side * edge));
            const lks_body_id free =
                add_body(world, ball_shape(0.2), support::fixed(-side * edge, 0, side * edge));
            const lks_joint_id joint = add_joint(world, kind.second, held, free);
            INFO("bodies on two corners of the world, ", kind.first);
            // 23,725 km, of which the number holds 8,388.
            CHECK(error_of(world, joint) > 8388606.9);
            world.step(60);
            // At the speed limit or slower, for a second.
            const Vector after = state_of(world, free).position;
            INFO(after.x, ", ", after.y, ", ", after.z);
            CHECK(side * after.x > -edge + 1);
            CHECK(-side * after.z > -edge + 1);
        }
    }
}
