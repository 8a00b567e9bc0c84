// What a body was added with is read back and changed within the ranges, and with the sentences, of its
// definition.
#include <doctest/doctest.h>

#include <functional>
#include <string>

#include "support/bodies.h"
#include "support/refusals.h"

using namespace support;

namespace {

lks_body_def odd_definition() {
    lks_body_def def = lks_default_body_def();
    def.gravity_factor = fixed(-0.5);
    def.linear_damping = fixed(0.25);
    def.angular_damping = fixed(3);
    def.static_friction = fixed(2);
    def.dynamic_friction = fixed(1.5);
    def.restitution = fixed(0.75);
    def.filter = {6, 0x80000009u, -4};
    def.never_sleeps = 1;
    return def;
}

void check_reads(const World& world, lks_body_id body, const lks_body_def& def) {
    lks_fixed a = 1;
    lks_fixed b = 2;
    lks_fixed c = 3;
    lks_filter filter{};
    CHECK(lks_body_gravity_factor(world, body, &a) == LKS_OK);
    CHECK(a == def.gravity_factor);
    CHECK(lks_body_damping(world, body, &a, &b) == LKS_OK);
    CHECK(a == def.linear_damping);
    CHECK(b == def.angular_damping);
    CHECK(lks_body_surface(world, body, &a, &b, &c) == LKS_OK);
    CHECK(a == def.static_friction);
    CHECK(b == def.dynamic_friction);
    CHECK(c == def.restitution);
    CHECK(lks_body_filter(world, body, &filter) == LKS_OK);
    CHECK(filter.category == def.filter.category);
    CHECK(filter.mask == def.filter.mask);
    CHECK(filter.group == def.filter.group);
    CHECK(lks_body_never_sleeps(world, body) == def.never_sleeps);
}

lks_result set_all(const World& world, lks_body_id body, const lks_body_def& def) {
    const lks_result results[] = {
        lks_body_set_gravity_factor(world, body, def.gravity_factor),
        lks_body_set_damping(world, body, def.linear_damping, def.angular_damping),
        lks_body_set_surface(world, body, def.static_friction, def.dynamic_friction, def.restitution),
        lks_body_set_filter(world, body, def.filter),
        lks_body_set_never_sleeps(world, body, def.never_sleeps),
    };
    for (const lks_result result : results) {
        if (result != LKS_OK) {
            return result;
        }
    }
    return LKS_OK;
}

// One field that is out of its range, and the call that sets it.
struct Case {
    std::function<void(lks_body_def&)> change;
    std::function<lks_result(lks_world*, lks_body_id, const lks_body_def&)> set;
    const char* value;
};

lks_result set_gravity(lks_world* world, lks_body_id body, const lks_body_def& d) {
    return lks_body_set_gravity_factor(world, body, d.gravity_factor);
}
lks_result set_damping(lks_world* world, lks_body_id body, const lks_body_def& d) {
    return lks_body_set_damping(world, body, d.linear_damping, d.angular_damping);
}
lks_result set_surface(lks_world* world, lks_body_id body, const lks_body_def& d) {
    return lks_body_set_surface(world, body, d.static_friction, d.dynamic_friction, d.restitution);
}
lks_result set_never_sleeps(lks_world* world, lks_body_id body, const lks_body_def& d) {
    return lks_body_set_never_sleeps(world, body, d.never_sleeps);
}

const Case cases[] = {
    {[](lks_body_def& d) { d.gravity_factor = fixed(101); }, set_gravity, "101"},
    {[](lks_body_def& d) { d.gravity_factor = fixed(-100) - 1; }, set_gravity, "gravity factor -100"},
    {[](lks_body_def& d) { d.linear_damping = -1; }, set_damping, "linear damping"},
    {[](lks_body_def& d) { d.linear_damping = fixed(1001); }, set_damping, "1001"},
    {[](lks_body_def& d) { d.angular_damping = fixed(-1); }, set_damping, "angular damping -1"},
    {[](lks_body_def& d) { d.angular_damping = fixed(1000) + 1; }, set_damping, "angular damping 1000"},
    {[](lks_body_def& d) { d.static_friction = fixed(101); }, set_surface, "static friction 101"},
    {[](lks_body_def& d) { d.static_friction = -1; }, set_surface, "static friction"},
    {[](lks_body_def& d) { d.dynamic_friction = d.static_friction + 1; }, set_surface, "dynamic friction"},
    {[](lks_body_def& d) { d.dynamic_friction = -1; }, set_surface, "dynamic friction"},
    {[](lks_body_def& d) { d.restitution = fixed(1.5); }, set_surface, "restitution 1.5"},
    {[](lks_body_def& d) { d.restitution = -1; }, set_surface, "restitution"},
    {[](lks_body_def& d) { d.never_sleeps = 2; }, set_never_sleeps, "never_sleeps 2"},
};

} // namespace

