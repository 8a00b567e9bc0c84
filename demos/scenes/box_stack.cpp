// Ten boxes upon each other, a pyramid, and a ball that rolls into it.
#include "scenes/scene_list.h"
#include "scenes/time_curves.h"

namespace lks_demo {
namespace {

class BoxStack final : public Scene {
public:
    using Scene::Scene;

private:
    void configure(lks_world_def& def) override { def.substeps = 12; }

    bool build() override {
        camera_ = {{3.6f, 2.6f, 9.0f}, {0.5f, 1.7f, 0.0f}, 34.0f, {0.45f, 0.8f, 0.5f}};
        return add_ground(rgb(0xa19e99)) && add_tower() && add_pyramid() && add_ball();
    }

    bool add_box(std::int64_t x, std::int64_t y, std::int64_t z, std::int64_t half, Rgb colour) {
        lks_body_shape shape = lks_default_body_shape();
        shape.shape = LKS_SHAPE_BOX;
        shape.half_extents = millimetres(half, half, half);
        shape.density = LKS_FIXED(500);
        lks_body_def def = lks_default_body_def();
        def.transform.position = millimetres(x, y, z);
        def.shapes = &shape;
        def.shape_count = 1;
        return add_body("box", def, colour);
    }

    bool add_tower() {
        static const Rgb colours[2] = {rgb(0xbf6b4b), rgb(0xd9b382)};
        bool good = true;
        for (int i = 0; i < 10; ++i) {
            good = good && add_box(-1300, 200 + 400 * i, 0, 200, colours[i % 2]);
        }
        return good;
    }

    bool add_pyramid() {
        static const Rgb colours[3] = {rgb(0x5f6f7f), rgb(0x6c7d48), rgb(0x33497f)};
        bool good = true;
        for (int row = 0; row < 6; ++row) {
            for (int i = 0; i < 6 - row; ++i) {
                good = good && add_box(500 + 520 * i + 260 * row, 250 + 500 * row, 0, 250, colours[row % 3]);
            }
        }
        return good;
    }

    bool add_ball() {
        lks_body_shape shape = lks_default_body_shape();
        shape.radius = millimetres(450);
        shape.density = LKS_FIXED(900);
        lks_body_def def = lks_default_body_def();
        def.transform.position = millimetres(2000, 450, 9000);
        def.velocity = millimetres(0, 0, -9000);
        def.shapes = &shape;
        def.shape_count = 1;
        return add_body("ball", def, rgb(0xa92f36));
    }
};

} // namespace

std::unique_ptr<Scene> make_box_stack(const SceneInfo& info) {
    return std::make_unique<BoxStack>(info);
}

} // namespace lks_demo
