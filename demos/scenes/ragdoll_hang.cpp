// A mannequin is held by the hands on two ropes. It swings; then it is pulled down, and the left rope tears
// off its hook.
#include "scenes/mannequin.h"
#include "scenes/scene_list.h"
#include "scenes/time_curves.h"

namespace lks_demo {
namespace {

constexpr std::int64_t lift = 900;       // of the feet over the ground, mm
constexpr std::int64_t shoulder_x = 205; // of the humanoid
constexpr std::int64_t shoulder_y = 1430;
constexpr std::int64_t arm = 630; // from the shoulder to the middle of the hand
constexpr std::uint32_t segments = 12;
constexpr std::int64_t rope_length = 1200;
constexpr std::int64_t hand_height = lift + shoulder_y;
constexpr std::int64_t beam_height = hand_height + rope_length;
constexpr std::int64_t hook_bears = 3500; // N: four and a half times its weight

class RagdollHang final : public Scene {
public:
    using Scene::Scene;

private:
    void configure(lks_world_def& def) override { def.substeps = 20; }

    bool build() override {
        camera_ = {{2.6f, 2.2f, 5.2f}, {0.0f, 1.85f, 0.0f}, 40.0f, {0.4f, 0.8f, 0.5f}};
        return add_ground(rgb(0xa19e99)) && add_beam() && add_mannequin() && add_ropes();
    }

    bool add_beam() {
        const Rgb wood = rgb(0x6e5a48);
        const std::int64_t half_post = beam_height / 2 + 60;
        bool good = true;
        for (const std::int64_t side : {-1, 1}) {
            good = good &&
                   add_block(millimetres(side * 1350, half_post, 0), millimetres(60, half_post, 60), wood);
        }
        return good && add_block(millimetres(0, beam_height + 90, 0), millimetres(1500, 60, 80), wood);
    }

    // Arms out to the sides, and a push: it swings before the ropes are taut.
    bool add_mannequin() {
        Mannequin mannequin;
        for (const std::uint32_t upper : {LKS_HUMANOID_UPPER_ARM_LEFT, LKS_HUMANOID_UPPER_ARM_RIGHT}) {
            mannequin.bones[upper].swing_limit = LKS_FIXED(170); // looser than a human's
            mannequin.bones[upper].twist_min = -LKS_FIXED(180);
            mannequin.bones[upper].twist_max = LKS_FIXED(180);
        }
        const MannequinLook look = mannequin_look(rgb(0xcf9a3e), rgb(0x33497f));
        lks_ragdoll_def def = lks_default_ragdoll_def();
        def.bones = mannequin.bones;
        def.bone_count = LKS_HUMANOID_BONES;
        def.transform.position = millimetres(0, lift, 0);
        if (!add_ragdoll("mannequin", def, look.bones, bodies_)) {
            return false;
        }
        lks_transform pose[LKS_HUMANOID_BONES];
        if (!accept(lks_ragdoll_pose(world(), bodies_, LKS_HUMANOID_BONES, pose))) {
            return false;
        }
        for (std::uint32_t i = 0; i < 3; ++i) {
            spread(pose[LKS_HUMANOID_UPPER_ARM_LEFT + i], 1);
            spread(pose[LKS_HUMANOID_UPPER_ARM_RIGHT + i], -1);
        }
        return accept(lks_ragdoll_set_pose(world(), bodies_, LKS_HUMANOID_BONES, pose, nullptr)) &&
               accept(lks_body_apply_impulse(world(), bodies_[LKS_HUMANOID_PELVIS],
                                             millimetres(15000, 0, 60000),
                                             place(millimetres(0, lift + 990, 0))));
    }

    // By a quarter turn about the shoulder, forward axis.
    void spread(lks_transform& bone, std::int64_t side) const {
        const lks_vec3 shoulder = place(millimetres(side * shoulder_x, lift + shoulder_y, 0));
        const lks_fixed x = bone.position.x - shoulder.x;
        const lks_fixed y = bone.position.y - shoulder.y;
        bone.position.x = shoulder.x - side * y;
        bone.position.y = shoulder.y + side * x;
        bone.rotation =
            product(turn_about({0, 0, LKS_FIXED_ONE}, side * LKS_FIXED_RATIO(1, 4)), bone.rotation);
    }

    bool add_ropes() {
        lks_rope_def def = lks_default_rope_def();
        def.segments = segments;
        def.length = 1.2;
        def.linear_density = 3.0;
        def.particle_radius = 0.02;
        const lks_asset* asset = nullptr;
        if (!create_rope(def, asset)) {
            return false;
        }
        const RopeLook look = {rgb(0xc2a072), rgb(0x7a5a38), 0.6f};
        for (const std::int64_t side : {1, -1}) {
            lks_object_def object = lks_default_object_def();
            // From the beam down.
            object.transform.position = millimetres(side * (shoulder_x + arm), beam_height, 0);
            object.transform.rotation = turn_about({0, 0, LKS_FIXED_ONE}, -LKS_FIXED_RATIO(1, 4));
            object.linear_damping = LKS_FIXED_RATIO(3, 10);
            if (!add_object(side > 0 ? "left" : "right", asset, object)) {
                return false;
            }
            look_as_rope(1.2, 0.02, look);
            const lks_body_id hand = bodies_[side > 0 ? LKS_HUMANOID_HAND_LEFT : LKS_HUMANOID_HAND_RIGHT];
            if (!tie(segments, hand, 0) ||
                !(side > 0 ? hang_on_hook(object.transform.position) : pin(last_object(), 0))) {
                return false;
            }
        }
        return true;
    }

    // The last object's vertex to a body's middle; 0 N: for good.
    bool tie(std::uint32_t vertex, lks_body_id body, std::int64_t break_force) {
        lks_attachment_def hold = lks_default_attachment_def();
        hold.object = last_object();
        hold.vertex = vertex;
        hold.body = body;
        hold.break_force = LKS_FIXED(break_force);
        lks_attachment_id id{};
        return accept(lks_world_add_attachment(world(), &hold, &id));
    }

    bool hang_on_hook(const lks_vec3& position) {
        lks_body_shape shape = lks_default_body_shape();
        shape.radius = millimetres(35);
        lks_body_def def = lks_default_body_def();
        def.kind = LKS_BODY_KINEMATIC;
        def.filter.mask = 0;
        def.transform.position = position;
        def.shapes = &shape;
        def.shape_count = 1;
        lks_body_id hook{};
        return add_body("hook", def, rgb(0x5f6f7f), &hook) && tie(0, hook, hook_bears);
    }

    bool apply_inputs(lks_fixed seconds) override {
        if (seconds != LKS_FIXED(3)) {
            return true;
        }
        lks_transform pelvis{};
        return accept(lks_body_transform(world(), bodies_[LKS_HUMANOID_PELVIS], &pelvis)) &&
               accept(lks_body_apply_impulse(world(), bodies_[LKS_HUMANOID_PELVIS],
                                             millimetres(0, -320000, 0), pelvis.position));
    }

    lks_body_id bodies_[LKS_HUMANOID_BONES];
};

} // namespace

std::unique_ptr<Scene> make_ragdoll_hang(const SceneInfo& info) {
    return std::make_unique<RagdollHang>(info);
}

} // namespace lks_demo
