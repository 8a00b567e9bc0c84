// Instruction sets: named, asked for, refused where they are not there, and overridden by the environment.
#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

#include "support/builders.h"
#include "support/refusals.h"

using namespace support;

namespace {

constexpr lks_simd levels[] = {LKS_SIMD_SCALAR, LKS_SIMD_SSE41, LKS_SIMD_AVX2,
                               LKS_SIMD_AVX512, LKS_SIMD_NEON,  LKS_SIMD_WASM};

lks_world_def with(lks_simd simd) {
    lks_world_def def = world_def(60, 4);
    def.simd = static_cast<std::uint32_t>(simd);
    return def;
}

#if !defined(_WIN32)
// Sets LOCKSTITCH_SIMD, and puts back what was there.
class Environment {
public:
    explicit Environment(const char* value) {
        if (const char* old = std::getenv("LOCKSTITCH_SIMD")) {
            old_ = old;
            had_ = true;
        }
        setenv("LOCKSTITCH_SIMD", value, 1);
    }
    ~Environment() {
        if (had_) {
            setenv("LOCKSTITCH_SIMD", old_.c_str(), 1);
        } else {
            unsetenv("LOCKSTITCH_SIMD");
        }
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    std::string old_;
    bool had_ = false;
};
#endif

} // namespace

TEST_CASE("every instruction set has a name of its own and plain integers are always there") {
    CHECK(lks_simd_is_available(LKS_SIMD_AUTO) == 1);
    CHECK(lks_simd_is_available(LKS_SIMD_SCALAR) == 1);
    CHECK(lks_simd_is_available(static_cast<lks_simd>(7)) == 0);
    CHECK(std::string(lks_simd_name(LKS_SIMD_AUTO)) == "auto");
    CHECK(std::string(lks_simd_name(static_cast<lks_simd>(7))) == "unknown");
    for (const lks_simd a : levels) {
        CHECK(std::string(lks_simd_name(a)) != "unknown");
        for (const lks_simd b : levels) {
            CHECK((std::string(lks_simd_name(a)) == lks_simd_name(b)) == (a == b));
        }
    }
}

TEST_CASE("a world uses the instruction set that it is asked to and the same bits come out") {
    Net net;
    net.side = 23;
    net.shear = soft(1e-5, 3);
    const Asset asset = net.build();
    std::uint64_t expected = 0;
    lks_simd widest = LKS_SIMD_SCALAR;
    for (const lks_simd level : levels) {
        INFO(std::string(lks_simd_name(level)));
        if (lks_simd_is_available(level) == 0) {
            check_world_refused(with(level), LKS_ERROR_INVALID_ARGUMENT, lks_simd_name(level));
            continue;
        }
        widest = level;
        World world(with(level));
        CHECK(lks_world_simd(world) == level);
        const lks_object_id object = world.add(asset, at(0, 0, 0));
        world.pin(object, 0);
        world.step(60);
        expected = expected == 0 ? world.hash() : expected;
        CHECK(world.hash() == expected);
    }
    const World automatic;
    if (std::getenv("LOCKSTITCH_SIMD") == nullptr) {
        CHECK(lks_world_simd(automatic) == widest);
    }
    CHECK(lks_simd_is_available(lks_world_simd(automatic)) == 1);
    CHECK(lks_world_simd(nullptr) == LKS_SIMD_AUTO);
}

TEST_CASE("an image saved with one instruction set continues with another") {
    Net net;
    net.side = 20;
    const Asset asset = net.build();
    World plain(with(LKS_SIMD_SCALAR));
    const lks_object_id object = plain.add(asset, at(0, 0, 0));
    plain.pin(object, 3);
    plain.step(20);
    World best(with(LKS_SIMD_AUTO));
    best.add(asset, at(0, 0, 0));
    const auto image = plain.save();
    REQUIRE(lks_world_load(best, image.data(), image.size()) == LKS_OK);
    plain.step(20);
    best.step(20);
    CHECK(plain.hash() == best.hash());
}

#if !defined(_WIN32)
TEST_CASE("the environment decides where the world does not and is ignored where it names nothing") {
    const lks_simd best = lks_world_simd(World());
    {
        const Environment environment("scalar");
        CHECK(lks_world_simd(World()) == LKS_SIMD_SCALAR);
        for (const lks_simd level : levels) {
            if (lks_simd_is_available(level) != 0) {
                CHECK(lks_world_simd(World(with(level))) == level);
            }
        }
    }
    if (std::getenv("LOCKSTITCH_SIMD") == nullptr) {
        const Environment environment("a-machine-of-the-future");
        CHECK(lks_world_simd(World()) == best);
    }
}
#endif
