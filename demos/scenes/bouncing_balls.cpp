// What plates give back of a fall: nothing, a part, all of it; and one ball that its plate lets through.
//
// Five plates with restitutions from 0 to 0.9, each under a ball that has none of its own. On a wider plate
// two balls of which one has a mask that lacks the plates. At the ends two tilted plates that give back
// everything and have no friction: the one throws a ball over to the other, which throws it up again.
#include "scenes/scene_list.h"
#include "scenes/time_curves.h"

namespace lks_demo {
namespace {

constexpr std::uint32_t plates = 2; // their category
constexpr std::int64_t radius = 180;
constexpr std::int64_t half_thickness = 40;
constexpr std::int64_t half_size = 290; // of a plate
constexpr std::int64_t table = 800;     // height of the tops of the plates in the row
constexpr std::int64_t fall = 2000;
// What falls so far on a plate that is tilted by 22.5° and loses nothing leaves it at 45° and flies twice as
// far: from one plate to the other, if both are as far from the middle.
constexpr std::int64_t long_fall = 2600;
constexpr std::int64_t thrown_from = 600; // height of the ball when it touches them
constexpr std::int64_t in_front = 850;    // of the row

class BouncingBalls final : public Scene {
public:
    using Scene::Scene;

private:
    bool build() override {
        camera_ = {{1.2f, 2.4f, 8.6f}, {0.05f, 1.55f, 0.0f}, 30.0f, {0.4f, 0.8f, 0.45f}};
        return add_ground(rgb(0xa19e99)) && add_row() && add_sieve() && add_throw();
    }

    bool add_plate(lks_transform transform, std::int64_t half_width, lks_fixed restitution,
                   lks_fixed friction, Rgb colour) {
        lks_collider_def def = lks_default_collider_def();
        def.shape = LKS_SHAPE_BOX;
        def.half_extents = millimetres(half_width, half_thickness, half_size);
        def.transform = transform;
        def.restitution = restitution;
        def.static_friction = friction;
        def.dynamic_friction = friction;
        def.filter.category = plates;
        ColliderLook look;
        look.colour = colour;
        return add_collider(def, look) && add_post(transform.position);
    }

    // Under a plate, from the ground to its middle. It meets whom the plate meets.
    bool add_post(lks_vec3 top) {
        lks_collider_def def = lks_default_collider_def();
        def.shape = LKS_SHAPE_CAPSULE;
        def.radius = millimetres(25);
        def.half_length = top.y / 2;
        def.transform.position = {top.x, top.y / 2, top.z};
        def.filter.category = plates;
        ColliderLook look;
        look.colour = rgb(0x4a4f57);
        return add_collider(def, look);
    }

    bool add_table(std::int64_t x, std::int64_t half_width, lks_fixed restitution, Rgb colour) {
        lks_transform transform = lks_default_collider_def().transform;
        transform.position = millimetres(x, table - half_thickness, 0);
        return add_plate(transform, half_width, restitution, LKS_FIXED_RATIO(4, 10), colour);
    }

    bool add_ball(lks_vec3 position, Rgb colour, lks_fixed restitution = 0, std::uint32_t mask = ~0u) {
        lks_body_shape shape = lks_default_body_shape();
        shape.radius = millimetres(radius);
        lks_body_def def = lks_default_body_def();
        def.transform.position = position;
        def.shapes = &shape;
        def.shape_count = 1;
        def.restitution = restitution;
        def.filter.mask = mask;
        return add_body("ball", def, colour);
    }

    bool add_row() {
        static const Rgb colours[5] = {rgb(0x33497f), rgb(0x4f7f8f), rgb(0x6c7d48), rgb(0xd9a441),
                                       rgb(0xbf5b3b)};
        constexpr std::int64_t tenths[5] = {0, 3, 5, 7, 9};
        bool good = true;
        for (int i = 0; i < 5; ++i) {
            const std::int64_t x = -1950 + 680 * i;
            good = good && add_table(x, half_size, LKS_FIXED_RATIO(tenths[i], 10), colours[i]) &&
                   add_ball(millimetres(x, table + fall + radius, 0), colours[i]);
        }
        return good;
    }

    // The pale ball falls through to the ground, where it bounces a little by a restitution of its own.
    bool add_sieve() {
        constexpr std::int64_t x = 1660;
        constexpr std::int64_t height = table + fall + radius;
        const Rgb colour = rgb(0x6f7f8f);
        return add_table(x, 500, LKS_FIXED_RATIO(7, 10), colour) &&
               add_ball(millimetres(x - 250, height, 0), colour) &&
               add_ball(millimetres(x + 250, height, 0), rgb(0xe8e2d4), LKS_FIXED_RATIO(3, 10), ~plates);
    }

    bool add_throw() {
        const Rgb colour = rgb(0xa92f36);
        // From the middle of a plate to that of the ball that touches it there.
        constexpr std::int64_t away = radius + half_thickness;
        constexpr std::int64_t across = away * 382683 / 1000000; // sin 22.5°
        constexpr std::int64_t up = away * 923880 / 1000000;     // cos 22.5°
        bool good = true;
        for (const int side : {-1, 1}) {
            lks_transform transform{};
            transform.position = millimetres(side * (long_fall + across), thrown_from - up, in_front);
            transform.rotation = turn_about({0, 0, LKS_FIXED_ONE}, side * LKS_FIXED_RATIO(1, 16));
            good = good && add_plate(transform, half_size, LKS_FIXED_ONE, 0, colour);
        }
        return good && add_ball(millimetres(-long_fall, thrown_from + long_fall, in_front), colour);
    }
};

} // namespace

std::unique_ptr<Scene> make_bouncing_balls(const SceneInfo& info) {
    return std::make_unique<BouncingBalls>(info);
}

} // namespace lks_demo
