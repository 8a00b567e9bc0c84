#include "paper.h"

#include <algorithm>
#include <limits>

#include "call_time.h"

namespace lks_accuracy {

using reference::Engine;

std::vector<SagRun> run_cloth(const ClothHang& cloth, const std::vector<Engine>& engines,
                              const std::vector<int>& iterations) {
    const lks_distance_material material{cloth.compliance, 0, 1, 0};
    reference::ParticleScene scene =
        reference::make_cloth(cloth.side, 2, 1, {material, material, material}, false);
    scene.pins = {0, cloth.side - 1};
    scene.linear_damping = 4; // to settle it
    const std::size_t middle = std::size_t{cloth.side} * (cloth.side - 1) + cloth.side / 2;
    std::vector<SagRun> runs;
    for (const Engine engine : engines) {
        for (const int count : iterations) {
            const auto simulation = simulate(engine, scene, {1, count}, cloth.pbd_stiffness);
            double least = std::numeric_limits<double>::infinity();
            for (int frame = 0; frame < static_cast<int>(cloth.seconds * scene.tick_rate_hz); ++frame) {
                least = std::min(least, nanoseconds_of([&] { simulation->tick(); }));
            }
            runs.push_back({name_of(engine), count, scene.start[middle].y - simulation->positions()[middle].y,
                            least / 1e6});
        }
    }
    return runs;
}

} // namespace lks_accuracy
