// What worlds tell of what happened in them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/attachments.h"
#include "support/bodies.h"
#include "support/builders.h"
#include "support/events.h"
#include "support/refusals.h"

using namespace support;

namespace {

std::vector<lks_event> only(const std::vector<lks_event>& all, lks_event_kind kind) {
    std::vector<lks_event> some;
    std::copy_if(all.begin(), all.end(), std::back_inserter(some),
                 [kind](const lks_event& e) { return e.kind == static_cast<std::uint32_t>(kind); });
    return some;
}

// Of those that load a contact, or unload it.
std::vector<lks_event> loads(const std::vector<lks_event>& all, lks_event_kind kind) {
    std::vector<lks_event> some;
    for (const lks_event& event : only(all, kind)) {
        if (event.body_b.generation == 0) { // with the ground
            some.push_back(event);
        }
    }
    return some;
}

} // namespace

TEST_CASE("a ball that falls, bounces and rests begins and ends its contacts with the impulse that it has") {
    World world(world_def(60, 8));
    add_ground(world);
    lks_body_def def = lks_default_body_def();
    def.restitution = fixed(0.5);
    const lks_body_id ball = add_body(world, ball_shape(0.2), fixed(0, 1.2, 0), def);
    record(world);
    const std::vector<lks_event> all = run(world, 400);
    const std::vector<lks_event> begins = only(all, LKS_EVENT_CONTACT_BEGIN);
    const std::vector<lks_event> ends = only(all, LKS_EVENT_CONTACT_END);
    REQUIRE(begins.size() >= 3);
    CHECK(ends.size() == begins.size() - 1); // it lies now
    // It falls a metre and leaves with half its speed.
    const double speed = std::sqrt(2 * 9.81);
    CHECK(std::abs(metres(begins[0].strength) / (1.5 * mass_of(world, ball) * speed) - 1) < 0.03);
    CHECK(begins[0].body_a.index == ball.index);
    CHECK(begins[0].body_b.generation == 0);
    CHECK(begins[0].collider.generation == 1);
    CHECK(std::abs(static_cast<double>(begins[0].tick) / 60 - speed / 9.81) < 0.05);
    CHECK(begins[1].strength < begins[0].strength);
    const std::vector<lks_event> asleep = only(all, LKS_EVENT_FELL_ASLEEP);
    REQUIRE(asleep.size() == 1);
    CHECK(asleep[0].body_a.generation == ball.generation);
    REQUIRE(lks_body_apply_impulse(world, ball, fixed(0, 100, 0), fixed(0, 0.2, 0)) == LKS_OK);
    const std::vector<lks_event> flight = run(world, 5);
    CHECK(only(flight, LKS_EVENT_WOKE).size() == 1);
    CHECK(only(flight, LKS_EVENT_CONTACT_END).size() == 1);
}

// A box of 8 kg with its lowest face this high above the ground, flat.
lks_body_id drop_box(World& world, double height, double restitution = 0) {
    lks_body_def def = lks_default_body_def();
    def.restitution = fixed(restitution);
    def.never_sleeps = 1;
    return add_body(world, box_shape(0.1, 0.1, 0.1), fixed(0, height + 0.1, 0), def);
}

TEST_CASE("every impact over the threshold is told once and whole, wherever in a tick it begins") {
    for (const int substeps : {2, 8, 20}) {
        int wrong = 0;
        double worst = 0;
        for (int i = 0; i < 200; ++i) {
            const double height = 1 + 0.0031 * i;
            const double restitution = i % 2 == 0 ? 0 : 0.4;
            World world(world_def(60, substeps));
            add_ground(world);
            const lks_body_id box = drop_box(world, height, restitution);
            const double speed = std::sqrt(2 * 9.81 * height);
            const double impulse = mass_of(world, box) * speed * (1 + restitution);
            record(world, LKS_ALL_EVENTS, impulse * (i % 3 == 0 ? 0.9 : i % 3 == 1 ? 0.5 : 0.25));
            // Until it comes down again.
            const double flight = 2 * restitution * speed / 9.81;
            const std::vector<lks_event> all =
                run(world, static_cast<int>(60 * (speed / 9.81 + (flight > 0 ? 0.6 * flight : 0.5))));
            const std::vector<lks_event> hits = only(all, LKS_EVENT_CONTACT_HIT);
            wrong += hits.size() != 1 ? 1 : 0;
            for (const lks_event& hit : hits) {
                worst = std::max(worst, std::abs(metres(hit.strength) / impulse - 1));
            }
            const std::vector<lks_event> begins = only(all, LKS_EVENT_CONTACT_BEGIN);
            CHECK(begins.size() == 1);
            CHECK(only(all, LKS_EVENT_CONTACT_END).size() == (restitution > 0 ? 1u : 0u));
            worst = std::max(worst, std::abs(metres(begins[0].strength) / impulse - 1));
        }
        CAPTURE(substeps);
        CHECK(wrong == 0);
        CHECK(worst < 0.05);
    }
}

