// Images with wrong values behind a right checksum: what a cheat or a bug would make. Each is refused without
// a trace or gives a world that works; none crashes.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "reference_checksum.h"
#include "rigid/body.h"
#include "state/hash.h"
#include "state/image.h"
#include "support/attachments.h"
#include "support/bodies.h"
#include "support/builders.h"
#include "support/refusals.h"

using namespace support;

namespace {

struct Small {
    Asset chain = Chain().build();
    World world{world_def(60, 2)};
    lks_object_id object{};

    Small() {
        // A free slot between two used ones, forces, pins, and every shape.
        lks_object_def def = object_def(chain, at(1, 2, 3));
        def.record_forces = 1;
        object = world.add(def);
        const lks_object_id gap = world.add(chain, at(0, 0, 0));
        world.add(chain, at(0, 1, 0));
        REQUIRE(lks_world_remove_object(world, gap) == LKS_OK);
        world.pin(object, 0);
        world.pin(object, 7);
        for (std::uint32_t shape = 0; shape < 4; ++shape) {
            lks_collider_def collider = lks_default_collider_def();
            collider.shape = shape;
            collider.half_length = fixed(0.5);
            collider.half_extents = fixed(1, 1, 1);
            // The first one has the defaults.
            collider.restitution = fixed(0.25 * shape);
            collider.filter.group = static_cast<std::int32_t>(shape);
            world.add(collider);
        }
        add_bodies();
        world.step(3);
    }

    // The present state's hash is that of no other state, but for this image's.
    bool knows_apart(const Image& image) {
        lks::Hash hash;
        hash.add_bytes(image.bytes() + lks::image_checked_from, image.size() - lks::image_checked_from);
        const auto found = seen.emplace(world.hash(), hash.finish());
        return found.first->second == hash.finish();
    }

    std::map<std::uint64_t, std::uint64_t> seen; // hashes of images by hashes of states

    // A free slot between used ones, a joint of each kind, boxes that push each other, one that is kinematic,
    // one of every shape.
    void add_bodies() {
        lks_body_id bodies[6];
        for (int i = 0; i < 6; ++i) {
            lks_body_def def = lks_default_body_def();
            def.kind = i == 5 ? LKS_BODY_KINEMATIC : LKS_BODY_DYNAMIC;
            def.never_sleeps = i == 4 ? 1u : 0u;
            bodies[i] =
                add_body(world, box_shape(0.2, 0.1, 0.15), fixed(20, 0.3 * i - 0.001 * (i % 2), 0), def);
        }
        for (std::uint32_t kind = LKS_JOINT_BALL; kind <= LKS_JOINT_DISTANCE; ++kind) {
            lks_joint_def joint = lks_default_joint_def();
            joint.kind = kind;
            joint.distance_max = fixed(1);
            joint.bodies_collide = 1;
            const lks_joint_id id = add_joint(world, joint, bodies[kind], bodies[kind + 1]);
            if (kind == LKS_JOINT_HINGE) {
                const lks_motor motor{fixed(5), fixed(0.1), {0, 0, 0, LKS_ROTATION_ONE}};
                REQUIRE(lks_joint_set_motor(world, id, &motor) == LKS_OK);
            }
        }
        const lks_body_id left = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(30, 0.2, 0));
        const lks_body_id right = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(30, 0.599, 0));
        REQUIRE(lks_world_has_body(world, left) == 1);
        REQUIRE(lks_world_has_body(world, right) == 1);
        add_body_of_every_shape();
        REQUIRE(lks_world_remove_body(world, bodies[0]) == LKS_OK);
        attach(right);
    }

    void add_body_of_every_shape() {
        const lks_body_shape shapes[] = {ball_shape(0.2), capsule_shape(0.1, 0.3), box_shape(0.2, 0.1, 0.3)};
        lks_body_def def = lks_default_body_def();
        def.shapes = shapes;
        def.shape_count = 3;
        def.transform.position = fixed(40, 0.29, 0);
        lks_body_id id{};
        REQUIRE(lks_world_add_body(world, &def, &id) == LKS_OK);
    }

    // A free slot between one of each kind.
    void attach(lks_body_id body) {
        lks_attachment_def def = lks_default_attachment_def();
        lks_attachment_id ids[3];
        def.object = object;
        def.vertex = 3;
        def.body = body;
        def.point = fixed(0.1, 0.2, 0);
        def.compliance = fixed(0.01);
        def.break_force = fixed(100);
        REQUIRE(lks_world_add_attachment(world, &def, &ids[0]) == LKS_OK);
        REQUIRE(lks_world_add_attachment(world, &def, &ids[1]) == LKS_OK);
        def.kind = LKS_ATTACHMENT_TO_VERTEX;
        def.other_object = object;
        def.other_vertex = 9;
        def.break_force = 0;
        REQUIRE(lks_world_add_attachment(world, &def, &ids[2]) == LKS_OK);
        REQUIRE(lks_world_remove_attachment(world, ids[1]) == LKS_OK);
    }
};

