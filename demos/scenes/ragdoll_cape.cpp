// A mannequin walks in a circle: its pelvis is animated, everything else is turned by its own muscles towards
// the pose of a walk. On its shoulders hangs a cape.
#include "scenes/caped_scene.h"
#include "scenes/mannequin.h"
#include "scenes/scene_list.h"
#include "scenes/time_curves.h"

namespace lks_demo {
namespace {

constexpr std::int64_t radius = 1300;          // of the circle, mm
constexpr lks_fixed round_time = LKS_FIXED(8); // seconds
constexpr lks_fixed step_time = LKS_FIXED(1);  // of two steps
constexpr lks_vec3 side_axis = {LKS_FIXED_ONE, 0, 0};
constexpr lks_vec3 up_axis = {0, LKS_FIXED_ONE, 0};

class RagdollCape final : public CapedScene {
public:
    using CapedScene::CapedScene;

private:
    void configure(lks_world_def& def) override { def.substeps = 20; }

    bool build() override {
        camera_ = {{3.4f, 2.1f, 4.2f}, {0.0f, 0.85f, 0.0f}, 36.0f, {0.4f, 0.8f, 0.5f}};
        return add_ground(rgb(0xa19e99)) && add_mannequin() &&
               add_cape(bodies_[LKS_HUMANOID_CHEST], millimetres(radius, 0, 0), rgb(0x9c2530), rgb(0x7d1d28));
    }

    bool add_mannequin() {
        mannequin_.bones[LKS_HUMANOID_PELVIS].body.kind = LKS_BODY_KINEMATIC;
        def_ = lks_default_ragdoll_def();
        def_.bones = mannequin_.bones;
        def_.bone_count = LKS_HUMANOID_BONES;
        def_.transform.position = millimetres(radius, 4, 0);
        def_.group = -1;
        const MannequinLook look = mannequin_look(rgb(0x3c4a63), rgb(0x5c5148));
        return add_ragdoll("mannequin", def_, look.bones, bodies_, joints_);
    }

    static void turn(lks_transform& bone, lks_fixed turns) {
        bone.rotation = product(turn_about(side_axis, turns), bone.rotation);
    }

    // The pose of a walk, `phase` in turns: only how bones are turned against each other counts.
    void stride(lks_fixed phase, lks_transform (&pose)[LKS_HUMANOID_BONES]) const {
        for (std::uint32_t i = 0; i < LKS_HUMANOID_BONES; ++i) {
            pose[i] = mannequin_.bones[i].body.transform;
        }
        for (int side = 0; side < 2; ++side) {
            const lks_fixed own = phase + side * LKS_FIXED_ONE / 2;
            const lks_fixed swing = sine_of_turns(own);
            const lks_fixed lifted = sine_of_turns(own + LKS_FIXED_RATIO(1, 4));
            const lks_fixed thigh = -swing * 7 / 100 - LKS_FIXED_RATIO(1, 100);
            const lks_fixed knee = LKS_FIXED_RATIO(2, 100) + (lifted > 0 ? lifted * 13 / 100 : 0);
            const std::uint32_t leg = side == 0 ? LKS_HUMANOID_UPPER_LEG_LEFT : LKS_HUMANOID_UPPER_LEG_RIGHT;
            turn(pose[leg], thigh);
            turn(pose[leg + 1], thigh + knee);
            turn(pose[leg + 2], thigh / 2);
            // Arms swing against the legs.
            const std::uint32_t arm = side == 0 ? LKS_HUMANOID_UPPER_ARM_LEFT : LKS_HUMANOID_UPPER_ARM_RIGHT;
            turn(pose[arm], swing * 6 / 100);
            turn(pose[arm + 1], swing * 6 / 100 - LKS_FIXED_RATIO(8, 100));
            turn(pose[arm + 2], swing * 6 / 100 - LKS_FIXED_RATIO(8, 100));
        }
        turn(pose[LKS_HUMANOID_CHEST], LKS_FIXED_RATIO(1, 100));
    }

    // Where on the circle, so many turns after the start; it starts to walk within a second.
    static lks_fixed way(lks_fixed seconds) {
        const lks_fixed start =
            seconds < LKS_FIXED_ONE ? coarse_product(seconds, seconds) / 2 : seconds - LKS_FIXED_ONE / 2;
        return start / (round_time / LKS_FIXED_ONE);
    }

    bool apply_inputs(lks_fixed seconds) override {
        const lks_fixed tick = LKS_FIXED_RATIO(1, lks_world_tick_rate(world()));
        const lks_fixed turns = way(seconds + tick);
        const lks_fixed phase = turns * (round_time / step_time);
        lks_transform pelvis = mannequin_.bones[LKS_HUMANOID_PELVIS].body.transform;
        const lks_fixed bob = sine_of_turns(2 * phase) * 12 / 1000;
        pelvis.position =
            place({coarse_product(millimetres(radius), sine_of_turns(turns + LKS_FIXED_RATIO(1, 4))),
                   pelvis.position.y + bob, coarse_product(millimetres(radius), sine_of_turns(turns))});
        pelvis.rotation = turn_about(up_axis, -turns);
        lks_transform pose[LKS_HUMANOID_BONES];
        stride(phase, pose);
        return accept(lks_body_move_to(world(), bodies_[LKS_HUMANOID_PELVIS], pelvis)) &&
               accept(
                   lks_ragdoll_drive(world(), &def_, joints_, pose, LKS_FIXED_ONE, LKS_FIXED_RATIO(1, 20)));
    }

    Mannequin mannequin_;
    lks_ragdoll_def def_{};
    lks_body_id bodies_[LKS_HUMANOID_BONES];
    lks_joint_id joints_[LKS_HUMANOID_BONES - 1];
};

} // namespace

std::unique_ptr<Scene> make_ragdoll_cape(const SceneInfo& info) {
    return std::make_unique<RagdollCape>(info);
}

} // namespace lks_demo
