// A pennant, a triangle mesh that is no grid, held along its hoist. The wind is the game's: impulses computed
// in integers from the positions and velocities of the last tick.
#include "scenes/pennant_mesh.h"
#include "scenes/scene_list.h"
#include "scenes/time_curves.h"
#include "scenes/wind.h"

namespace lks_demo {
namespace {

class Flag final : public Scene {
public:
    using Scene::Scene;

private:
    bool build() override {
        camera_ = {{2.6f, 1.9f, 5.4f}, {1.1f, 1.75f, 0.0f}, 33.0f, {0.3f, 0.75f, 0.6f}};
        return add_ground(rgb(0xa19e99)) && add_pole() && add_pennant();
    }

    bool add_pole() {
        lks_collider_def pole = lks_default_collider_def();
        pole.shape = LKS_SHAPE_CAPSULE;
        pole.transform.position = millimetres(-60, 1400, 0);
        pole.radius = millimetres(35);
        pole.half_length = millimetres(1400);
        ColliderLook look;
        look.colour = rgb(0xe8e2d6);
        return add_collider(pole, look);
    }

    bool add_pennant() {
        const PennantMesh mesh = make_pennant();
        lks_cloth_def def = lks_default_cloth_def();
        def.vertices = mesh.vertices.data();
        def.vertex_count = static_cast<std::uint32_t>(mesh.vertices.size() / 3);
        def.triangles = mesh.triangles.data();
        def.triangle_count = static_cast<std::uint32_t>(mesh.triangles.size() / 3);
        def.columns = 0;
        def.rows = 0;
        def.width = 0.0;
        def.height = 0.0;
        def.area_density = 0.18;
        def.stretch.compliance = 1e-7;
        def.bend.compliance = 1e-3;
        def.particle_radius = 0.008;
        const lks_asset* asset = nullptr;
        lks_object_def object = lks_default_object_def();
        object.transform.position = millimetres(0, 2150, 0);
        object.linear_damping = LKS_FIXED_RATIO(1, 5);
        ClothLook look;
        look.front = {Pattern::stripes, rgb(0x2f7b7d), rgb(0xf0e6cf), rgb(0xcf9a3e), 0.3f};
        look.back = {Pattern::stripes, rgb(0x2a6c70), rgb(0xe4dac4), rgb(0xcf9a3e), 0.3f};
        look.thickness = 0.005f;
        look.translucency = 0.35f;
        if (!create_cloth(def, asset) || !add_object("pennant", asset, object)) {
            return false;
        }
        look_as_mesh(mesh.vertices, look);
        wind_ = Wind(millimetres(4200), asset);
        for (std::uint32_t vertex = 0; vertex < mesh.hoist_vertices; ++vertex) {
            if (!pin(last_object(), vertex)) {
                return false;
            }
        }
        return true;
    }

    bool apply_inputs(lks_fixed seconds) override {
        return accept(wind_.blow(world(), last_object(), seconds, place({})));
    }

    Wind wind_;
};

} // namespace

std::unique_ptr<Scene> make_flag(const SceneInfo& info) {
    return std::make_unique<Flag>(info);
}

} // namespace lks_demo
