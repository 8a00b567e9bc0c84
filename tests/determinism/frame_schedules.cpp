// Whatever the frame rate, with jitter and hitches: the state after every tick is the same bits as with one
// step a tick.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "support/scene.h"

using namespace support;

namespace {

constexpr std::uint64_t ticks_compared = 150;
constexpr std::int64_t second = 1000000000;

// The state's hash at the beginning of each tick, seen from the hook, which also gives the inputs.
struct Watcher {
    Scene* scene = nullptr;
    std::vector<std::uint64_t> hashes;

    static void before_tick(void* user, lks_world* world, std::uint64_t tick) {
        auto& self = *static_cast<Watcher*>(user);
        self.hashes.push_back(lks_world_hash(world));
        self.scene->give_inputs(tick);
    }
};

lks_world_def watched_def(Watcher& watcher, std::uint32_t cap) {
    lks_world_def def = world_def(60, 6);
    def.max_ticks_per_advance = cap;
    def.before_tick = {&Watcher::before_tick, &watcher};
    return def;
}

std::vector<std::uint64_t> stepped_hashes(const SceneAssets& assets) {
    Watcher watcher;
    Scene scene(assets, {}, watched_def(watcher, 8));
    watcher.scene = &scene;
    for (std::uint64_t tick = 0; tick < ticks_compared + 40; ++tick) {
        REQUIRE(lks_world_step(scene.world) == LKS_OK);
    }
    return watcher.hashes;
}

enum class Jitter { none, strong };

// Advances frame by frame until the compared ticks are done, and gives the hash of each.
std::vector<std::uint64_t> advanced_hashes(const SceneAssets& assets, int frame_rate, Jitter jitter,
                                           std::uint64_t hitch_frame) {
    Watcher watcher;
    Scene scene(assets, {}, watched_def(watcher, 40));
    watcher.scene = &scene;
    Random random(static_cast<std::uint64_t>(frame_rate));
    std::int64_t now = 0;
    for (std::uint64_t frame = 1; scene.world.tick() < ticks_compared; ++frame) {
        std::int64_t elapsed = static_cast<std::int64_t>(frame) * second / frame_rate -
                               static_cast<std::int64_t>(frame - 1) * second / frame_rate;
        if (jitter == Jitter::strong) {
            elapsed = random.between(elapsed / 10, elapsed * 19 / 10);
        }
        if (frame == hitch_frame) {
            elapsed += 300000000;
        }
        now += elapsed;
        const std::uint64_t before = scene.world.tick();
        std::uint32_t ran = 0;
        REQUIRE(lks_world_advance(scene.world, elapsed, &ran) == LKS_OK);
        REQUIRE(scene.world.tick() == before + ran);
        // Not one tick too few or too many, at any time.
        REQUIRE(scene.world.tick() == static_cast<std::uint64_t>(now) * 60 / second);
    }
    REQUIRE(scene.world.counters().dropped_ticks == 0);
    watcher.hashes.push_back(scene.world.hash());
    return watcher.hashes;
}

bool agree(const std::vector<std::uint64_t>& stepped, const std::vector<std::uint64_t>& advanced) {
    REQUIRE(advanced.size() > ticks_compared);
    REQUIRE(advanced.size() <= stepped.size());
    for (std::size_t tick = 0; tick < advanced.size(); ++tick) {
        if (stepped[tick] != advanced[tick]) {
            MESSAGE("differs from tick " << tick);
            return false;
        }
    }
    return true;
}

} // namespace

TEST_CASE("every tick has the same hash at any frame rate with jitter and with a hitch") {
    const SceneAssets assets;
    const std::vector<std::uint64_t> stepped = stepped_hashes(assets);
    for (std::size_t tick = 1; tick < stepped.size(); ++tick) {
        REQUIRE(stepped[tick] !=
                stepped[tick - 1]); // the scene never comes to rest, so equality means something
    }
    for (const int frame_rate : {24, 30, 50, 60, 75, 90, 120, 144, 165, 240}) {
        INFO(frame_rate << " frames a second");
        CHECK(agree(stepped, advanced_hashes(assets, frame_rate, Jitter::none, 0)));
        CHECK(agree(stepped, advanced_hashes(assets, frame_rate, Jitter::strong, 0)));
        CHECK(agree(stepped, advanced_hashes(assets, frame_rate, Jitter::strong, 20)));
    }
}

TEST_CASE("an hour of frames of whole nanoseconds is exactly 216000 ticks at 60 Hz") {
    World world(world_def(60, 1));
    Random random(7);
    std::int64_t left = 3600 * second;
    while (left > 0) {
        const std::int64_t elapsed = std::min(left, random.between(1, 40000000));
        REQUIRE(lks_world_advance(world, elapsed, nullptr) == LKS_OK);
        left -= elapsed;
        if (left == 1) {
            CHECK(world.tick() == 215999);
        }
    }
    CHECK(world.tick() == 216000);
    CHECK(lks_world_interpolation(world) == 0);
    CHECK(world.counters().dropped_ticks == 0);
}

