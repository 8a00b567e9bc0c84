// A mannequin is pushed off the top of a flight of stairs and tumbles down.
#include "scenes/mannequin.h"
#include "scenes/scene_list.h"
#include "scenes/time_curves.h"

namespace lks_demo {
namespace {

constexpr int step_count = 10;
constexpr std::int64_t rise = 170;
constexpr std::int64_t depth = 300;

class RagdollStairs final : public Scene {
public:
    using Scene::Scene;

private:
    void configure(lks_world_def& def) override { def.substeps = 8; }

    bool build() override {
        camera_ = {{4.2f, 2.6f, 5.3f}, {1.55f, 1.35f, 0.0f}, 40.0f, {0.35f, 0.8f, 0.55f}};
        return add_ground(rgb(0xa19e99)) && add_stairs() && add_mannequin();
    }

    bool add_step(std::int64_t x, std::int64_t half_x, std::int64_t top) {
        return add_block(millimetres(x, top / 2, 0), millimetres(half_x, top / 2, 1200), rgb(0x8d8478));
    }

    bool add_stairs() {
        bool good = add_step(-900, 900, rise * step_count);
        for (int i = 1; i < step_count; ++i) {
            good = good && add_step(depth / 2 + depth * (i - 1), depth / 2, rise * (step_count - i));
        }
        return good;
    }

    bool add_mannequin() {
        const Mannequin mannequin;
        const MannequinLook look = mannequin_look(rgb(0x2f7b7d), rgb(0x3c4a63));
        lks_ragdoll_def def = lks_default_ragdoll_def();
        def.bones = mannequin.bones;
        def.bone_count = LKS_HUMANOID_BONES;
        def.transform.position = millimetres(-250, rise * step_count + 2, 0);
        def.transform.rotation = turn_about({0, LKS_FIXED_ONE, 0}, LKS_FIXED_RATIO(3, 10));
        def.velocity = millimetres(1800, 0, 100);
        lks_body_id ids[LKS_HUMANOID_BONES];
        if (!add_ragdoll("mannequin", def, look.bones, ids)) {
            return false;
        }
        // A push between the shoulders.
        lks_vec3 chest = place(millimetres(-350, rise * step_count + 1400, 0));
        return accept(
            lks_body_apply_impulse(world(), ids[LKS_HUMANOID_CHEST], millimetres(140000, 0, -20000), chest));
    }
};

} // namespace

std::unique_ptr<Scene> make_ragdoll_stairs(const SceneInfo& info) {
    return std::make_unique<RagdollStairs>(info);
}

} // namespace lks_demo
