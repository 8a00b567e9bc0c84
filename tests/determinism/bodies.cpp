// Rigid bodies are part of the state: saved, loaded into fresh and dirty worlds, moved and replayed to the
// bit.
#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <vector>

#include "support/attachments.h"
#include "support/bodies.h"
#include "support/builders.h"
#include "support/sanitised.h"

using namespace support;

namespace {

lks_world_def settings(std::uint32_t substeps, std::uint32_t workers, lks_simd simd) {
    lks_world_def def = world_def(60, substeps);
    def.worker_count = workers;
    def.simd = static_cast<std::uint32_t>(simd);
    return def;
}

// Two humanoids that fall onto each other, a stack, a ball that bounces into it, a moved plank, a rope's
// worth of links: contacts and joints of every kind.
class Playground {
public:
    explicit Playground(const lks_vec3& offset = {}, std::uint32_t workers = 1, lks_simd simd = LKS_SIMD_AUTO)
        : world(settings(6, workers, simd)), offset_(offset) {
        lks_collider_def ground = lks_default_collider_def();
        ground.shape = LKS_SHAPE_PLANE;
        ground.transform.position = place(0, 0, 0);
        world.add(ground);
        lks_collider_def step = lks_default_collider_def();
        step.shape = LKS_SHAPE_BOX;
        step.half_extents = fixed(0.5, 0.2, 1);
        step.transform.position = place(0.6, 0.2, 0);
        step.restitution = fixed(0.5);
        step.filter.category = 2;
        world.add(step);
        add_veil();
        add_humanoids();
        for (int i = 0; i < 4; ++i) {
            add_body(world, box_shape(0.2, 0.2, 0.2), place(-2, 0.2 + 0.4 * i, 0));
        }
        lks_body_def ball = lks_default_body_def();
        ball.restitution = fixed(0.6);
        ball.velocity = fixed(0, 2, -6);
        add_body(world, ball_shape(0.2), place(-2, 0.8, 3), ball);
        add_plank();
        add_links();
        add_cloth_and_rope();
    }

    void tick(int count) {
        for (int i = 0; i < count; ++i) {
            give_inputs();
            world.step();
        }
    }

    // What an image of it needs in an empty world.
    static void know_assets(const World& world) {
        REQUIRE(lks_world_register_asset(world, cloth()) == LKS_OK);
        REQUIRE(lks_world_register_asset(world, rope()) == LKS_OK);
    }

    World world;
    lks_body_id plank{};

private:
    static const Asset& cloth() {
        static const Asset asset = [] {
            Net net;
            net.side = 10;
            net.width = 1;
            net.radius = 0.01;
            return net.build();
        }();
        return asset;
    }

    static const Asset& rope() {
        static const Asset asset = [] {
            Chain chain;
            chain.segments = 6;
            chain.length = 0.6;
            chain.particle_mass = 0.1;
            return chain.build();
        }();
        return asset;
    }

    lks_vec3 place(double x, double y, double z) const { return offset_ + fixed(x, y, z); }

    // All fall through it but cloth and ropes.
    void add_veil() {
        lks_collider_def veil = lks_default_collider_def();
        veil.radius = fixed(0.15);
        veil.transform.position = place(-0.3, 0.4, 0.6);
        veil.filter.mask = LKS_CATEGORY_PARTICLES;
        world.add(veil);
    }

    void add_humanoids() {
        for (int i = 0; i < 2; ++i) {
            Humanoid humanoid;
            lks_transform& place_of = humanoid.def.transform;
            place_of.position = place(0.1 + 0.2 * i, 0.5 + 0.7 * i, 0.1 - 0.2 * i);
            REQUIRE(lks_rotation_from_axis_angle(1, 0.2, 0.1 * i, 60 + 70 * i, &place_of.rotation) == LKS_OK);
            humanoid.def.scale = fixed(1 - 0.3 * i);
            REQUIRE(humanoid.add(world) == LKS_OK);
        }
    }

    void add_plank() {
        lks_body_def def = lks_default_body_def();
        def.kind = LKS_BODY_KINEMATIC;
        plank = add_body(world, box_shape(1, 0.05, 0.3), place(3, 0.5, 0), def);
        add_body(world, capsule_shape(0.1, 0.3), place(3, 0.8, 0));
    }

