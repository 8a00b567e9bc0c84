// Attachments that are refused, each with a sentence.
#include <doctest/doctest.h>

#include <functional>

#include "support/attachments.h"
#include "support/bodies.h"
#include "support/builders.h"
#include "support/refusals.h"

using namespace support;

namespace {

struct Case {
    std::function<void(lks_attachment_def&)> change;
    const char* value;
    lks_result expected = LKS_ERROR_INVALID_ARGUMENT;
};

} // namespace

TEST_CASE("attachments out of range, of what is gone or can't move, are refused") {
    World world(world_def(60, 8));
    const Asset rope = Chain().build();
    const lks_object_id object = world.add(rope, at(0, 0, 0));
    const lks_object_id gone = world.add(rope, at(0, 0, 0));
    REQUIRE(lks_world_remove_object(world, gone) == LKS_OK);
    world.pin(object, 0);
    world.pin(object, 19);
    const lks_body_id body = add_body(world, ball_shape(0.1), fixed(5, 0, 0));
    const lks_body_id anchor = add_anchor(world, {});
    const auto to_vertex = [&](lks_attachment_def& d) {
        d.kind = LKS_ATTACHMENT_TO_VERTEX;
        d.other_object = object;
    };
    const Case cases[] = {
        {[](lks_attachment_def& d) { d.struct_size = 1; }, "1", LKS_ERROR_STRUCT_SIZE},
        {[](lks_attachment_def& d) { d.kind = 2; }, "kind 2"},
        {[&](lks_attachment_def& d) { d.object = gone; }, "index 1", LKS_ERROR_STALE_ID},
        {[](lks_attachment_def& d) { d.vertex = 20; }, "20"},
        {[](lks_attachment_def& d) { d.body.generation = 7; }, "generation 7", LKS_ERROR_STALE_ID},
        {[](lks_attachment_def& d) { d.point.y = fixed(-65); }, "-65"},
        {[](lks_attachment_def& d) { d.compliance = fixed(-1); }, "compliance -1"},
        {[](lks_attachment_def& d) { d.damping = fixed(-1); }, "damping -1"},
        {[](lks_attachment_def& d) { d.break_force = fixed(-1); }, "break_force -1"},
        {[&](lks_attachment_def& d) { d.vertex = 0, d.body = anchor; }, "vertex 0"},
        {[&](lks_attachment_def& d) { to_vertex(d), d.vertex = 5, d.other_vertex = 5; }, "vertex 5"},
        {[&](lks_attachment_def& d) { to_vertex(d), d.vertex = 0, d.other_vertex = 19; }, "vertex 0"},
        {[&](lks_attachment_def& d) { to_vertex(d), d.other_vertex = 99; }, "99"},
        {[&](lks_attachment_def& d) { to_vertex(d), d.other_object = gone; }, "index 1", LKS_ERROR_STALE_ID},
    };
    lks_attachment_def good = lks_default_attachment_def();
    good.object = object;
    good.vertex = 3;
    good.body = body;
    for (const Case& bad : cases) {
        lks_attachment_def def = good;
        bad.change(def);
        lks_attachment_id id{};
        check_call_refused(world, bad.expected, bad.value,
                           [&] { return lks_world_add_attachment(world, &def, &id); });
    }
    lks_attachment_id id{};
    CHECK(lks_world_add_attachment(nullptr, &good, &id) == LKS_ERROR_NULL_ARGUMENT);
    CHECK(lks_world_add_attachment(world, nullptr, &id) == LKS_ERROR_NULL_ARGUMENT);
    CHECK(lks_world_add_attachment(world, &good, nullptr) == LKS_ERROR_NULL_ARGUMENT);
    REQUIRE(lks_world_add_attachment(world, &good, &id) == LKS_OK);
    CHECK(lks_attachment_error(world, id, nullptr) == LKS_ERROR_NULL_ARGUMENT);
    CHECK(lks_attachment_force(world, id, nullptr) == LKS_ERROR_NULL_ARGUMENT);
    REQUIRE(lks_world_remove_body(world, body) == LKS_OK);
    CHECK(lks_world_has_attachment(world, id) == 0);
    lks_fixed error = 0;
    check_call_refused(world, LKS_ERROR_STALE_ID, "index 0",
                       [&] { return lks_attachment_error(world, id, &error); });
    check_call_refused(world, LKS_ERROR_STALE_ID, "index 0",
                       [&] { return lks_world_remove_attachment(world, id); });
    world.step(3);
}

TEST_CASE("what hangs on what is torn away, or is in the same place, ends where it can") {
    World world(world_def(60, 2));
    const Asset rope = Chain().build();
    const lks_object_id object = world.add(rope, at(0, 0, 0));
    world.pin(object, 0);
    const lks_body_id body = add_body(world, ball_shape(0.1), fixed(2, 0, 0));
    lks_attachment_def def = lks_default_attachment_def();
    def.object = object;
    def.vertex = 19;
    def.body = body;
    lks_attachment_id id{};
    REQUIRE(lks_world_add_attachment(world, &def, &id) == LKS_OK);
    world.set_target(object, 0, fixed(-50, 0, 0));
    world.step(30);
    REQUIRE(lks_body_set_transform(world, body, at(5000, 0, 0)) == LKS_OK);
    world.step(30);
    REQUIRE(lks_body_set_velocity(world, body, fixed(100, 100, 100), fixed(50, 50, 50)) == LKS_OK);
    world.step(600);
    lks_fixed error = 0;
    REQUIRE(lks_attachment_error(world, id, &error) == LKS_OK);
    CHECK(error >= 0);
    // Everything in one point, and a second attachment that contradicts the first.
    const lks_object_id other = world.add(rope, at(0, 0, 0));
    def.kind = LKS_ATTACHMENT_TO_VERTEX;
    def.other_object = other;
    def.vertex = 4;
    REQUIRE(lks_world_add_attachment(world, &def, &id) == LKS_OK);
    def.other_vertex = 19;
    REQUIRE(lks_world_add_attachment(world, &def, &id) == LKS_OK);
    world.step(120);
    for (const lks_object_id rope_of : {object, other}) {
        for (const lks_vec3& position : world.positions(rope_of)) {
            CHECK(metres(position).length() < 6000); // near what pulls at it, 5 km away
        }
    }
    CHECK(energy_of(world) < 1e9);
}

