// Memory of bodies: ticks need none, what can't be had changes nothing, and rubbish in it changes no bit.
#include <doctest/doctest.h>

#include "support/allocator.h"
#include "support/attachments.h"
#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

lks_world_def settings(Allocator& allocator) {
    lks_world_def def = world_def(60, 4);
    def.allocator = allocator.interface();
    return def;
}

// Humanoids that fall onto each other and onto a ground: contacts come and go.
void add_humanoid(const World& world, double height) {
    Humanoid humanoid;
    humanoid.def.transform.position = fixed(0.1 * height, height, 0);
    REQUIRE(humanoid.add(world) == LKS_OK);
}

// Over them, a corner in a hand.
void add_cloth(World& world) {
    Net net;
    net.side = 12;
    net.width = 1;
    net.radius = 0.01;
    lks_transform over = at(0.1, 4.2, 0);
    REQUIRE(lks_rotation_from_axis_angle(1, 0, 0, -90, &over.rotation) == LKS_OK);
    attach(world, to_body(world.add(net.build(), over), 0, {LKS_HUMANOID_HAND_LEFT, 1}));
}

} // namespace

TEST_CASE("no tick of bodies allocates or releases, and loading into a world that has them neither") {
    Allocator allocator;
    {
        World world(settings(allocator));
        add_ground(world);
        add_humanoid(world, 0.1);
        add_humanoid(world, 2.2);
        add_cloth(world);
        world.step(10);
        const Image image = world.save();
        const std::uint64_t allocations = allocator.allocations();
        const std::uint64_t releases = allocator.releases();
        world.step(240);
        REQUIRE(lks_world_load(world, image.data(), image.size()) == LKS_OK);
        world.step(60);
        CHECK(allocator.allocations() == allocations);
        CHECK(allocator.releases() == releases);
    }
    CHECK(allocator.live_blocks() == 0);
    CHECK(allocator.misuses() == 0);
}

TEST_CASE("what uninitialised memory holds changes no bit of bodies") {
    std::uint64_t hashes[3];
    int i = 0;
    for (const Allocator::Fill fill :
         {Allocator::Fill::none, Allocator::Fill::byte_cd, Allocator::Fill::random}) {
        Allocator allocator(fill);
        World world(settings(allocator));
        add_ground(world);
        add_humanoid(world, 0.1);
        add_humanoid(world, 2.2);
        add_cloth(world);
        add_body(world, ball_shape(0.3), fixed(3, 1, 0));
        world.step(120);
        hashes[i++] = world.hash();
    }
    CHECK(hashes[0] == hashes[1]);
    CHECK(hashes[0] == hashes[2]);
}

TEST_CASE("bodies, joints and ragdolls that can't be added for lack of memory change nothing") {
    for (std::uint64_t countdown = 0; countdown < 60; ++countdown) {
        Allocator allocator;
        World world(settings(allocator));
        const lks_body_id first = add_body(world, ball_shape(0.1), {});
        const lks_body_id second = add_body(world, ball_shape(0.1), fixed(1, 0, 0));
        const std::uint64_t hash = world.hash();
        allocator.fail_after(countdown);
        const Humanoid humanoid;
        const lks_result result = humanoid.add(world);
        CHECK(result == (allocator.refused_any() ? LKS_ERROR_OUT_OF_MEMORY : LKS_OK));
        if (result != LKS_OK) {
            CHECK(world.hash() == hash);
            CHECK(lks_world_body_count(world) == 2);
        }
        allocator.never_fail();
        if (result != LKS_OK) {
            lks_joint_def joint = lks_default_joint_def();
            joint.body_a = first;
            joint.body_b = second;
            lks_joint_id id{};
            allocator.fail_after(0);
            const lks_result joined = lks_world_add_joint(world, &joint, &id);
            allocator.never_fail();
            CHECK((joined == LKS_OK || (joined == LKS_ERROR_OUT_OF_MEMORY && world.hash() == hash)));
            REQUIRE(humanoid.add(world) == LKS_OK);
            world.step(5);
        } else {
            break;
        }
    }
}
