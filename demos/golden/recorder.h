// Records a scene's golden state while it runs.
#pragma once

#include <functional>

#include "golden/golden_state.h"
#include "scenes/scene.h"

namespace lks_golden {

class Recorder {
public:
    // Takes down the scene's parameters and tick 0.
    explicit Recorder(lks_demo::Scene& scene);

    // After each tick.
    void record_tick();
    // After the last one.
    void record_end();

    const GoldenState& state() const { return state_; }

private:
    void record_parameters();
    void record_points();
    void record_bodies();

    lks_demo::Scene& scene_;
    GoldenState state_;
};

// Runs the scene through its golden ticks and records them. `after_tick` (may be empty) is called after each;
// false from it ends the run. False, with a sentence: the scene can't be run, or `after_tick` ended it.
bool record_run(lks_demo::Scene& scene,
                const std::function<bool(std::uint32_t tick, std::string&)>& after_tick, GoldenState& state,
                std::string& error);

} // namespace lks_golden
