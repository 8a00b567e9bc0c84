// Objects carried along by a frame that jumps: nothing but where they are changes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/attachments.h"
#include "support/places.h"
#include "support/scene.h"

using namespace support;

namespace {

constexpr lks_rotation no_turn{0, 0, 0, LKS_ROTATION_ONE};
const lks_rotation quarter_turn{0, 759250125, 0, 759250125}; // about y: z becomes x, and x -z

// A net that swings on two pins, one of which moves, with forces recorded and previous positions kept.
struct Swinging {
    Swinging(const Asset& net, const lks_vec3& place) : world(definition()) {
        lks_object_def def = object_def(net, at(place));
        def.record_forces = 1;
        object = world.add(def);
        world.pin(object, 0);
        world.pin(object, 9);
        REQUIRE(lks_object_add_velocity(world, object, fixed(0.3, 0, 2)) == LKS_OK);
        lead(place);
        world.step(20);
    }

    static lks_world_def definition() {
        lks_world_def def = world_def(60, 8);
        def.keep_previous_positions = 1;
        return def;
    }

    static Net net() {
        Net net;
        net.side = 10;
        net.width = 0.9;
        net.shear = soft(1e-6, 10);
        net.anchors = {0, 9};
        return net;
    }

    void lead(const lks_vec3& place) {
        target = place + fixed(-0.4, 0.5, 0.05);
        world.set_target(object, 0, target);
    }

    World world;
    lks_object_id object{};
    lks_vec3 target{};
};

double worst_speed(const World& world, lks_object_id object) {
    double worst = 0;
    for (const lks_vec3& velocity : world.velocities(object)) {
        worst = std::max(worst, metres(velocity).length());
    }
    return worst;
}

double gap_of(const World& world, lks_attachment_id id) {
    lks_fixed error = 0;
    REQUIRE(lks_attachment_error(world, id, &error) == LKS_OK);
    return metres(error);
}

// A torso that moves and turns as it likes, with a cape that swings on its shoulders.
struct Wearer {
    explicit Wearer(const Asset& net, std::uint32_t kind) : world(world_def(60, 8)) {
        lks_body_def def = lks_default_body_def();
        def.kind = kind;
        def.gravity_factor = 0;
        def.velocity = fixed(0.5, 0, -1);
        def.angular_velocity = fixed(0, 0.5, 0);
        torso = add_body(world, box_shape(0.2, 0.3, 0.1), fixed(3, 2, 1), def);
        cape = world.add(net, at(3, 1.8, 0.88));
        const std::vector<lks_vec3> places = world.positions(cape);
        for (std::uint32_t i = 0; i < side; ++i) {
            grips.push_back(attach(world, to_body(cape, i, torso, places[i] - fixed(3, 2, 1))));
        }
        REQUIRE(lks_object_add_velocity(world, cape, fixed(0.2, 0, -1.5)) == LKS_OK);
        world.step(40);
    }

    static Net net() {
        Net net;
        net.side = side;
        net.width = 0.4;
        net.shear = soft(1e-6, 10);
        net.bend = soft(1e-3);
        net.radius = 0.01;
        return net;
    }

    lks_transform place() const {
        lks_transform place{};
        REQUIRE(lks_body_transform(world, torso, &place) == LKS_OK);
        return place;
    }

    void jump(const lks_transform& to, bool with_cape = true) {
        const lks_transform from = place();
        const BodyState before = state_of(world, torso);
        REQUIRE(lks_body_set_transform(world, torso, to) == LKS_OK);
        if (lks_body_get_kind(world, torso) == LKS_BODY_DYNAMIC) {
            const lks_rotation& q = from.rotation;
            const lks_rotation turn = product(to.rotation, {-q.x, -q.y, -q.z, q.w});
            const Vector velocity = rotate(turn, before.velocity);
            const Vector spin = rotate(turn, before.spin);
            REQUIRE(lks_body_set_velocity(world, torso, fixed(velocity.x, velocity.y, velocity.z),
                                          fixed(spin.x, spin.y, spin.z)) == LKS_OK);
        }
        if (with_cape) {
            teleport(world, cape, from, to);
        }
    }

    double worst_gap() const {
        double worst = 0;
        for (const lks_attachment_id id : grips) {
            worst = std::max(worst, gap_of(world, id));
        }
        return worst;
    }