void put_u64(Image& image, std::size_t place, std::uint64_t value) {
    for (int i = 0; i < 8; ++i) {
        image.bytes()[place + static_cast<std::size_t>(i)] = static_cast<unsigned char>(value >> (8 * i));
    }
}

std::uint64_t get_u64(const Image& image, std::size_t place) {
    std::uint64_t value = 0;
    for (std::size_t i = 8; i-- > 0;) {
        value = value << 8 | image.bytes()[place + i];
    }
    return value;
}

// The first 64-bit word of that value behind the checksum.
std::size_t find_u64(const Image& image, std::uint64_t value) {
    std::size_t place = lks::image_checked_from;
    while (get_u64(image, place) != value) {
        place += 8;
        REQUIRE(place + 8 <= image.size());
    }
    return place;
}

void put_right_checksum(Image& image) {
    put_u64(image, 24,
            lks::test::reference_checksum(image.bytes() + lks::image_checked_from,
                                          image.size() - lks::image_checked_from));
}

// Every body is turned by a rotation.
bool is_turned_well(const World& world) {
    for (std::uint32_t i = 0; i < 12; ++i) {
        const lks_body_id body{i, 1};
        lks_transform transform{};
        if (lks_world_has_body(world, body) == 0) {
            continue;
        }
        REQUIRE(lks_body_transform(world, body, &transform) == LKS_OK);
        const lks_rotation& q = transform.rotation;
        const double squared =
            (double(q.x) * q.x + double(q.y) * q.y + double(q.z) * q.z + double(q.w) * q.w) * 0x1p-60;
        if (std::abs(squared - 1) > 1e-5) {
            return false;
        }
    }
    return true;
}

// Loads it; where it is refused nothing may have changed, and where it is not the world must be another one,
// and go on.
bool survives(Small& small, const Image& image, std::uint64_t& accepted) {
    const std::uint64_t before = small.world.hash();
    const lks_result result = lks_world_load(small.world, image.data(), image.size());
    if (result == LKS_OK) {
        ++accepted;
        const Image now = small.world.save();
        const bool good = now == image && is_turned_well(small.world) && small.knows_apart(now);
        small.world.step(2);
        (void)small.world.hash();
        return good;
    }
    return (result == LKS_ERROR_CORRUPT_IMAGE || result == LKS_ERROR_FOREIGN_IMAGE) &&
           small.world.hash() == before && lks_world_last_error(small.world)->message[0] != '\0';
}

} // namespace

TEST_CASE("the checksum of an image is the one that tests compute") {
    Small small;
    const Image image = small.world.save();
    Image copy = image;
    put_right_checksum(copy);
    CHECK(copy == image);
}

