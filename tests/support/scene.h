// One small scene with everything in it that can influence a tick: two cloths, a rope with recorded forces,
// fixed and moving pins, static and kinematic colliders of every shape, impulses. The inputs of a tick depend
// on the tick's number alone, so that any stretch of it can be simulated again.
#pragma once

#include <cstdint>

#include "support/allocator.h"
#include "support/builders.h"

namespace support {

struct SceneAssets {
    explicit SceneAssets(const lks_allocator& allocator = {});

    Asset net;
    Asset mesh;
    Asset rope;
};

class Scene {
public:
    enum class Order { usual, reversed };

    explicit Scene(const SceneAssets& assets, const lks_vec3& offset = {},
                   const lks_world_def& def = lks_default_world_def(), Order order = Order::usual);

    // What the game does before a tick.
    void give_inputs(std::uint64_t tick);
    void tick(std::uint64_t count = 1);

    World world;
    lks_object_id net{}, mesh{}, rope{};
    lks_collider_id ground{}, ball{}, bar{}, crate{};

private:
    lks_vec3 place(double x, double y, double z) const { return offset_ + fixed(x, y, z); }
    void add_net(const SceneAssets& assets);
    void add_mesh(const SceneAssets& assets);
    void add_rope(const SceneAssets& assets);

    lks_vec3 offset_;
};

} // namespace support
