// Records a scene's golden state while it runs.
#pragma once

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
    void record_points();

    const GoldenState& state() const { return state_; }

private:
    void record_parameters();

    lks_demo::Scene& scene_;
    GoldenState state_;
};

} // namespace lks_golden