    void add_links() {
        lks_body_id last = plank;
        for (int i = 0; i < 4; ++i) {
            const lks_body_id link = add_body(world, capsule_shape(0.03, 0.07), place(4, 0.4 - 0.2 * i, 0));
            lks_joint_def joint = lks_default_joint_def();
            joint.kind = i == 2 ? LKS_JOINT_DISTANCE : i == 3 ? LKS_JOINT_FIXED : LKS_JOINT_BALL;
            joint.frame_a.position = i == 0 ? fixed(1, 0, 0) : fixed(0, -0.1, 0);
            joint.frame_b.position = fixed(0, 0.1, 0);
            joint.distance_max = fixed(0.02);
            joint.compliance = i == 1 ? fixed(1e-4) : 0;
            joint.angular_damping = i == 2 ? fixed(0.01) : 0;
            if (i == 1) {
                joint.swing_limit = fixed(2);
                joint.limit_compliance = fixed(0.05);
                joint.limit_damping = fixed(0.1);
            }
            const lks_joint_id id = add_joint(world, joint, last, link);
            motor_joint_ = i == 0 ? id : motor_joint_;
            last = link;
        }
        last_link_ = last;
        // A motor swings the first one.
        const lks_motor motor{fixed(0.5), fixed(0.1), {0, 0, 1 << 29, 929887697}};
        REQUIRE(lks_joint_set_motor(world, motor_joint_, &motor) == LKS_OK);
    }

    // A cloth falls over the humanoids, one of its corners on the last link by a soft attachment; a rope from
    // the plank to the stack, with a second one tied to its middle.
    void add_cloth_and_rope() {
        lks_transform over{place(-0.4, 1.6, 0.5), {}};
        REQUIRE(lks_rotation_from_axis_angle(1, 0, 0, -90, &over.rotation) == LKS_OK);
        const lks_object_id sheet = world.add(cloth(), over);
        const lks_object_id line = world.add(rope(), {place(3, 0.55, 0.3), {0, 0, 0, LKS_ROTATION_ONE}});
        const lks_object_id branch = world.add(rope(), {place(3.3, 0.55, 0.3), {0, 0, 0, LKS_ROTATION_ONE}});
        lks_attachment_def softly = to_body(sheet, 9, last_link_);
        softly.compliance = fixed(0.01);
        softly.damping = fixed(5);
        attach(world, softly);
        attach(world, to_body(line, 0, plank, fixed(0, 0.05, 0.3)));
        attach(world, to_vertex(branch, 0, line, 3));
    }

    void give_inputs() {
        const auto tick = static_cast<std::int64_t>(world.tick());
        lks_transform target{};
        REQUIRE(lks_body_transform(world, plank, &target) == LKS_OK);
        target.position.y =
            offset_.y + fixed(0.5) + (tick % 120 < 60 ? tick % 60 : 60 - tick % 60) * fixed(0.01);
        REQUIRE(lks_body_move_to(world, plank, target) == LKS_OK);
        if (tick % 40 == 7) {
            REQUIRE(lks_body_apply_impulse(world, {2, 1}, fixed(5, 20, -3), place(0.1, 1, 0)) == LKS_OK);
        }
    }

    lks_vec3 offset_;
    lks_body_id last_link_{};
    lks_joint_id motor_joint_{};
};

// With lanes, and several workers, as with plain integers: hashes_of(workers, simd).
template <typename HashesOf>
void check_lanes(const HashesOf& hashes_of) {
    const std::vector<std::uint64_t> expected = hashes_of(1, LKS_SIMD_SCALAR);
    for (const lks_simd simd : {LKS_SIMD_AVX2, LKS_SIMD_AVX512}) {
        if (lks_simd_is_available(simd) != 0) {
            INFO(std::string(lks_simd_name(simd)));
            CHECK(hashes_of(1, simd) == expected);
            CHECK(hashes_of(3, simd) == expected);
        }
    }
}

} // namespace

TEST_CASE("bodies saved in the middle of a pile go on with the same bits, in a fresh and in a dirty world") {
    Playground original;
    original.tick(45);
    const Image image = original.world.save();
    Playground dirty({}, 1);
    dirty.tick(200);
    Playground fresh;
    REQUIRE(lks_world_load(dirty.world, image.data(), image.size()) == LKS_OK);
    REQUIRE(lks_world_load(fresh.world, image.data(), image.size()) == LKS_OK);
    World empty(world_def(60, 6));
    Playground::know_assets(empty);
    REQUIRE(lks_world_load(empty, image.data(), image.size()) == LKS_OK);
    CHECK(empty.hash() == original.world.hash());
    CHECK(empty.save() == image);
    for (int i = 0; i < (sanitised ? 20 : 120); ++i) {
        REQUIRE(dirty.world.hash() == original.world.hash());
        REQUIRE(fresh.world.hash() == original.world.hash());
        original.tick(5);
        dirty.tick(5);
        fresh.tick(5);
    }
    CHECK(dirty.world.save() == original.world.save());
}