TEST_CASE("any 64-bit word of an image may be anything behind a right checksum") {
    Small small;
    const Image good = small.world.save();
    Random random(4);
    std::uint64_t accepted = 0;
    std::uint64_t tried = 0;
    bool all_survived = true;
    for (std::size_t place = lks::image_checked_from; place + 8 <= good.size(); place += 8) {
        for (const std::uint64_t value :
             {std::uint64_t{0}, ~std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 63,
              ~std::uint64_t{0} >> 1, std::uint64_t{0xffffffff}, std::uint64_t{1} << 32, random.next()}) {
            Image bad = good;
            put_u64(bad, place, value);
            put_right_checksum(bad);
            const bool survived = survives(small, bad, accepted);
            if (!survived) {
                MESSAGE("word at byte " << place << " set to " << value);
            }
            all_survived = all_survived && survived;
            ++tried;
        }
    }
    CHECK(all_survived);
    MESSAGE(accepted << " of " << tried << " changed images hold a possible state");
    CHECK(accepted < tried);
    CHECK(accepted > 0);
    CHECK(lks_world_load(small.world, good.data(), good.size()) == LKS_OK);
    CHECK(small.world.save() == good);
}

TEST_CASE("an image whose collider gives back less than nothing or more than all is refused and names it") {
    World world(world_def(60, 2));
    lks_collider_def def = lks_default_collider_def();
    world.add(def);
    def.restitution = fixed(0.5);
    world.add(def);
    const Image good = world.save();
    // Of the second one, behind its slot, its kind, filter, shape and friction.
    const std::size_t place =
        lks::image_header_size + 2 * lks::image_slot_size + lks::image_collider_size + 16 + 5 * 8 + 2 * 8;
    for (const lks_fixed restitution : {lks_fixed{-1}, LKS_FIXED_ONE + 1, INT64_MIN, INT64_MAX}) {
        Image bad = good;
        put_u64(bad, place, static_cast<std::uint64_t>(restitution));
        put_right_checksum(bad);
        check_call_refused(world, LKS_ERROR_CORRUPT_IMAGE, "collider 1",
                           [&] { return lks_world_load(world, bad.data(), bad.size()); });
    }
    const std::uint64_t hash = world.hash();
    for (const lks_fixed restitution : {lks_fixed{0}, LKS_FIXED_ONE}) {
        Image other = good;
        put_u64(other, place, static_cast<std::uint64_t>(restitution));
        put_right_checksum(other);
        CHECK(lks_world_load(world, other.data(), other.size()) == LKS_OK);
        CHECK(world.hash() != hash);
    }
}

TEST_CASE("an image whose kinematic body is farther from its target than a tick may move it is refused") {
    World world(world_def(60, 2));
    lks_body_def def = lks_default_body_def();
    def.kind = LKS_BODY_KINEMATIC;
    const lks_vec3 place = fixed(8000000, 3, 4);
    add_body(world, ball_shape(0.5), place, def);
    add_body(world, ball_shape(0.5), fixed(8000000, 6, 4));
    const Image good = world.save();
    // The first of these is its position, its target comes later.
    const std::size_t word = find_u64(good, static_cast<std::uint64_t>(place.x));
    for (const lks_fixed x : {-place.x, place.x - fixed(101), LKS_FIXED(0)}) {
        Image bad = good;
        put_u64(bad, word, static_cast<std::uint64_t>(x));
        put_right_checksum(bad);
        check_call_refused(world, LKS_ERROR_CORRUPT_IMAGE, "body 0",
                           [&] { return lks_world_load(world, bad.data(), bad.size()); });
    }
    Image near = good;
    put_u64(near, word, static_cast<std::uint64_t>(place.x - fixed(99)));
    put_right_checksum(near);
    REQUIRE(lks_world_load(world, near.data(), near.size()) == LKS_OK);
    world.step(2);
}