    // Of its stretched edges, as shares of their lengths.
    double worst_stretch() const {
        const std::vector<Vector> p = world.positions_from(cape, place().position);
        const double rest = 0.4 / (side - 1);
        double worst = 0;
        for (std::size_t i = 0; i < p.size(); ++i) {
            if (i % side + 1 < side) {
                worst = std::max(worst, (p[i + 1] - p[i]).length() / rest - 1);
            }
            if (i + side < p.size()) {
                worst = std::max(worst, (p[i + side] - p[i]).length() / rest - 1);
            }
        }
        return worst;
    }

    static constexpr std::uint32_t side = 12;
    World world;
    lks_body_id torso{};
    lks_object_id cape{};
    std::vector<lks_attachment_id> grips;
};

std::int64_t greatest_difference(const std::vector<lks_raw_position>& a,
                                 const std::vector<lks_raw_position>& b) {
    std::int64_t worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        worst = std::max(
            {worst, std::abs(a[i].x - b[i].x), std::abs(a[i].y - b[i].y), std::abs(a[i].z - b[i].z)});
    }
    return worst;
}

} // namespace

TEST_CASE("an object that is carried without a turn moves as one that was made there, to the bit") {
    const Asset net = Swinging::net().build();
    Random random(1);
    const std::int64_t limit = LKS_FIXED(4000000);
    for (int round = 0; round < 12; ++round) {
        const auto any = [&] {
            return lks_vec3{random.between(-limit, limit), random.between(-limit, limit),
                            random.between(-limit, limit)};
        };
        const lks_vec3 by = round == 0 ? lks_vec3{1, 0, -1} : any();
        const lks_vec3 frame = any();
        const lks_rotation rotation = about(1, 2, 3, 10.0 * round);
        Swinging here(net, fixed(0.1, 2, 0));
        Swinging there(net, fixed(0.1, 2, 0) + by);
        const std::vector<lks_raw_position> raw = here.world.raw_positions(here.object);
        const std::vector<lks_vec3> velocities = here.world.velocities(here.object);
        const lks_vec3 origin = here.world.origin(here.object);
        const double force = here.world.force(here.object, 5);
        REQUIRE(here.world.hash() != there.world.hash());
        teleport(here.world, here.object, {frame, rotation}, {frame + by, rotation});
        CHECK(same(here.world.raw_positions(here.object), raw));
        CHECK(same(here.world.velocities(here.object), velocities));
        CHECK(same(here.world.origin(here.object), origin + by));
        CHECK(here.world.force(here.object, 5) == force);
        CHECK(force != 0);
        CHECK(here.world.hash() == there.world.hash());
        CHECK(drawn(here.world, here.object, 0) == drawn(here.world, here.object, LKS_VIEW_LAST_TICK));
        here.world.step();
        there.world.step();
        CHECK(here.world.hash() == there.world.hash());
        here.lead(fixed(0.2, 2, 0) + by);
        there.lead(fixed(0.2, 2, 0) + by);
        here.world.step(20);
        there.world.step(20);
        CHECK(here.world.hash() == there.world.hash());
    }
}

TEST_CASE("an object reaches any place in the world from any other in one call") {
    const Asset net = Swinging::net().build();
    Swinging scene(net, fixed(8387000, -8387000, 0));
    const std::vector<lks_raw_position> raw = scene.world.raw_positions(scene.object);
    teleport(scene.world, scene.object, at(8388000, -8388000, 0), at(-8386000, 8386000, 0));
    CHECK(same(scene.world.raw_positions(scene.object), raw));
    // By a frame at the other end of it.
    const lks_vec3 origin = scene.world.origin(scene.object);
    teleport(scene.world, scene.object, at(8388000, -8388000, 0), at(8387900, -8387900, 0));
    CHECK(same(scene.world.origin(scene.object), origin + fixed(-100, 100, 0)));
    // Half a turn about the middle of the world, by a frame at its edge.
    const std::vector<lks_vec3> before = scene.world.positions(scene.object);
    teleport(scene.world, scene.object, at(8388000, 0, 0),
             {fixed(-8388000, 0, 0), {0, LKS_ROTATION_ONE, 0, 0}});
    const std::vector<lks_vec3> after = scene.world.positions(scene.object);
    bool turned = true;
    for (std::size_t i = 0; i < before.size(); ++i) {
        // Where they are drawn to is rounded half up.
        turned = turned && std::abs(after[i].x + before[i].x) <= 1 && after[i].y == before[i].y &&
                 std::abs(after[i].z + before[i].z) <= 1;
    }
    CHECK(turned);
}

