// Golden states of bodies: what they write they read, and what differs is named.
#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <vector>

#include "golden/recorder.h"
#include "scenes/scene.h"

namespace {

// The first ticks of a scene; `meddle` is called before the last of them is taken down.
lks_golden::GoldenState record(const std::string& name, std::uint32_t ticks,
                               const std::function<void(lks_demo::Scene&)>& meddle = {}) {
    std::string error;
    const std::unique_ptr<lks_demo::Scene> scene = lks_demo::create_scene(name, {}, error);
    REQUIRE_MESSAGE(scene != nullptr, error);
    lks_golden::Recorder recorder(*scene);
    for (std::uint32_t tick = 1; tick <= ticks; ++tick) {
        REQUIRE_MESSAGE(scene->step(error), error);
        if (tick == ticks && meddle) {
            meddle(*scene);
        }
        recorder.record_tick();
    }
    recorder.record_end();
    return recorder.state();
}

bool begins_with(const std::string& text, const std::string& start) {
    return text.compare(0, start.size(), start) == 0;
}

} // namespace

TEST_CASE("golden states of bodies, joints and objects are read as they are written") {
    for (const char* name : {"box_stack", "crane", "newtons_cradle", "ragdoll_cape", "spider"}) {
        const lks_golden::GoldenState state = record(name, 20);
        const std::string text = lks_golden::to_text(state);
        lks_golden::GoldenState parsed;
        std::string error;
        REQUIRE_MESSAGE(lks_golden::parse(text, parsed, error), error);
        CHECK(lks_golden::to_text(parsed) == text);
        CHECK(lks_golden::differences(text, state).empty());
        CHECK(parsed.bodies.size() > 0);
        CHECK(parsed.ticks.back().bodies.size() == parsed.bodies.size());
    }
}

TEST_CASE("the first sentence names the first body that differs, whatever of it does") {
    const lks_golden::GoldenState golden = record("ragdoll_stairs", 20);
    using Change = std::function<void(lks_world*, lks_body_id)>;
    const Change changes[] = {
        [](lks_world* world, lks_body_id body) {
            lks_transform at{};
            lks_body_transform(world, body, &at);
            ++at.position.y;
            lks_body_set_transform(world, body, at);
        },
        [](lks_world* world, lks_body_id body) {
            lks_transform at{};
            lks_body_transform(world, body, &at);
            REQUIRE(lks_rotation_from_axis_angle(0, 1, 0, 20, &at.rotation) == LKS_OK);
            lks_body_set_transform(world, body, at);
        },
        [](lks_world* world, lks_body_id body) {
            lks_body_set_velocity(world, body, {0, 1, 0}, {0, 0, 0});
        },
        [](lks_world* world, lks_body_id body) {
            lks_vec3 velocity{};
            lks_body_velocity(world, body, &velocity, nullptr);
            lks_body_set_velocity(world, body, velocity, {0, 1, 0});
        },
    };
    for (const Change& change : changes) {
        const lks_golden::GoldenState other = record("ragdoll_stairs", 20, [&](lks_demo::Scene& scene) {
            change(scene.world(), scene.bodies()[7].id);
            change(scene.world(), scene.bodies()[9].id);
        });
        const std::vector<std::string> sentences = lks_golden::differences(golden, other);
        REQUIRE(sentences.size() >= 3);
        CHECK(begins_with(sentences[0], "scene ragdoll_stairs, tick 20, body 7 (mannequin): expected "));
        CHECK(begins_with(sentences[1], "scene ragdoll_stairs, tick 20, body 9 (mannequin): expected "));
        CHECK(begins_with(sentences[2], "scene ragdoll_stairs, tick 20, the world without its place"));
    }
}

TEST_CASE("a golden state that tells of other bodies is refused or named") {
    const lks_golden::GoldenState golden = record("box_stack", 10);
    const std::string text = lks_golden::to_text(golden);
    const auto with = [&text](const std::string& from, const std::string& to) {
        std::string changed = text;
        const std::size_t at = changed.find(from);
        REQUIRE(at != std::string::npos);
        return changed.replace(at, from.size(), to);
    };
    lks_golden::GoldenState parsed;
    std::string error;
    CHECK_FALSE(lks_golden::parse(with("tick 10 bodies 15 ", "tick 10 bodies 14 "), parsed, error));
    CHECK_FALSE(lks_golden::parse(with("tick 10 bodies 0 ", "tick 20 bodies 0 "), parsed, error));
    CHECK_FALSE(lks_golden::parse(with("tick 10 bodies 0 ", "tick 10 bodies 0 12345 "), parsed, error));
    CHECK_FALSE(lks_golden::parse(with("body 3 ", "body 4 "), parsed, error));
    CHECK_FALSE(lks_golden::parse(with(" rotation ", " turned "), parsed, error));

    lks_golden::GoldenState fewer = golden;
    fewer.bodies.pop_back();
    CHECK(lks_golden::differences(golden, fewer).size() == 1);
    CHECK(lks_golden::differences(fewer, golden).size() == 1);
    lks_golden::GoldenState moved = golden;
    moved.bodies[2].metres = "1 2 3";
    const std::vector<std::string> sentences = lks_golden::differences(golden, moved);
    REQUIRE(sentences.size() == 1);
    CHECK(begins_with(sentences[0], "scene box_stack, last tick, body 2 ("));
    fewer = golden;
    fewer.ticks.back().bodies.pop_back();
    CHECK(lks_golden::differences(golden, fewer).size() == 1);
}
