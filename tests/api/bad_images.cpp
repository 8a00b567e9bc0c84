// Images and buffers that are refused: truncated, corrupted, foreign, too small, misaligned. The world stays
// as it was.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "support/refusals.h"
#include "support/scene.h"

using namespace support;

namespace {

// A world with little in it, so that each byte of its image can be tried: a pinned chain with recorded forces
// and a collider.
struct Small {
    Asset chain;
    World world;
    lks_object_id object{};

    explicit Small(const lks_world_def& def = world_def(60, 2)) : chain(build()), world(def) {
        lks_object_def object_settings = object_def(chain, at(1, 2, 3));
        object_settings.record_forces = 1;
        object = world.add(object_settings);
        world.pin(object, 0);
        world.add(lks_default_collider_def());
        world.step(5);
    }

    static Asset build() {
        Chain description;
        description.segments = 3;
        description.length = 1;
        return description.build();
    }
};

// Refused as one of the two kinds of bad image, with a sentence and without a trace.
bool refused(const World& world, const void* memory, std::size_t size, std::uint64_t hash) {
    const lks_result result = lks_world_load(world, memory, size);
    return (result == LKS_ERROR_CORRUPT_IMAGE || result == LKS_ERROR_FOREIGN_IMAGE) && world.hash() == hash &&
           world.message().size() > 10 && lks_world_last_error(world)->result == result;
}

} // namespace

TEST_CASE("an image with any bit of any byte flipped is refused and leaves the world untouched") {
    Small small;
    const Image good = small.world.save();
    small.world.step(7);
    const std::uint64_t hash = small.world.hash();
    const Image before = small.world.save();
    Image bad = good;
    std::size_t accepted = 0;
    for (std::size_t i = 0; i < bad.size(); ++i) {
        for (int bit = 0; bit < 8; ++bit) {
            bad.bytes()[i] ^= static_cast<unsigned char>(1 << bit);
            accepted += refused(small.world, bad.data(), bad.size(), hash) ? 0 : 1;
            bad.bytes()[i] ^= static_cast<unsigned char>(1 << bit);
        }
    }
    CHECK(accepted == 0);
    CHECK(small.world.save() == before);
    CHECK(lks_world_load(small.world, good.data(), good.size()) == LKS_OK);
    CHECK(small.world.save() == good);
}

TEST_CASE("an image of any shorter length and longer ones are refused and leave the world untouched") {
    Small small;
    const Image good = small.world.save();
    small.world.step(7);
    const std::uint64_t hash = small.world.hash();
    std::size_t accepted = 0;
    for (std::size_t size = 0; size < good.size(); ++size) {
        // A copy of just that size, for the sanitizers to see a read behind its end.
        Image part(size);
        if (size != 0) {
            std::memcpy(part.data(), good.data(), size);
        }
        std::uint64_t nothing = 0;
        accepted += refused(small.world, size == 0 ? &nothing : part.data(), size, hash) ? 0 : 1;
    }
    CHECK(accepted == 0);
    Image longer(good.size() + 64);
    std::memcpy(longer.data(), good.data(), good.size());
    CHECK(refused(small.world, longer.data(), longer.size(), hash));
    CHECK(refused(small.world, longer.data(), good.size() + 8, hash));
    CHECK(lks_world_load(small.world, longer.data(), good.size()) == LKS_OK);
}

TEST_CASE("an image of another format version or solver version is refused as foreign") {
    Small small;
    const std::uint64_t hash = small.world.hash();
    for (const std::size_t place : {8u, 12u}) { // the two versions, behind the magic number
        Image other = small.world.save();
        other.bytes()[place] += 1;
        const std::string named = "version is " + std::to_string(static_cast<int>(other.bytes()[place]));
        check_call_refused(small.world, LKS_ERROR_FOREIGN_IMAGE, named.c_str(),
                           [&] { return lks_world_load(small.world, other.data(), other.size()); });
    }
    CHECK(small.world.hash() == hash);
}

