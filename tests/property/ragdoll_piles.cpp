// How well ragdolls hold together in piles, how deep they rest in each other, and when they fall asleep.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <vector>

#include "support/ragdolls.h"
#include "support/sanitised.h"

using namespace support;

namespace {

// The last of a pile has fallen for 1.2 s when it meets the others.
constexpr int ticks_of_fall = 72;

struct FallenPile {
    bool asleep;
    double seconds; // since the first tick
    double overlap, joints, limits;
};

// Each figure up to 2 cm aside, at random; until all sleep, or for so many ticks after the last has landed.
FallenPile fall(std::uint32_t seed, std::uint32_t substeps, int ticks) {
    World world(world_def(60, substeps));
    add_pit(world);
    Ragdolls ragdolls(world);
    std::mt19937 random(seed);
    ragdolls.add_pile(6, [&] {
        const double low = random();
        return 0.04 * ((low + random() * 0x1p32) * 0x1p-64 - 0.5);
    });
    int tick = 0;
    for (; tick < ticks_of_fall + ticks && (tick == 0 || lks_world_awake_body_count(world) > 0); ++tick) {
        ragdolls.step();
    }
    return {lks_world_awake_body_count(world) == 0, tick / 60.0, ragdolls.overlap(), ragdolls.worst(),
            ragdolls.limit()};
}

struct FallenPiles {
    int awake = 0;
    int deep = 0; // above 2 mm
    double mean_overlap = 0, overlap = 0;
    double mean_seconds = 0, seconds = 0; // of those asleep
};

FallenPiles fall_all(std::uint32_t first, std::uint32_t last, std::uint32_t substeps) {
    FallenPiles all;
    for (std::uint32_t seed = first; seed <= last; ++seed) {
        const FallenPile pile = fall(seed, substeps, 900);
        std::printf("layout %3u at %u substeps: %.2f mm of overlap, %s after %.1f s\n", seed, substeps,
                    1e3 * pile.overlap, pile.asleep ? "asleep" : "AWAKE", pile.seconds);
        std::fflush(stdout);
        all.awake += pile.asleep ? 0 : 1;
        all.deep += pile.overlap > 2e-3 ? 1 : 0;
        all.mean_overlap += pile.overlap / (last - first + 1);
        all.overlap = std::max(all.overlap, pile.overlap);
        all.mean_seconds += pile.asleep ? pile.seconds : 0;
        all.seconds = std::max(all.seconds, pile.seconds);
    }
    all.mean_seconds /= std::max(1, static_cast<int>(last - first + 1) - all.awake);
    std::printf(
        "layouts %u to %u at %u substeps: deepest %.2f mm on the average, %.2f at the worst, %d above "
        "2 mm; asleep after %.1f s, %.1f at the latest, %d awake\n",
        first, last, substeps, 1e3 * all.mean_overlap, 1e3 * all.overlap, all.deep, all.mean_seconds,
        all.seconds, all.awake);
    return all;
}

void check_rest(const FallenPiles& piles) {
    CHECK(piles.deep <= 6);
    CHECK(piles.overlap < 7e-3);
    CHECK(piles.mean_overlap < 1.5e-3);
    CHECK(piles.awake == 0);
    CHECK(piles.mean_seconds < 4);
}

} // namespace

TEST_CASE("ten ragdolls that fall into a pit stay in one piece and fall asleep") {
    World world(world_def(60, 8));
    add_pit(world);
    Ragdolls ragdolls(world);
    ragdolls.add_pile(2, [] { return 0; });
    int tick = 0;
    for (; tick < 300 && (tick == 0 || lks_world_awake_body_count(world) > 0); ++tick) {
        ragdolls.step();
    }
    CHECK(ragdolls.worst() < 1e-3);
    CHECK(ragdolls.limit() < 2);
    CHECK(ragdolls.overlap() < 2e-3);
    CHECK(lks_world_awake_body_count(world) == 0);
}

