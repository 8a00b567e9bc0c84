// A mannequin in a cape stands on a plinth between two lanterns by its own strength, salutes, bows, and then
// is left by it. The lanterns are heavy above and stand on light feet.
#include "scenes/caped_scene.h"
#include "scenes/mannequin.h"
#include "scenes/scene_list.h"
#include "scenes/time_curves.h"

namespace lks_demo {
namespace {

constexpr std::int64_t plinth = 180; // its height, mm
constexpr lks_fixed salute = LKS_FIXED_RATIO(8, 10);
constexpr lks_fixed lower = LKS_FIXED_RATIO(22, 10);
constexpr lks_fixed bow = LKS_FIXED(3);
constexpr lks_fixed collapse = LKS_FIXED_RATIO(39, 10);
constexpr lks_vec3 side_axis = {LKS_FIXED_ONE, 0, 0};
constexpr lks_vec3 up_axis = {0, LKS_FIXED_ONE, 0};
constexpr lks_vec3 front_axis = {0, 0, LKS_FIXED_ONE};

class Sentry final : public CapedScene {
public:
    using CapedScene::CapedScene;

private:
    void configure(lks_world_def& def) override { def.substeps = 8; }

    bool build() override {
        camera_ = {{3.1f, 1.9f, 4.0f}, {-0.1f, 0.72f, 0.6f}, 37.0f, {0.45f, 0.8f, 0.5f}};
        return add_ground(rgb(0xa19e99)) &&
               add_block(millimetres(0, plinth / 2, 0), millimetres(480, plinth / 2, 420), rgb(0x8a8580)) &&
               add_mannequin() && add_lantern(-800) && add_lantern(800);
    }

    bool add_mannequin() {
        def_ = lks_default_ragdoll_def();
        def_.bones = mannequin_.bones;
        def_.bone_count = LKS_HUMANOID_BONES;
        def_.transform.position = millimetres(0, plinth + 15, 0);
        const MannequinLook look = mannequin_look(rgb(0x8c2f33), rgb(0x2f3a4f));
        return add_ragdoll("mannequin", def_, look.bones, bodies_, joints_) &&
               add_cape(bodies_[LKS_HUMANOID_CHEST], def_.transform.position, rgb(0x2d4a78), rgb(0x263e66));
    }

    // A foot of 1 kg under a post of 4 and a lantern of 18.
    bool add_lantern(std::int64_t x) {
        lks_body_id foot{}, post{}, head{};
        return add_part(x, 25, {130, 25, 130}, 1, rgb(0x3b3f45), foot) &&
               add_part(x, 650, {22, 600, 22}, 4, rgb(0x4b5058), post) &&
               add_part(x, 1380, {95, 130, 95}, 18, rgb(0xe3b45c), head) && join(post, foot, -600, 25) &&
               join(post, head, 600, -130);
    }
    bool add_part(std::int64_t x, std::int64_t y, const std::int64_t (&half)[3], std::int64_t mass,
                  Rgb colour, lks_body_id& id) {
        lks_body_shape shape = lks_default_body_shape();
        shape.shape = LKS_SHAPE_BOX;
        shape.half_extents = millimetres(half[0], half[1], half[2]);
        lks_body_def def = lks_default_body_def();
        def.shapes = &shape;
        def.shape_count = 1;
        def.mass = mass * LKS_FIXED_ONE;
        def.transform.position = millimetres(x, y + 10, 250);
        return add_body("lantern", def, colour, &id);
    }
    bool join(lks_body_id post, lks_body_id other, std::int64_t on_post, std::int64_t on_other) {
        lks_joint_def def = lks_default_joint_def();
        def.kind = LKS_JOINT_FIXED;
        def.body_a = post;
        def.body_b = other;
        def.frame_a.position = millimetres(0, on_post, 0);
        def.frame_b.position = millimetres(0, on_other, 0);
        lks_joint_id id{};
        return accept(lks_world_add_joint(world(), &def, &id));
    }

    static void turn(lks_transform& bone, const lks_vec3& axis, lks_fixed turns) {
        bone.rotation = product(turn_about(axis, turns), bone.rotation);
    }

    // From 0 to 1 in six tenths of a second.
    static lks_fixed since(lks_fixed seconds, lks_fixed start) {
        const lks_fixed part = (seconds - start) * 10 / 6;
        return part < 0 ? 0 : part > LKS_FIXED_ONE ? LKS_FIXED_ONE : part;
    }

    // Only how bones are turned against each other counts.
    void act(lks_fixed seconds, lks_transform (&pose)[LKS_HUMANOID_BONES]) const {
        for (std::uint32_t i = 0; i < LKS_HUMANOID_BONES; ++i) {
            pose[i] = mannequin_.bones[i].body.transform;
        }
        const lks_fixed raised = since(seconds, salute) - since(seconds, lower);
        // The elbow bent, the forearm turned upwards, and the arm out to the side: a hand at the brow.
        for (const std::uint32_t bone :
             {LKS_HUMANOID_UPPER_ARM_RIGHT, LKS_HUMANOID_LOWER_ARM_RIGHT, LKS_HUMANOID_HAND_RIGHT}) {
            if (bone != LKS_HUMANOID_UPPER_ARM_RIGHT) {
                turn(pose[bone], side_axis, -raised * 37 / 100);
            }
            turn(pose[bone], up_axis, -raised * 20 / 100);
            turn(pose[bone], front_axis, -raised * 24 / 100);
        }
        const lks_fixed bent = since(seconds, bow);
        for (const std::uint32_t bone :
             {LKS_HUMANOID_CHEST, LKS_HUMANOID_HEAD, LKS_HUMANOID_UPPER_ARM_LEFT, LKS_HUMANOID_LOWER_ARM_LEFT,
              LKS_HUMANOID_HAND_LEFT, LKS_HUMANOID_UPPER_ARM_RIGHT, LKS_HUMANOID_LOWER_ARM_RIGHT,
              LKS_HUMANOID_HAND_RIGHT}) {
            turn(pose[bone], side_axis, bent * 7 / 100);
        }
        turn(pose[LKS_HUMANOID_HEAD], side_axis, bent * 5 / 100);
    }

    bool apply_inputs(lks_fixed seconds) override {
        lks_transform pose[LKS_HUMANOID_BONES];
        act(seconds, pose);
        const lks_fixed strength = seconds < collapse ? LKS_FIXED_ONE : 0;
        return accept(lks_ragdoll_drive(world(), &def_, joints_, pose, strength, LKS_FIXED_RATIO(1, 20)));
    }

    Mannequin mannequin_;
    lks_ragdoll_def def_{};
    lks_body_id bodies_[LKS_HUMANOID_BONES];
    lks_joint_id joints_[LKS_HUMANOID_BONES - 1];
};

} // namespace

std::unique_ptr<Scene> make_sentry(const SceneInfo& info) {
    return std::make_unique<Sentry>(info);
}

} // namespace lks_demo
