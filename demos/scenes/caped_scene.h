// A scene whose mannequin wears a cape.
#pragma once

#include "scenes/scene.h"

namespace lks_demo {

class CapedScene : public Scene {
public:
    using Scene::Scene;

protected:
    // Hangs from the shoulders down the back of a mannequin that stands at `feet`, at its rest pose; its
    // upper edge is held along a line behind them. False: refused.
    bool add_cape(lks_body_id chest, const lks_vec3& feet, Rgb front, Rgb back);
};

} // namespace lks_demo