TEST_CASE("rolling back and running again gives the same bits at every tick") {
    Playground playground;
    playground.tick(20);
    for (int round = 0; round < (sanitised ? 5 : 20); ++round) {
        const Image image = playground.world.save();
        playground.tick(7);
        const std::uint64_t hash = playground.world.hash();
        const lks_result loaded = lks_world_load(playground.world, image.data(), image.size());
        INFO(playground.world.message());
        REQUIRE(loaded == LKS_OK);
        playground.tick(7);
        REQUIRE(playground.world.hash() == hash);
    }
}

TEST_CASE("where in the world bodies are changes no bit of how they move") {
    const lks_vec3 offsets[] = {{12345678901, -98765432109, 55555555555},
                                fixed(7000000, -7000000, 7000000.25)};
    for (const lks_vec3& offset : offsets) {
        Playground here;
        Playground there(offset);
        for (int i = 0; i < 60; ++i) {
            REQUIRE(here.world.local_hash() == there.world.local_hash());
            here.tick(5);
            there.tick(5);
        }
        CHECK(here.world.hash() != there.world.hash());
    }
}

TEST_CASE("bodies don't depend on the number of workers") {
    Playground one;
    Playground three({}, 3);
    one.tick(120);
    three.tick(120);
    CHECK(one.world.hash() == three.world.hash());
}

TEST_CASE("bodies, cloth and ropes that touch have the same bits on every instruction set") {
    Playground plain({}, 1, LKS_SIMD_SCALAR);
    std::vector<std::uint64_t> expected;
    for (int i = 0; i < 48; ++i) {
        plain.tick(5);
        expected.push_back(plain.world.hash());
    }
    for (const lks_simd simd :
         {LKS_SIMD_SSE41, LKS_SIMD_AVX2, LKS_SIMD_AVX512, LKS_SIMD_NEON, LKS_SIMD_WASM}) {
        if (lks_simd_is_available(simd) == 0) {
            continue;
        }
        INFO(std::string(lks_simd_name(simd)));
        Playground wide({}, 2, simd);
        for (const std::uint64_t hash : expected) {
            wide.tick(5);
            REQUIRE(wide.world.hash() == hash);
        }
    }
}

TEST_CASE("a crowd whose trees are solved side by side has the bits of plain integers") {
    // Two sizes; one is held, one has a foot of a tonne, and another one loses a limb.
    const auto hashes_of = [](std::uint32_t workers, lks_simd simd) {
        World world(settings(6, workers, simd));
        add_ground(world);
        lks_joint_id joints[LKS_HUMANOID_BONES - 1];
        for (int i = 0; i < 15; ++i) {
            Humanoid humanoid;
            const int row = i / 3;
            humanoid.def.transform = {fixed(0.4 * (i % 3), 0.4 + 0.5 * row, -0.9 + 0.1 * i),
                                      about(1, 0, 0, 90)};
            humanoid.def.scale = fixed(i < 11 ? 1 : 0.6);
            if (i == 3) {
                humanoid.bones[LKS_HUMANOID_HEAD].body.kind = LKS_BODY_KINEMATIC;
            }
            if (i == 6) {
                humanoid.bones[LKS_HUMANOID_FOOT_LEFT].body.mass = fixed(1000);
            }
            REQUIRE(humanoid.add(world, nullptr, i == 8 ? joints : nullptr) == LKS_OK);
        }
        std::vector<std::uint64_t> hashes;
        for (int i = 0; i < 60; ++i) {
            if (i == 20) {
                REQUIRE(lks_world_remove_joint(world, joints[4]) == LKS_OK);
            }
            world.step();
            hashes.push_back(world.hash());
        }
        return hashes;
    };
    check_lanes(hashes_of);
}