TEST_CASE("a vertex is rigidly held at one thing that can't move, not at two") {
    World world(world_def(60, 4));
    const Asset rope = Chain().build();
    const lks_object_id object = world.add(rope, at(0, 0, 0));
    const lks_object_id other = world.add(rope, at(0, 1, 0));
    world.pin(other, 0);
    const lks_body_id left = add_anchor(world, fixed(-1, 0, 0));
    const lks_body_id right = add_anchor(world, fixed(1, 0, 0));
    const auto held = [&](lks_body_id body) {
        lks_attachment_def def = lks_default_attachment_def();
        def.object = object;
        def.vertex = 19;
        def.body = body;
        return def;
    };
    lks_attachment_id id{};
    const lks_attachment_def first = held(left);
    REQUIRE(lks_world_add_attachment(world, &first, &id) == LKS_OK);
    const auto refused = [&](const lks_attachment_def& def) {
        lks_attachment_id none{};
        check_call_refused(world, LKS_ERROR_INVALID_ARGUMENT, "vertex 19",
                           [&] { return lks_world_add_attachment(world, &def, &none); });
    };
    lks_attachment_def to_pinned = held(right);
    to_pinned.kind = LKS_ATTACHMENT_TO_VERTEX;
    to_pinned.other_object = other;
    to_pinned.other_vertex = 0;
    lks_attachment_def from_pinned = to_pinned;
    from_pinned.object = other;
    from_pinned.vertex = 0;
    from_pinned.other_object = object;
    from_pinned.other_vertex = 19;
    for (const lks_attachment_def& def : {held(right), held(left), to_pinned, from_pinned}) {
        refused(def);
    }
    check_call_refused(world, LKS_ERROR_INVALID_ARGUMENT, "vertex 19",
                       [&] { return lks_object_pin(world, object, 19); });

    // What gives way contradicts nothing, nor does what can move, nor another vertex.
    lks_attachment_def soft = held(right);
    soft.compliance = fixed(0.001);
    lks_attachment_def breakable = held(right);
    breakable.break_force = fixed(100);
    lks_attachment_def to_free = to_pinned;
    to_free.other_vertex = 5;
    lks_attachment_def next = held(right);
    next.vertex = 18;
    for (const lks_attachment_def& def : {soft, breakable, to_free, next}) {
        lks_attachment_id more{};
        CHECK(lks_world_add_attachment(world, &def, &more) == LKS_OK);
    }
    world.step(30);
    REQUIRE(lks_world_remove_attachment(world, id) == LKS_OK);
    CHECK(lks_object_pin(world, object, 19) == LKS_OK);
    world.step(30);
}

TEST_CASE("a vertex is rigidly held at one point of a body, not at two") {
    for (const bool pinned : {false, true}) {
        World world(world_def(60, 8));
        const Asset rope = Chain().build();
        const lks_object_id object = world.add(rope, at(0, 0, 0));
        if (pinned) {
            world.pin(object, 0);
        }
        lks_body_shape shape = box_shape(0.2, 0.2, 0.2);
        shape.transform.position.x = fixed(0.5); // points are those of the frame, not of the middle
        const lks_body_id body = add_body(world, shape, fixed(-0.3, 0, 0));
        const lks_body_id second = add_body(world, shape, fixed(0.3, 0, 0));
        const lks_attachment_def first = to_body(object, 0, body, fixed(0.2, 0.15, 0));
        const lks_attachment_id id = attach(world, first);
        lks_attachment_def other = to_body(object, 0, body, fixed(0.2, -0.15, 0));
        const auto refused = [&](const char* value) {
            lks_attachment_id none{};
            check_call_refused(world, LKS_ERROR_INVALID_ARGUMENT, value,
                               [&] { return lks_world_add_attachment(world, &other, &none); });
        };
        for (const char* value : {"index 0", "vertex 0", "(0.2, 0.15, 0)", "(0.2, -0.15, 0)"}) {
            refused(value);
        }
        // What gives way contradicts nothing, nor does the same point, another vertex, or another body.
        lks_attachment_def soft = other;
        soft.compliance = fixed(0.001);
        lks_attachment_def breakable = other;
        breakable.break_force = fixed(100);
        lks_attachment_def next = other;
        next.vertex = 1;
        lks_attachment_def elsewhere = other;
        elsewhere.body = second;
        for (const lks_attachment_def& def : {soft, breakable, next, elsewhere, first}) {
            attach(world, def);
        }
        world.step(30);
        REQUIRE(lks_world_remove_attachment(world, id) == LKS_OK);
        refused("index 5"); // the same point's
        const Image image = world.save();
        CHECK(lks_world_load(world, image.data(), image.size()) == LKS_OK);
    }
}
