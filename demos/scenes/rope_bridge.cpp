// A bridge: nine ropes side by side as a walkway and two as rails. A kinematic roller runs over it and back,
// and presses the ropes down as it goes.
#include "scenes/scene_list.h"
#include "scenes/time_curves.h"

namespace lks_demo {
namespace {

constexpr std::uint32_t segments = 64;
constexpr std::int64_t half_span = 3000; // mm
constexpr std::int64_t deck_height = 1430;
constexpr std::int64_t rail_height = 2350;
constexpr std::int64_t roller_radius = 240;
constexpr std::int64_t rope_radius = 28;
constexpr int deck_ropes = 9;

// A hanging chain is near enough a parabola. Whole 1/65536 m, so that the doubles are exact.
std::vector<double> sagging_points(std::int64_t sag_mm) {
    std::vector<double> points;
    for (std::int64_t i = 0; i <= segments; ++i) {
        const std::int64_t x = (2 * i - segments) * half_span * 65536 / (segments * 1000);
        const std::int64_t y = -4 * sag_mm * 65536 * i * (segments - i) / (1000 * segments * segments);
        points.insert(points.end(),
                      {static_cast<double>(x) / 65536.0, static_cast<double>(y) / 65536.0, 0.0});
    }
    return points;
}

class RopeBridge final : public Scene {
public:
    using Scene::Scene;

private:
    bool build() override {
        camera_ = {{2.6f, 3.0f, 8.3f}, {0.05f, 1.3f, 0.0f}, 33.0f, {0.45f, 0.8f, 0.5f}};
        return add_ground(rgb(0xa19e99)) && add_banks() && add_posts() && add_roller() && add_deck() &&
               add_rails();
    }

    bool add_banks() {
        bool good = true;
        for (const std::int64_t side : {-1, 1}) {
            lks_collider_def bank = lks_default_collider_def();
            bank.shape = LKS_SHAPE_BOX;
            bank.transform.position = millimetres(side * (half_span + 750), 700, 0);
            bank.half_extents = millimetres(700, 700, 800);
            ColliderLook look;
            look.colour = rgb(0x5f6f7f);
            good = good && add_collider(bank, look);
        }
        return good;
    }

    bool add_posts() {
        bool good = true;
        for (const std::int64_t side : {-1, 1}) {
            for (const std::int64_t z : {-620, 620}) {
                lks_collider_def post = lks_default_collider_def();
                post.shape = LKS_SHAPE_CAPSULE;
                post.transform.position = millimetres(side * (half_span + 110), 1900, z);
                post.radius = millimetres(60);
                post.half_length = millimetres(550);
                ColliderLook look;
                look.colour = rgb(0x6e5a48);
                good = good && add_collider(post, look);
            }
        }
        return good;
    }

    bool add_roller() {
        lks_collider_def roller = lks_default_collider_def();
        roller.shape = LKS_SHAPE_CAPSULE;
        roller.transform = roller_at(0);
        roller.radius = millimetres(roller_radius);
        roller.half_length = millimetres(360);
        roller.static_friction = millimetres(300);
        roller.dynamic_friction = millimetres(200);
        ColliderLook look;
        look.colour = rgb(0xbf6b4b);
        look.marking = 0.5f;
        return add_collider(roller, look, &roller_);
    }

    bool add_deck() {
        const std::vector<double> points = sagging_points(700);
        lks_rope_def def = lks_default_rope_def();
        def.point_count = segments + 1;
        def.points = points.data();
        def.segments = 0;
        def.length = 0.0;
        def.linear_density = 0.9;
        def.particle_radius = 0.028;
        const lks_asset* asset = nullptr;
        if (!create_rope(def, asset)) {
            return false;
        }
        for (int i = 0; i < deck_ropes; ++i) {
            const std::int64_t z = (i - deck_ropes / 2) * 95;
            const RopeLook look = {i % 2 == 0 ? rgb(0xc2a072) : rgb(0xa98558), rgb(0xeadfc8), 0.5f};
            if (!add_rope("deck_" + std::to_string(i), asset, millimetres(0, deck_height, z), look)) {
                return false;
            }
        }
        return true;
    }