TEST_CASE("figures that hang on ropes among others that don't have the bits of plain integers") {
    Chain chain;
    chain.segments = 8;
    chain.length = 1;
    chain.particle_mass = 0.05;
    chain.solver = LKS_ROPE_DIRECT;
    const Asset rope = chain.build();
    for (std::uint32_t roped = 0; roped < 4; ++roped) {
        const auto hashes_of = [&](std::uint32_t workers, lks_simd simd) {
            World world(settings(6, workers, simd));
            lks_attachment_id held{};
            for (std::uint32_t i = 0; i < 4; ++i) {
                Humanoid humanoid;
                humanoid.def.transform = {fixed(2.0 * i, 0, 0), about(1, 0, 0, 0)};
                lks_body_id bodies[LKS_HUMANOID_BONES];
                REQUIRE(humanoid.add(world, bodies) == LKS_OK);
                if (i == roped) {
                    const Vector hand = state_of(world, bodies[LKS_HUMANOID_HAND_LEFT]).position;
                    const lks_object_id line = world.add(
                        rope, {fixed(hand.x - chain.length, hand.y, hand.z), {0, 0, 0, LKS_ROTATION_ONE}});
                    world.pin(line, 0);
                    held = attach(world, to_body(line, chain.segments, bodies[LKS_HUMANOID_HAND_LEFT]));
                }
            }
            std::vector<std::uint64_t> hashes;
            for (int tick = 0; tick < 60; ++tick) {
                if (tick == 45) {
                    REQUIRE(lks_world_remove_attachment(world, held) == LKS_OK);
                }
                world.step();
                hashes.push_back(world.hash());
            }
            return hashes;
        };
        INFO("number ", roped);
        check_lanes(hashes_of);
    }
}

TEST_CASE("figures that are thrown at a wall, some of them ahead, have the bits of plain integers") {
    const auto hashes_of = [](std::uint32_t workers, lks_simd simd) {
        World world(settings(8, workers, simd));
        add_box(world, fixed(0.025, 20, 20), fixed(3, 0, 0));
        add_body(world, box_shape(0.025, 2, 2, 20000), fixed(2.5, 0, 2));
        for (int i = 0; i < 12; ++i) {
            Humanoid humanoid;
            humanoid.def.transform = {fixed(0.3 * (i % 5) - 0.6, 0, 0.8 * i - 4), about(1, 2, i, 40 * i)};
            humanoid.def.velocity = fixed(i == 7 ? 5 : 60, 0, 0);
            REQUIRE(humanoid.add(world) == LKS_OK);
        }
        std::vector<std::uint64_t> hashes;
        for (int i = 0; i < 30; ++i) {
            world.step();
            hashes.push_back(world.hash());
        }
        return hashes;
    };
    check_lanes(hashes_of);
}

TEST_CASE("figures that are held by a hand or led by a bone have the bits of plain integers") {
    const auto hashes_of = [](std::uint32_t workers, lks_simd simd) {
        World world(settings(8, workers, simd));
        lks_body_id anchors[9];
        lks_body_id led[9];
        for (int i = 0; i < 9; ++i) {
            Humanoid humanoid;
            humanoid.def.transform = {fixed(0, 0, 4 * i), about(0, 1, 0, 20 * i)};
            lks_body_id bodies[LKS_HUMANOID_BONES];
            REQUIRE(humanoid.add(world, bodies) == LKS_OK);
            // And one of which a bone itself is led.
            humanoid.def.transform.position.x = fixed(4);
            lks_body_id others[LKS_HUMANOID_BONES];
            REQUIRE(humanoid.add(world, others) == LKS_OK);
            led[i] = others[(5 + 3 * i) % LKS_HUMANOID_BONES];
            REQUIRE(lks_body_set_kind(world, led[i], LKS_BODY_KINEMATIC) == LKS_OK);
            const lks_body_id hand = bodies[i % 2 == 0 ? LKS_HUMANOID_HAND_LEFT : LKS_HUMANOID_HAND_RIGHT];
            const Vector place = state_of(world, hand).position;
            anchors[i] = add_anchor(world, fixed(place.x, place.y, place.z));
            add_joint(world, lks_default_joint_def(), anchors[i], hand);
        }
        std::vector<std::uint64_t> hashes;
        for (int i = 0; i < 60; ++i) {
            for (const lks_body_id body : {anchors[4], led[0], led[2], led[3], led[7]}) {
                lks_transform to{};
                REQUIRE(lks_body_transform(world, body, &to) == LKS_OK);
                to.position.x += fixed(0.05);
                REQUIRE(lks_body_move_to(world, body, to) == LKS_OK);
            }
            world.step();
            hashes.push_back(world.hash());
        }
        return hashes;
    };
    check_lanes(hashes_of);
}

