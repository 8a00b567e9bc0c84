// The list of who touches whom is the set that begin and end events make, in their order, also for a world
// that was loaded.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

#include "support/bodies.h"
#include "support/events.h"

using namespace support;

namespace {

// Two bodies, or a body and a collider, with their generations.
using Ids =
    std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;

template <typename Sides>
Ids ids_of(const Sides& s) {
    return {s.body_a.index,      s.body_a.generation, s.body_b.index,
            s.body_b.generation, s.collider.index,    s.collider.generation};
}

std::vector<lks_contact> contacts_of(const World& world) {
    std::uint32_t count = 0;
    REQUIRE(lks_world_contacts(world, nullptr, 0, &count) == LKS_OK);
    std::vector<lks_contact> contacts(count);
    REQUIRE(lks_world_contacts(world, contacts.data(), count, &count) == LKS_OK);
    REQUIRE(count == contacts.size());
    return contacts;
}

// As a game keeps it.
class Touching {
public:
    void follow(const World& world) {
        for (const lks_event& event : events_of(world)) {
            if (event.kind == LKS_EVENT_CONTACT_BEGIN) {
                CHECK(ids_.insert(ids_of(event)).second);
            } else if (event.kind == LKS_EVENT_CONTACT_END) {
                CHECK(ids_.erase(ids_of(event)) == 1);
            }
        }
    }

    template <typename Is>
    void forget(const Is& is) {
        for (auto at = ids_.begin(); at != ids_.end();) {
            at = is(*at) ? ids_.erase(at) : std::next(at);
        }
    }

    void take(const World& world) {
        ids_.clear();
        for (const lks_contact& contact : contacts_of(world)) {
            ids_.insert(ids_of(contact));
        }
    }

    bool operator==(const Touching& other) const { return ids_ == other.ids_; }
    std::size_t size() const { return ids_.size(); }

private:
    std::set<Ids> ids_;
};

void check_list(const World& world, const Touching& kept) {
    Touching now;
    now.take(world);
    CHECK(now == kept);
    std::uint32_t shape_pairs = 0;
    for (const lks_contact& contact : contacts_of(world)) {
        CHECK(contact.shape_pairs >= 1);
        CHECK((contact.body_b.generation == 0) != (contact.collider.generation == 0));
        shape_pairs += contact.shape_pairs;
    }
    CHECK(shape_pairs == lks_world_contact_count(world));
}

// Bodies of several shapes, figures and balls that fall on each other, on tiles and on the ground.
struct Heap {
    Heap() : world(world_def(60, 6)) {
        add_ground(world);
        for (int i = 0; i < 3; ++i) {
            lks_collider_def def = lks_default_collider_def();
            def.shape = LKS_SHAPE_BOX;
            def.half_extents = fixed(0.3, 0.1, 0.3);
            def.transform.position = fixed(0.6 * i - 0.6, 0.1, 0);
            tiles.push_back(world.add(def));
        }
        for (int i = 0; i < 4; ++i) {
            bodies.push_back(add_dumbbell(0.1 * i, 0.6 + 0.5 * i));
            lks_body_def def = lks_default_body_def();
            def.restitution = fixed(0.6);
            bodies.push_back(
                add_body(world, ball_shape(0.12), fixed(0.2 - 0.1 * i, 0.7 + 0.5 * i, 0.1), def));
        }
        Humanoid humanoid;
        humanoid.def.transform.position = fixed(0, 2.5, 0);
        REQUIRE(humanoid.add(world) == LKS_OK);
    }

    lks_body_id add_dumbbell(double x, double y) {
        lks_body_shape shapes[2] = {ball_shape(0.1), box_shape(0.1, 0.1, 0.1)};
        shapes[0].transform.position = fixed(-0.2, 0, 0);
        shapes[1].transform.position = fixed(0.2, 0, 0);
        lks_body_def def = lks_default_body_def();
        def.shapes = shapes;
        def.shape_count = 2;
        def.transform.position = fixed(x, y, 0);
        lks_body_id id{};
        REQUIRE(lks_world_add_body(world, &def, &id) == LKS_OK);
        return id;
    }