    bool add_rails() {
        const std::vector<double> points = sagging_points(560);
        lks_rope_def def = lks_default_rope_def();
        def.point_count = segments + 1;
        def.points = points.data();
        def.segments = 0;
        def.length = 0.0;
        def.linear_density = 0.7;
        def.particle_radius = 0.028;
        const lks_asset* asset = nullptr;
        const RopeLook look = {rgb(0x33497f), rgb(0xeadfc8), 0.8f};
        return create_rope(def, asset) &&
               add_rope("rail_near", asset, millimetres(0, rail_height, 620), look) &&
               add_rope("rail_far", asset, millimetres(0, rail_height, -620), look);
    }

    bool add_rope(const std::string& name, const lks_asset* asset, lks_vec3 position, const RopeLook& look) {
        lks_object_def object = lks_default_object_def();
        object.transform.position = position;
        object.linear_damping = LKS_FIXED_RATIO(3, 10);
        if (!add_object(name, asset, object)) {
            return false;
        }
        look_as_rope(6.2, 0.028, look);
        return pin(last_object(), 0) && pin(last_object(), segments);
    }

    // Over the bridge within 4 s and back; on the bridge it runs below where the ropes hang by themselves,
    // and above where they would be taut.
    static lks_transform roller_at(lks_fixed seconds) {
        const lks_fixed round = seconds % LKS_FIXED(9);
        const lks_fixed way = smooth_step(round, millimetres(300), LKS_FIXED(4)) -
                              smooth_step(round, millimetres(4600), LKS_FIXED(4));
        const lks_fixed x = mix(millimetres(-3700), millimetres(3700), way);
        // Near the ellipse of a taut rope with foci at its pins: the square root's parabola, from below.
        const lks_fixed u = coarse_product(x, x) * 10 / 94;
        lks_fixed depth = coarse_product(millimetres(770), LKS_FIXED_ONE - u / 2 - coarse_product(u, u) / 2);
        depth = depth < 0 ? 0 : depth;
        // One turn a circumference of 2π · 24 cm.
        const lks_fixed turns = -x * 1000 / 1508;
        lks_transform transform = lks_transform_identity();
        transform.position = {x, millimetres(deck_height + roller_radius + rope_radius) - depth, 0};
        transform.rotation = product(turn_about({0, 0, LKS_FIXED_ONE}, turns),
                                     turn_about({LKS_FIXED_ONE, 0, 0}, LKS_FIXED_RATIO(1, 4)));
        return transform;
    }

    bool apply_inputs(lks_fixed seconds) override {
        // A move ends with the tick: the target is where the roller is to be one tick later.
        const lks_fixed tick = LKS_FIXED_RATIO(1, lks_world_tick_rate(world()));
        lks_transform target = roller_at(seconds + tick);
        target.position = place(target.position);
        if (!accept(lks_collider_move_to(world(), roller_, target))) {
            return false;
        }
        return sway_rails(seconds, tick);
    }

    // A breath of wind on the rails, at every second second for a fifth of one.
    bool sway_rails(lks_fixed seconds, lks_fixed tick) {
        if (seconds % LKS_FIXED(2) >= millimetres(200)) {
            return true;
        }
        const lks_vec3 push = {0, 0, 4 * tick};
        const std::size_t rails = objects().size() - 2;
        return accept(lks_object_add_velocity(world(), objects()[rails].id, push)) &&
               accept(lks_object_add_velocity(world(), objects()[rails + 1].id, push));
    }

    lks_collider_id roller_{};
};

} // namespace

std::unique_ptr<Scene> make_rope_bridge(const SceneInfo& info) {
    return std::make_unique<RopeBridge>(info);
}

} // namespace lks_demo
