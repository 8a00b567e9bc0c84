// A ball rolls over tiles and tips the first of a row of dominoes; the last one sends another ball into pins.
// All but the first ball fall asleep before it is their turn.
#include "scenes/scene_list.h"
#include "scenes/time_curves.h"

namespace lks_demo {
namespace {

constexpr std::int64_t spacing = 150; // mm
constexpr std::int64_t floor_height = 100;
constexpr std::int64_t row_side = 1000; // how far the two straight parts are from the middle
constexpr int straight_count = 16;
constexpr int bend_count = 21;

class Dominoes final : public Scene {
public:
    using Scene::Scene;

private:
    void configure(lks_world_def& def) override { def.substeps = 8; }

    bool build() override {
        camera_ = {{-1.4f, 3.3f, 5.6f}, {-1.25f, 0.1f, -0.15f}, 33.0f, {0.5f, 0.85f, 0.4f}};
        return add_ground(rgb(0x8f949a)) && add_tiles() && add_row() && add_balls() && add_pins();
    }

    // Flush with each other: what rolls and slides over them finds no seams.
    bool add_tiles() {
        static const Rgb colours[2] = {rgb(0xb9ac98), rgb(0xa5957e)};
        bool good = true;
        for (int i = 0; i < 14; ++i) {
            for (int j = 0; j < 8; ++j) {
                good = good && add_block(millimetres(-4750 + 500 * i, floor_height / 2, -1750 + 500 * j),
                                         millimetres(250, floor_height / 2, 250), colours[(i + j) % 2]);
            }
        }
        return good;
    }

    bool add_box(const std::string& name, const lks_transform& transform, const lks_vec3& half_extents,
                 Rgb colour) {
        lks_body_shape shape = lks_default_body_shape();
        shape.shape = LKS_SHAPE_BOX;
        shape.half_extents = half_extents;
        shape.density = LKS_FIXED(600);
        lks_body_def def = lks_default_body_def();
        def.transform = transform;
        def.static_friction = def.dynamic_friction = LKS_FIXED_RATIO(2, 5);
        def.shapes = &shape;
        def.shape_count = 1;
        return add_body(name, def, colour);
    }

    // `turns`: the way that it falls, from +x towards -z.
    bool add_domino(lks_fixed x, lks_fixed z, lks_fixed turns) {
        static const Rgb colours[6] = {rgb(0xa9413a), rgb(0xc27a3a), rgb(0xc9b04c),
                                       rgb(0x5f8a4f), rgb(0x3f6d8f), rgb(0x6d4f86)};
        const Rgb colour = colours[count_++ / 4 % 6];
        return add_box("domino",
                       {{x, millimetres(floor_height + 200), z}, turn_about({0, LKS_FIXED_ONE, 0}, turns)},
                       millimetres(20, 200, 100), colour);
    }

    bool add_row() {
        bool good = true;
        for (int i = straight_count; i > 0; --i) {
            good = good && add_domino(millimetres(-spacing * i), millimetres(row_side), 0);
        }
        for (int i = 0; i <= bend_count; ++i) {
            const lks_fixed turns = LKS_FIXED_RATIO(i, 2 * bend_count);
            const lks_fixed radius = millimetres(row_side);
            const lks_fixed cosine = sine_of_turns(turns + LKS_FIXED_RATIO(1, 4));
            good = good && add_domino(coarse_product(radius, sine_of_turns(turns)),
                                      coarse_product(radius, cosine), turns);
        }
        for (int i = 1; i <= straight_count; ++i) {
            good =
                good && add_domino(millimetres(-spacing * i), millimetres(-row_side), LKS_FIXED_RATIO(1, 2));
        }
        return good;
    }

    bool add_ball(const lks_vec3& position, std::int64_t radius, std::int64_t density, std::int64_t speed,
                  Rgb colour) {
        lks_body_shape shape = lks_default_body_shape();
        shape.radius = millimetres(radius);
        shape.density = LKS_FIXED(density);
        lks_body_def def = lks_default_body_def();
        def.transform.position = position;
        def.velocity = millimetres(speed, 0, 0);
        def.angular_velocity = {0, 0, -LKS_FIXED_RATIO(speed, radius)};
        def.shapes = &shape;
        def.shape_count = 1;
        return add_body("ball", def, colour);
    }

    bool add_balls() {
        return add_ball(millimetres(-4300, floor_height + 250, row_side), 250, 150, 1500, rgb(0xa92f36)) &&
               add_ball(millimetres(-2630, floor_height + 190, -row_side), 190, 120, 0, rgb(0x33497f));
    }

    bool add_pins() {
        bool good = true;
        for (int row = 0; row < 3; ++row) {
            for (int i = 0; i <= row; ++i) {
                const lks_vec3 place =
                    millimetres(-3300 - 170 * row, floor_height + 150, -row_side - 90 * row + 180 * i);
                lks_transform transform = lks_transform_identity();
                transform.position = place;
                good = good && add_box("pin", transform, millimetres(35, 150, 35), rgb(0xd8d2c4));
            }
        }
        return good;
    }

    int count_ = 0;
};

} // namespace

std::unique_ptr<Scene> make_dominoes(const SceneInfo& info) {
    return std::make_unique<Dominoes>(info);
}

} // namespace lks_demo