TEST_CASE("one nanosecond before a tick is due it has not run and one later it has") {
    for (const std::uint32_t rate : {1u, 7u, 30u, 60u, 75u, 144u, 240u, 1000u, 9999u}) {
        INFO(rate << " Hz");
        lks_world_def def = world_def(rate, 1);
        def.max_ticks_per_advance = 10000;
        World world(def);
        std::int64_t now = 0;
        for (std::int64_t tick = 1; tick <= 50; ++tick) {
            const std::int64_t due =
                (tick * second + rate - 1) / rate; // rounded up: the first nanosecond that reaches it
            std::uint32_t ran = 7;
            REQUIRE(lks_world_advance(world, due - 1 - now, &ran) == LKS_OK);
            CHECK(ran == 0);
            REQUIRE(lks_world_advance(world, 1, &ran) == LKS_OK);
            CHECK(ran == 1);
            now = due;
        }
    }
}

TEST_CASE("beyond the cap DROP drops whole ticks and counts them and keeps the fraction") {
    lks_world_def def = world_def(60, 1);
    def.max_ticks_per_advance = 8;
    def.excess_time = LKS_EXCESS_TIME_DROP;
    World world(def);
    std::uint32_t ran = 0;
    // 18.3 ticks and a fraction: 8 run, 10 are dropped, 0.3 stay.
    REQUIRE(lks_world_advance(world, 305000000, &ran) == LKS_OK);
    CHECK(ran == 8);
    CHECK(world.tick() == 8);
    CHECK(world.counters().dropped_ticks == 10);
    CHECK(lks_world_interpolation(world) == 0x4ccccccc); // 0.3 of 2^32, rounded down
    REQUIRE(lks_world_advance(world, 0, &ran) == LKS_OK);
    CHECK(ran == 0);
    // 0.7 of a tick later, to the nanosecond, the next one is due.
    REQUIRE(lks_world_advance(world, 11666666, &ran) == LKS_OK);
    CHECK(ran == 0);
    REQUIRE(lks_world_advance(world, 1, &ran) == LKS_OK);
    CHECK(ran == 1);
    CHECK(world.counters().dropped_ticks == 10);
}

TEST_CASE("beyond the cap KEEP runs what is due in later calls and drops nothing") {
    lks_world_def def = world_def(60, 1);
    def.max_ticks_per_advance = 8;
    def.excess_time = LKS_EXCESS_TIME_KEEP;
    World world(def);
    std::uint32_t ran = 0;
    REQUIRE(lks_world_advance(world, 305000000, &ran) == LKS_OK);
    CHECK(ran == 8);
    CHECK(lks_world_interpolation(world) >= 0xfffffff0u); // the view stays just before the next tick
    REQUIRE(lks_world_advance(world, 0, &ran) == LKS_OK);
    CHECK(ran == 8);
    REQUIRE(lks_world_advance(world, 0, &ran) == LKS_OK);
    CHECK(ran == 2);
    CHECK(lks_world_interpolation(world) == 0x4ccccccc);
    REQUIRE(lks_world_advance(world, 0, &ran) == LKS_OK);
    CHECK(ran == 0);
    CHECK(world.tick() == 18);
    CHECK(world.counters().dropped_ticks == 0);
}

TEST_CASE("the clock is no part of the state") {
    const SceneAssets assets;
    Scene stepped(assets);
    Scene advanced(assets);
    stepped.world.step();
    REQUIRE(lks_world_advance(advanced.world, 30000000, nullptr) == LKS_OK);
    CHECK(stepped.world.tick() == advanced.world.tick());
    CHECK(lks_world_interpolation(stepped.world) != lks_world_interpolation(advanced.world));
    CHECK(stepped.world.hash() == advanced.world.hash());
    CHECK(stepped.world.save() == advanced.world.save());
}

TEST_CASE("a tick hook that tries to step or advance or load or destroy its world is refused") {
    struct Meddler {
        lks_result step{}, advance{}, load{};
        std::uint64_t calls = 0;
        Image image;
    };
    Meddler meddler;
    lks_world_def def = world_def(60, 1);
    def.before_tick.user = &meddler;
    def.before_tick.call = [](void* user, lks_world* world, std::uint64_t tick) {
        auto& self = *static_cast<Meddler*>(user);
        self.calls += tick == self.calls ? 1 : 1000;
        self.step = lks_world_step(world);
        self.advance = lks_world_advance(world, 100000000, nullptr);
        self.load = lks_world_load(world, self.image.data(), self.image.size());
        lks_world_destroy(world);
    };
    World world(def);
    meddler.image = world.save();
    world.step(2);
    CHECK(meddler.calls == 2);
    CHECK(world.tick() == 2);
    CHECK(meddler.step == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(meddler.advance == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(meddler.load == LKS_ERROR_INVALID_ARGUMENT);
}