TEST_CASE("a quarter turn permutes coordinates, velocities and targets exactly, and four are none") {
    const Asset net = Swinging::net().build();
    Swinging scene(net, fixed(0.1, 2, 0));
    World& world = scene.world;
    const lks_vec3 pivot = fixed(5, 1, -3);
    const std::vector<lks_vec3> velocities = world.velocities(scene.object);
    const std::vector<lks_raw_position> raw = world.raw_positions(scene.object);
    const lks_vec3 origin = world.origin(scene.object);
    teleport(world, scene.object, {pivot, no_turn}, {pivot, quarter_turn});
    const std::vector<lks_raw_position> now = world.raw_positions(scene.object);
    const lks_vec3 o = world.origin(scene.object);
    bool exact = true;
    for (std::size_t i = 0; i < raw.size(); ++i) {
        // In units of 2^-56 m, modulo 2^64.
        const auto place = [](std::int64_t frame, std::int64_t x, std::int64_t about) {
            return (static_cast<std::uint64_t>(frame - about) << 16) + static_cast<std::uint64_t>(x);
        };
        exact = exact && place(o.x, now[i].x, pivot.x) == place(origin.z, raw[i].z, pivot.z) &&
                place(o.y, now[i].y, pivot.y) == place(origin.y, raw[i].y, pivot.y) &&
                place(o.z, now[i].z, pivot.z) == 0 - place(origin.x, raw[i].x, pivot.x);
    }
    CHECK(exact);
    const std::vector<lks_vec3> turned = world.velocities(scene.object);
    bool alike = true;
    for (std::size_t i = 0; i < turned.size(); ++i) {
        alike = alike && turned[i].x == velocities[i].z && turned[i].y == velocities[i].y &&
                turned[i].z == -velocities[i].x;
    }
    CHECK(alike);
    CHECK(drawn(world, scene.object, 0) == drawn(world, scene.object, LKS_VIEW_LAST_TICK));
    for (int i = 0; i < 3; ++i) {
        teleport(world, scene.object, {pivot, no_turn}, {pivot, quarter_turn});
    }
    CHECK(same(world.velocities(scene.object), velocities));
    const Vector back =
        metres(world.positions(scene.object)[7]) -
        (metres(origin) + Vector{raw_metres(raw[7].x), raw_metres(raw[7].y), raw_metres(raw[7].z)});
    CHECK(back.length() < 2e-12);
    teleport(world, scene.object, {pivot, no_turn}, {pivot, quarter_turn});
    // Its target has turned with it.
    world.step();
    const lks_vec3 arm = scene.target - pivot;
    CHECK(same(world.positions(scene.object)[0], pivot + lks_vec3{arm.z, arm.y, -arm.x}));
    CHECK(world.counters().target_clamps == 0);
}

TEST_CASE("any turn is undone by its reverse within two units of 2^-56 m, and is the one asked for") {
    const Asset net = Swinging::net().build();
    Swinging scene(net, fixed(0.1, 2, 0));
    World& world = scene.world;
    // From now on its origin is in its middle.
    teleport(world, scene.object, {{}, no_turn}, {{}, quarter_turn});
    Random random(2);
    std::int64_t worst = 0;
    double deviation = 0;
    for (int round = 0; round < 200; ++round) {
        const auto any = [&](double range) {
            return range * (static_cast<double>(random.between(0, 2000000)) / 1e6 - 1);
        };
        const lks_transform from{fixed(any(3), any(3), any(3)), about(any(1), any(1), 1, any(360))};
        const lks_transform to{fixed(any(3), any(3), any(3)), about(any(1), any(1), 1, any(360))};
        const std::vector<lks_raw_position> raw = world.raw_positions(scene.object);
        const std::vector<lks_vec3> places = world.positions(scene.object);
        const std::vector<lks_vec3> velocities = world.velocities(scene.object);
        const lks_vec3 origin = world.origin(scene.object);
        teleport(world, scene.object, from, to);
        const lks_rotation& q = from.rotation;
        const lks_rotation turn = product(to.rotation, {-q.x, -q.y, -q.z, q.w});
        const std::vector<Vector> now = world.positions_from(scene.object, to.position);
        const std::vector<lks_vec3> turned = world.velocities(scene.object);
        for (std::size_t i = 0; i < now.size(); ++i) {
            deviation =
                std::max({deviation, (now[i] - rotate(turn, metres(places[i] - from.position))).length(),
                          (metres(turned[i]) - rotate(turn, metres(velocities[i]))).length()});
        }
        teleport(world, scene.object, to, from);
        const lks_vec3 shift = world.origin(scene.object) - origin;
        std::vector<lks_raw_position> back = world.raw_positions(scene.object);
        for (lks_raw_position& x : back) {
            x = {x.x + (shift.x << 16), x.y + (shift.y << 16), x.z + (shift.z << 16)};
        }
        worst = std::max(worst, greatest_difference(back, raw));
    }
    MESSAGE("off by " << worst << " units after a turn and its reverse, from doubles by " << deviation);
    CHECK(worst <= 2);
    CHECK(worst > 0);
    CHECK(deviation < 1e-7); // what the test's own quaternions are rounded by
}

