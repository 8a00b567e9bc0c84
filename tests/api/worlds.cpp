// World settings that are refused, each with a sentence that names the value.
#include <doctest/doctest.h>

#include <vector>

#include "support/allocator.h"
#include "support/refusals.h"

using namespace support;

namespace {

template <typename Change>
lks_world_def changed(Change change) {
    lks_world_def def = lks_default_world_def();
    change(def);
    return def;
}

} // namespace

TEST_CASE("a tick rate of zero or beyond 10000 is refused") {
    check_world_refused(changed([](auto& def) { def.tick_rate_hz = 0; }), LKS_ERROR_INVALID_ARGUMENT, "0");
    check_world_refused(changed([](auto& def) { def.tick_rate_hz = 10001; }), LKS_ERROR_INVALID_ARGUMENT,
                        "10001");
    check_world_refused(changed([](auto& def) { def.tick_rate_hz = 4294967295u; }),
                        LKS_ERROR_INVALID_ARGUMENT, "4294967295");
}

TEST_CASE("zero or too many substeps and iterations are refused") {
    check_world_refused(changed([](auto& def) { def.substeps = 0; }), LKS_ERROR_INVALID_ARGUMENT,
                        "substeps is 0");
    check_world_refused(changed([](auto& def) { def.substeps = 1001; }), LKS_ERROR_INVALID_ARGUMENT, "1001");
    check_world_refused(changed([](auto& def) { def.iterations = 0; }), LKS_ERROR_INVALID_ARGUMENT,
                        "iterations is 0");
    check_world_refused(changed([](auto& def) { def.iterations = 1001; }), LKS_ERROR_INVALID_ARGUMENT,
                        "1001");
    check_world_refused(changed([](auto& def) {
                            def.tick_rate_hz = 10000;
                            def.substeps = 101;
                        }),
                        LKS_ERROR_INVALID_ARGUMENT, "1010000");
    World(changed([](auto& def) {
        def.tick_rate_hz = 10000;
        def.substeps = 100;
    }));
}

