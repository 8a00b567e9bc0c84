// A cloth of 64 × 64 vertices and 23,938 constraints starts level, held at two corners, and swings down. The
// corners come together, so that it hangs in folds: a stiff sheet between corners at full width has none.
// Tethers to both keep it from stretching where it is caught.
#include "scenes/scene_list.h"
#include "scenes/time_curves.h"

namespace lks_demo {
namespace {

constexpr std::uint32_t side = 64;
constexpr std::uint32_t corners[] = {0, side - 1};
constexpr std::int64_t half_width = 1600; // mm
constexpr std::int64_t height_of_corners = 3500;

class ClothHang final : public Scene {
public:
    using Scene::Scene;

private:
    bool build() override {
        camera_ = {{2.1f, 2.2f, 7.4f}, {0.0f, 1.95f, 0.0f}, 33.0f, {0.5f, 0.75f, 0.55f}};
        lks_cloth_def def = lks_default_cloth_def();
        def.columns = side;
        def.rows = side;
        def.width = 3.2;
        def.height = 3.2;
        def.area_density = 0.2;
        def.shear.compliance = 1e-6;
        def.bend.compliance = 1e-4;
        def.tether_anchors = corners;
        def.tether_anchor_count = 2;
        const lks_asset* asset = nullptr;
        lks_object_def object = lks_default_object_def();
        // The sheet lies level behind the corners, its front up, and swings forward.
        object.transform.position = millimetres(0, height_of_corners, -half_width);
        object.transform.rotation = turn_about({LKS_FIXED_ONE, 0, 0}, LKS_FIXED_RATIO(1, 4));
        object.linear_damping = LKS_FIXED_RATIO(2, 5);
        ClothLook look;
        look.front = {Pattern::tartan, rgb(0x9c2f35), rgb(0x2c3f63), rgb(0xe3c77d), 0.5f};
        look.back = {Pattern::tartan, rgb(0x8c3a3e), rgb(0x33456a), rgb(0xd9c086), 0.5f};
        if (!add_ground(rgb(0xa19e99)) || !create_cloth(def, asset) || !add_object("cloth", asset, object)) {
            return false;
        }
        look_as_grid(def, look);
        return pin(last_object(), corners[0]) && pin(last_object(), corners[1]);
    }

    bool apply_inputs(lks_fixed seconds) override {
        const lks_fixed share = smooth_step(seconds, millimetres(200), LKS_FIXED(2));
        const lks_fixed x = mix(millimetres(half_width), millimetres(1150), share);
        const auto move = [this](std::uint32_t vertex, lks_fixed to) {
            const lks_vec3 target = place({to, millimetres(height_of_corners), 0});
            return accept(lks_object_set_pin_target(world(), last_object(), vertex, target));
        };
        return move(corners[0], -x) && move(corners[1], x);
    }
};

} // namespace

std::unique_ptr<Scene> make_cloth_hang(const SceneInfo& info) {
    return std::make_unique<ClothHang>(info);
}

} // namespace lks_demo
