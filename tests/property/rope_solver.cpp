// An automatic rope is, in each world, either of the two others: to the bit, with its forces, and through an
// image.
#include <doctest/doctest.h>

#include <vector>

#include "support/builders.h"

using namespace support;

namespace {

// 2 m, with half of its mass at the end: 4 / m for two segments, 144 / m for twelve, 1600 / m for forty.
Chain rope_of(std::uint32_t segments, std::uint32_t solver) {
    Chain chain;
    chain.segments = segments;
    chain.particle_mass = 0.01;
    chain.end_mass = 0.01 * segments;
    chain.stretch = soft(1e-6);
    chain.bend = soft(1e-3);
    chain.solver = solver;
    return chain;
}

// Hung up beside each other by one end, level.
struct Three {
    explicit Three(std::uint32_t segments, const lks_world_def& def)
        : assets{rope_of(segments, LKS_ROPE_AUTOMATIC).build(), rope_of(segments, LKS_ROPE_SWEPT).build(),
                 rope_of(segments, LKS_ROPE_DIRECT).build()},
          world(def) {}

    void hang() {
        for (const Asset& asset : assets) {
            lks_object_def def = object_def(asset, at(0, 0, 0));
            def.record_forces = 1;
            ids.push_back(world.add(def));
            world.pin(ids.back(), 0);
        }
    }

    bool are_equal(int a, int b) const {
        const std::vector<lks_raw_position> p = world.raw_positions(ids[a]);
        const std::vector<lks_raw_position> q = world.raw_positions(ids[b]);
        bool equal = true;
        for (std::size_t i = 0; i < p.size(); ++i) {
            equal = equal && p[i].x == q[i].x && p[i].y == q[i].y && p[i].z == q[i].z;
        }
        for (std::uint32_t i = 0; i < assets[0].constraint_count(); ++i) {
            equal = equal && world.force(ids[a], i) == world.force(ids[b], i);
        }
        return equal;
    }

    void check(bool direct) const {
        CHECK(are_equal(0, direct ? 2 : 1));
        CHECK_FALSE(are_equal(0, direct ? 1 : 2));
    }

    Asset assets[3];
    World world;
    std::vector<lks_object_id> ids;
};

} // namespace

TEST_CASE("an automatic rope moves as the one that its world's substeps and iterations ask for") {
    struct Row {
        std::uint32_t rate, substeps, iterations;
        bool two, twelve, forty; // segments: whether these are solved at once
    };
    for (const Row& row : {Row{60, 1, 1, true, true, true}, Row{60, 20, 1, false, false, true},
                           Row{60, 100, 1, false, false, false}, Row{30, 20, 1, false, true, true},
                           Row{240, 4, 1, false, false, true}, Row{60, 10, 1, false, true, true},
                           Row{60, 10, 4, false, false, true}, Row{60, 20, 8, false, false, false}}) {
        for (const auto& rope : {std::pair{2u, row.two}, {12u, row.twelve}, {40u, row.forty}}) {
            const std::uint32_t segments = rope.first;
            const bool direct = rope.second;
            INFO(row.rate << " Hz x " << row.substeps << " x " << row.iterations << ", " << segments);
            const lks_world_def def = world_def(row.rate, row.substeps, row.iterations);
            Three three(segments, def);
            three.hang();
            three.world.step(12);
            three.check(direct);
            // As a world has it that has only heard of the ropes.
            Three other(segments, def);
            for (const Asset& asset : other.assets) {
                REQUIRE(lks_world_register_asset(other.world, asset) == LKS_OK);
            }
            const Image image = three.world.save();
            REQUIRE(lks_world_load(other.world, image.data(), image.size()) == LKS_OK);
            other.ids = three.ids;
            CHECK(other.world.hash() == three.world.hash());
            three.world.step(12);
            other.world.step(12);
            other.check(direct);
            CHECK(other.world.hash() == three.world.hash());
        }
    }
}