TEST_CASE("gravity beyond 1000 m/s2 on any axis is refused when created and when set") {
    for (int axis = 0; axis < 3; ++axis) {
        for (const std::int64_t sign : {1, -1}) {
            lks_vec3 gravity{};
            (axis == 0   ? gravity.x
             : axis == 1 ? gravity.y
                         : gravity.z) = sign * (LKS_FIXED(1000) + LKS_FIXED_ONE / 2);
            const std::string value = sign > 0 ? "1000.5" : "-1000.5";
            check_world_refused(changed([&](auto& def) { def.gravity = gravity; }),
                                LKS_ERROR_INVALID_ARGUMENT, value);
            const World world;
            check_call_refused(world, LKS_ERROR_INVALID_ARGUMENT, value,
                               [&] { return lks_world_set_gravity(world, gravity); });
        }
    }
    lks_vec3 extreme{INT64_MIN, INT64_MAX, 0};
    const World world;
    CHECK(lks_world_set_gravity(world, extreme) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(lks_world_set_gravity(world, {LKS_FIXED(1000), LKS_FIXED(-1000), 0}) == LKS_OK);
}

TEST_CASE("a cap of no ticks or too many and unknown policies are refused") {
    check_world_refused(changed([](auto& def) { def.max_ticks_per_advance = 0; }), LKS_ERROR_INVALID_ARGUMENT,
                        "0");
    check_world_refused(changed([](auto& def) { def.max_ticks_per_advance = 10001; }),
                        LKS_ERROR_INVALID_ARGUMENT, "10001");
    check_world_refused(changed([](auto& def) { def.excess_time = 2; }), LKS_ERROR_INVALID_ARGUMENT, "2");
    check_world_refused(changed([](auto& def) { def.keep_previous_positions = 7; }),
                        LKS_ERROR_INVALID_ARGUMENT, "7");
    check_world_refused(changed([](auto& def) { def.simd = 9; }), LKS_ERROR_INVALID_ARGUMENT, "9");
}

TEST_CASE("half an allocator is refused") {
    Allocator allocator;
    check_world_refused(changed([&](auto& def) {
                            def.allocator = allocator.interface();
                            def.allocator.release = nullptr;
                        }),
                        LKS_ERROR_INVALID_ARGUMENT, "allocator");
    check_world_refused(changed([&](auto& def) {
                            def.allocator = allocator.interface();
                            def.allocator.allocate = nullptr;
                        }),
                        LKS_ERROR_INVALID_ARGUMENT, "allocator");
    CHECK(allocator.allocations() == 0);
}

TEST_CASE("time that runs backwards or too far is refused and nothing runs") {
    World world;
    for (const std::int64_t elapsed :
         {std::int64_t{-1}, INT64_MIN, std::int64_t{100000000000001}, INT64_MAX}) {
        std::uint32_t ran = 77;
        check_call_refused(world, LKS_ERROR_INVALID_ARGUMENT, std::to_string(elapsed),
                           [&] { return lks_world_advance(world, elapsed, &ran); });
        CHECK(ran == 77);
        CHECK(world.tick() == 0);
        CHECK(lks_world_interpolation(world) == 0);
    }
    CHECK(lks_world_advance(world, 100000000000000, nullptr) == LKS_OK);
    CHECK(world.tick() == 8);
}

TEST_CASE("ticks that pile up without end are refused before the clock overflows") {
    lks_world_def def = lks_default_world_def();
    def.tick_rate_hz = 10000;
    def.substeps = 1;
    def.max_ticks_per_advance = 1;
    def.excess_time = LKS_EXCESS_TIME_KEEP;
    World world(def);
    lks_result result = LKS_OK;
    int calls = 0;
    while (result == LKS_OK && calls < 100) {
        result = lks_world_advance(world, 100000000000000, nullptr);
        ++calls;
    }
    CHECK(result == LKS_ERROR_LIMIT);
    CHECK(calls > 5);
    check_sentence(world.message(), "ticks");
    std::uint32_t ran = 0;
    CHECK(lks_world_advance(world, 0, &ran) == LKS_OK);
    CHECK(ran == 1);
}

TEST_CASE("each failed call goes to the log once and to the last error") {
    std::vector<std::string> lines;
    lks_world_def def = lks_default_world_def();
    def.log.user = &lines;
    def.log.write = [](void* user, lks_log_level level, const char* message) {
        CHECK(level == LKS_LOG_ERROR);
        static_cast<std::vector<std::string>*>(user)->push_back(message);
    };
    World world(def);
    CHECK(lks_world_last_error(world)->result == LKS_OK);
    CHECK(lks_world_advance(world, -5, nullptr) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(lks_world_remove_object(world, {3, 9}) == LKS_ERROR_STALE_ID);
    REQUIRE(lines.size() == 2);
    CHECK(lines[1] == world.message());
    CHECK(lks_world_last_error(world)->result == LKS_ERROR_STALE_ID);
    world.step();
    CHECK(lks_world_last_error(world)->result == LKS_ERROR_STALE_ID); // a success does not wipe it
    CHECK(lines.size() == 2);
}

TEST_CASE("every result has a word") {
    for (int result = LKS_OK; result <= LKS_ERROR_UNSUPPORTED; ++result) {
        const char* text = lks_result_text(static_cast<lks_result>(result));
        REQUIRE(text != nullptr);
        CHECK(std::string(text).size() > 1);
        for (int other = LKS_OK; other < result; ++other) {
            CHECK(std::string(text) != lks_result_text(static_cast<lks_result>(other)));
        }
    }
    CHECK(lks_result_text(static_cast<lks_result>(15)) != nullptr);
    CHECK(lks_version() == LKS_VERSION_MAJOR * 10000 + LKS_VERSION_MINOR * 100 + LKS_VERSION_PATCH);
    CHECK(lks_solver_version() == LKS_SOLVER_VERSION);
}

TEST_CASE("a world tells the settings that it was made with") {
    const World world(world_def(75, 12, 3));
    CHECK(lks_world_tick_rate(world) == 75);
    CHECK(lks_world_substeps(world) == 12);
    CHECK(lks_world_iterations(world) == 3);
}

TEST_CASE("no workers and too many and half a task system are refused") {
    check_world_refused(changed([](auto& def) { def.worker_count = 0; }), LKS_ERROR_INVALID_ARGUMENT, "0");
    check_world_refused(changed([](auto& def) { def.worker_count = 65; }), LKS_ERROR_INVALID_ARGUMENT, "65");
    check_world_refused(changed([](auto& def) { def.reserved = 3; }), LKS_ERROR_INVALID_ARGUMENT,
                        "is 3; it must be 0.");
    check_world_refused(changed([](auto& def) { def.tasks.finish = [](void*, void*) {}; }),
                        LKS_ERROR_INVALID_ARGUMENT, "task system");
    check_world_refused(changed([](auto& def) {
                            def.tasks.enqueue = [](void*, lks_task, void*) -> void* { return nullptr; };
                        }),
                        LKS_ERROR_INVALID_ARGUMENT, "task system");
}
