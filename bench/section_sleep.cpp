#include <memory>

#include "ground_world.h"
#include "measure.h"
#include "sections.h"

namespace lks_bench {

void measure_sleep(int rounds, Results& results) {
    constexpr std::uint32_t substeps = 8;
    constexpr int few = 1;
    constexpr int many = 100;
    constexpr int most_ticks = 1200; // of lying down
    std::vector<std::unique_ptr<GroundWorld>> worlds;
    std::vector<Contender> contenders;
    for (const int count : {few, many}) {
        for (const bool sleeping : {true, false}) {
            GroundWorld& world = *worlds.emplace_back(std::make_unique<GroundWorld>(substeps));
            world.add_humanoids(count, !sleeping);
            for (int tick = 0; tick < most_ticks && (tick < 300 || sleeping); ++tick) {
                if (sleeping && lks_world_awake_body_count(world.get()) == 0) {
                    break;
                }
                world.tick();
            }
            const std::uint32_t awake = lks_world_awake_body_count(world.get());
            if (sleeping && awake != 0) {
                demand(LKS_ERROR_LIMIT, "humanoids that sleep", "some are awake after twenty seconds");
            }
            const int ticks = sleeping ? 1000 : 100 / count;
            contenders.push_back({std::to_string(count) + (count == 1 ? " humanoid" : " humanoids") +
                                      (sleeping ? " asleep" : " lying awake"),
                                  [&world, ticks] {
                                      for (int tick = 0; tick < ticks; ++tick) {
                                          world.tick();
                                      }
                                  },
                                  static_cast<double>(ticks)});
        }
    }
    for (const Measurement& m : measure_in_turns(contenders, rounds)) {
        results.push_back({sleep_name, "tick", m.name, m.nanoseconds, "ns", 0, m.least});
    }
}

} // namespace lks_bench
