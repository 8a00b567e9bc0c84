#include <array>
#include <memory>
#include <random>

#include "ground_world.h"
#include "measure.h"
#include "sections.h"
#include "workloads.h"

namespace lks_bench {
namespace {

// In metres, at random, always the same.
class Places {
public:
    lks_vec3 next() { return {length(), length() + LKS_FIXED(5), length()}; }

private:
    // From -5 to 5 m.
    lks_fixed length() {
        return static_cast<lks_fixed>(random_() % (std::uint64_t{10} << LKS_FIXED_FRACTION_BITS)) -
               LKS_FIXED(5);
    }

    std::mt19937_64 random_{1};
};

struct Scene {
    const char* name;
    lks_world* world;
};

Contender contender(const Scene& scene, const char* kind, lks_fixed radius) {
    constexpr int count = 100;
    const bool cast = kind[0] == 'r';
    const bool closest = kind[0] == 'n';
    return {std::string(scene.name) + ", " + kind,
            [world = scene.world, radius, cast, closest] {
                Places places;
                lks_query query = lks_default_query();
                query.radius = radius;
                std::array<lks_hit, 8> hits{};
                std::uint32_t found = 0;
                for (int i = 0; i < count; ++i) {
                    const lks_vec3 from = places.next();
                    const lks_vec3 to = places.next();
                    if (cast) {
                        lks_world_cast(world, &query, from, to, hits.data(), 1, &found);
                    } else if (closest) {
                        lks_world_closest(world, &query, from, hits.data(), &found);
                    } else {
                        lks_world_overlap(world, &query, from, hits.data(), 8, &found);
                    }
                }
            },
            count};
}

} // namespace

void measure_queries(int rounds, Results& results) {
    GroundWorld ground(8);
    GroundWorld figures(8);
    figures.add_humanoids(100, true);
    GroundWorld balls(8);
    lks_body_shape shape = lks_default_body_shape();
    shape.radius = LKS_FIXED_RATIO(1, 10);
    lks_body_def ball = lks_default_body_def();
    ball.shapes = &shape;
    ball.shape_count = 1;
    for (int i = 0; i < 10000; ++i) {
        ball.transform.position = {LKS_FIXED_RATIO(3 * (i % 100), 10), shape.radius,
                                   LKS_FIXED_RATIO(3 * (i / 100), 10)};
        balls.add(ball);
    }
    GroundWorld walls(8);
    lks_collider_def box = lks_default_collider_def();
    box.shape = LKS_SHAPE_BOX;
    box.half_extents = {LKS_FIXED_RATIO(1, 10), LKS_FIXED_RATIO(1, 10), LKS_FIXED_RATIO(1, 10)};
    for (int i = 0; i < 4000; ++i) {
        box.transform.position = {LKS_FIXED_RATIO(3 * (i % 64), 10) - LKS_FIXED(10), 0,
                                  LKS_FIXED_RATIO(3 * (i / 64), 10) - LKS_FIXED(10)};
        walls.add(box);
    }
    const BenchWorld cloth(*find_workload("cloth_256"), LKS_SIMD_AUTO);
    const Scene scenes[] = {{"a plane", ground.get()},
                            {"100 humanoids", figures.get()},
                            {"10,000 balls", balls.get()},
                            {"4,000 boxes that stay", walls.get()},
                            {"a cloth of 256²", cloth.world()}};
    std::vector<Contender> contenders;
    for (const Scene& scene : scenes) {
        contenders.push_back(contender(scene, "ray", 0));
        contenders.push_back(contender(scene, "overlap of 50 cm", LKS_FIXED_RATIO(1, 2)));
        contenders.push_back(contender(scene, "nearest within 1 m", LKS_FIXED_ONE));
    }
    for (const Measurement& m : measure_in_turns(contenders, rounds)) {
        const std::size_t comma = m.name.rfind(", ");
        results.push_back({queries_name, m.name.substr(comma + 2), m.name.substr(0, comma), m.nanoseconds,
                           "ns", 0, m.least});
    }
}

} // namespace lks_bench
