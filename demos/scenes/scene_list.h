// One function a scene; registry.cpp names them.
#pragma once

#include <memory>

#include "scenes/scene.h"

namespace lks_demo {

std::unique_ptr<Scene> make_cloth_hang(const SceneInfo& info);
std::unique_ptr<Scene> make_cloth_drape(const SceneInfo& info);
std::unique_ptr<Scene> make_flag(const SceneInfo& info);
std::unique_ptr<Scene> make_rope_bridge(const SceneInfo& info);
std::unique_ptr<Scene> make_rope_wrap(const SceneInfo& info);
std::unique_ptr<Scene> make_curtain_rings(const SceneInfo& info);
std::unique_ptr<Scene> make_crane(const SceneInfo& info);
std::unique_ptr<Scene> make_box_stack(const SceneInfo& info);
std::unique_ptr<Scene> make_dominoes(const SceneInfo& info);
std::unique_ptr<Scene> make_newtons_cradle(const SceneInfo& info);
std::unique_ptr<Scene> make_bouncing_balls(const SceneInfo& info);
std::unique_ptr<Scene> make_cart(const SceneInfo& info);
std::unique_ptr<Scene> make_ragdoll_stairs(const SceneInfo& info);
std::unique_ptr<Scene> make_ragdoll_pile(const SceneInfo& info);
std::unique_ptr<Scene> make_ragdoll_hang(const SceneInfo& info);
std::unique_ptr<Scene> make_ragdoll_cape(const SceneInfo& info);
std::unique_ptr<Scene> make_sentry(const SceneInfo& info);
std::unique_ptr<Scene> make_spider(const SceneInfo& info);

} // namespace lks_demo