TEST_CASE("a pin's target that a turn takes out of its object's range is clamped and counted") {
    World world;
    const Asset asset = Chain().build();
    const lks_object_id object = world.add(asset, at(0, 0, 0));
    world.pin(object, 0);
    world.set_target(object, 0, fixed(60, 0, 60));
    teleport(world, object, at(0, 0, 0), at(1, 0, 0));
    CHECK(world.counters().target_clamps == 0);
    teleport(world, object, at(0, 0, 0), turned(at(0, 0, 0), 0, 1, 0, 45));
    CHECK(world.counters().target_clamps == 1);
}

TEST_CASE("a cape goes with its wearer as if neither had gone anywhere") {
    const Asset net = Wearer::net().build();
    for (const std::uint32_t kind : {LKS_BODY_KINEMATIC, LKS_BODY_DYNAMIC}) {
        for (const double degrees : {0.0, 90.0, 180.0, -37.0}) {
            Wearer stays(net, kind);
            Wearer jumps(net, kind);
            const lks_transform from = jumps.place();
            lks_transform to{from.position + fixed(6, -5, 6.2),
                             product(about(0, 1, 0, degrees), from.rotation)};
            const double gap = jumps.worst_gap();
            const double stretch = jumps.worst_stretch();
            jumps.jump(to);
            const double opened = jumps.worst_gap() - gap;
            CHECK(opened < 1e-9);
            CHECK(std::abs(jumps.worst_stretch() - stretch) < 1e-11);
            double speed = 0;
            double deviation = 0;
            double stretched = 0;
            for (int tick = 0; tick < 60; ++tick) {
                stays.world.step();
                jumps.world.step();
                speed = std::max(speed, worst_speed(jumps.world, jumps.cape));
                deviation = std::max(deviation, std::abs(worst_speed(jumps.world, jumps.cape) -
                                                         worst_speed(stays.world, stays.cape)));
                stretched = std::max(stretched, jumps.worst_stretch() - stays.worst_stretch());
            }
            MESSAGE("kind " << kind << ", " << degrees << " degrees: " << speed
                            << " m/s at most, off the twin by " << deviation << ", more stretch by "
                            << stretched << ", opened by " << opened);
            CHECK(speed > 0.5);
            CHECK(deviation < 2e-5);
            CHECK(stretched < 1e-6);
        }
    }
}

TEST_CASE("a cape that stays behind is dragged after its wearer") {
    const Asset net = Wearer::net().build();
    Wearer jumps(net, LKS_BODY_KINEMATIC);
    jumps.jump(at(10, 2, 1), false);
    double speed = 0;
    for (int tick = 0; tick < 30; ++tick) {
        jumps.world.step();
        speed = std::max(speed, worst_speed(jumps.world, jumps.cape));
    }
    MESSAGE(speed << " m/s");
    CHECK(speed > 20);
}

TEST_CASE("objects that are tied to each other stay so where all are carried") {
    World world(world_def(60, 8));
    Chain chain;
    chain.segments = 10;
    chain.length = 1;
    chain.particle_mass = 0.1;
    chain.solver = LKS_ROPE_DIRECT;
    const Asset rope = chain.build();
    const lks_object_id first = world.add(rope, at(0, 5, 0));
    const lks_object_id second = world.add(rope, at(1, 5, 0));
    world.pin(first, 0);
    const lks_body_id ball = add_body(world, ball_shape(0.1), fixed(2, 5, 0));
    const lks_attachment_id knot = attach(world, to_vertex(second, 0, first, 10));
    const lks_attachment_id hook = attach(world, to_body(second, 10, ball));
    world.step(30);
    const lks_transform from = at(0.3, 4, 0);
    const lks_transform to{fixed(-100, 300, 12.7), about(0, 1, 0, 77)};
    const double knot_gap = gap_of(world, knot);
    const double hook_gap = gap_of(world, hook);
    lks_transform place{};
    REQUIRE(lks_body_transform(world, ball, &place) == LKS_OK);
    const Vector velocity = rotate(to.rotation, state_of(world, ball).velocity);
    const Vector spin = rotate(to.rotation, state_of(world, ball).spin);
    REQUIRE(lks_body_set_transform(world, ball, carried(place, from, to)) == LKS_OK);
    REQUIRE(lks_body_set_velocity(world, ball, fixed(velocity.x, velocity.y, velocity.z),
                                  fixed(spin.x, spin.y, spin.z)) == LKS_OK);
    const double energy = energy_of(world);
    teleport(world, first, from, to);
    teleport(world, second, from, to);
    CHECK(std::abs(gap_of(world, knot) - knot_gap) < 2e-12);
    CHECK(std::abs(gap_of(world, hook) - hook_gap) < 1e-8); // where the test has put the ball
    world.step();
    CHECK(gap_of(world, knot) < 1e-6);
    CHECK(gap_of(world, hook) < 1e-6);
    CHECK(energy_of(world) > 0.5 * energy);
    CHECK(energy_of(world) < 1.5 * energy);
}

