// Where events happen.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/attachments.h"
#include "support/bodies.h"
#include "support/builders.h"
#include "support/events.h"

using namespace support;

namespace {

// The first of a kind.
lks_event first_of(const std::vector<lks_event>& all, lks_event_kind kind) {
    const auto found = std::find_if(all.begin(), all.end(), [kind](const lks_event& e) {
        return e.kind == static_cast<std::uint32_t>(kind);
    });
    REQUIRE(found != all.end());
    return *found;
}

double between(const Vector& a, const Vector& b) {
    return (a - b).length();
}

double distance_from(const lks_event& event, const Vector& point) {
    return between(metres(event.point), point);
}

bool is_nowhere(const lks_event& event) {
    return event.point.x == 0 && event.point.y == 0 && event.point.z == 0 && event.normal.x == 0 &&
           event.normal.y == 0 && event.normal.z == 0;
}

} // namespace

TEST_CASE("a ball tells where it comes down, also at speed, and in which direction the ground is") {
    for (const int substeps : {4, 8, 20}) {
        for (const double restitution : {0.0, 0.7}) {
            CAPTURE(substeps);
            CAPTURE(restitution);
            World world(world_def(60, substeps));
            add_ground(world, 0);
            lks_body_def def = lks_default_body_def();
            def.restitution = fixed(restitution);
            def.linear_damping = 0;
            def.velocity = fixed(20, -5, 10);
            add_body(world, ball_shape(0.1), fixed(3, 2.1, -1), def);
            record(world);
            const std::vector<lks_event> all = run(world, 30);
            const double seconds = (std::sqrt(25 + 2 * 9.81 * 2) - 5) / 9.81;
            const double speed = std::sqrt(25 + 2 * 9.81 * 2);
            const Vector point{3 + 20 * seconds, 0, -1 + 10 * seconds};
            // As far as it goes in a substep.
            const double way = std::sqrt(500 + speed * speed) / (60 * substeps);
            for (const lks_event_kind kind : {LKS_EVENT_CONTACT_BEGIN, LKS_EVENT_CONTACT_HIT}) {
                const lks_event event = first_of(all, kind);
                CHECK(distance_from(event, point) < 1.5 * way);
                CHECK(std::abs(metres(event.point.y)) < 0.5 * way);
                CHECK(between(metres(event.normal), {0, -1, 0}) < 1e-9);
            }
            if (restitution > 0) {
                const lks_event end = first_of(all, LKS_EVENT_CONTACT_END);
                const bool at_once = end.tick == first_of(all, LKS_EVENT_CONTACT_BEGIN).tick;
                CHECK(is_nowhere(end) != at_once);
            }
        }
    }
}

TEST_CASE(
    "two that meet in the air are told half way between their surfaces, the normal out of the lower index") {
    for (const bool swapped : {false, true}) {
        World world(world_def(60, 20));
        REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
        lks_body_def def = lks_default_body_def();
        def.linear_damping = 0;
        def.velocity = fixed(swapped ? -1 : 1, 0, 0);
        add_body(world, ball_shape(0.3), fixed(swapped ? 2 : -2, 0, 0), def);
        def.velocity = fixed(0, 0, 0);
        add_body(world, ball_shape(0.5), fixed(0, 0.4, 0), def);
        record(world);
        const lks_event event = first_of(run(world, 120), LKS_EVENT_CONTACT_BEGIN);
        // Their centres are 0.8 m apart then, 0.4 of it in height.
        const double side = swapped ? 1 : -1;
        const double across = std::sqrt(0.64 - 0.16);
        CHECK(distance_from(event, {side * across * 0.5 / 0.8, 0.4 - 0.4 * 0.5 / 0.8, 0}) < 3e-3);
        CHECK(between(metres(event.normal), {-side * across / 0.8, 0.5, 0}) < 0.01);
    }
}

