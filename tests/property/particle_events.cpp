// What worlds tell of cloth and ropes on bodies.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "support/bodies.h"
#include "support/builders.h"
#include "support/events.h"

using namespace support;

namespace {

constexpr double g = 9.81;
constexpr int particles = 20;
constexpr double particle_mass = 0.05;

enum class Table { kinematic, asleep, awake };

// A rope falls flat on a table, from 0.5 m above it.
struct Fall {
    explicit Fall(Table kind, std::uint32_t workers = 1) : world(definition(workers)) {
        add_ground(world);
        lks_body_def def = lks_default_body_def();
        def.kind = kind == Table::kinematic ? LKS_BODY_KINEMATIC : LKS_BODY_DYNAMIC;
        def.never_sleeps = kind == Table::awake ? 1 : 0;
        table = add_body(world, box_shape(1.5, 0.25, 0.5), fixed(1, 0.25, 0), def);
        if (kind == Table::asleep) {
            world.step(120);
        }
        start = lks_world_tick(world);
        Chain chain;
        chain.particle_mass = particle_mass;
        rope = world.add(chain.build(), at(0, 1, 0));
    }

    static lks_world_def definition(std::uint32_t workers) {
        lks_world_def def = world_def(60, 20);
        def.worker_count = workers;
        return def;
    }
    void record(double least = 0) {
        support::record(world, LKS_EVENT_BIT(LKS_EVENT_PARTICLES_PUSHED), least, 100);
    }
    std::vector<lks_event> run(int ticks) { return support::run(world, ticks); }

    World world;
    lks_body_id table{};
    lks_object_id rope{};
    std::uint64_t start = 0;
};

} // namespace

TEST_CASE("a rope that falls on a table pushes it with all the momentum that gravity gives it") {
    for (const Table kind : {Table::kinematic, Table::asleep, Table::awake}) {
        Fall fall(kind);
        fall.record();
        constexpr int ticks = 120;
        double sum = 0, greatest = 0;
        std::uint64_t first = 0;
        for (const lks_event& event : fall.run(ticks)) {
            CHECK(event.kind == LKS_EVENT_PARTICLES_PUSHED);
            CHECK(event.body_a.index == fall.table.index);
            CHECK(event.body_a.generation == fall.table.generation);
            CHECK(event.object.index == fall.rope.index);
            CHECK(event.object.generation == fall.rope.generation);
            CHECK(event.collider.generation == 0);
            first = first == 0 ? event.tick : first;
            greatest = std::max(greatest, metres(event.strength));
            sum += metres(event.strength);
        }
        const double mass = particles * particle_mass;
        INFO("table " << static_cast<int>(kind) << ": " << sum << " N·s, the most in a tick " << greatest);
        CHECK(std::abs(sum / (mass * g * ticks / 60) - 1) < 0.01);
        CHECK(std::abs(greatest / (mass * std::sqrt(2 * g * 0.5)) - 1) < 0.07);
        CHECK(std::abs(static_cast<double>(first - fall.start) - 60 * std::sqrt(2 * 0.5 / g)) < 2);
    }
}

TEST_CASE("what lies still is not told of where it pushes with less than the threshold, nor if nobody asks") {
    Fall fall(Table::kinematic);
    fall.record(particles * particle_mass * g / 60 * 2);
    CHECK(fall.run(120).size() == 1);
    REQUIRE(lks_world_record_events(fall.world, LKS_ALL_EVENTS & ~LKS_EVENT_BIT(LKS_EVENT_PARTICLES_PUSHED),
                                    0, 100) == LKS_OK);
    CHECK(fall.run(10).empty());
}

TEST_CASE("events of particles change no bit, and are the same after a load and with two workers") {
    Fall quiet(Table::asleep);
    Fall telling(Table::asleep);
    Fall together(Table::asleep, 2);
    telling.record();
    together.record();
    telling.run(25);
    together.run(25);
    quiet.world.step(25);
    const Image image = telling.world.save();
    const std::vector<lks_event> first = telling.run(40);
    const std::vector<lks_event> shared = together.run(40);
    quiet.world.step(40);
    CHECK(quiet.world.hash() == telling.world.hash());
    REQUIRE(lks_world_load(telling.world, image.data(), image.size()) == LKS_OK);
    const std::vector<lks_event> again = telling.run(40);
    REQUIRE(first.size() > 20);
    REQUIRE(first.size() == again.size());
    REQUIRE(first.size() == shared.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        CHECK(same(first[i], again[i]));
        CHECK(same(first[i], shared[i]));
    }
}

TEST_CASE("within a tick particles come after contacts, by objects and then bodies") {
    World world(world_def(60, 8));
    add_ground(world);
    for (int i = 0; i < 3; ++i) {
        lks_body_def def = lks_default_body_def();
        def.never_sleeps = 1;
        add_body(world, box_shape(0.3, 0.1, 0.3), fixed(0.2 + 0.8 * i, 0.15, 0), def);
    }
    const Asset rope = Chain().build();
    for (int i = 0; i < 3; ++i) {
        world.add(rope, at(0, 0.5, 0.1 * i - 0.1));
    }
    record(world);
    std::size_t most = 0;
    for (int tick = 0; tick < 90; ++tick) {
        world.step();
        const lks_event* events = lks_world_events(world);
        std::size_t pushed = 0;
        for (std::uint32_t i = 0; i < lks_world_event_count(world); ++i) {
            const bool particle = events[i].kind == LKS_EVENT_PARTICLES_PUSHED;
            pushed += particle ? 1u : 0u;
            if (i > 0 && events[i - 1].kind == LKS_EVENT_PARTICLES_PUSHED) {
                REQUIRE(events[i].kind >= LKS_EVENT_JOINT_BROKE);
                const auto place = [](const lks_event& e) {
                    return std::uint64_t{e.object.index} << 32 | e.body_a.index;
                };
                CHECK((!particle || place(events[i - 1]) < place(events[i])));
            }
        }
        most = std::max(most, pushed);
    }
    CHECK(most == 9);
}
