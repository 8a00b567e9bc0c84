// A demo scene: a world with its assets, objects and colliders, the inputs of each tick, and how it is drawn.
//
//     std::string error;
//     std::unique_ptr<lks_demo::Scene> scene = lks_demo::create_scene("flag", {}, error);
//     while (scene && scene->tick() < 300 && scene->step(error)) { ... }
//
// A scene is written once and is used by the demos, the golden states, the tests and the benchmarks. Its
// inputs depend on the tick and on the world's state only, so it may be stepped, advanced, saved and loaded
// at will.
#pragma once

#include <lockstitch/lockstitch.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "scenes/look.h"

namespace lks_demo {

struct SceneInfo {
    const char* name;
    const char* title; // one line
    std::uint32_t default_ticks;
    std::uint32_t golden_ticks;
    std::vector<std::uint32_t> image_ticks; // of the golden images; none after golden_ticks
};

// Zero: the scene's own.
struct SceneOptions {
    lks_vec3 offset{}; // moves everything: objects, colliders, targets of pins
    std::uint32_t tick_rate_hz = 0;
    std::uint32_t substeps = 0;
    std::uint32_t iterations = 0;
    std::uint32_t max_ticks_per_advance = 0;
    lks_simd simd = LKS_SIMD_AUTO;
    std::uint32_t worker_count = 1;
    lks_task_system tasks{};   // null functions: threads of the world's own
    lks_allocator allocator{}; // of the world and its assets
    lks_log log{};
};

class Scene {
public:
    explicit Scene(const SceneInfo& info) : info_(info) {}
    virtual ~Scene();
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    // Builds the world and what is in it. False, with a sentence: something was refused.
    bool create(const SceneOptions& options, std::string& error);

    // One tick, or those that are due after `elapsed_ns` more nanoseconds. False, with a sentence, if the
    // world or one of the scene's inputs was refused.
    bool step(std::string& error);
    bool advance(std::int64_t elapsed_ns, std::string& error);

    const SceneInfo& info() const { return info_; }
    lks_world* world() const { return world_; }
    std::uint64_t tick() const { return lks_world_tick(world_); }
    lks_vec3 offset() const { return options_.offset; }
    const std::vector<lks_asset*>& assets() const { return assets_; }
    const std::vector<ObjectLook>& objects() const { return objects_; }
    const std::vector<ColliderLook>& colliders() const { return colliders_; }
    const std::vector<BodyLook>& bodies() const { return bodies_; }
    const CameraLook& camera() const { return camera_; }
    const std::vector<MarkLook>& marks() const { return marks_; }
    Rgb mark_colour() const { return mark_colour_; }

    // Called before each tick's inputs, also between two ticks of one advance: there the world is as the tick
    // before has left it.
    std::function<void(const lks_world*)> before_inputs;

protected:
    // The scene's own settings, before the options.
    virtual void configure(lks_world_def&) {}
    virtual bool build() = 0;
    // The inputs of the tick that begins at `seconds`. False ends the run.
    virtual bool apply_inputs(lks_fixed seconds);

    // Parts of a scene; places are without the offset. False: refused, and error_ says why.
    bool add_ground(Rgb colour);
    bool add_block(const lks_vec3& position, const lks_vec3& half_extents, Rgb colour); // a box collider
    bool add_collider(lks_collider_def def, const ColliderLook& look, lks_collider_id* id = nullptr);
    bool add_body(const std::string& name, lks_body_def def, Rgb colour, lks_body_id* id = nullptr);
    // Places are those of `def`; a look for each bone. `ids` has room for them, or is null.
    bool add_ragdoll(const std::string& name, lks_ragdoll_def def, const BoneLook* looks,
                     lks_body_id* ids = nullptr, lks_joint_id* joints = nullptr);
    bool create_cloth(lks_cloth_def def, const lks_asset*& asset);
    bool create_rope(lks_rope_def def, const lks_asset*& asset);
    bool add_object(const std::string& name, const lks_asset* asset, lks_object_def def);
    // After add_object, of the object that was added last: how it is drawn.
    void look_as_grid(const lks_cloth_def& def, const ClothLook& look);
    void look_as_mesh(const std::vector<double>& vertices, const ClothLook& look);
    void look_as_rope(double length, double radius, const RopeLook& look);
    bool pin(lks_object_id object, std::uint32_t vertex);
    // Where contacts hit, from now on; the last so many stay. For the picture only: who loads an image loses
    // them.
    void leave_marks(std::size_t most, Rgb colour);
    // Inputs, and all else: notes the failure.
    bool accept(lks_result result);

    lks_vec3 place(lks_vec3 position) const;
    lks_object_id last_object() const { return objects_.back().id; }

    CameraLook camera_;

private:
    static void on_tick(void* user, lks_world* world, std::uint64_t tick);
    ObjectLook& look_of(ObjectKind kind);
    void see_events();
    void look_as_body(const std::string& name, lks_body_id id, const lks_body_def& def, double scale,
                      Rgb colour);
    void look_as_joint(const lks_bone& bone, double scale, float radius);

    const SceneInfo& info_;
    SceneOptions options_;
    lks_world* world_ = nullptr;
    std::vector<lks_asset*> assets_;
    std::vector<ObjectLook> objects_;
    std::vector<ColliderLook> colliders_;
    std::vector<BodyLook> bodies_;
    std::vector<MarkLook> marks_;
    std::size_t most_marks_ = 0;
    Rgb mark_colour_;
    lks_error refusal_{}; // of a call that has no world to tell it
    std::string error_;
};

// In the order in which they are listed and rendered.
const std::vector<std::string>& scene_names();
// Null for an unknown name.
const SceneInfo* find_scene_info(const std::string& name);
// Null, with a sentence: the name is unknown, or something in it was refused.
std::unique_ptr<Scene> create_scene(const std::string& name, const SceneOptions& options, std::string& error);

} // namespace lks_demo