TEST_CASE("an image whose attachments hold a vertex at two points of one body is refused and names one") {
    World world(world_def(60, 2));
    const Asset chain = Chain().build();
    const lks_object_id object = world.add(chain, at(0, 0, 0));
    const lks_body_id body = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(1, 0, 0));
    const lks_vec3 point = fixed(0.1, 0.15, 0.05);
    attach(world, to_body(object, 7, body, point));
    attach(world, to_body(object, 3, body, point));
    attach(world, to_body(object, 5, body, fixed(0.1, 0, 0)));
    attach(world, to_body(object, 3, body, point));
    const Image good = world.save();
    REQUIRE(lks_world_load(world, good.data(), good.size()) == LKS_OK);
    std::vector<std::size_t> places;
    for (std::size_t i = lks::image_checked_from; i + 8 <= good.size(); i += 4) {
        if (get_u64(good, i) == static_cast<std::uint64_t>(point.y)) {
            places.push_back(i);
        }
    }
    REQUIRE(places.size() == 3);
    Image bad = good;
    put_u64(bad, places[1], static_cast<std::uint64_t>(point.y + 1));
    put_right_checksum(bad);
    check_call_refused(world, LKS_ERROR_CORRUPT_IMAGE, "attachment 3",
                       [&] { return lks_world_load(world, bad.data(), bad.size()); });
    REQUIRE(lks_world_load(world, good.data(), good.size()) == LKS_OK);
    world.step(2);
}

TEST_CASE("an image whose contact names a collider that the image has not got is refused and names it") {
    World world(world_def(60, 8));
    add_ground(world);
    add_body(world, ball_shape(0.5), fixed(0, 0.5, 0));
    world.step(5);
    REQUIRE(lks_world_contact_count(world) == 1);
    const Image good = world.save();
    // Body 0 and collider 0, side by side.
    const std::uint64_t pair = std::uint64_t{0x80000000} << 32;
    std::size_t at = lks::image_checked_from;
    int found = 0;
    for (std::size_t i = at; i + 8 <= good.size(); i += 4) {
        if (get_u64(good, i) == pair) {
            at = i;
            ++found;
        }
    }
    REQUIRE(found == 1);
    for (const std::uint32_t collider : {1u, 4000u, LKS_MAX_COLLIDERS - 1}) {
        Image bad = good;
        put_u64(bad, at, pair | std::uint64_t{collider} << 32);
        put_right_checksum(bad);
        check_call_refused(world, LKS_ERROR_CORRUPT_IMAGE, "contact 0",
                           [&] { return lks_world_load(world, bad.data(), bad.size()); });
    }
}

TEST_CASE("an image whose sleeper moves, or whose sleep is none, is refused") {
    World world(world_def(60, 2));
    add_ground(world);
    const lks_body_id box = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(0, 0.2, 0));
    world.step(120);
    REQUIRE(lks_body_is_awake(world, box) == 0);
    const Image good = world.save();
    // Behind its orientations a body's velocity: six words of nought in the image of one that sleeps.
    const lks_fixed y = [&] {
        lks_transform transform{};
        REQUIRE(lks_body_transform(world, box, &transform) == LKS_OK);
        return transform.position.y;
    }();
    const std::size_t word = find_u64(good, static_cast<std::uint64_t>(y));
    const std::size_t velocity = word - 8 + offsetof(lks::BodyState, velocity);
    for (std::size_t part = 0; part < 6; ++part) {
        REQUIRE(get_u64(good, velocity + 8 * part) == 0);
        for (const std::uint64_t speed : {std::uint64_t{1}, std::uint64_t{0} - 1, std::uint64_t{1} << 41}) {
            Image bad = good;
            put_u64(bad, velocity + 8 * part, speed);
            put_right_checksum(bad);
            check_call_refused(world, LKS_ERROR_CORRUPT_IMAGE, "body 0",
                               [&] { return lks_world_load(world, bad.data(), bad.size()); });
        }
    }
    // What it rests for, whether it sleeps, gathers speed, has turned, and for how long it has accelerated.
    const std::size_t sleep = word - 8 + offsetof(lks::BodyState, rest);
    const auto with = [&](std::uint64_t asleep, std::uint64_t gathers, std::uint64_t turns,
                          std::uint64_t steady) {
        Image image = good;
        const std::uint64_t rest = get_u64(good, sleep) & 0xffffffff;
        put_u64(image, sleep, rest | asleep << 32 | gathers << 40 | turns << 48 | steady << 56);
        put_right_checksum(image);
        return image;
    };
    REQUIRE(with(1, 0, 0, 0) == good);
    for (const Image& bad : {with(2, 0, 0, 0), with(1, 1, 0, 0), with(1, 0, 1, 0), with(1, 0, 0, 1),
                             with(0, 2, 0, 0), with(0, 0, 3, 0), with(0, 0, 255, 0)}) {
        check_call_refused(world, LKS_ERROR_CORRUPT_IMAGE, "body 0",
                           [&] { return lks_world_load(world, bad.data(), bad.size()); });
    }
    const Image restless = with(0, 1, 2, 255);
    CHECK(lks_world_load(world, restless.data(), restless.size()) == LKS_OK);
    CHECK(world.save() == restless);
    REQUIRE(lks_world_load(world, good.data(), good.size()) == LKS_OK);
}

