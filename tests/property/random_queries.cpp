// Rays, balls, overlaps and nearest points at random against double precision, on every shape, turned any
// way.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "support/bodies.h"
#include "support/builders.h"
#include "support/overlaps.h"

using namespace support;

namespace {

// One thing that a query may find: where it is, in double precision, and what the SDK calls it.
struct Thing {
    std::uint32_t kind, index, part;
    bool plane;
    Solid solid; // of a plane its centre is a point of it and its second axis its normal

    double distance(const Vector& point) const {
        return plane ? (point - solid.centre).dot(solid.axes[1]) : distance_from(solid, point);
    }
};

Solid solid_at(const lks_body_shape& shape, const lks_transform& transform) {
    return solid_of(shape, {metres(transform.position), {}, {}, transform.rotation});
}

class Field {
public:
    explicit Field(std::uint32_t seed) : random_(seed), world_(weightless(8)) {
        for (const std::uint32_t shape : collider_shapes) {
            for (int i = 0; i < 4; ++i) {
                add_collider(shape);
            }
        }
        for (int i = 0; i < 12; ++i) {
            add_random_body();
        }
        add_cloth();
    }

    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    lks_vec3 point(double reach) {
        return fixed(between(-reach, reach), between(-reach, reach), between(-reach, reach));
    }

    const World& world() const { return world_; }
    const std::vector<Thing>& things() const { return things_; }

private:
    lks_rotation any_rotation() {
        return about(between(-1, 1), between(-1, 1), between(0.1, 1), between(-180, 180));
    }

    lks_body_shape any_shape(std::uint32_t kind) {
        lks_body_shape shape = capsule_shape(between(0.05, 0.8), between(0, 1));
        shape.shape = kind;
        shape.half_extents = fixed(between(0.05, 1), between(0.05, 1), between(0.05, 1));
        return shape;
    }

    void add_collider(std::uint32_t kind) {
        const lks_body_shape shape = any_shape(kind);
        lks_collider_def def = lks_default_collider_def();
        def.shape = kind;
        def.radius = shape.radius;
        def.half_length = shape.half_length;
        def.half_extents = shape.half_extents;
        def.transform.position = kind == LKS_SHAPE_PLANE ? point(1) : point(3);
        def.transform.rotation = any_rotation();
        if (kind == LKS_SHAPE_PLANE) { // far below, so that not all is behind it
            const Vector normal = rotate(def.transform.rotation, {0, 1, 0});
            def.transform.position = def.transform.position - fixed(3 * normal.x, 3 * normal.y, 3 * normal.z);
        }
        const lks_collider_id id = world_.add(def);
        things_.push_back(
            {LKS_HIT_COLLIDER, id.index, 0, kind == LKS_SHAPE_PLANE, solid_at(shape, def.transform)});
    }

    // Of one shape: bodies of several are placed about their centre of mass.
    void add_random_body() {
        lks_body_def def = lks_default_body_def();
        def.transform.rotation = any_rotation();
        def.transform.position = point(3);
        const lks_body_shape shape = any_shape(LKS_SHAPE_SPHERE + things_.size() % 3);
        const lks_body_id id = add_body(world_, shape, def.transform.position, def);
        things_.push_back({LKS_HIT_BODY, id.index, 0, false, solid_at(shape, def.transform)});
    }

    void add_cloth() {
        Net net;
        net.side = 6;
        net.radius = 0.06;
        const lks_object_id id = world_.add(net.build(), at(-1, 0.3, -1));
        const std::vector<lks_vec3> places = world_.positions(id);
        for (std::uint32_t i = 0; i < places.size(); ++i) {
            lks_transform transform = at(places[i]);
            things_.push_back({LKS_HIT_PARTICLE, id.index, i, false, solid_at(ball_shape(0.06), transform)});
        }
    }

    std::mt19937 random_;
    World world_;
    std::vector<Thing> things_;
};

std::uint32_t index_of(const lks_hit& hit) {
    return hit.kind == LKS_HIT_COLLIDER ? hit.collider.index
           : hit.kind == LKS_HIT_BODY   ? hit.body.index
                                        : hit.object.index;
}

const lks_hit* find(const std::vector<lks_hit>& hits, const Thing& thing) {
    for (const lks_hit& hit : hits) {
        if (hit.kind == thing.kind && index_of(hit) == thing.index && hit.part == thing.part) {
            return &hit;
        }
    }
    return nullptr;
}

// A way in double precision: where along it, from 0 to 1, a ball meets something, and how near it comes.
struct Way {
    Vector from, whole;

