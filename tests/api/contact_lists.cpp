// The list of who touches whom, as a call: what it writes, and what it refuses.
#include <doctest/doctest.h>

#include "support/bodies.h"
#include "support/refusals.h"

using namespace support;

namespace {

// Three balls that lie on the ground, apart.
struct Balls {
    Balls() : world(world_def(60, 8)) {
        add_ground(world);
        for (int i = 0; i < 3; ++i) {
            add_body(world, ball_shape(0.2), fixed(i, 0.2, 0));
        }
        world.step(5);
    }

    World world;
};

constexpr lks_contact untouched{{7, 7}, {7, 7}, {7, 7}, 7, 7};

} // namespace

TEST_CASE("as many contacts are written as there is room for, and all are counted") {
    const Balls balls;
    for (const std::uint32_t capacity : {0u, 1u, 3u, 4u}) {
        lks_contact contacts[4] = {untouched, untouched, untouched, untouched};
        std::uint32_t count = 99;
        REQUIRE(lks_world_contacts(balls.world, capacity == 0 ? nullptr : contacts, capacity, &count) ==
                LKS_OK);
        CHECK(count == 3);
        for (std::uint32_t i = 0; i < 4; ++i) {
            const bool written = i < capacity && i < 3;
            CHECK(contacts[i].body_a.index == (written ? i : 7));
            CHECK(contacts[i].body_a.generation == (written ? 1 : 7));
            CHECK(contacts[i].body_b.generation == (written ? 0 : 7));
            CHECK(contacts[i].collider.index == (written ? 0 : 7));
            CHECK(contacts[i].collider.generation == (written ? 1 : 7));
            CHECK(contacts[i].shape_pairs == (written ? 1 : 7));
            CHECK(contacts[i].reserved == (written ? 0 : 7));
        }
    }
    std::uint32_t count = 99;
    const World empty;
    CHECK(lks_world_contacts(empty, nullptr, 0, &count) == LKS_OK);
    CHECK(count == 0);
}

TEST_CASE("a list of contacts with nowhere to go is refused, and asking changes nothing") {
    const Balls balls;
    const World& world = balls.world;
    lks_contact contact = untouched;
    std::uint32_t count = 99;
    check_call_refused(world, LKS_ERROR_NULL_ARGUMENT, "count",
                       [&] { return lks_world_contacts(world, &contact, 1, nullptr); });
    check_call_refused(world, LKS_ERROR_NULL_ARGUMENT, "contacts",
                       [&] { return lks_world_contacts(world, nullptr, 1, &count); });
    CHECK(lks_world_contacts(nullptr, &contact, 1, &count) == LKS_ERROR_NULL_ARGUMENT);
    CHECK(count == 99);
    CHECK(contact.body_a.index == 7);
    const std::uint64_t hash = world.hash();
    CHECK(lks_world_contacts(world, &contact, 1, &count) == LKS_OK);
    CHECK(world.hash() == hash);
}
