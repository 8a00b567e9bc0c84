// The SDK as one of the solvers that a scene can be given to, seen as a game sees it.
#pragma once

#include <lockstitch/lockstitch.h>

#include <memory>

#include "reference/particle_scene.h"

namespace reference {

class SceneAsset {
public:
    explicit SceneAsset(const ParticleScene& scene); // throws std::runtime_error where it is refused
    SceneAsset(const SceneAsset&) = delete;
    SceneAsset& operator=(const SceneAsset&) = delete;
    ~SceneAsset() { lks_asset_release(asset_); }

    const lks_asset* get() const { return asset_; }

private:
    lks_asset* asset_ = nullptr;
};

std::unique_ptr<Simulation> make_fixed_point(const ParticleScene& scene, const Schedule& schedule);

} // namespace reference