TEST_CASE("a pile saved as it lands goes on for 600 ticks with other workers and instructions" *
          doctest::skip(sanitised)) {
    const auto fill = [](World& world, int count) {
        add_ground(world);
        for (int i = 0; i < count; ++i) {
            Humanoid humanoid;
            humanoid.def.transform = {fixed(0.2 * (i % 2), 0.4 + 0.5 * i, -0.9), about(1, 0, 0, 90)};
            REQUIRE(humanoid.add(world) == LKS_OK);
        }
    };
    World original(settings(8, 1, LKS_SIMD_AUTO));
    fill(original, 6);
    original.step(50);
    lks_fixed moving = 0;
    REQUIRE(lks_world_kinetic_energy(original, &moving) == LKS_OK);
    REQUIRE(moving > LKS_FIXED(100)); // some lie, some still fall
    const Image image = original.save();
    World fresh(settings(8, 4, LKS_SIMD_SCALAR));
    World dirty(settings(8, 2, LKS_SIMD_AUTO));
    fill(dirty, 8);
    dirty.step(120);
    for (World* world : {&fresh, &dirty}) {
        REQUIRE(lks_world_load(*world, image.data(), image.size()) == LKS_OK);
    }
    for (int tick = 0; tick < 600; ++tick) {
        original.step();
        fresh.step();
        dirty.step();
        REQUIRE(fresh.hash() == original.hash());
        REQUIRE(dirty.hash() == original.hash());
    }
    CHECK(lks_world_awake_body_count(original) == 0);
    CHECK(fresh.save() == original.save());
    CHECK(dirty.save() == original.save());
}

TEST_CASE("groups of bodies that have nothing to do with each other may be added in any order") {
    // A figure that falls, a stack that is struck, a chain on an anchor, a ball that hangs on a rope.
    Chain shape;
    shape.segments = 6;
    shape.particle_mass = 0.1;
    const Asset rope = shape.build();
    using Group = std::function<std::vector<lks_body_id>(World&)>;
    const Group groups[] = {
        [](World& world) {
            Humanoid humanoid;
            humanoid.def.transform = {fixed(0, 0.5, 0), about(1, 0.3, 0, 70)};
            std::vector<lks_body_id> bodies(LKS_HUMANOID_BONES);
            REQUIRE(humanoid.add(world, bodies.data()) == LKS_OK);
            return bodies;
        },
        [](World& world) {
            std::vector<lks_body_id> bodies;
            for (int i = 0; i < 4; ++i) {
                bodies.push_back(add_body(world, box_shape(0.2, 0.2, 0.2), fixed(20, 0.2 + 0.4 * i, 0)));
            }
            lks_body_def ball = lks_default_body_def();
            ball.velocity = fixed(5, 1, 0);
            bodies.push_back(add_body(world, ball_shape(0.2), fixed(18, 1, 0.1), ball));
            return bodies;
        },
        [](World& world) {
            std::vector<lks_body_id> bodies{add_anchor(world, fixed(40, 3, 0))};
            for (int i = 0; i < 5; ++i) {
                bodies.push_back(add_body(world, capsule_shape(0.05, 0.15), fixed(40.2 + 0.4 * i, 3, 0)));
                lks_joint_def joint = lks_default_joint_def();
                joint.frame_a.position = fixed(i == 0 ? 0 : 0.2, 0, 0);
                joint.frame_b.position = fixed(-0.2, 0, 0);
                add_joint(world, joint, bodies[bodies.size() - 2], bodies.back());
            }
            return bodies;
        },
        [&](World& world) {
            const lks_object_id line = world.add(rope, at(60, 5, 0));
            world.pin(line, 0);
            lks_attachment_def def = lks_default_attachment_def();
            def.object = line;
            def.vertex = 6;
            def.body = add_body(world, ball_shape(0.2), fixed(60 + shape.length, 5, 0));
            lks_attachment_id id{};
            REQUIRE(lks_world_add_attachment(world, &def, &id) == LKS_OK);
            return std::vector<lks_body_id>{def.body};
        }};
    // Where all bodies of each group end.
    const auto run = [&](const std::vector<int>& order, std::uint32_t workers) {
        lks_world_def def = world_def(60, 8);
        def.worker_count = workers;
        World world(def);
        add_ground(world);
        std::vector<std::vector<lks_body_id>> bodies(std::size(groups));
        for (const int group : order) {
            bodies[static_cast<std::size_t>(group)] = groups[group](world);
        }
        world.step(180);
        std::vector<std::int64_t> found;
        for (const std::vector<lks_body_id>& group : bodies) {
            for (const lks_body_id body : group) {
                lks_transform place{};
                lks_vec3 velocity{};
                lks_vec3 spin{};
                REQUIRE(lks_body_transform(world, body, &place) == LKS_OK);
                REQUIRE(lks_body_velocity(world, body, &velocity, &spin) == LKS_OK);
                for (const lks_vec3& v : {place.position, velocity, spin}) {
                    found.insert(found.end(), {v.x, v.y, v.z});
                }
                const lks_rotation& q = place.rotation;
                found.insert(found.end(), {q.x, q.y, q.z, q.w});
            }
        }
        return found;
    };
    const std::vector<std::int64_t> expected = run({0, 1, 2, 3}, 1);
    CHECK(run({3, 2, 1, 0}, 1) == expected);
    CHECK(run({1, 3, 0, 2}, 1) == expected);
    CHECK(run({2, 0, 3, 1}, 4) == expected);
    CHECK(run({2, 1}, 1) != expected); // it looks at all of them
}