TEST_CASE("a box that falls on an edge tells of the edge, one that lies of where it bears its weight") {
    World world(world_def(60, 8));
    add_ground(world);
    lks_body_def def = lks_default_body_def();
    def.transform.rotation = about(0, 0, 1, 30);
    add_body(world, box_shape(0.4, 0.2, 0.3), fixed(1, 1.5, 2), def);
    record(world);
    const std::vector<lks_event> fall = run(world, 60);
    // The lowest edge, turned by 30 degrees: (-0.4, -0.2) comes to x = -0.4 cos 30 + 0.2 sin 30.
    const double x = 1 - 0.4 * std::cos(std::numbers::pi / 6) + 0.2 * std::sin(std::numbers::pi / 6);
    CHECK(distance_from(first_of(fall, LKS_EVENT_CONTACT_BEGIN), {x, 0, 2}) < 0.012);

    // A long foot under a heavy head at one end: what loads the ground is told below the centre of mass.
    World scales(world_def(60, 8));
    add_ground(scales);
    lks_body_shape shapes[2] = {box_shape(0.5, 0.1, 0.3, 500), box_shape(0.1, 0.1, 0.1, 8000)};
    shapes[1].transform.position = fixed(0.3, 0.2, -0.1);
    lks_body_def body = lks_default_body_def();
    body.shapes = shapes;
    body.shape_count = 2;
    body.transform.position = fixed(0, 0.1, 0);
    body.never_sleeps = 1;
    lks_body_id id{};
    REQUIRE(lks_world_add_body(scales, &body, &id) == LKS_OK);
    const double foot = 500 * 1 * 0.2 * 0.6;
    const double head = 8000 * 0.008;
    scales.step(120);
    record(scales, LKS_ALL_EVENTS, 100);
    REQUIRE(lks_body_apply_impulse(scales, id, fixed(0, -200, 0),
                                   fixed(0.3 * head / (foot + head), 0.1, -0.1 * head / (foot + head))) ==
            LKS_OK);
    const lks_event struck = first_of(run(scales, 2), LKS_EVENT_CONTACT_HIT);
    CHECK(distance_from(struck, {0.3 * head / (foot + head), 0, -0.1 * head / (foot + head)}) < 0.01);
}

TEST_CASE("particles tell where they pushed most, and what breaks where it broke") {
    World world(world_def(60, 20));
    lks_body_def def = lks_default_body_def();
    def.kind = LKS_BODY_KINEMATIC;
    add_body(world, ball_shape(0.5), fixed(1, 0, 0), def);
    Chain chain;
    chain.segments = 20;
    const Asset rope = chain.build();
    world.add(rope, at(0, 1, 0)); // from x = 0 on
    record(world);
    const lks_event pushed = first_of(run(world, 60), LKS_EVENT_PARTICLES_PUSHED);
    CHECK(distance_from(pushed, {1, 0.5, 0}) < 0.06); // one link
    CHECK(std::abs(between(metres(pushed.point), {1, 0, 0}) - 0.5) < 0.01);
    const Vector outwards = metres(pushed.point) - Vector{1, 0, 0};
    CHECK(between(metres(pushed.normal), outwards * (1 / outwards.length())) < 0.01);

    World gallows(world_def(60, 8));
    const lks_body_id anchor = add_anchor(gallows, fixed(0, 2, 0));
    const lks_body_id ball = add_body(gallows, ball_shape(0.1), fixed(0, 1, 0));
    lks_joint_def joint = lks_default_joint_def();
    joint.break_force = fixed(0.9 * mass_of(gallows, ball) * 9.81);
    joint.frame_b.position = fixed(0, 1, 0);
    add_joint(gallows, joint, anchor, ball);
    const Asset other = Chain().build();
    lks_attachment_def hold = to_body(gallows.add(other, at(0, 3, 0)), 0, anchor, fixed(0, 1, 0));
    hold.break_force = fixed(1);
    attach(gallows, hold);
    record(gallows);
    const std::vector<lks_event> all = run(gallows, 30);
    CHECK(distance_from(first_of(all, LKS_EVENT_JOINT_BROKE), {0, 2, 0}) < 0.01);
    CHECK(distance_from(first_of(all, LKS_EVENT_ATTACHMENT_BROKE), {0, 3, 0}) < 0.02);
}

TEST_CASE("places are the same with more workers and with plain integers") {
    const auto tell = [](std::uint32_t workers, std::uint32_t simd) {
        lks_world_def def = world_def(60, 8);
        def.worker_count = workers;
        def.simd = simd;
        World world(def);
        add_ground(world);
        for (int i = 0; i < 40; ++i) {
            const lks_body_shape shape = i % 2 == 0 ? box_shape(0.1, 0.1, 0.1) : capsule_shape(0.08, 0.1);
            add_body(world, shape, fixed(0.05 * (i % 3), 0.2 + 0.3 * i, 0.04 * (i % 4)));
        }
        const Asset rope = Chain().build();
        world.add(rope, at(-1, 3, 0));
        record(world, LKS_ALL_EVENTS, 0.1, 10000);
        return run(world, 90);
    };
    const std::vector<lks_event> one = tell(1, LKS_SIMD_AUTO);
    CHECK(one.size() > 100);
    for (const std::vector<lks_event>& other : {tell(3, LKS_SIMD_AUTO), tell(1, LKS_SIMD_SCALAR)}) {
        REQUIRE(other.size() == one.size());
        int different = 0;
        for (std::size_t i = 0; i < one.size(); ++i) {
            different += same(one[i], other[i]) ? 0 : 1;
        }
        CHECK(different == 0);
    }
}
