// What the game changes of bodies that exist is state: saved, loaded into fresh and dirty worlds, rolled
// back, and the same with any number of workers and any instructions.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "support/attachments.h"
#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

lks_world_def settings(std::uint32_t workers, lks_simd simd) {
    lks_world_def def = world_def(60, 6);
    def.worker_count = workers;
    def.simd = static_cast<std::uint32_t>(simd);
    return def;
}

// Figures, boxes and balls on the ground and on a kinematic table, a cloth over some of them and a rope in a
// hand; each tick one of the bodies is changed. The inputs of a tick depend on its number alone.
class Changing {
public:
    explicit Changing(std::uint32_t workers = 1, lks_simd simd = LKS_SIMD_AUTO, int figures = 2)
        : world(settings(workers, simd)) {
        add_ground(world);
        lks_body_def def = lks_default_body_def();
        def.kind = LKS_BODY_KINEMATIC;
        bodies.push_back(add_body(world, box_shape(1, 0.2, 1), fixed(0, 0.2, 0), def));
        for (int i = 0; i < 6; ++i) {
            bodies.push_back(add_body(world, box_shape(0.15, 0.15, 0.15), fixed(0.1 * i, 0.6 + 0.31 * i, 0)));
            bodies.push_back(add_body(world, ball_shape(0.1), fixed(0.5 * i - 1.5, 0.8, 0.4)));
        }
        lks_body_id hand{};
        for (int i = 0; i < figures; ++i) {
            Humanoid humanoid;
            humanoid.def.transform.position = fixed(0.8 * (i % 8) - 1, 1, 1.5 + i / 8);
            lks_body_id bones[LKS_HUMANOID_BONES];
            REQUIRE(humanoid.add(world, bones) == LKS_OK);
            bodies.insert(bodies.end(), bones, bones + LKS_HUMANOID_BONES);
            hand = bones[LKS_HUMANOID_HAND_LEFT];
        }
        world.add(cloth, turned(at(-0.5, 1.6, -0.5), 1, 0, 0, -90));
        const Vector grip = state_of(world, hand).position;
        const lks_object_id line =
            world.add(rope, {fixed(grip.x - 1, grip.y, grip.z), {0, 0, 0, LKS_ROTATION_ONE}});
        world.pin(line, 0);
        attach(world, to_body(line, 8, hand));
    }

    void tick(int count) {
        for (int i = 0; i < count; ++i) {
            change();
            world.step();
        }
    }

    // By this tick's number.
    void change() {
        const std::uint64_t n = world.tick();
        const lks_body_id body = bodies[(7 * n) % bodies.size()];
        const double part = static_cast<double>(n % 11) / 11;
        switch (n % 6) {
        case 0:
            REQUIRE(lks_body_set_gravity_factor(world, body, fixed(1.5 - 2 * part)) == LKS_OK);
            break;
        case 1:
            REQUIRE(lks_body_set_damping(world, body, fixed(part), fixed(2 * part)) == LKS_OK);
            break;
        case 2:
            REQUIRE(lks_body_set_surface(world, body, fixed(part), fixed(part / 2), fixed(part)) == LKS_OK);
            break;
        case 3: {
            const lks_filter filters[] = {{1, 0xffffffffu, 0},
                                          {3, 0xfffffffdu, 0},
                                          {2, 1, -1},
                                          {1, 0x7fffffffu, 0},
                                          {1, 0xffffffffu, 2}};
            REQUIRE(lks_body_set_filter(world, body, filters[n % 5]) == LKS_OK);
            break;
        }
        case 4:
            REQUIRE(lks_body_set_never_sleeps(world, body, n % 4 == 0 ? 1u : 0u) == LKS_OK);
            break;
        default:
            REQUIRE(lks_body_set_kind(world, body, n % 4 == 1 ? LKS_BODY_KINEMATIC : LKS_BODY_DYNAMIC) ==
                    LKS_OK);
        }
    }

    std::vector<std::uint64_t> hashes(int ticks) {
        std::vector<std::uint64_t> all;
        for (int i = 0; i < ticks; ++i) {
            tick(1);
            all.push_back(world.hash());
        }
        return all;
    }

