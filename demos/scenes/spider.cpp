// A spider walks over rubble by its own strength, four legs at a time, until that leaves it.
#include "scenes/scene_list.h"
#include "scenes/time_curves.h"

namespace lks_demo {
namespace {

constexpr lks_fixed collapse = LKS_FIXED(5);

class Spider final : public Scene {
public:
    using Scene::Scene;

private:
    void configure(lks_world_def& def) override { def.substeps = 20; }

    bool build() override {
        camera_ = {{2.5f, 1.7f, 2.6f}, {-0.1f, 0.1f, 0.15f}, 36.0f, {0.4f, 0.8f, 0.5f}};
        return add_ground(rgb(0xa19e99)) && add_rubble() && add_spider();
    }

    // Flat stones that lie loose.
    bool add_rubble() {
        bool good = true;
        for (int i = 0; i < 24; ++i) {
            lks_body_shape shape = lks_default_body_shape();
            shape.shape = LKS_SHAPE_BOX;
            shape.half_extents =
                millimetres(50 + 9 * (i * 7 % 5), 12 + 3 * (i * 5 % 4), 45 + 8 * (i * 3 % 6));
            shape.density = LKS_FIXED(2400);
            lks_body_def def = lks_default_body_def();
            def.shapes = &shape;
            def.shape_count = 1;
            def.static_friction = LKS_FIXED(1);
            def.dynamic_friction = LKS_FIXED_RATIO(8, 10);
            def.transform.position =
                millimetres(-620 + 410 * (i % 4) + 37 * (i * 5 % 7), 20 + 3 * (i * 5 % 4),
                            -250 + 290 * (i / 4) + 29 * (i * 3 % 5));
            def.transform.rotation = turn_about({0, LKS_FIXED_ONE, 0}, LKS_FIXED_RATIO(i * 37 % 100, 100));
            good = good && add_body("stone", def, i % 2 == 0 ? rgb(0x8d8478) : rgb(0x7b746b));
        }
        return good;
    }

    bool add_spider() {
        if (lks_spider(bones_, shapes_) != LKS_OK) {
            return false;
        }
        BoneLook looks[LKS_SPIDER_BONES];
        for (std::uint32_t i = 0; i < LKS_SPIDER_BONES; ++i) {
            looks[i].colour = i % 2 == 0 ? rgb(0x4a3328) : rgb(0x7a4a2e);
            bones_[i].body.static_friction = LKS_FIXED(1);
            bones_[i].body.dynamic_friction = LKS_FIXED_RATIO(8, 10);
        }
        looks[LKS_SPIDER_THORAX].colour = rgb(0x3a2a24);
        looks[LKS_SPIDER_ABDOMEN].colour = rgb(0x8a3b2c);
        def_ = lks_default_ragdoll_def();
        def_.bones = bones_;
        def_.bone_count = LKS_SPIDER_BONES;
        def_.transform.position = millimetres(0, 70, -550);
        return add_ragdoll("spider", def_, looks, nullptr, joints_);
    }

    // Legs of one group are in the air while the others push back.
    void step(lks_fixed phase, lks_transform (&pose)[LKS_SPIDER_BONES]) const {
        for (std::uint32_t i = 0; i < LKS_SPIDER_BONES; ++i) {
            pose[i] = bones_[i].body.transform;
        }
        for (std::uint32_t leg = 0; leg < LKS_SPIDER_LEGS; ++leg) {
            const bool left = leg < LKS_SPIDER_LEGS / 2;
            const bool odd = (leg % 2 == 1) != left;
            const lks_fixed own = phase + (odd ? LKS_FIXED_ONE / 2 : 0);
            const lks_fixed forward = sine_of_turns(own);
            const lks_fixed lifted = sine_of_turns(own + LKS_FIXED_RATIO(1, 4));
            const lks_fixed yaw = (left ? -forward : forward) * 5 / 100;
            const lks_fixed lift = (left ? 1 : -1) * (lifted > 0 ? lifted * 9 / 100 : 0);
            const lks_rotation turned =
                product(turn_about({0, LKS_FIXED_ONE, 0}, yaw), turn_about({0, 0, LKS_FIXED_ONE}, lift));
            const std::uint32_t thigh = LKS_SPIDER_FIRST_LEG + 2 * leg;
            pose[thigh].rotation = product(turned, pose[thigh].rotation);
            pose[thigh + 1].rotation = product(turned, pose[thigh + 1].rotation);
        }
    }

    bool apply_inputs(lks_fixed seconds) override {
        lks_transform pose[LKS_SPIDER_BONES];
        const lks_fixed walking = seconds < LKS_FIXED_ONE ? 0 : seconds - LKS_FIXED_ONE;
        step(walking * 10 / 8, pose);
        const lks_fixed strength = seconds < collapse ? LKS_FIXED_ONE : 0;
        return accept(lks_ragdoll_drive(world(), &def_, joints_, pose, strength, LKS_FIXED_RATIO(3, 100)));
    }

    lks_bone bones_[LKS_SPIDER_BONES];
    lks_body_shape shapes_[LKS_SPIDER_BONES];
    lks_ragdoll_def def_{};
    lks_joint_id joints_[LKS_SPIDER_BONES - 1];
};

} // namespace

std::unique_ptr<Scene> make_spider(const SceneInfo& info) {
    return std::make_unique<Spider>(info);
}

} // namespace lks_demo