TEST_CASE("what strikes a contact that is there already is told once, what only lies there is not") {
    World world(world_def(60, 8));
    add_ground(world);
    const lks_body_id box = drop_box(world, 0);
    record(world, LKS_ALL_EVENTS, 50);
    std::vector<lks_event> all = run(world, 30);
    CHECK(only(all, LKS_EVENT_CONTACT_BEGIN).size() == 1);
    CHECK(only(all, LKS_EVENT_CONTACT_HIT).empty());
    // As it lies there.
    REQUIRE(lks_body_apply_impulse(world, box, fixed(0, -400, 0), fixed(0, 0.1, 0)) == LKS_OK);
    all = run(world, 30);
    REQUIRE(all.size() == 1);
    CHECK(all[0].kind == LKS_EVENT_CONTACT_HIT);
    CHECK(all[0].tick == 30); // of the tick that began then
    CHECK(std::abs(metres(all[0].strength) / 401 - 1) < 0.01);
    // By another one that falls on it: theirs begins, and both are struck.
    const lks_body_id second = add_body(world, box_shape(0.1, 0.1, 0.1), fixed(0, 2.3, 0));
    all = run(world, 90);
    CHECK(only(all, LKS_EVENT_CONTACT_BEGIN).size() == 1);
    const std::vector<lks_event> hits = only(all, LKS_EVENT_CONTACT_HIT);
    REQUIRE(hits.size() == 2);
    CHECK(hits[0].body_b.index == second.index);
    CHECK(hits[1].body_b.generation == 0);
    // Whoever hardly touches, and leaves, begins and ends.
    REQUIRE(lks_body_apply_impulse(world, second, fixed(0, 30, 0), fixed(0, 0.3, 0)) == LKS_OK);
    all = run(world, 10);
    REQUIRE(all.size() == 1);
    CHECK(all[0].kind == LKS_EVENT_CONTACT_END);
}

TEST_CASE(
    "a weight above the threshold is told when it comes to bear, and a rolled-back world tells it again") {
    World world(world_def(60, 8));
    add_ground(world);
    const lks_body_id box = drop_box(world, 0.02); // pushes with 1.3 N s a tick
    record(world, LKS_ALL_EVENTS, 1);
    CHECK(only(run(world, 60), LKS_EVENT_CONTACT_HIT).size() == 1);
    record(world, LKS_ALL_EVENTS, 50);
    REQUIRE(lks_body_apply_impulse(world, box, fixed(0, 40, 0), fixed(0, 0.1, 0)) == LKS_OK);
    for (int i = 0; i < 80; ++i) {
        const Image image = world.save();
        const std::vector<lks_event> first = run(world, 3);
        REQUIRE(lks_world_load(world, image.data(), image.size()) == LKS_OK);
        world.step();
        REQUIRE(lks_world_load(world, image.data(), image.size()) == LKS_OK);
        const std::vector<lks_event> second = run(world, 3);
        REQUIRE(first.size() == second.size());
        for (std::size_t k = 0; k < first.size(); ++k) {
            CHECK(same(first[k], second[k]));
        }
    }
}

TEST_CASE("soft touches stay below the threshold, and kinds that nobody wants out of the list") {
    for (const bool loud : {false, true}) {
        World world(world_def(60, 8));
        add_ground(world);
        const lks_body_id ball = add_body(world, ball_shape(0.2), fixed(0, 0.45, 0));
        const double impulse = mass_of(world, ball) * std::sqrt(2 * 9.81 * 0.25);
        record(world, LKS_EVENT_BIT(LKS_EVENT_CONTACT_HIT), impulse * (loud ? 0.8 : 1.2));
        const std::vector<lks_event> all = run(world, 120);
        CHECK(all.size() == (loud ? 1 : 0));
    }
}