    // What the game does before a tick, by the tick's number alone. `kept`: follows what is removed.
    void act(Touching& kept) {
        const std::uint64_t tick = world.tick();
        if (tick == 100) {
            REQUIRE(lks_world_remove_body(world, bodies[2]) == LKS_OK);
            const std::uint32_t index = bodies[2].index;
            kept.forget([index](const Ids& ids) {
                return std::get<0>(ids) == index || (std::get<3>(ids) != 0 && std::get<2>(ids) == index);
            });
        } else if (tick == 120) {
            bodies[2] = add_dumbbell(0, 1.5);
        } else if (tick == 140) {
            REQUIRE(lks_world_remove_collider(world, tiles[1]) == LKS_OK);
            const std::uint32_t index = tiles[1].index;
            kept.forget(
                [index](const Ids& ids) { return std::get<5>(ids) != 0 && std::get<4>(ids) == index; });
        } else if (tick == 160) {
            lks_transform up = lks_transform_identity();
            up.position = fixed(0, 2, 0);
            REQUIRE(lks_body_set_transform(world, bodies[0], up) == LKS_OK);
        } else if (tick == 180) {
            REQUIRE(lks_body_set_kind(world, bodies[1], LKS_BODY_KINEMATIC) == LKS_OK);
        } else if (tick == 200) {
            REQUIRE(lks_body_set_filter(world, bodies[3], {2, 0, 0}) == LKS_OK);
        } else if (tick == 230) {
            REQUIRE(lks_body_set_filter(world, bodies[3], {1, 0xffffffffu, 0}) == LKS_OK);
        }
    }

    World world;
    std::vector<lks_collider_id> tiles;
    std::vector<lks_body_id> bodies;
};

} // namespace

TEST_CASE("the list is the set that begin and end events make, in every tick") {
    Heap heap;
    record(heap.world);
    Touching kept;
    std::size_t most = 0;
    for (int tick = 0; tick < 600; ++tick) {
        heap.act(kept);
        check_list(heap.world, kept);
        heap.world.step();
        kept.follow(heap.world);
        check_list(heap.world, kept);
        most = std::max(most, kept.size());
    }
    CHECK(most > 15);
    CHECK(kept.size() > 10); // those that sleep are among them
}

TEST_CASE("pairs of which one body has several shapes that push are listed once, with how many they are") {
    World world(world_def(60, 8));
    add_ground(world);
    lks_body_shape shapes[3] = {ball_shape(0.1), ball_shape(0.1), ball_shape(0.1)};
    for (int i = 0; i < 3; ++i) {
        shapes[i].transform.position = fixed(0.4 * (i == 0) - 0.4 * (i == 1), 0, 0.4 * (i == 2));
    }
    lks_body_def def = lks_default_body_def();
    def.shapes = shapes;
    def.shape_count = 3;
    def.transform.position = fixed(0, 0.1, 0);
    lks_body_id id{};
    REQUIRE(lks_world_add_body(world, &def, &id) == LKS_OK);
    world.step(10);
    const std::vector<lks_contact> contacts = contacts_of(world);
    REQUIRE(contacts.size() == 1);
    CHECK(contacts[0].shape_pairs == 3);
    CHECK(lks_world_contact_count(world) == 3);
}

TEST_CASE("contacts that begin in one tick are listed in the order of their events") {
    World world(world_def(60, 8));
    add_ground(world);
    for (int i = 0; i < 4; ++i) {
        add_body(world, box_shape(0.2, 0.2, 0.2), fixed(0.4 * i, 0.2, 0));
        add_body(world, box_shape(0.1, 0.1, 0.1), fixed(0.4 * i, 0.5, 0));
    }
    record(world, LKS_EVENT_BIT(LKS_EVENT_CONTACT_BEGIN));
    world.step();
    const std::vector<lks_event> begins = events_of(world);
    const std::vector<lks_contact> contacts = contacts_of(world);
    REQUIRE(begins.size() >= 8);
    REQUIRE(contacts.size() == begins.size());
    for (std::size_t i = 0; i < begins.size(); ++i) {
        CHECK(ids_of(contacts[i]) == ids_of(begins[i]));
    }
}

TEST_CASE("who joins late has from the list what the others have kept, and goes on with it") {
    for (const int joined : {60, 101, 161, 181, 201, 320}) {
        CAPTURE(joined);
        Heap host;
        record(host.world);
        Touching kept;
        for (int tick = 0; tick < joined; ++tick) {
            host.act(kept);
            host.world.step();
            kept.follow(host.world);
        }
        host.act(kept); // the image may be of what no tick has seen yet
        const Image image = host.world.save();
        World late(world_def(60, 6));
        record(late);
        REQUIRE(lks_world_load(late, image.data(), image.size()) == LKS_OK);
        CHECK(lks_world_event_count(late) == 0);
        Touching of_late;
        of_late.take(late);
        CHECK(of_late == kept);
        for (int tick = 0; tick < 30; ++tick) {
            host.world.step();
            kept.follow(host.world);
            late.step();
            of_late.follow(late);
            CHECK(of_late == kept);
        }
        check_list(late, of_late);
    }
}
