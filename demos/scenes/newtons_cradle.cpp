// Five balls on rods: one is let go, and the one at the other end takes its motion over.
#include "scenes/scene_list.h"
#include "scenes/time_curves.h"

namespace lks_demo {
namespace {

constexpr int ball_count = 5;
constexpr std::int64_t radius = 200;
constexpr std::int64_t height = 2400; // of the beam
constexpr std::int64_t rod = 1500;

class NewtonsCradle final : public Scene {
public:
    using Scene::Scene;

private:
    void configure(lks_world_def& def) override { def.substeps = 20; }

    bool build() override {
        camera_ = {{1.6f, 1.9f, 6.0f}, {0.0f, 1.35f, 0.0f}, 36.0f, {0.4f, 0.8f, 0.5f}};
        return add_ground(rgb(0xa19e99)) && add_frame() && add_balls();
    }

    bool add_frame() {
        lks_body_shape shape = lks_default_body_shape();
        shape.shape = LKS_SHAPE_CAPSULE;
        shape.radius = millimetres(60);
        shape.half_length = millimetres(1500);
        shape.transform.rotation = turn_about({0, 0, LKS_FIXED_ONE}, LKS_FIXED_RATIO(1, 4));
        lks_body_def def = lks_default_body_def();
        def.kind = LKS_BODY_KINEMATIC;
        def.transform.position = millimetres(0, height, 0);
        def.shapes = &shape;
        def.shape_count = 1;
        def.filter.mask = 0;
        return add_body("beam", def, rgb(0x5f6f7f), &beam_);
    }

    // The first one is pulled aside by 45 degrees. A rod is a light capsule that belongs to its ball.
    bool add_balls() {
        bool good = true;
        for (int i = 0; i < ball_count; ++i) {
            // A hair's breadth between them: each impact is one of two balls.
            const std::int64_t x =
                (i - ball_count / 2) * (2 * radius * LKS_FIXED_ONE / 1000 + LKS_FIXED_ONE / 10000);
            good = good && add_ball(x, i == 0);
        }
        return good;
    }

    bool add_ball(lks_fixed x, bool aside) {
        lks_body_shape shapes[2] = {lks_default_body_shape(), lks_default_body_shape()};
        shapes[0].radius = millimetres(radius);
        shapes[0].density = LKS_FIXED(7800);
        shapes[1].shape = LKS_SHAPE_CAPSULE;
        shapes[1].radius = millimetres(12);
        shapes[1].half_length = millimetres((rod - radius) / 2);
        shapes[1].transform.position = millimetres(0, (rod + radius) / 2, 0);
        shapes[1].density = LKS_FIXED(100);
        lks_body_def def = lks_default_body_def();
        def.transform.position = {x, millimetres(height - rod), 0};
        if (aside) {
            def.transform.rotation = turn_about({0, 0, LKS_FIXED_ONE}, -LKS_FIXED_RATIO(1, 8));
            const lks_fixed across = LKS_FIXED_RATIO(1060660, 1000000); // rod · sin 45°
            def.transform.position = {x - across, millimetres(height) - across, 0};
        }
        def.shapes = shapes;
        def.shape_count = 2;
        def.static_friction = 0;
        def.dynamic_friction = 0;
        def.restitution = LKS_FIXED_ONE;
        lks_body_id ball{};
        if (!add_body("ball", def, rgb(0xb8bcc2), &ball)) {
            return false;
        }
        lks_joint_def joint = lks_default_joint_def();
        joint.kind = LKS_JOINT_HINGE;
        joint.body_a = beam_;
        joint.body_b = ball;
        joint.frame_a.position = {x, 0, 0};
        joint.frame_b.position = millimetres(0, rod, 0);
        // About z: local y along it.
        joint.frame_a.rotation = turn_about({LKS_FIXED_ONE, 0, 0}, LKS_FIXED_RATIO(1, 4));
        joint.frame_b.rotation = joint.frame_a.rotation;
        lks_joint_id id{};
        return accept(lks_world_add_joint(world(), &joint, &id));
    }

    lks_body_id beam_{};
};

} // namespace

std::unique_ptr<Scene> make_newtons_cradle(const SceneInfo& info) {
    return std::make_unique<NewtonsCradle>(info);
}

} // namespace lks_demo