    Vector at(double share) const { return from + whole * share; }
    double closest(const Thing& thing) const {
        double low = 0, high = 1;
        for (int i = 0; i < 100; ++i) { // the distance to what is convex is convex along it
            const double first = low + (high - low) / 3;
            const double second = high - (high - low) / 3;
            (thing.distance(at(first)) < thing.distance(at(second)) ? high : low) =
                thing.distance(at(first)) < thing.distance(at(second)) ? second : first;
        }
        return (low + high) / 2;
    }
    double entry(const Thing& thing, double radius, double inside) const {
        double low = 0, high = inside;
        for (int i = 0; i < 60; ++i) {
            const double middle = (low + high) / 2;
            (thing.distance(at(middle)) > radius ? low : high) = middle;
        }
        return high;
    }
};

template <typename Ask>
std::vector<lks_hit> all_hits(const Ask& ask) {
    std::vector<lks_hit> hits(128);
    std::uint32_t count = 0;
    REQUIRE(ask(hits.data(), 128u, &count) == LKS_OK);
    REQUIRE(count <= 128);
    hits.resize(count);
    return hits;
}

} // namespace

TEST_CASE("rays and balls at random hit what double precision says, where it says") {
    int hit_count[3] = {}, from_within = 0;
    double worst = 0; // times the cosine to the surface: a micrometre of height is more along what grazes
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        Field field(seed);
        for (int i = 0; i < 60; ++i) {
            lks_query query = lks_default_query();
            query.radius = i % 2 == 0 ? 0 : fixed(field.between(0, 0.5));
            const lks_vec3 from = field.point(5), to = field.point(5);
            const std::vector<lks_hit> hits =
                all_hits([&](lks_hit* out, std::uint32_t room, std::uint32_t* n) {
                    return lks_world_cast(field.world(), &query, from, to, out, room, n);
                });
            const Way way{metres(from), metres(to) - metres(from)};
            const double radius = metres(query.radius);
            for (const Thing& thing : field.things()) {
                const double nearest = way.closest(thing);
                const double depth = radius - thing.distance(way.at(nearest));
                const lks_hit* hit = find(hits, thing);
                if (std::abs(depth) < 1e-5) {
                    continue; // grazes it
                }
                CAPTURE(seed);
                CAPTURE(i);
                CAPTURE(thing.kind);
                CAPTURE(thing.index);
                REQUIRE((hit != nullptr) == (depth > 0));
                if (hit == nullptr) {
                    continue;
                }
                ++hit_count[thing.kind];
                const double at_start = thing.distance(way.from);
                if (at_start < radius) {
                    ++from_within;
                    CHECK(hit->distance == 0);
                    continue;
                }
                const double expected = way.entry(thing, radius, nearest) * way.whole.length();
                const double cosine = std::abs(metres(hit->normal).dot(way.whole)) / way.whole.length();
                const double error = std::abs(metres(hit->distance) - expected);
                worst = std::max(worst, error * std::max(cosine, 1e-3));
                CHECK(error * std::max(cosine, 1e-3) < 3e-6);
                // Where the ball touches: on the surface, the normal from there to the ball's middle.
                const Vector middle = metres(from) + way.whole * (metres(hit->distance) / way.whole.length());
                CHECK((metres(hit->point) + metres(hit->normal) * radius - middle).length() <
                      4e-6 / std::max(cosine, 1e-3));
                CHECK(std::abs(thing.distance(metres(hit->point))) < 4e-6);
                CHECK(std::abs(metres(hit->normal).length() - 1) < 1e-6);
            }
            CHECK(std::is_sorted(hits.begin(), hits.end(),
                                 [](const lks_hit& a, const lks_hit& b) { return a.distance < b.distance; }));
            // With room for one the nearest is the same.
            lks_hit first{};
            std::uint32_t count = 0;
            REQUIRE(lks_world_cast(field.world(), &query, from, to, &first, 1, &count) == LKS_OK);
            REQUIRE(count == hits.size());
            if (count > 0) {
                CHECK(first.distance == hits[0].distance);
                CHECK(index_of(first) == index_of(hits[0]));
            }
        }
    }
    MESSAGE("worst: " << worst << " m; hits " << hit_count[0] << ", " << hit_count[1] << ", "
                      << hit_count[2]);
    CHECK(hit_count[LKS_HIT_COLLIDER] > 1000);
    CHECK(hit_count[LKS_HIT_BODY] > 300);
    CHECK(hit_count[LKS_HIT_PARTICLE] > 100);
    CHECK(from_within > 100);
}