    static Asset make_cloth() {
        Net shape;
        shape.side = 10;
        shape.width = 1;
        return shape.build();
    }
    static Asset make_rope() {
        Chain chain;
        chain.segments = 8;
        chain.length = 1;
        return chain.build();
    }

    Asset cloth = make_cloth();
    Asset rope = make_rope();
    World world;
    std::vector<lks_body_id> bodies;
};

} // namespace

TEST_CASE("a world whose bodies are changed goes on from an image, in a fresh and in a dirty world") {
    for (const int saved : {15, 47, 90}) {
        CAPTURE(saved);
        Changing original;
        original.tick(saved);
        original.change(); // not yet seen by any tick
        const Image image = original.world.save();
        const std::uint64_t hash = original.world.hash();
        original.world.step();
        const std::vector<std::uint64_t> future = original.hashes(60);
        Changing fresh;
        Changing dirty;
        dirty.tick(saved / 2);
        Changing ahead;
        ahead.tick(saved + 20);
        for (Changing* other : {&fresh, &dirty, &ahead, &original}) {
            REQUIRE(lks_world_load(other->world, image.data(), image.size()) == LKS_OK);
            CHECK(other->world.hash() == hash);
            CHECK(other->world.save() == image);
            other->world.step();
            CHECK(other->hashes(60) == future);
        }
    }
}

TEST_CASE("a world that loads changed bodies reads what they were changed to") {
    Changing original;
    original.tick(70);
    const Image image = original.world.save();
    Changing with_assets;
    REQUIRE(lks_world_load(with_assets.world, image.data(), image.size()) == LKS_OK);
    for (const lks_body_id body : original.bodies) {
        lks_fixed a[7] = {};
        lks_fixed b[7] = {};
        lks_filter filter_a{};
        lks_filter filter_b{};
        const auto read = [body](const World& world, lks_fixed(&to)[7], lks_filter& filter) {
            REQUIRE(lks_body_gravity_factor(world, body, to) == LKS_OK);
            REQUIRE(lks_body_damping(world, body, to + 1, to + 2) == LKS_OK);
            REQUIRE(lks_body_surface(world, body, to + 3, to + 4, to + 5) == LKS_OK);
            REQUIRE(lks_body_filter(world, body, &filter) == LKS_OK);
            to[6] = lks_body_never_sleeps(world, body);
        };
        read(original.world, a, filter_a);
        read(with_assets.world, b, filter_b);
        for (int i = 0; i < 7; ++i) {
            CHECK(a[i] == b[i]);
        }
        CHECK(filter_a.category == filter_b.category);
        CHECK(filter_a.mask == filter_b.mask);
        CHECK(filter_a.group == filter_b.group);
    }
}

TEST_CASE("rolled back across every change, a world comes to the same hashes") {
    Changing rolled;
    Changing straight;
    const std::vector<std::uint64_t> expected = straight.hashes(120);
    std::size_t done = 0;
    while (done < expected.size()) {
        const Image image = rolled.world.save();
        const std::size_t ahead = std::min<std::size_t>(8, expected.size() - done);
        rolled.tick(static_cast<int>(ahead));
        REQUIRE(lks_world_load(rolled.world, image.data(), image.size()) == LKS_OK);
        for (std::size_t i = 0; i < ahead; ++i) {
            rolled.tick(1);
            CHECK(rolled.world.hash() == expected[done++]);
        }
    }
}

TEST_CASE("changed bodies have the same bits with any number of workers and any instructions") {
    // Enough of them for workers to be woken.
    const auto hashes_of = [](std::uint32_t workers, lks_simd simd) {
        Changing changing(workers, simd, 16);
        return changing.hashes(40);
    };
    const std::vector<std::uint64_t> expected = hashes_of(1, LKS_SIMD_SCALAR);
    for (const lks_simd simd : {LKS_SIMD_SSE41, LKS_SIMD_AVX2, LKS_SIMD_AVX512}) {
        if (lks_simd_is_available(simd) != 0) {
            INFO(std::string(lks_simd_name(simd)));
            CHECK(hashes_of(1, simd) == expected);
            CHECK(hashes_of(3, simd) == expected);
        }
    }
}