TEST_CASE("thirty ragdolls that fall into a pit stay in one piece and fall asleep, for an hour" *
          doctest::skip(support::sanitised)) {
    World world(world_def(60, 8));
    add_pit(world);
    Ragdolls ragdolls(world);
    ragdolls.add_pile(6, [] { return 0; });
    double least = ragdolls.energy();
    double rise = 0;
    int tick = 0;
    for (; tick < ticks_of_fall + 600 && (tick == 0 || lks_world_awake_body_count(world) > 0); ++tick) {
        ragdolls.step();
        const double energy = ragdolls.energy();
        rise = std::max(rise, energy - least);
        least = std::min(least, energy);
    }
    const double overlap = ragdolls.overlap();
    std::printf("30 ragdolls in a pit: joints %.2e mm, worst %.3f mm; limits %.2f, at rest %.2f degrees; "
                "%.2f J gained; %.2f mm of overlap at rest; asleep after %.1f s\n",
                1e3 * ragdolls.mean(), 1e3 * ragdolls.worst(), ragdolls.limit(), ragdolls.limit_now(), rise,
                1e3 * overlap, tick / 60.0);
    CHECK(ragdolls.mean() < 1e-5);
    CHECK(ragdolls.worst() < 5e-3);
    CHECK(ragdolls.limit() < 5);
    CHECK(ragdolls.limit_now() < 0.5);
    CHECK(overlap < 2e-3);
    CHECK(rise < 20); // of 60 kJ: what parts lifts what lies upon it
    CHECK(lks_world_awake_body_count(world) == 0);
    const std::uint64_t hash = world.local_hash();
    std::vector<BodyState> before;
    for (const lks_body_id body : ragdolls.bodies()) {
        before.push_back(state_of(world, body));
    }
    world.step(216000); // an hour
    CHECK(energy_of(world) == 0);
    CHECK(world.local_hash() != hash); // the tick is part of it
    for (std::size_t i = 0; i < before.size(); ++i) {
        const BodyState now = state_of(world, ragdolls.bodies()[i]);
        CHECK((now.position - before[i].position).length() == 0);
        CHECK(now.rotation.x == before[i].rotation.x);
        CHECK(now.rotation.y == before[i].rotation.y);
        CHECK(now.rotation.z == before[i].rotation.z);
        CHECK(now.rotation.w == before[i].rotation.w);
    }
}

// Feet under chests, which nothing frees as long as only they are pushed: where figures are not moved as
// wholes, the first of these layouts is awake after 10 s, and the others end with 5 to 10 mm.
TEST_CASE("piles in which feet are jammed come apart and fall asleep, too" *
          doctest::skip(support::sanitised)) {
    for (const std::uint32_t seed : {16u, 21u, 33u, 44u, 48u}) {
        const FallenPile pile = fall(seed, 8, 600);
        INFO("layout " << seed << ": " << pile.seconds << " s, " << 1e3 * pile.overlap << " mm of overlap");
        CHECK(pile.asleep);
        CHECK(pile.overlap < 4e-3); // below two in nearly all: see below
        CHECK(pile.joints < 5e-3);
        CHECK(pile.limits < 5);
    }
}

// What is promised of one pile, measured on many: in version 28 3 of these 192 were above 2 mm (21 in version
// 27, when what hung over a box's edge was held there alone), one at 3.7 mm, and one slept after 15.5 s only.
// In version 33 7 were (13 in version 32, one at 10 mm), the worst at 3.7 mm, and one slept after 11.8 s. In
// version 35 5 are, the worst, which rattles and falls asleep at a spike, at 6.0 mm, and all sleep after
// 6.0 s.
TEST_CASE("of layouts 1 to 64 at 8 substeps nearly all rest within 2 mm" * doctest::skip(!long_runs())) {
    check_rest(fall_all(1, 64, 8));
}

TEST_CASE("of layouts 65 to 128 at 8 substeps nearly all rest within 2 mm" * doctest::skip(!long_runs())) {
    check_rest(fall_all(65, 128, 8));
}

TEST_CASE("of layouts 129 to 192 at 8 substeps nearly all rest within 2 mm" * doctest::skip(!long_runs())) {
    check_rest(fall_all(129, 192, 8));
}

TEST_CASE("of layouts 1 to 64 at 4 substeps most fall asleep within 15 s" * doctest::skip(!long_runs())) {
    const FallenPiles piles = fall_all(1, 64, 4);
    CHECK(piles.awake <= 10);
    CHECK(piles.mean_overlap < 7.5e-3);
    CHECK(piles.overlap < 36e-3);
}
