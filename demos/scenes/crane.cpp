// What a game does to a scene from outside: a winch lifts a crate and lets it fall, a barrier is opened by
// the limits of its hinge and falls shut, and a banner is sent from pad to pad. Where something hits, a mark
// is left.
#include "scenes/scene_list.h"
#include "scenes/time_curves.h"

namespace lks_demo {
namespace {

constexpr lks_vec3 forward_axis = {0, 0, LKS_FIXED_ONE};
constexpr lks_vec3 up_axis = {0, LKS_FIXED_ONE, 0};

// The crane, mm.
constexpr std::int64_t crane_x = -1500;
constexpr std::int64_t drum_height = 2700;
constexpr std::int64_t half_crate = 300;
constexpr lks_vec3 hook = millimetres(170, half_crate, 110); // of the crate: it hangs askew
constexpr std::int64_t cable_long = drum_height - 2 * half_crate + 60;
constexpr std::int64_t cable_short = 1000;
constexpr std::int64_t cable_loose = 3000;

// The barrier.
constexpr std::int64_t hinge_x = -500;
constexpr std::int64_t hinge_height = 850;
constexpr std::int64_t hinge_z = 1100;
constexpr std::int64_t half_arm = 800;
constexpr lks_fixed opened = LKS_FIXED(70); // degrees

// The banner and its pads.
constexpr std::int64_t pad_x = 1500;
constexpr std::int64_t far_pad_z = -900;
constexpr std::int64_t near_pad_z = 900;
constexpr std::int64_t bar_height = 1750;
constexpr std::int64_t half_bar = 330;
constexpr std::uint32_t columns = 15;
constexpr std::uint32_t rows = 25;

// Marks are a hand's breadth of chalk, and of what is harder than a knock.
constexpr lks_fixed least_impulse = LKS_FIXED(4);
constexpr std::size_t most_marks = 12;

class Crane final : public Scene {
public:
    using Scene::Scene;

private:
    void configure(lks_world_def& def) override { def.substeps = 20; }

    bool build() override {
        camera_ = {{0.7f, 2.6f, 5.7f}, {0.0f, 1.2f, 0.0f}, 38.0f, {0.45f, 0.8f, 0.5f}};
        leave_marks(most_marks, rgb(0xf3efe6));
        return add_ground(rgb(0xa19e99)) && add_gantry() && add_crate() && add_cable() && add_barrier() &&
               add_pads() && add_stand() && add_banner() &&
               accept(
                   lks_world_record_events(world(), LKS_EVENT_BIT(LKS_EVENT_CONTACT_HIT), least_impulse, 64));
    }

    bool add_gantry() {
        const Rgb wood = rgb(0x6e5a48);
        for (const std::int64_t side : {-1, 1}) {
            if (!add_block(millimetres(crane_x, drum_height / 2, side * 700),
                           millimetres(70, drum_height / 2, 70), wood)) {
                return false;
            }
        }
        lks_body_shape shape = lks_default_body_shape();
        shape.shape = LKS_SHAPE_CAPSULE;
        shape.radius = millimetres(90);
        shape.half_length = millimetres(700);
        shape.transform.rotation = turn_about({LKS_FIXED_ONE, 0, 0}, LKS_FIXED_RATIO(1, 4));
        lks_body_def def = lks_default_body_def();
        def.kind = LKS_BODY_KINEMATIC;
        def.transform.position = millimetres(crane_x, drum_height, 0);
        def.shapes = &shape;
        def.shape_count = 1;
        return add_body("drum", def, rgb(0x5f6f7f), &drum_);
    }

    bool add_crate() {
        lks_body_shape shape = lks_default_body_shape();
        shape.shape = LKS_SHAPE_BOX;
        shape.half_extents = millimetres(half_crate, half_crate, half_crate);
        shape.density = LKS_FIXED(300);
        lks_body_def def = lks_default_body_def();
        def.transform.position = millimetres(crane_x, half_crate, 0);
        def.shapes = &shape;
        def.shape_count = 1;
        lks_joint_def cable = lks_default_joint_def();
        cable.kind = LKS_JOINT_DISTANCE;
        cable.frame_b.position = hook;
        cable.distance_max = millimetres(cable_long);
        if (!add_body("crate", def, rgb(0xb08a5b), &crate_)) {
            return false;
        }
        cable.body_a = drum_;
        cable.body_b = crate_;
        return accept(lks_world_add_joint(world(), &cable, &winch_));
    }