TEST_CASE("a broken image of bodies is refused and leaves the world as it was") {
    Playground playground;
    playground.tick(30);
    const Image good = playground.world.save();
    World world(world_def(60, 6));
    Playground::know_assets(world);
    REQUIRE(lks_world_load(world, good.data(), good.size()) == LKS_OK);
    const std::uint64_t hash = world.hash();
    Image bad = good;
    bad.bytes()[good.size() / 2] ^= 1;
    CHECK(lks_world_load(world, bad.data(), bad.size()) == LKS_ERROR_CORRUPT_IMAGE);
    CHECK(world.hash() == hash);
    CHECK(lks_world_load(world, good.data(), good.size() - 8) == LKS_ERROR_CORRUPT_IMAGE);
    CHECK(world.hash() == hash);
}

TEST_CASE("where contacts are more than there is room for, they are lost alike in every world, and counted") {
    // Forty balls in one place: 780 pairs, where 64 + 16 · 40 find room.
    World one(world_def(60, 4));
    REQUIRE(lks_world_set_gravity(one, {0, 0, 0}) == LKS_OK);
    for (int i = 0; i < 40; ++i) {
        add_body(one, ball_shape(0.5), fixed(0.01 * i, 0.013 * (i % 7), 0.017 * (i % 5)));
    }
    const Image image = one.save();
    World two(world_def(60, 4));
    // Memory for many more bodies, which are gone again.
    for (int i = 0; i < 300; ++i) {
        add_body(two, ball_shape(0.1), fixed(i, 50, 0));
    }
    REQUIRE(lks_world_load(two, image.data(), image.size()) == LKS_OK);
    one.step(20);
    two.step(20);
    CHECK(one.hash() == two.hash());
    CHECK(one.counters().lost_contacts > 0);
    CHECK(two.counters().lost_contacts > 0);
}

TEST_CASE("a sleeping body that is struck wakes with the same bits in a world that was loaded") {
    World original(world_def(60, 8));
    add_ground(original);
    lks_body_def def = lks_default_body_def();
    def.restitution = fixed(0.8);
    const lks_body_id target = add_body(original, capsule_shape(0.2, 0.3), fixed(0, 0.5, 0), def);
    original.step(600);
    REQUIRE(lks_body_is_awake(original, target) == 0);
    def.velocity = fixed(-6, 0, 0);
    def.gravity_factor = 0;
    // So near that it strikes in the first substep.
    add_body(original, ball_shape(0.1), fixed(0.305, state_of(original, target).position.y + 0.1, 0.01), def);
    const Image image = original.save();
    World loaded(world_def(60, 8));
    REQUIRE(lks_world_load(loaded, image.data(), image.size()) == LKS_OK);
    for (int tick = 0; tick < 120; ++tick) {
        original.step();
        loaded.step();
        REQUIRE(original.hash() == loaded.hash());
    }
    CHECK(state_of(original, target).position.x < -0.05);
}