TEST_CASE("a body tells what it was added with, and then what it was changed to") {
    World world;
    const lks_body_id plain = add_body(world, ball_shape(0.1), {});
    const lks_body_id odd = add_body(world, ball_shape(0.1), fixed(1, 0, 0), odd_definition());
    check_reads(world, plain, lks_default_body_def());
    check_reads(world, odd, odd_definition());
    REQUIRE(set_all(world, plain, odd_definition()) == LKS_OK);
    REQUIRE(set_all(world, odd, lks_default_body_def()) == LKS_OK);
    check_reads(world, plain, odd_definition());
    check_reads(world, odd, lks_default_body_def());
    // Places for results may be left out, one or all.
    lks_fixed value = 0;
    CHECK(lks_body_damping(world, plain, nullptr, &value) == LKS_OK);
    CHECK(value == fixed(3));
    CHECK(lks_body_damping(world, plain, nullptr, nullptr) == LKS_OK);
    CHECK(lks_body_surface(world, plain, nullptr, nullptr, &value) == LKS_OK);
    CHECK(value == fixed(0.75));
    CHECK(lks_body_surface(world, plain, nullptr, nullptr, nullptr) == LKS_OK);
}

TEST_CASE("the ends of all ranges, and every filter, are taken") {
    World world;
    const lks_body_id body = add_body(world, ball_shape(0.1), {});
    for (const double factor : {-100.0, 0.0, 100.0}) {
        CHECK(lks_body_set_gravity_factor(world, body, fixed(factor)) == LKS_OK);
    }
    CHECK(lks_body_set_damping(world, body, 0, fixed(1000)) == LKS_OK);
    CHECK(lks_body_set_damping(world, body, fixed(1000), 0) == LKS_OK);
    CHECK(lks_body_set_surface(world, body, fixed(100), fixed(100), LKS_FIXED_ONE) == LKS_OK);
    CHECK(lks_body_set_surface(world, body, 0, 0, 0) == LKS_OK);
    for (const lks_filter& filter : {lks_filter{0, 0, 0}, {~0u, ~0u, INT32_MAX}, {1, 0, INT32_MIN}}) {
        CHECK(lks_body_set_filter(world, body, filter) == LKS_OK);
    }
}

TEST_CASE("what is changed is the same as if it had been added so") {
    World changed;
    World added;
    const lks_body_id body = add_body(changed, box_shape(0.1, 0.2, 0.3), {});
    add_body(added, box_shape(0.1, 0.2, 0.3), {}, odd_definition());
    CHECK(changed.hash() != added.hash());
    REQUIRE(set_all(changed, body, odd_definition()) == LKS_OK);
    CHECK(changed.hash() == added.hash());
    CHECK(changed.save() == added.save());
    changed.step(30);
    added.step(30);
    CHECK(changed.hash() == added.hash());
}