TEST_CASE("a contact is loaded by a weight over the threshold, asleep too, and unloaded when less is left") {
    for (const int substeps : {2, 8, 20}) {
        World world(world_def(60, substeps));
        add_ground(world);
        const lks_body_id box = add_body(world, box_shape(0.1, 0.1, 0.1), fixed(0, 0.1, 0)); // 1.3 N s a tick
        const double weight = mass_of(world, box) * 9.81 / 60;
        // Nobody asks for anything else of contacts.
        const std::uint32_t kinds =
            LKS_EVENT_BIT(LKS_EVENT_CONTACT_LOADED) | LKS_EVENT_BIT(LKS_EVENT_CONTACT_UNLOADED);
        record(world, kinds, 1.5 * weight);
        CHECK(loads(run(world, 60), LKS_EVENT_CONTACT_LOADED).empty());
        const lks_body_id second = add_body(world, box_shape(0.1, 0.1, 0.1), fixed(0, 0.3, 0));
        std::vector<lks_event> all = run(world, 300);
        const std::vector<lks_event> loaded = loads(all, LKS_EVENT_CONTACT_LOADED);
        REQUIRE(loaded.size() == 1);
        CHECK(loaded[0].body_a.index == box.index);
        CHECK(metres(loaded[0].strength) >= 1.5 * weight);
        CHECK(only(all, LKS_EVENT_CONTACT_LOADED).size() == 1); // between the boxes it is one weight
        CHECK(only(all, LKS_EVENT_CONTACT_UNLOADED).empty());
        CHECK(lks_world_awake_body_count(world) == 0);
        REQUIRE(lks_world_remove_body(world, second) == LKS_OK);
        all = run(world, 60);
        const std::vector<lks_event> unloaded = loads(all, LKS_EVENT_CONTACT_UNLOADED);
        REQUIRE(unloaded.size() == 1);
        CHECK(unloaded[0].body_a.index == box.index);
        CHECK(std::abs(metres(unloaded[0].strength) / weight - 1) < 0.6);
        // Lifted off: one weight is unloaded, and the contact ends.
        record(world, LKS_ALL_EVENTS, 0.5 * weight);
        REQUIRE(lks_body_apply_impulse(world, box, fixed(0, 40, 0), fixed(0, 0.1, 0)) == LKS_OK);
        all = run(world, 5);
        REQUIRE(only(all, LKS_EVENT_CONTACT_UNLOADED).size() == 1);
        CHECK(only(all, LKS_EVENT_CONTACT_UNLOADED)[0].strength == 0);
        CHECK(only(all, LKS_EVENT_CONTACT_END).size() == 1);
    }
}

// What the game puts elsewhere, or makes another, has parted for who counts touches, too.
TEST_CASE(
    "contacts of what is put elsewhere or becomes kinematic end and are unloaded once, and begin once") {
    enum class Change { far_away, a_millimetre, by_pose, lower_kinematic, both_kinematic, onto_ground };
    for (const Change change : {Change::far_away, Change::a_millimetre, Change::by_pose,
                                Change::lower_kinematic, Change::both_kinematic, Change::onto_ground}) {
        for (const bool asleep : {false, true}) {
            CAPTURE(static_cast<int>(change));
            CAPTURE(asleep);
            World world(world_def(60, 8));
            add_ground(world);
            const auto add = [&](double height, double density) {
                lks_body_def def = lks_default_body_def();
                def.never_sleeps = asleep ? 0 : 1;
                lks_body_shape shape = box_shape(0.1, 0.1, 0.1);
                shape.density = fixed(density);
                return add_body(world, shape, fixed(0, height, 0), def);
            };
            // The lower one is lighter: kinematic, its contact with the other counts in another mass.
            const lks_body_id lower = add(0.1, 500);
            const lks_body_id upper = add(0.3, 1000);
            record(world, LKS_ALL_EVENTS, 0.5 * mass_of(world, lower) * 9.81 / 60);
            std::vector<lks_event> all = run(world, 200);
            CHECK((lks_world_awake_body_count(world) == 0) == asleep);
            const auto open = [&](lks_event_kind begin, lks_event_kind end) {
                return static_cast<int>(only(all, begin).size()) - static_cast<int>(only(all, end).size());
            };
            CHECK(open(LKS_EVENT_CONTACT_BEGIN, LKS_EVENT_CONTACT_END) == 2);
            CHECK(open(LKS_EVENT_CONTACT_LOADED, LKS_EVENT_CONTACT_UNLOADED) == 2);
            const std::size_t begins = only(all, LKS_EVENT_CONTACT_BEGIN).size();
            const lks_transform aside = at(30, 5, 0);
            switch (change) {
            case Change::far_away:
                REQUIRE(lks_body_set_transform(world, upper, aside) == LKS_OK);
                break;
            case Change::a_millimetre:
                REQUIRE(lks_body_set_transform(world, upper, at(0.001, 0.3, 0)) == LKS_OK);
                break;
            case Change::by_pose:
                REQUIRE(lks_ragdoll_set_pose(world, &upper, 1, &aside, nullptr) == LKS_OK);
                break;
            case Change::both_kinematic:
                REQUIRE(lks_body_set_kind(world, upper, LKS_BODY_KINEMATIC) == LKS_OK);
                [[fallthrough]];
            case Change::lower_kinematic:
                REQUIRE(lks_body_set_kind(world, lower, LKS_BODY_KINEMATIC) == LKS_OK);
                break;
            case Change::onto_ground:
                REQUIRE(lks_body_set_transform(world, upper, at(3, 0.1, 0)) == LKS_OK);
                break;
            }
            // Known in what is saved meanwhile, too.
            const Image image = world.save();
            for (int round = 0; round < 2; ++round) {
                const std::vector<lks_event> before = all;
                const std::vector<lks_event> more = run(world, 10);
                all.insert(all.end(), more.begin(), more.end());
                const int left = change == Change::a_millimetre || change == Change::onto_ground ? 2
                                 : change == Change::both_kinematic                              ? 0
                                                                                                 : 1;
                CHECK(open(LKS_EVENT_CONTACT_BEGIN, LKS_EVENT_CONTACT_END) == left);
                CHECK(open(LKS_EVENT_CONTACT_LOADED, LKS_EVENT_CONTACT_UNLOADED) == left);
                // What touches the same one as before does not begin again.
                CHECK(only(all, LKS_EVENT_CONTACT_BEGIN).size() ==
                      begins + (change == Change::onto_ground ? 1 : 0));
                REQUIRE(lks_world_load(world, image.data(), image.size()) == LKS_OK);
                all = before;
            }
        }
    }
}