TEST_CASE("an image from a world of other settings is refused and the value named") {
    Small small;
    const struct {
        lks_world_def def;
        const char* value;
    } others[] = {{world_def(61, 2), "61"}, {world_def(60, 3), "3"}, {world_def(60, 2, 5), "5"}};
    for (const auto& other : others) {
        const Small foreign(other.def);
        const Image image = foreign.world.save();
        REQUIRE(lks_world_register_asset(small.world, foreign.chain) == LKS_OK);
        check_call_refused(small.world, LKS_ERROR_FOREIGN_IMAGE, other.value,
                           [&] { return lks_world_load(small.world, image.data(), image.size()); });
    }
}

TEST_CASE("an image that needs an unknown asset is refused until the asset is registered") {
    const Small small;
    const Image image = small.world.save();
    World stranger(world_def(60, 2));
    Net other;
    other.side = 5;
    REQUIRE(lks_world_register_asset(stranger, other.build()) == LKS_OK);
    check_call_refused(stranger, LKS_ERROR_FOREIGN_IMAGE, "asset",
                       [&] { return lks_world_load(stranger, image.data(), image.size()); });
    // Not the same pointer, but the same asset.
    const Asset twin = Small::build();
    CHECK(lks_asset_fingerprint(twin) == lks_asset_fingerprint(small.chain));
    REQUIRE(lks_world_register_asset(stranger, twin) == LKS_OK);
    REQUIRE(lks_world_register_asset(stranger, twin) == LKS_OK); // again is no harm
    CHECK(lks_world_load(stranger, image.data(), image.size()) == LKS_OK);
    CHECK(stranger.hash() == small.world.hash());
}

TEST_CASE("buffers that are too small to save into are refused with the size needed and stay untouched") {
    const Small small;
    std::size_t size = 0;
    REQUIRE(lks_world_save_size(small.world, &size) == LKS_OK);
    std::vector<std::uint64_t> memory(size / 8 + 2, 0x5555555555555555u);
    for (const std::size_t capacity : {std::size_t{0}, std::size_t{8}, size / 2, size - 1}) {
        std::size_t written = 4711;
        check_call_refused(small.world, LKS_ERROR_BUFFER_TOO_SMALL, std::to_string(size),
                           [&] { return lks_world_save(small.world, memory.data(), capacity, &written); });
        CHECK(written == 4711);
        CHECK(std::count(memory.begin(), memory.end(), 0x5555555555555555u) ==
              static_cast<std::ptrdiff_t>(memory.size()));
    }
    CHECK(lks_world_save(small.world, memory.data(), size, nullptr) == LKS_OK);
    // Exactly that many bytes are written.
    const auto* bytes = reinterpret_cast<const unsigned char*>(memory.data());
    for (std::size_t i = size; i < memory.size() * 8; ++i) {
        CHECK(bytes[i] == 0x55);
    }
    std::size_t written = 0;
    CHECK(lks_world_save(small.world, memory.data(), memory.size() * 8, &written) == LKS_OK);
    CHECK(written == size);
}

TEST_CASE("misaligned buffers are refused for saving and for loading") {
    const Small small;
    const Image good = small.world.save();
    Image memory(good.size() + 8);
    for (const std::size_t shift : {1u, 2u, 4u, 7u}) {
        unsigned char* misaligned = memory.bytes() + shift;
        check_call_refused(small.world, LKS_ERROR_MISALIGNED, "8",
                           [&] { return lks_world_save(small.world, misaligned, good.size(), nullptr); });
        std::memcpy(misaligned, good.data(), good.size());
        check_call_refused(small.world, LKS_ERROR_MISALIGNED, "8",
                           [&] { return lks_world_load(small.world, misaligned, good.size()); });
    }
}

TEST_CASE("rubbish that only looks like an image is refused") {
    const Small small;
    const std::uint64_t hash = small.world.hash();
    Random random(99);
    for (int i = 0; i < 200; ++i) {
        Image rubbish(static_cast<std::size_t>(random.between(1, 60)) * 8);
        for (std::size_t b = 0; b < rubbish.size(); ++b) {
            rubbish.bytes()[b] = static_cast<unsigned char>(random.next());
        }
        CHECK(refused(small.world, rubbish.data(), rubbish.size(), hash));
    }
}