TEST_CASE("overlaps and the nearest of them at random are those of double precision") {
    int found_count[3] = {}, nearest_count[3] = {};
    double worst = 0;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        Field field(seed);
        for (int i = 0; i < 60; ++i) {
            lks_query query = lks_default_query();
            query.radius = fixed(field.between(0, 2));
            const lks_vec3 centre = field.point(4);
            const std::vector<lks_hit> hits =
                all_hits([&](lks_hit* out, std::uint32_t room, std::uint32_t* n) {
                    return lks_world_overlap(field.world(), &query, centre, out, room, n);
                });
            double least = 1e9;
            for (const Thing& thing : field.things()) {
                const double distance = thing.distance(metres(centre));
                least = std::min(least, distance);
                const lks_hit* hit = find(hits, thing);
                if (std::abs(distance - metres(query.radius)) < 1e-6) {
                    continue;
                }
                CAPTURE(seed);
                CAPTURE(i);
                CAPTURE(thing.kind);
                CAPTURE(thing.index);
                REQUIRE((hit != nullptr) == (distance < metres(query.radius)));
                if (hit != nullptr) {
                    ++found_count[thing.kind];
                    worst = std::max(worst, std::abs(metres(hit->distance) - distance));
                    CHECK(std::abs(metres(hit->distance) - distance) < 1e-6);
                    CHECK(std::abs(thing.distance(metres(hit->point))) < 1e-6);
                    CHECK((metres(hit->point) + metres(hit->normal) * distance - metres(centre)).length() <
                          1e-6);
                }
            }
            CHECK(std::is_sorted(hits.begin(), hits.end(), [](const lks_hit& a, const lks_hit& b) {
                return a.kind != b.kind             ? a.kind < b.kind
                       : index_of(a) != index_of(b) ? index_of(a) < index_of(b)
                                                    : a.part < b.part;
            }));
            lks_hit nearest{};
            std::uint32_t found = 0;
            REQUIRE(lks_world_closest(field.world(), &query, centre, &nearest, &found) == LKS_OK);
            CHECK(found == (hits.empty() ? 0 : 1));
            if (found != 0) {
                ++nearest_count[nearest.kind];
                CHECK(std::abs(metres(nearest.distance) - least) < 1e-6);
            }
        }
    }
    MESSAGE("worst: " << worst << " m");
    CHECK(found_count[LKS_HIT_COLLIDER] > 1000);
    CHECK(found_count[LKS_HIT_BODY] > 500);
    CHECK(found_count[LKS_HIT_PARTICLE] > 500);
    CHECK(nearest_count[LKS_HIT_COLLIDER] > 100);
    CHECK(nearest_count[LKS_HIT_BODY] > 50);
    CHECK(nearest_count[LKS_HIT_PARTICLE] > 20);
}

TEST_CASE("of what is equally near colliders come before bodies before particles, each by index and part") {
    World world(weightless(8));
    const Asset points = loose_points({{0, 0, 0}, {9, 0, 0}}, {1, 1}, 0.25);
    for (int i = 0; i < 2; ++i) {
        world.add(points, at(3, 0, 0));
        lks_body_shape twice[2] = {ball_shape(0.25), ball_shape(0.25)};
        lks_body_def def = lks_default_body_def();
        def.shapes = twice;
        def.shape_count = 2;
        def.transform.position = fixed(3, 0, 0);
        lks_body_id body{};
        REQUIRE(lks_world_add_body(world, &def, &body) == LKS_OK);
        lks_collider_def collider = lks_default_collider_def();
        collider.radius = fixed(0.25);
        collider.transform = at(3, 0, 0);
        world.add(collider);
    }
    constexpr std::uint32_t all = 8;
    const std::uint32_t expected[all][3] = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 0, 1},
                                            {1, 1, 0}, {1, 1, 1}, {2, 0, 0}, {2, 1, 0}};
    const lks_query query = lks_default_query();
    lks_query wide = query;
    wide.radius = fixed(5);
    lks_hit along[all], around[all];
    for (std::uint32_t room = 1; room <= all; ++room) {
        std::uint32_t count = 0;
        REQUIRE(lks_world_cast(world, &query, {}, fixed(5, 0, 0), along, room, &count) == LKS_OK);
        REQUIRE(count == all);
        REQUIRE(lks_world_overlap(world, &wide, {}, around, room, &count) == LKS_OK);
        REQUIRE(count == all);
        for (const lks_hit* hits : {along, around}) {
            for (std::uint32_t i = 0; i < room; ++i) {
                CAPTURE(room);
                CAPTURE(i);
                CHECK(hits[i].kind == expected[i][0]);
                CHECK(index_of(hits[i]) == expected[i][1]);
                CHECK(hits[i].part == expected[i][2]);
                CHECK(std::abs(metres(hits[i].distance) - 2.75) < 2e-6);
            }
        }
    }
    lks_hit nearest{};
    std::uint32_t found = 0;
    REQUIRE(lks_world_closest(world, &wide, {}, &nearest, &found) == LKS_OK);
    REQUIRE(found == 1);
    CHECK(nearest.kind == LKS_HIT_COLLIDER);
    CHECK(nearest.collider.index == 0);
}
