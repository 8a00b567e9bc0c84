// Mannequins fall into a walled pit, one after the other, and pile up.
#include "scenes/mannequin.h"
#include "scenes/scene_list.h"
#include "scenes/time_curves.h"

namespace lks_demo {
namespace {

constexpr int columns = 5;
constexpr int layers = 6;

class RagdollPile final : public Scene {
public:
    using Scene::Scene;

private:
    void configure(lks_world_def& def) override { def.substeps = 8; }

    bool build() override {
        camera_ = {{3.4f, 4.6f, 6.2f}, {0.0f, 0.7f, 0.0f}, 36.0f, {0.35f, 0.85f, 0.4f}};
        return add_ground(rgb(0xa19e99)) && add_walls() && add_mannequins();
    }

    bool add_wall(std::int64_t x, std::int64_t z, std::int64_t half_x, std::int64_t half_z) {
        return add_block(millimetres(x, 450, z), millimetres(half_x, 450, half_z), rgb(0x8d8478));
    }

    bool add_walls() {
        return add_wall(0, 1900, 2100, 200) && add_wall(0, -1900, 2100, 200) &&
               add_wall(1900, 0, 200, 1700) && add_wall(-1900, 0, 200, 1700);
    }

    // Five abreast, lying in the air in turned directions, layer upon layer.
    bool add_mannequins() {
        const Mannequin mannequin;
        static const Rgb shirts[5] = {rgb(0x2f7b7d), rgb(0xa92f36), rgb(0xcf9a3e), rgb(0x33497f),
                                      rgb(0x6c7d48)};
        static const Rgb trousers[3] = {rgb(0x3c4a63), rgb(0x5c5148), rgb(0x7d8a94)};
        bool good = true;
        for (int i = 0; i < columns * layers && good; ++i) {
            const int column = i % columns;
            const int layer = i / columns;
            lks_ragdoll_def def = lks_default_ragdoll_def();
            def.bones = mannequin.bones;
            def.bone_count = LKS_HUMANOID_BONES;
            const bool across = layer % 2 == 1;
            const std::int64_t beside = 560 * (column - columns / 2) + 40 * layer - 100;
            const std::int64_t along = -900 + 30 * column;
            def.transform.position = millimetres(across ? along : beside, 900 + 1150 * layer + 90 * column,
                                                 across ? beside : along);
            // Face down, head first along z, or along x.
            const lks_rotation lying = turn_about({LKS_FIXED_ONE, 0, 0}, LKS_FIXED_RATIO(1, 4));
            const lks_rotation turned = turn_about({0, LKS_FIXED_ONE, 0}, across ? LKS_FIXED_RATIO(1, 4) : 0);
            def.transform.rotation = product(turned, lying);
            const MannequinLook look = mannequin_look(shirts[i % 5], trousers[i % 3]);
            good = add_ragdoll("mannequin", def, look.bones);
        }
        return good;
    }
};

} // namespace

std::unique_ptr<Scene> make_ragdoll_pile(const SceneInfo& info) {
    return std::make_unique<RagdollPile>(info);
}

} // namespace lks_demo