TEST_CASE("images cut anywhere are refused behind a right checksum and size") {
    Small small;
    const Image good = small.world.save();
    std::uint64_t accepted = 0;
    for (std::size_t size = lks::image_header_size; size < good.size(); size += 4) {
        Image part(size);
        std::memcpy(part.data(), good.data(), size);
        put_u64(part, 16, size);
        put_right_checksum(part);
        CHECK(survives(small, part, accepted));
    }
    CHECK(accepted == 0);
}

TEST_CASE("an image that counts more than it has bytes for is refused before anything is allocated for it") {
    Small small;
    const Image good = small.world.save();
    // Objects, colliders, bodies, joints, attachments; contacts have a limit by the number of bodies.
    for (const std::size_t place : {48u, 52u, 56u, 60u, 68u}) {
        Image bad = good;
        bad.bytes()[place + 1] = 8; // 2,048 more
        put_right_checksum(bad);
        const std::uint64_t before = small.world.hash();
        CAPTURE(place);
        CHECK(lks_world_load(small.world, bad.data(), bad.size()) == LKS_ERROR_CORRUPT_IMAGE);
        CHECK(std::string(lks_world_last_error(small.world)->message).find("add up to its size") !=
              std::string::npos);
        CHECK(small.world.hash() == before);
    }
}

TEST_CASE("an image that is refused at its end has changed nothing, not even what is derived") {
    Small other;
    const lks_body_id body{2, 1};
    REQUIRE(lks_world_remove_body(other.world, body) == LKS_OK);
    lks_body_def def = lks_default_body_def();
    def.mass = fixed(50);
    add_body(other.world, ball_shape(0.3), fixed(20, 1, 0), def);
    const lks_joint_id hinge{1, 1};
    CHECK(lks_world_has_joint(other.world, hinge) == 0);
    add_joint(other.world, lks_default_joint_def(), {3, 1}, {4, 1});
    other.world.step(3);
    Image bad = other.world.save();
    const Image good = bad;
    put_u64(bad, bad.size() - 8, ~std::uint64_t{0} >> 1);
    put_right_checksum(bad);

    Small small;
    Small twin;
    REQUIRE(lks_world_load(small.world, bad.data(), bad.size()) == LKS_ERROR_CORRUPT_IMAGE);
    for (int tick = 0; tick < 60; ++tick) {
        REQUIRE(small.world.hash() == twin.world.hash());
        small.world.step();
        twin.world.step();
    }
    CHECK(lks_world_load(small.world, good.data(), good.size()) == LKS_OK);
    CHECK(small.world.save() == good);
}

TEST_CASE("images with several random changes behind a right checksum are survived") {
    Small small;
    const Image good = small.world.save();
    Random random(8);
    std::uint64_t accepted = 0;
    bool all_survived = true;
    for (int i = 0; i < 3000; ++i) {
        Image bad = good;
        const auto changes = random.between(1, 4);
        for (std::int64_t c = 0; c < changes; ++c) {
            const auto place = static_cast<std::size_t>(
                random.between(lks::image_checked_from, static_cast<std::int64_t>(good.size()) - 1));
            bad.bytes()[place] = static_cast<unsigned char>(random.next());
        }
        put_right_checksum(bad);
        all_survived = survives(small, bad, accepted) && all_survived;
    }
    CHECK(all_survived);
}
