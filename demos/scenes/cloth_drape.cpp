// A cloth falls on a sphere and a box and is slowed by friction; most of it slides to the ground.
#include "scenes/scene_list.h"
#include "scenes/time_curves.h"

namespace lks_demo {
namespace {

class ClothDrape final : public Scene {
public:
    using Scene::Scene;

private:
    bool build() override {
        camera_ = {{3.0f, 2.5f, 4.7f}, {0.1f, 0.6f, 0.3f}, 33.0f, {0.35f, 0.85f, 0.3f}};
        return add_ground(rgb(0xa19e99)) && add_solids() && add_cloth();
    }

    bool add_solids() {
        lks_collider_def sphere = lks_default_collider_def();
        sphere.transform.position = millimetres(-550, 600, 0);
        sphere.radius = millimetres(600);
        sphere.static_friction = millimetres(240);
        sphere.dynamic_friction = millimetres(200);
        ColliderLook sphere_look;
        sphere_look.colour = rgb(0xbf6b4b);

        lks_collider_def box = lks_default_collider_def();
        box.shape = LKS_SHAPE_BOX;
        box.transform.position = millimetres(800, 350, 100);
        box.transform.rotation = turn_about({0, LKS_FIXED_ONE, 0}, LKS_FIXED_RATIO(1, 11));
        box.half_extents = millimetres(400, 350, 400);
        box.static_friction = millimetres(350);
        box.dynamic_friction = millimetres(280);
        ColliderLook box_look;
        box_look.colour = rgb(0x5f6f7f);
        return add_collider(sphere, sphere_look) && add_collider(box, box_look);
    }

    bool add_cloth() {
        lks_cloth_def def = lks_default_cloth_def();
        def.columns = 64;
        def.rows = 56;
        def.width = 2.56;
        def.height = 2.24;
        def.area_density = 0.25;
        def.shear.compliance = 1e-6;
        def.bend.compliance = 1e-4;
        def.particle_radius = 0.012;
        const lks_asset* asset = nullptr;
        lks_object_def object = lks_default_object_def();
        object.transform.position = millimetres(150, 1650, 400);
        object.transform.rotation = product(turn_about({0, LKS_FIXED_ONE, 0}, LKS_FIXED_RATIO(1, 20)),
                                            turn_about({LKS_FIXED_ONE, 0, 0}, LKS_FIXED_RATIO(-1, 4)));
        object.linear_damping = LKS_FIXED_RATIO(1, 5);
        ClothLook look;
        look.front = {Pattern::gingham, rgb(0xf1ece0), rgb(0x2f6f8f), rgb(0xcf9a3e), 0.16f};
        look.back = {Pattern::gingham, rgb(0xe7e0d2), rgb(0x5b8aa1), rgb(0xcf9a3e), 0.16f};
        if (!create_cloth(def, asset) || !add_object("cloth", asset, object)) {
            return false;
        }
        look_as_grid(def, look);
        return true;
    }
};

} // namespace

std::unique_ptr<Scene> make_cloth_drape(const SceneInfo& info) {
    return std::make_unique<ClothDrape>(info);
}

} // namespace lks_demo