TEST_CASE("who sleeps on a cloth that is carried away wakes, and who sleeps where it comes to") {
    World world(world_def(60, 8));
    add_ground(world);
    Net net;
    net.side = 12;
    net.width = 1.1;
    net.radius = 0.02;
    const Asset asset = net.build();
    const lks_object_id cloth = world.add(asset, turned(at(0, 1, 0), 1, 0, 0, 90));
    for (std::uint32_t i = 0; i < 144; ++i) {
        world.pin(cloth, i);
    }
    const lks_body_id above = add_body(world, box_shape(0.2, 0.1, 0.2, 200), fixed(0, 1.13, 0));
    const lks_body_id below = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(5, 0.2, 0));
    const lks_body_id beside = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(5, 0.2, 3));
    world.step(300);
    REQUIRE(lks_world_awake_body_count(world) == 0);
    const Image asleep = world.save();
    const auto is_awake = [&](lks_body_id body) { return lks_body_is_awake(world, body) == 1; };

    teleport(world, cloth, at(0, 1, 0), at(5, 0.42, 0)); // two centimetres above a box, as thick as it is
    CHECK(is_awake(above));
    CHECK(is_awake(below));
    CHECK_FALSE(is_awake(beside));
    world.step(60);
    CHECK(state_of(world, above).position.y < 0.2);

    REQUIRE(lks_world_load(world, asleep.data(), asleep.size()) == LKS_OK);
    teleport(world, cloth, at(0, 1, 0), at(0, 1, 0));
    world.step(60);
    CHECK(state_of(world, above).position.y > 1.1);

    REQUIRE(lks_world_load(world, asleep.data(), asleep.size()) == LKS_OK);
    std::vector<lks_vec3> places = world.positions(cloth);
    for (lks_vec3& place : places) {
        place = place + fixed(5, -0.58, 0);
    }
    REQUIRE(lks_object_set_positions(world, cloth, 0, 0, places.data()) == LKS_OK);
    CHECK_FALSE(is_awake(above));
    lay(world, cloth, 0, places);
    CHECK(is_awake(above));
    CHECK(is_awake(below));
    CHECK_FALSE(is_awake(beside));
}

TEST_CASE("nothing is hit on the way of an object that is carried through a wall") {
    const Asset net = Swinging::net().build();
    Swinging free(net, fixed(0, 2, 0));
    Swinging walled(net, fixed(0, 2, 0));
    add_box(walled.world, fixed(0.5, 30, 30), fixed(10, 0, 0));
    add_body(walled.world, box_shape(0.2, 5, 5), fixed(15, 0, 0));
    for (Swinging* const scene : {&free, &walled}) {
        teleport(scene->world, scene->object, at(0, 0, 0), at(20, 0, 0));
        scene->world.step(5);
    }
    CHECK(lks_object_hash(free.world, free.object) == lks_object_hash(walled.world, walled.object));
}

TEST_CASE("an image taken between a jump and the next tick leads to the same future") {
    const Asset net = Wearer::net().build();
    Wearer first(net, LKS_BODY_DYNAMIC);
    Wearer second(net, LKS_BODY_DYNAMIC);
    const Image before = first.world.save();
    const lks_transform to{fixed(-20, 3, 7), about(1, 2, 3, 50)};
    first.jump(to);
    const Image after = first.world.save();
    first.world.step(30);
    second.world.step(3);
    REQUIRE(lks_world_load(second.world, after.data(), after.size()) == LKS_OK);
    second.world.step(30);
    CHECK(first.world.hash() == second.world.hash());
    REQUIRE(lks_world_load(second.world, before.data(), before.size()) == LKS_OK);
    second.jump(to);
    second.world.step(30);
    CHECK(first.world.hash() == second.world.hash());
}