    // What is seen of the winch: a thread so limp that it is as long as it has to be.
    bool add_cable() {
        lks_rope_def def = lks_default_rope_def();
        def.segments = 1;
        def.length = 1;
        def.linear_density = 0.02;
        def.stretch.compliance = 1;
        const lks_asset* asset = nullptr;
        lks_object_def object = lks_default_object_def();
        object.transform.position = millimetres(crane_x, drum_height, 0);
        object.transform.rotation = turn_about(forward_axis, -LKS_FIXED_RATIO(1, 4));
        if (!create_rope(def, asset) || !add_object("cable", asset, object)) {
            return false;
        }
        look_as_rope(1, 0.018, {rgb(0x3a3a3c), rgb(0x3a3a3c), 0.0f});
        const lks_vec3 end = place({millimetres(crane_x) + hook.x, millimetres(half_crate) + hook.y, hook.z});
        return accept(lks_object_set_positions(world(), last_object(), 1, 1, &end)) &&
               hold(0, drum_, {0, 0, 0}) && hold(1, crate_, hook);
    }

    bool hold(std::uint32_t vertex, lks_body_id body, const lks_vec3& point) {
        lks_attachment_def def = lks_default_attachment_def();
        def.object = last_object();
        def.vertex = vertex;
        def.body = body;
        def.point = point;
        lks_attachment_id id{};
        return accept(lks_world_add_attachment(world(), &def, &id));
    }

    // Striped arm on a post; its other end comes to lie on a second one.
    bool add_barrier() {
        const Rgb grey = rgb(0x5f6f7f);
        lks_body_shape shape = lks_default_body_shape();
        shape.shape = LKS_SHAPE_BOX;
        shape.half_extents = millimetres(90, hinge_height / 2, 90);
        lks_body_def def = lks_default_body_def();
        def.kind = LKS_BODY_KINEMATIC;
        def.transform.position = millimetres(hinge_x, hinge_height / 2, hinge_z);
        def.shapes = &shape;
        def.shape_count = 1;
        lks_body_id post{};
        if (!add_body("post", def, grey, &post)) {
            return false;
        }
        shape.half_extents = millimetres(half_arm, 45, 45);
        shape.density = LKS_FIXED(700);
        def = lks_default_body_def();
        def.transform.position = millimetres(hinge_x + half_arm, hinge_height + 60, hinge_z);
        def.shapes = &shape;
        def.shape_count = 1;
        lks_body_id arm{};
        lks_joint_def hinge = lks_default_joint_def();
        hinge.kind = LKS_JOINT_HINGE;
        hinge.frame_a.position = millimetres(0, hinge_height / 2 + 60, 0);
        hinge.frame_b.position = millimetres(-half_arm, 0, 0);
        // About z: local y along it.
        hinge.frame_a.rotation = turn_about({LKS_FIXED_ONE, 0, 0}, LKS_FIXED_RATIO(1, 4));
        hinge.frame_b.rotation = hinge.frame_a.rotation;
        hinge.twist_min = 0;
        hinge.twist_max = 0;
        if (!add_body("arm", def, rgb(0xc2453a), &arm)) {
            return false;
        }
        hinge.body_a = post;
        hinge.body_b = arm;
        return add_block(millimetres(hinge_x + 2 * half_arm - 150, hinge_height / 2, hinge_z),
                         millimetres(70, hinge_height / 2, 70), grey) &&
               accept(lks_world_add_joint(world(), &hinge, &hinge_));
    }

    bool add_pads() {
        return add_block(millimetres(pad_x, 15, far_pad_z), millimetres(420, 15, 420), rgb(0x3f7f8c)) &&
               add_block(millimetres(pad_x, 15, near_pad_z), millimetres(420, 15, 420), rgb(0xbf6b4b));
    }

    // A pole with a bar on it.
    bool add_stand() {
        lks_body_shape shapes[2] = {lks_default_body_shape(), lks_default_body_shape()};
        for (lks_body_shape& shape : shapes) {
            shape.shape = LKS_SHAPE_CAPSULE;
            shape.radius = millimetres(25);
        }
        shapes[0].half_length = millimetres(bar_height / 2 - 30);
        shapes[0].transform.position = millimetres(0, bar_height / 2, 0);
        shapes[1].half_length = millimetres(half_bar);
        shapes[1].transform.position = millimetres(0, bar_height, 0);
        shapes[1].transform.rotation = turn_about(forward_axis, LKS_FIXED_RATIO(1, 4));
        lks_body_def def = lks_default_body_def();
        def.kind = LKS_BODY_KINEMATIC;
        def.transform = stand_at(0, false);
        def.shapes = shapes;
        def.shape_count = 2;
        return add_body("stand", def, rgb(0xcfc8ba), &stand_);
    }