TEST_CASE("what breaks says so, with the force that broke it") {
    World world(world_def(60, 8));
    const lks_body_id anchor = add_anchor(world, {});
    const lks_body_id ball = add_body(world, ball_shape(0.1), {});
    lks_joint_def joint = lks_default_joint_def();
    joint.break_force = fixed(0.9 * mass_of(world, ball) * 9.81);
    const lks_joint_id id = add_joint(world, joint, anchor, ball);
    const Asset rope = Chain().build();
    lks_attachment_def hold = to_body(world.add(rope, at(0, 3, 0)), 0, anchor, fixed(0, 3, 0));
    hold.break_force = fixed(1);
    const lks_attachment_id held = attach(world, hold);
    record(world);
    const std::vector<lks_event> all = run(world, 30);
    const std::vector<lks_event> broken = only(all, LKS_EVENT_JOINT_BROKE);
    REQUIRE(broken.size() == 1);
    CHECK(broken[0].joint.index == id.index);
    CHECK(broken[0].joint.generation == id.generation);
    CHECK(lks_world_has_joint(world, id) == 0);
    CHECK(broken[0].body_b.index == ball.index);
    CHECK(std::abs(metres(broken[0].strength) / (mass_of(world, ball) * 9.81) - 1) < 0.1);
    const std::vector<lks_event> torn = only(all, LKS_EVENT_ATTACHMENT_BROKE);
    REQUIRE(torn.size() == 1);
    CHECK(torn[0].attachment.generation == held.generation);
    CHECK(torn[0].body_a.index == anchor.index);
    CHECK(metres(torn[0].strength) > 1);
}

TEST_CASE("recording changes no bit; the same ticks tell the same, and in order") {
    const auto build = [](World& world) {
        add_ground(world);
        for (int i = 0; i < 12; ++i) {
            add_body(world, box_shape(0.1, 0.1, 0.1), fixed(0.03 * (i % 3), 0.2 + 0.3 * i, 0.02 * (i % 4)));
        }
    };
    World quiet(world_def(60, 8));
    World telling(world_def(60, 8));
    build(quiet);
    build(telling);
    record(telling);
    std::vector<lks_event> all = run(telling, 40);
    quiet.step(40);
    CHECK(quiet.hash() == telling.hash());
    const Image image = telling.save();
    const std::vector<lks_event> first = run(telling, 200);
    REQUIRE(lks_world_load(telling, image.data(), image.size()) == LKS_OK);
    CHECK(lks_world_event_count(telling) == 0);
    const std::vector<lks_event> second = run(telling, 200);
    REQUIRE(first.size() == second.size());
    CHECK(first.size() > 10);
    all.insert(all.end(), first.begin(), first.end());
    for (std::size_t i = 0; i < first.size(); ++i) {
        CHECK(same(first[i], second[i]));
    }
    for (std::size_t i = 1; i < all.size(); ++i) {
        CHECK(all[i - 1].tick <= all[i].tick);
        const bool both_contacts = all[i - 1].tick == all[i].tick && all[i].kind <= LKS_EVENT_CONTACT_END;
        if (both_contacts) {
            CHECK(all[i - 1].body_a.index <= all[i].body_a.index);
        }
    }
    // In a tick of its own each that begins ends once, or is still there.
    CHECK(only(all, LKS_EVENT_CONTACT_BEGIN).size() >= only(all, LKS_EVENT_CONTACT_END).size());
    // Several ticks of one call.
    REQUIRE(lks_world_load(telling, image.data(), image.size()) == LKS_OK);
    std::uint32_t ran = 0;
    REQUIRE(lks_world_advance(telling, 6 * 1000000000ll / 60 + 1000, &ran) == LKS_OK);
    REQUIRE(ran == 6);
    const auto in_time = static_cast<std::size_t>(
        std::count_if(first.begin(), first.end(), [&](const lks_event& e) { return e.tick < 46; }));
    CHECK(events_of(telling).size() == in_time);
}

