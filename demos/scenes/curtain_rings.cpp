// A pair of curtains, two objects of one asset, on rings that run along a rail: kinematic pins that draw them
// open and closed. Every other ring stands a little off the rail, so that the cloth knows where to fold.
#include "scenes/scene_list.h"
#include "scenes/time_curves.h"

namespace lks_demo {
namespace {

constexpr std::uint32_t rings = 13;
constexpr std::uint32_t columns_between = 4;
constexpr std::uint32_t columns = (rings - 1) * columns_between + 1;
constexpr std::int64_t rail_height = 2700; // mm
constexpr std::int64_t outer_end = 1960;
constexpr std::int64_t wide = 152; // between two rings, mm
constexpr std::int64_t narrow = 50;
constexpr std::int64_t widest = 160; // of the cloth at rest

class CurtainRings final : public Scene {
public:
    using Scene::Scene;

private:
    bool build() override {
        camera_ = {{1.2f, 1.75f, 7.0f}, {0.0f, 1.45f, 0.0f}, 30.0f, {0.45f, 0.75f, 0.65f}};
        return add_ground(rgb(0xa19e99)) && add_rail() && add_curtains();
    }

    bool add_rail() {
        lks_collider_def rail = lks_default_collider_def();
        rail.shape = LKS_SHAPE_CAPSULE;
        rail.transform.position = millimetres(0, rail_height + 70, 0);
        rail.transform.rotation = turn_about({0, 0, LKS_FIXED_ONE}, LKS_FIXED_RATIO(1, 4));
        rail.radius = millimetres(30);
        rail.half_length = millimetres(2150);
        ColliderLook look;
        look.colour = rgb(0x6e5a48);
        return add_collider(rail, look);
    }

    bool add_curtains() {
        lks_cloth_def def = lks_default_cloth_def();
        def.columns = columns;
        def.rows = 57;
        def.width = 1.92; // 12 gaps of `widest`
        def.height = 2.45;
        def.area_density = 0.3;
        def.shear.compliance = 1e-6;
        def.bend.compliance = 1e-4;
        def.bend.damping = 2;
        const lks_asset* asset = nullptr;
        ClothLook look;
        look.front = {Pattern::stripes, rgb(0x33497f), rgb(0xeadfc8), rgb(0xcf9a3e), 0.24f};
        look.back = {Pattern::stripes, rgb(0x3d5288), rgb(0xddd2bb), rgb(0xcf9a3e), 0.24f};
        look.turned = true;
        if (!create_cloth(def, asset)) {
            return false;
        }
        for (const std::int64_t side : {-1, 1}) {
            lks_object_def object = lks_default_object_def();
            object.transform.position = millimetres(side * (outer_end - 960), rail_height - 1225, 0);
            object.linear_damping = LKS_FIXED_RATIO(2, 5);
            if (!add_object(side < 0 ? "left" : "right", asset, object)) {
                return false;
            }
            look_as_grid(def, look);
            for (std::uint32_t ring = 0; ring < rings; ++ring) {
                if (!pin(last_object(), ring * columns_between)) {
                    return false;
                }
            }
        }
        return true;
    }

    // From flat, as the cloth is made, to hanging in soft folds; then open, and closed again.
    static lks_fixed gap_at(lks_fixed seconds) {
        const lks_fixed settling = smooth_step(seconds, 0, LKS_FIXED(1));
        const lks_fixed round = seconds % LKS_FIXED(8);
        const lks_fixed opening = smooth_step(round, millimetres(1200), millimetres(2200)) -
                                  smooth_step(round, millimetres(4800), millimetres(2200));
        return mix(mix(millimetres(widest), millimetres(wide), settling), millimetres(narrow), opening);
    }

    bool apply_inputs(lks_fixed seconds) override {
        const lks_fixed end = seconds + LKS_FIXED_RATIO(1, lks_world_tick_rate(world()));
        const lks_fixed gap = gap_at(end);
        const lks_fixed off_rail = mix(0, millimetres(28), smooth_step(end, 0, LKS_FIXED(1)));
        bool good = true;
        for (std::uint32_t ring = 0; ring < rings; ++ring) {
            const lks_fixed z = ring % 2 == 0 ? off_rail : -off_rail;
            const lks_fixed from_outer_end = gap * ring;
            // The left curtain's first ring is its outer one, the right one's last.
            good = good && move_ring(0, ring, from_outer_end - millimetres(outer_end), z) &&
                   move_ring(1, rings - 1 - ring, millimetres(outer_end) - from_outer_end, z);
        }
        return good;
    }

    bool move_ring(std::size_t curtain, std::uint32_t ring, lks_fixed x, lks_fixed z) {
        const lks_vec3 target = place({x, millimetres(rail_height), z});
        return accept(
            lks_object_set_pin_target(world(), objects()[curtain].id, ring * columns_between, target));
    }
};

} // namespace

std::unique_ptr<Scene> make_curtain_rings(const SceneInfo& info) {
    return std::make_unique<CurtainRings>(info);
}

} // namespace lks_demo
