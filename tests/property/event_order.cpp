// The order in which the events of a tick come: what lockstitch/event.h promises.
#include <doctest/doctest.h>

#include <array>
#include <tuple>
#include <vector>

#include "support/attachments.h"
#include "support/bodies.h"
#include "support/builders.h"
#include "support/events.h"

using namespace support;

namespace {

// Contacts, particles on bodies, joints, attachments, sleep; within each by indices, colliders behind bodies.
using Rank = std::tuple<std::uint64_t, int, std::uint64_t, std::uint64_t>;

Rank rank_of(const lks_event& event) {
    switch (event.kind) {
    case LKS_EVENT_PARTICLES_PUSHED:
        return {event.tick, 1, event.object.index, event.body_a.index};
    case LKS_EVENT_JOINT_BROKE:
        return {event.tick, 2, event.joint.index, 0};
    case LKS_EVENT_ATTACHMENT_BROKE:
        return {event.tick, 3, event.attachment.index, 0};
    case LKS_EVENT_FELL_ASLEEP:
    case LKS_EVENT_WOKE:
        return {event.tick, 4, event.body_a.index, 0};
    default:
        return {event.tick, 0, event.body_a.index,
                event.body_b.generation != 0 ? event.body_b.index
                                             : std::uint64_t{0x80000000} + event.collider.index};
    }
}

bool is_contact(const lks_event& event) {
    return std::get<1>(rank_of(event)) == 0;
}

} // namespace

TEST_CASE(
    "events come by tick, then contacts, particles, joints, attachments and sleep, each by its indices") {
    World world(world_def(60, 8));
    add_ground(world);
    add_box(world, fixed(0.5, 0.1, 3), fixed(0, 0.1, 0));
    // Sleepers that what falls later wakes; boxes that fall upon each other, on two colliders at once; pairs
    // whose joints break when they land; ropes that their weights tear off; a cloth over all.
    for (int i = 0; i < 6; ++i) {
        add_body(world, box_shape(0.1, 0.1, 0.1), fixed(0.45 * (i - 2.5), 0.3, 2));
    }
    world.step(120);
    REQUIRE(lks_world_awake_body_count(world) == 0);
    for (int i = 0; i < 8; ++i) {
        const double x = 0.4 * (i - 3.5);
        const lks_body_id low = add_body(world, box_shape(0.1, 0.1, 0.1), fixed(x, 1, 0));
        const lks_body_id high = add_body(world, box_shape(0.1, 0.1, 0.1), fixed(x, 1.25, 0));
        lks_joint_def joint = lks_default_joint_def();
        joint.kind = LKS_JOINT_FIXED;
        joint.frame_a.position = fixed(0, 0.125, 0);
        joint.frame_b.position = fixed(0, -0.125, 0);
        joint.break_force = fixed(200);
        add_joint(world, joint, low, high);
        add_body(world, ball_shape(0.12), fixed(x, 1.6, 2), lks_default_body_def());
    }
    const Asset rope(straight_rope(6, 0.5));
    for (int i = 0; i < 4; ++i) {
        const lks_object_id object = world.add(rope, at(2 + 0.3 * i, 3, 0));
        world.pin(object, 0);
        const lks_body_id weight = add_body(world, ball_shape(0.1), fixed(2.5 + 0.3 * i, 3, 0));
        lks_attachment_def hold = to_body(object, 6, weight);
        hold.break_force = fixed(30);
        attach(world, hold);
    }
    for (int i = 0; i < 2; ++i) {
        Net net;
        net.side = 16;
        net.width = 3;
        net.radius = 0.02;
        world.add(net.build(), at(-1.5, 1.9 + 0.3 * i, -1));
    }
    record(world, LKS_ALL_EVENTS, 0.05, 100000);
    const std::vector<lks_event> all = run(world, 240);
    std::array<int, 10> kinds{};
    std::array<int, 5> changes{}; // how often two of a class stand side by side in a tick
    for (std::size_t i = 0; i < all.size(); ++i) {
        ++kinds[all[i].kind];
        if (i == 0) {
            continue;
        }
        const Rank before = rank_of(all[i - 1]);
        const Rank now = rank_of(all[i]);
        CAPTURE(i);
        if (is_contact(all[i - 1]) && is_contact(all[i])) {
            CHECK(before <= now); // of one pair there may be several
        } else {
            CHECK(before < now);
        }
        if (std::get<0>(before) == std::get<0>(now) && std::get<1>(before) == std::get<1>(now)) {
            ++changes[static_cast<std::size_t>(std::get<1>(now))];
        }
    }
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        CAPTURE(kind);
        CHECK(kinds[kind] > 3);
    }
    for (std::size_t group = 0; group < changes.size(); ++group) {
        CAPTURE(group);
        CHECK(changes[group] > 1);
    }
}
