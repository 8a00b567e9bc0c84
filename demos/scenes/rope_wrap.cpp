// Ropes and capsules: a weighted rope swings down and winds itself around a peg; two others fall across pegs,
// hang and slide until friction holds them.
#include "scenes/scene_list.h"
#include "scenes/time_curves.h"

namespace lks_demo {
namespace {

class RopeWrap final : public Scene {
public:
    using Scene::Scene;

private:
    bool build() override {
        camera_ = {{2.2f, 2.3f, 7.4f}, {0.1f, 1.5f, 0.0f}, 33.0f, {0.4f, 0.8f, 0.5f}};
        return add_ground(rgb(0xa19e99)) && add_pegs() && add_swinging_rope() && add_falling_ropes();
    }

    bool add_peg(std::int64_t x, std::int64_t y, std::int64_t radius, std::int64_t half_length, Rgb colour) {
        lks_collider_def peg = lks_default_collider_def();
        peg.shape = LKS_SHAPE_CAPSULE;
        peg.transform.position = millimetres(x, y, 0);
        peg.transform.rotation = turn_about({LKS_FIXED_ONE, 0, 0}, LKS_FIXED_RATIO(1, 4));
        peg.radius = millimetres(radius);
        peg.half_length = millimetres(half_length);
        peg.static_friction = millimetres(800);
        peg.dynamic_friction = millimetres(600);
        ColliderLook look;
        look.colour = colour;
        return add_collider(peg, look);
    }

    bool add_pegs() {
        return add_peg(-1900, 1350, 80, 350, rgb(0xbf6b4b)) && add_peg(400, 1350, 150, 600, rgb(0x5f6f7f)) &&
               add_peg(1250, 2050, 180, 600, rgb(0x6c7d48)) && add_peg(2100, 1350, 150, 600, rgb(0x5f6f7f));
    }

    // Held at one end above the first peg and let go level: its weighted tip pulls it around the peg.
    bool add_swinging_rope() {
        constexpr std::uint32_t segments = 90;
        std::vector<double> masses(segments + 1, 0.2 / 32.0);
        masses.back() = 0.5;
        lks_rope_def def = lks_default_rope_def();
        def.length = 2.5;
        def.segments = segments;
        def.linear_density = 0.0;
        def.vertex_masses = masses.data();
        def.particle_radius = 0.025;
        const lks_asset* asset = nullptr;
        lks_object_def object = lks_default_object_def();
        object.transform.position = millimetres(-2000, 3050, -60);
        object.velocity = {0, 0, millimetres(120)};
        const RopeLook look = {rgb(0xa92f36), rgb(0xeadfc8), 0.8f};
        if (!create_rope(def, asset) || !add_object("swinging", asset, object)) {
            return false;
        }
        look_as_rope(def.length, def.particle_radius, look);
        return pin(last_object(), 0);
    }

    bool add_falling_ropes() {
        lks_rope_def def = lks_default_rope_def();
        def.length = 4.5;
        def.segments = 150;
        def.linear_density = 0.3;
        def.particle_radius = 0.03;
        const lks_asset* asset = nullptr;
        return create_rope(def, asset) &&
               add_falling_rope("falling_front", asset, def, millimetres(-1150, 2650, 330), 4,
                                {rgb(0xc2a072), rgb(0xeadfc8), 0.6f}) &&
               add_falling_rope("falling_middle", asset, def, millimetres(-800, 3100, 60), -3,
                                {rgb(0x2f7b7d), rgb(0xeadfc8), 0.8f}) &&
               add_falling_rope("falling_back", asset, def, millimetres(-1250, 2400, -250), 2,
                                {rgb(0x33497f), rgb(0xcf9a3e), 0.8f});
    }

    bool add_falling_rope(const std::string& name, const lks_asset* asset, const lks_rope_def& def,
                          lks_vec3 position, std::int64_t degrees, const RopeLook& look) {
        lks_object_def object = lks_default_object_def();
        object.transform.position = position;
        // Askew in both directions, so that no rope stays in one plane.
        object.transform.rotation = product(turn_about({0, LKS_FIXED_ONE, 0}, LKS_FIXED_RATIO(degrees, 240)),
                                            turn_about({0, 0, LKS_FIXED_ONE}, LKS_FIXED_RATIO(degrees, 360)));
        object.linear_damping = LKS_FIXED_RATIO(1, 10);
        if (!add_object(name, asset, object)) {
            return false;
        }
        look_as_rope(def.length, def.particle_radius, look);
        return true;
    }
};

} // namespace

std::unique_ptr<Scene> make_rope_wrap(const SceneInfo& info) {
    return std::make_unique<RopeWrap>(info);
}

} // namespace lks_demo