TEST_CASE("each of them alone is seen by the hash, and what is the same changes nothing") {
    World world(world_def(60, 8));
    add_ground(world);
    const lks_body_id body = add_body(world, ball_shape(0.1), fixed(0, 0.1, 0), odd_definition());
    world.step(20); // it has rested for a while, which a change would take back
    const lks_body_def same = odd_definition();
    const std::uint64_t before = world.hash();
    const Image image = world.save();
    REQUIRE(set_all(world, body, same) == LKS_OK);
    CHECK(world.hash() == before);
    const std::function<void(lks_body_def&)> changes[] = {
        [](lks_body_def& d) { ++d.gravity_factor; },   [](lks_body_def& d) { ++d.linear_damping; },
        [](lks_body_def& d) { ++d.angular_damping; },  [](lks_body_def& d) { ++d.static_friction; },
        [](lks_body_def& d) { ++d.dynamic_friction; }, [](lks_body_def& d) { ++d.restitution; },
        [](lks_body_def& d) { ++d.filter.category; },  [](lks_body_def& d) { ++d.filter.mask; },
        [](lks_body_def& d) { ++d.filter.group; },     [](lks_body_def& d) { d.never_sleeps = 0; },
    };
    for (const auto& change : changes) {
        lks_body_def def = same;
        change(def);
        REQUIRE(set_all(world, body, def) == LKS_OK);
        CHECK(world.hash() != before);
        CHECK(world.local_hash() != before);
        check_reads(world, body, def);
        REQUIRE(lks_world_load(world, image.data(), image.size()) == LKS_OK);
        check_reads(world, body, same);
        CHECK(world.hash() == before);
    }
}

TEST_CASE("what is out of range is refused with the sentence of the definition") {
    World world;
    const lks_body_id body = add_body(world, ball_shape(0.1), {}, odd_definition());
    const lks_body_id anchor = add_anchor(world, fixed(3, 0, 0));
    for (const Case& bad : cases) {
        lks_body_shape shape = ball_shape(0.1);
        lks_body_def def = lks_default_body_def();
        def.shapes = &shape;
        def.shape_count = 1;
        bad.change(def);
        lks_body_id id{};
        check_call_refused(world, LKS_ERROR_INVALID_ARGUMENT, bad.value,
                           [&] { return lks_world_add_body(world, &def, &id); });
        const std::string sentence = world.message();
        check_call_refused(world, LKS_ERROR_INVALID_ARGUMENT, bad.value,
                           [&] { return bad.set(world, body, def); });
        CHECK(world.message() == sentence);
        check_call_refused(world, LKS_ERROR_INVALID_ARGUMENT, bad.value,
                           [&] { return bad.set(world, anchor, def); });
        check_reads(world, body, odd_definition());
    }
}

TEST_CASE("settings of bodies that are gone, of no world, or with nowhere to go, are refused") {
    World world;
    add_body(world, ball_shape(0.1), fixed(1, 0, 0));
    const lks_body_id body = add_body(world, ball_shape(0.1), {});
    const lks_body_id gone = add_body(world, ball_shape(0.1), fixed(2, 0, 0));
    REQUIRE(lks_world_remove_body(world, gone) == LKS_OK);
    lks_fixed value = fixed(7);
    lks_filter filter{7, 7, 7};
    const auto call = [&](int which, lks_world* w, lks_body_id id) {
        switch (which) {
        case 0:
            return lks_body_set_gravity_factor(w, id, 0);
        case 1:
            return lks_body_gravity_factor(w, id, &value);
        case 2:
            return lks_body_set_damping(w, id, 0, 0);
        case 3:
            return lks_body_damping(w, id, &value, &value);
        case 4:
            return lks_body_set_surface(w, id, 0, 0, 0);
        case 5:
            return lks_body_surface(w, id, &value, &value, &value);
        case 6:
            return lks_body_set_filter(w, id, {});
        case 7:
            return lks_body_filter(w, id, &filter);
        default:
            return lks_body_set_never_sleeps(w, id, 1);
        }
    };
    for (int which = 0; which < 9; ++which) {
        CAPTURE(which);
        check_call_refused(world, LKS_ERROR_STALE_ID, "index 2", [&] { return call(which, world, gone); });
        check_call_refused(world, LKS_ERROR_STALE_ID, "index 99", [&] {
            return call(which, world, {99, 1});
        });
        CHECK(call(which, nullptr, body) == LKS_ERROR_NULL_ARGUMENT);
    }
    CHECK(value == fixed(7));
    CHECK(filter.mask == 7);
    CHECK(lks_body_never_sleeps(world, gone) == 0);
    CHECK(lks_body_never_sleeps(nullptr, body) == 0);
    check_call_refused(world, LKS_ERROR_NULL_ARGUMENT, "factor",
                       [&] { return lks_body_gravity_factor(world, body, nullptr); });
    check_call_refused(world, LKS_ERROR_NULL_ARGUMENT, "filter",
                       [&] { return lks_body_filter(world, body, nullptr); });
}