TEST_CASE("events beyond the room for them are counted, and wrong settings refused") {
    World world(world_def(60, 8));
    add_ground(world);
    for (int i = 0; i < 8; ++i) {
        add_body(world, ball_shape(0.1), fixed(i, 0.099, 0));
    }
    record(world, LKS_ALL_EVENTS, 0, 3);
    world.step();
    CHECK(lks_world_event_count(world) == 3);
    CHECK(world.counters().lost_events == 21); // each begins, hits and is loaded
    check_call_refused(world, LKS_ERROR_INVALID_ARGUMENT, "1024",
                       [&] { return lks_world_record_events(world, 1024, 0, 10); });
    CHECK(world.message() == "The kinds of events are 1024; they are sums of bits, up to 1023.");
    check_call_refused(world, LKS_ERROR_INVALID_ARGUMENT, "-1",
                       [&] { return lks_world_record_events(world, 1, fixed(-1), 10); });
    check_call_refused(world, LKS_ERROR_INVALID_ARGUMENT, "0 events",
                       [&] { return lks_world_record_events(world, 1, 0, 0); });
    CHECK(lks_world_record_events(nullptr, 1, 0, 1) == LKS_ERROR_NULL_ARGUMENT);
    CHECK(lks_world_events(nullptr) == nullptr);
    CHECK(lks_world_event_count(nullptr) == 0);
    CHECK(lks_world_event_count(world) == 3);
}

TEST_CASE("who comes gently to touch a sleeper of another mass is told with the impulse that stops him") {
    for (const bool light_first : {true, false}) {
        World world(world_def(60, 8));
        add_ground(world);
        lks_body_def heavy = lks_default_body_def();
        heavy.mass = fixed(1000);
        heavy.never_sleeps = 1;
        heavy.gravity_factor = 0;
        lks_body_def light = lks_default_body_def();
        light.mass = fixed(1);
        const auto add_light = [&] {
            return add_body(world, box_shape(0.5, 0.2, 0.5), fixed(0, 0.2, 0), light);
        };
        const auto add_heavy = [&] {
            return add_body(world, box_shape(0.5, 0.5, 0.5), fixed(0, 3, 0), heavy);
        };
        const lks_body_id one = light_first ? add_light() : add_heavy();
        const lks_body_id two = light_first ? add_heavy() : add_light();
        const lks_body_id sleeper = light_first ? one : two;
        const lks_body_id comer = light_first ? two : one;
        world.step(90);
        REQUIRE(lks_body_is_awake(world, sleeper) == 0);
        record(world, LKS_EVENT_BIT(LKS_EVENT_CONTACT_BEGIN) | LKS_EVENT_BIT(LKS_EVENT_CONTACT_HIT), 1);
        REQUIRE(lks_body_set_transform(world, comer, at(0, 0.9005, 0)) == LKS_OK);
        REQUIRE(lks_body_set_velocity(world, comer, fixed(0, -0.005, 0), {}) == LKS_OK);
        std::vector<lks_event> all;
        double stopped = 0; // N·s that it has lost until it was told
        while (world.tick() < 120 && all.empty()) {
            world.step();
            all = events_of(world);
            stopped = 1000 * (0.005 + state_of(world, comer).velocity.y);
        }
        INFO("light first: " << light_first);
        REQUIRE(!all.empty());
        CHECK(metres(all[0].strength) > 2);
        CHECK(metres(all[0].strength) < 6);
        CHECK(metres(all[0].strength) > 0.9 * stopped);
    }
}
