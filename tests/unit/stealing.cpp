// Blocks that take long now and then, and helpers that come late: who takes which block changes all the time,
// and nothing else does.
#include <doctest/doctest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "fixed_samples.h"
#include "solver/world.h"
#include "support/builders.h"
#include "support/sanitised.h"
#include "support/scene.h"
#include "threads/team.h"
#include "unit/dawdling.h"

using namespace support;
using lks::test::best_kernels;
using lks::test::dawdle;
using lks::test::dawdling;

namespace {

struct Stretched {
    Asset sheet;
    Asset net;

    static Asset make(std::uint32_t side, const std::vector<std::uint32_t>& anchors) {
        Net net;
        net.side = side;
        net.shear = soft(1e-6, 2);
        net.anchors = anchors;
        return net.build();
    }
    Stretched() : sheet(make(72, {0, 71})), net(make(9, {})) {}

    // Each within reach of one vertex alone, which is in one of the blocks.
    static void add_marbles_at_the_corners(World& world, const std::vector<lks_vec3>& vertices) {
        const lks_vec3 first = vertices.front();
        const lks_vec3 last = vertices.back();
        for (const std::uint32_t corner : {0u, 71u, 71u * 72, 72u * 72 - 1}) {
            const lks_vec3 place = vertices[corner];
            const auto beyond = [](std::int64_t at, std::int64_t from, std::int64_t to) {
                return at + (at - (from + to) / 2) / 50;
            };
            lks_collider_def marble = lks_default_collider_def();
            marble.radius = fixed(0.025);
            marble.transform.position = {beyond(place.x, first.x, last.x), beyond(place.y, first.y, last.y),
                                         beyond(place.z, first.z, last.z)};
            world.add(marble);
        }
    }

    std::vector<std::uint64_t> hashes(std::uint32_t workers, const lks::Kernels& kernels) const {
        lks_world_def def = world_def(60, 5, 2);
        def.worker_count = workers;
        World world(def);
        static_cast<lks_world*>(world)->kernels = &kernels;
        world.add(lks_default_collider_def());
        const lks_object_id large = world.add(sheet, at(-1, 1, -1));
        add_marbles_at_the_corners(world, world.positions(large));
        world.pin(large, 0);
        world.pin(large, 71);
        for (int i = 0; i < 12; ++i) {
            world.add(net, at(i, 2, 0.1 * i));
        }
        std::vector<std::uint64_t> found;
        for (int tick = 0; tick < 8; ++tick) {
            world.step();
            found.push_back(world.hash());
        }
        return found;
    }
};

} // namespace

TEST_CASE("threads: whoever takes which block, and however long it takes, hashes are the same") {
    const Stretched scene;
    const std::vector<std::uint64_t> expected = scene.hashes(1, best_kernels());
    for (std::uint32_t workers = 1; workers <= 8; workers += support::sanitised ? 3 : 1) {
        CAPTURE(workers);
        CHECK(scene.hashes(workers, dawdling()) == expected);
    }
}

TEST_CASE("threads: each block of a stage runs once, and none after its stage is over") {
    constexpr std::uint32_t helper_count = 7;
    constexpr std::uint32_t most_blocks = 40;
    struct Context {
        std::atomic<std::uint32_t> runs[most_blocks] = {};
        std::atomic<std::uint32_t> by_worker[helper_count + 1] = {};
        std::atomic<bool> over{true};
        std::atomic<std::uint32_t> late{0};
    };
    Context context;
    const auto run = [](void* argument, std::uint32_t block, std::uint32_t worker) {
        Context& c = *static_cast<Context*>(argument);
        dawdle();
        c.late += c.over ? 1 : 0;
        ++c.runs[block];
        ++c.by_worker[worker];
    };
    lks::Team team;
    std::uint32_t wrong = 0;
    std::uint32_t total = 0;
    lks::test::Random random(6);
    for (int tick = 0; tick < 20; ++tick) {
        team.open();
        std::vector<std::thread> helpers;
        for (std::uint32_t i = 1; i <= helper_count; ++i) {
            helpers.emplace_back([&team, i] {
                dawdle();
                team.help(i);
            });
        }
        for (int stage = 0; stage < 50; ++stage) {
            const auto blocks = static_cast<std::uint32_t>(random.below(most_blocks + 1));
            context.over = false;
            team.run({run, &context, blocks});
            context.over = true;
            total += blocks;
            for (std::uint32_t block = 0; block < most_blocks; ++block) {
                wrong += context.runs[block].exchange(0) != (block < blocks ? 1u : 0u) ? 1 : 0;
            }
        }
        team.close();
        for (std::thread& helper : helpers) {
            helper.join();
        }
    }
    CHECK(wrong == 0);
    CHECK(context.late == 0);
    std::uint32_t sum = 0;
    for (const std::atomic<std::uint32_t>& count : context.by_worker) {
        sum += count;
    }
    CHECK(sum == total);
    CHECK(context.by_worker[0] < total); // others did help
}
