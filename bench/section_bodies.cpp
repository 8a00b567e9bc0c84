#include <lockstitch/lockstitch.h>

#include <cmath>
#include <memory>

#include "demand.h"
#include "measure.h"
#include "sections.h"

namespace lks_bench {
namespace {

constexpr std::uint32_t counts[] = {1250, 2500, 5000, 10000, 20000};

// Balls of 0.4 m side by side in a square on the ground, at one substep, of which none may sleep.
class Balls {
public:
    explicit Balls(std::uint32_t count) {
        lks_world_def def = lks_default_world_def();
        def.substeps = 1;
        lks_error error{};
        def.error = &error;
        demand(lks_world_create(&def, &world_), "a world", error.message);
        lks_collider_def ground = lks_default_collider_def();
        ground.shape = LKS_SHAPE_PLANE;
        lks_collider_id plane{};
        demand(lks_world_add_collider(world_, &ground, &plane), "the ground",
               lks_world_last_error(world_)->message);
        lks_body_shape shape = lks_default_body_shape();
        shape.radius = LKS_FIXED_RATIO(1, 5);
        lks_body_def ball = lks_default_body_def();
        ball.never_sleeps = 1;
        ball.shapes = &shape;
        ball.shape_count = 1;
        const auto edge = static_cast<std::uint32_t>(std::ceil(std::sqrt(count)));
        for (std::uint32_t i = 0; i < count; ++i) {
            ball.transform.position = {LKS_FIXED_RATIO(2 * (i % edge), 5), shape.radius,
                                       LKS_FIXED_RATIO(2 * (i / edge), 5)};
            lks_body_id id{};
            demand(lks_world_add_body(world_, &ball, &id), "a ball", lks_world_last_error(world_)->message);
        }
        for (int tick = 0; tick < 3; ++tick) {
            run();
        }
    }
    ~Balls() { lks_world_destroy(world_); }
    Balls(const Balls&) = delete;
    Balls& operator=(const Balls&) = delete;

    void run() const { lks_world_step(world_); }

private:
    lks_world* world_ = nullptr;
};

} // namespace

void measure_bodies(int rounds, Results& results) {
    std::vector<std::unique_ptr<Balls>> worlds;
    std::vector<Contender> contenders;
    for (const std::uint32_t count : counts) {
        const Balls* balls = worlds.emplace_back(std::make_unique<Balls>(count)).get();
        // As much work in each.
        const std::uint32_t ticks = counts[4] / count;
        contenders.push_back({std::to_string(count) + " balls",
                              [balls, ticks] {
                                  for (std::uint32_t tick = 0; tick < ticks; ++tick) {
                                      balls->run();
                                  }
                              },
                              static_cast<double>(ticks) * count});
    }
    for (const Measurement& m : measure_in_turns(contenders, rounds)) {
        results.push_back({bodies_name, "tick", m.name, m.nanoseconds, "ns a body", m.ratio, m.least});
    }
}

} // namespace lks_bench
