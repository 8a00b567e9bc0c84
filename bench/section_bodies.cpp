#include <cmath>
#include <memory>

#include "ground_world.h"
#include "measure.h"
#include "sections.h"

namespace lks_bench {
namespace {

constexpr std::uint32_t counts[] = {1250, 2500, 5000, 10000, 20000};

// Balls of 0.4 m side by side in a square on the ground, at one substep, of which none may sleep.
class Balls {
public:
    explicit Balls(std::uint32_t count) {
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
            world_.add(ball);
        }
        for (int tick = 0; tick < 3; ++tick) {
            run();
        }
    }

    void run() const { world_.tick(); }

private:
    GroundWorld world_{1};
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