    // It turns to and fro, so that the banner is on the move when it is sent.
    static lks_transform stand_at(lks_fixed seconds, bool near) {
        lks_transform at = lks_transform_identity();
        at.position = millimetres(pad_x, 40, near ? near_pad_z : far_pad_z);
        const lks_fixed turn = sine_of_turns(seconds * 3 / 5) / 12 + (near ? LKS_FIXED_RATIO(1, 8) : 0);
        at.rotation = turn_about(up_axis, turn);
        return at;
    }

    bool add_banner() {
        lks_cloth_def def = lks_default_cloth_def();
        def.columns = columns;
        def.rows = rows;
        def.width = 2.0 * half_bar / 1000;
        def.height = 1.1;
        def.area_density = 0.25;
        def.bend.compliance = 1e-3;
        def.particle_radius = 0.01;
        const lks_asset* asset = nullptr;
        lks_object_def object = lks_default_object_def();
        object.transform = stand_at(0, false);
        object.transform.position.y += millimetres(bar_height - 40 - 550);
        object.transform.position.z += millimetres(40);
        object.linear_damping = LKS_FIXED_RATIO(1, 2);
        ClothLook look;
        look.front = {Pattern::stripes, rgb(0x33497f), rgb(0xeadfc8), rgb(0xcf9a3e), 0.22f};
        look.back = {Pattern::plain, rgb(0x2b3d69), rgb(0x2b3d69), rgb(0xcf9a3e), 0.2f};
        if (!create_cloth(def, asset) || !add_object("banner", asset, object)) {
            return false;
        }
        look_as_grid(def, look);
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::int64_t across =
                (2 * static_cast<std::int64_t>(column) - (columns - 1)) * half_bar / (columns - 1);
            if (!hold(column, stand_, millimetres(across, bar_height, 40))) {
                return false;
            }
        }
        return true;
    }

    bool apply_inputs(lks_fixed seconds) override {
        return wind(seconds) && open(seconds) && turn_or_send(seconds);
    }

    // Up within two seconds, and lets go.
    bool wind(lks_fixed seconds) {
        lks_limits limits{};
        if (!accept(lks_joint_limits(world(), winch_, &limits))) {
            return false;
        }
        limits.distance_max = seconds < millimetres(3100)
                                  ? mix(millimetres(cable_long), millimetres(cable_short),
                                        smooth_step(seconds, millimetres(300), LKS_FIXED(2)))
                                  : millimetres(cable_loose);
        return accept(lks_joint_set_limits(world(), winch_, &limits));
    }

    // The limits lift it, and leave it to its weight.
    bool open(lks_fixed seconds) {
        lks_limits limits{};
        if (!accept(lks_joint_limits(world(), hinge_, &limits))) {
            return false;
        }
        const bool held = seconds < millimetres(2600);
        const lks_fixed lifted =
            coarse_product(opened, smooth_step(seconds, millimetres(500), millimetres(1500)));
        limits.twist_min = held ? lifted : 0;
        limits.twist_max = held ? lifted : opened;
        return accept(lks_joint_set_limits(world(), hinge_, &limits));
    }

    bool turn_or_send(lks_fixed seconds) {
        const lks_fixed tick = LKS_FIXED_RATIO(1, lks_world_tick_rate(world()));
        const bool near = is_near(seconds);
        lks_transform to = stand_at(seconds, near);
        to.position = place(to.position);
        if (near != is_near(seconds - tick)) {
            lks_transform from = stand_at(seconds, !near);
            from.position = place(from.position);
            if (!accept(lks_body_set_transform(world(), stand_, to)) ||
                !accept(lks_object_teleport(world(), last_object(), &from, &to))) {
                return false;
            }
        }
        lks_transform next = stand_at(seconds + tick, near);
        next.position = place(next.position);
        return accept(lks_body_move_to(world(), stand_, next));
    }

    static bool is_near(lks_fixed seconds) {
        return seconds >= millimetres(2200) && seconds < millimetres(4400);
    }

    lks_body_id drum_{}, crate_{}, stand_{};
    lks_joint_id winch_{}, hinge_{};
};

} // namespace

std::unique_ptr<Scene> make_crane(const SceneInfo& info) {
    return std::make_unique<Crane>(info);
}

} // namespace lks_demo
