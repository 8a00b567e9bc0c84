// A cart rolls over bumps, one side after the other, and into a pile of crates. Its rear wheels hang on
// springs, its front ones on two arms each, which close loops, with a rod that keeps them straight and a
// spring between.
#include "scenes/scene_list.h"
#include "scenes/time_curves.h"

namespace lks_demo {
namespace {

constexpr std::int64_t start = -4200; // of the cart's middle, along x
constexpr std::int64_t speed = 4600;
constexpr std::int64_t chassis_height = 560;
constexpr std::int64_t wheel_radius = 260;
constexpr std::int64_t front = 600;

// Local y along z.
lks_rotation along_z() {
    return turn_about({LKS_FIXED_ONE, 0, 0}, LKS_FIXED_RATIO(1, 4));
}

class Cart final : public Scene {
public:
    using Scene::Scene;

private:
    void configure(lks_world_def& def) override { def.substeps = 8; }

    bool build() override {
        camera_ = {{4.3f, 1.9f, 6.2f}, {0.3f, 0.35f, 0.0f}, 45.0f, {0.4f, 0.85f, 0.5f}};
        return add_ground(rgb(0x9aa08f)) && add_bump(-2000, 700) && add_bump(-900, -700) &&
               add_bump(200, 0) && add_chassis() && add_wheels() && add_driver() && add_crates() &&
               add_arms(-1) && add_arms(1);
    }

    // A bar across the way, the most of which is in the ground.
    bool add_bump(std::int64_t x, std::int64_t z) {
        lks_collider_def def = lks_default_collider_def();
        def.shape = LKS_SHAPE_CAPSULE;
        def.radius = millimetres(150);
        def.half_length = millimetres(z == 0 ? 1100 : 500);
        def.transform = {millimetres(x, -60, z), along_z()};
        def.static_friction = def.dynamic_friction = LKS_FIXED_RATIO(8, 10);
        ColliderLook look;
        look.colour = rgb(0x6f6a5f);
        return add_collider(def, look);
    }

    // What belongs to the cart meets nothing else of it.
    bool add_part(const char* name, const lks_body_shape* shapes, std::uint32_t count, const lks_vec3& place,
                  Rgb colour, lks_body_id& id, lks_fixed spin = 0) {
        lks_body_def def = lks_default_body_def();
        def.shapes = shapes;
        def.shape_count = count;
        def.transform.position = place;
        def.velocity = millimetres(speed, 0, 0);
        def.angular_velocity = {0, 0, spin};
        def.static_friction = def.dynamic_friction = LKS_FIXED_RATIO(8, 10);
        def.filter.group = -1;
        return add_body(name, def, colour, &id);
    }

    static lks_body_shape box(const lks_vec3& middle, const lks_vec3& half_extents, std::int64_t density) {
        lks_body_shape shape = lks_default_body_shape();
        shape.shape = LKS_SHAPE_BOX;
        shape.transform.position = middle;
        shape.half_extents = half_extents;
        shape.density = LKS_FIXED(density);
        return shape;
    }

    bool add_chassis() {
        const lks_body_shape shapes[] = {
            box(millimetres(0, 0, 0), millimetres(820, 70, 300), 500),
            box(millimetres(-260, 150, 0), millimetres(460, 80, 300), 300),
            box(millimetres(-640, 330, 0), millimetres(70, 200, 260), 200),
            box(millimetres(front, -190, 0), millimetres(90, 140, 110), 300),
        };
        return add_part("chassis", shapes, 4, millimetres(start, chassis_height, 0), rgb(0xb5402f), chassis_);
    }

    bool join(lks_joint_def def, lks_body_id a, lks_body_id b, const lks_vec3& on_a, const lks_vec3& on_b) {
        def.body_a = a;
        def.body_b = b;
        def.frame_a.position = on_a;
        def.frame_b.position = on_b;
        lks_joint_id id{};
        return accept(lks_world_add_joint(world(), &def, &id));
    }

    // A spring that yields by compliance times load, and the damper beside it.
    static lks_joint_def spring(lks_fixed compliance, std::int64_t damping) {
        lks_joint_def def = lks_default_joint_def();
        def.kind = LKS_JOINT_FIXED;
        def.compliance = compliance;
        def.damping = LKS_FIXED(damping);
        return def;
    }

    // On a spring, or, in front, on what add_arms adds.
    bool add_wheel(std::int64_t x, std::int64_t z) {
        const bool in_front = x == front;
        const lks_body_shape hub =
            box({}, in_front ? millimetres(40, 110, 40) : millimetres(70, 50, 90), 3000);
        lks_body_id& axle = hubs_[z > 0 ? 1 : 0];
        const std::int64_t inner = z - (z > 0 ? 150 : -150);
        if (!add_part("hub", &hub, 1, millimetres(start + x, wheel_radius, inner), rgb(0x4a4a4a), axle)) {
            return false;
        }
        lks_body_shape tyre = lks_default_body_shape();
        tyre.shape = LKS_SHAPE_CAPSULE;
        tyre.radius = millimetres(wheel_radius);
        tyre.half_length = millimetres(40);
        tyre.transform.rotation = along_z();
        tyre.density = LKS_FIXED(150);
        lks_body_id wheel{};
        if (!add_part("wheel", &tyre, 1, millimetres(start + x, wheel_radius, z), rgb(0x2c2f33), wheel,
                      -LKS_FIXED_RATIO(speed, wheel_radius))) {
            return false;
        }
        lks_joint_def hinge = lks_default_joint_def();
        hinge.kind = LKS_JOINT_HINGE;
        hinge.frame_a.rotation = hinge.frame_b.rotation = along_z();
        return (in_front || join(spring(LKS_FIXED_RATIO(8, 100000), 500), chassis_, axle,
                                 millimetres(x, wheel_radius - chassis_height, inner), {})) &&
               join(hinge, axle, wheel, millimetres(0, 0, z - inner), {});
    }

    bool add_wheels() {
        return add_wheel(-600, -560) && add_wheel(-600, 560) && add_wheel(front, -560) &&
               add_wheel(front, 560);
    }

    // From the chassis to above or below the hub's middle; hinges along x, balls at the hub.
    bool add_arm(std::int64_t side, std::int64_t height, lks_body_id& id) {
        constexpr std::int64_t in = 110, out = 410;
        const lks_body_shape shape = box({}, millimetres(45, 14, (out - in) / 2 - 20), 1500);
        const std::int64_t middle = (in + out) / 2;
        const std::int64_t up = wheel_radius + height;
        lks_joint_def hinge = lks_default_joint_def();
        hinge.kind = LKS_JOINT_HINGE;
        hinge.frame_a.rotation = hinge.frame_b.rotation =
            turn_about({0, 0, LKS_FIXED_ONE}, LKS_FIXED_RATIO(-1, 4));
        return add_part("arm", &shape, 1, millimetres(start + front, up, side * middle), rgb(0xd9b13b), id) &&
               join(hinge, chassis_, id, millimetres(front, up - chassis_height, side * in),
                    millimetres(0, 0, side * (in - middle))) &&
               join(lks_default_joint_def(), id, hubs_[side > 0 ? 1 : 0],
                    millimetres(0, 0, side * (out - middle)), millimetres(0, height, 0));
    }

    static lks_joint_def rod(std::int64_t length) {
        lks_joint_def def = lks_default_joint_def();
        def.kind = LKS_JOINT_DISTANCE;
        def.distance_min = def.distance_max = LKS_FIXED_RATIO(length, 1000);
        return def;
    }

    bool add_arms(std::int64_t side) {
        lks_body_id upper{}, lower{};
        // From the chassis above to the lower arm's end: 3-4-5.
        lks_joint_def strut = rod(300);
        strut.compliance = LKS_FIXED_RATIO(5, 100000);
        strut.damping = LKS_FIXED(900);
        return add_arm(side, 80, upper) && add_arm(side, -80, lower) &&
               join(rod(300), chassis_, hubs_[side > 0 ? 1 : 0],
                    millimetres(front - 60, wheel_radius - chassis_height, side * 110),
                    millimetres(-60, 0, 0)) &&
               join(strut, chassis_, lower, millimetres(front, 420 - chassis_height, side * 200),
                    millimetres(0, 0, side * 120));
    }

    // A head that nods on a soft neck.
    bool add_driver() {
        lks_body_shape shapes[] = {lks_default_body_shape(), lks_default_body_shape()};
        shapes[0].shape = LKS_SHAPE_CAPSULE;
        shapes[0].radius = millimetres(60);
        shapes[0].half_length = millimetres(90);
        shapes[1].radius = millimetres(180);
        shapes[1].transform.position = millimetres(0, 300, 0);
        for (lks_body_shape& shape : shapes) {
            shape.density = LKS_FIXED(300);
        }
        lks_body_id head{};
        lks_joint_def neck = spring(LKS_FIXED_RATIO(1, 1000), 20);
        neck.angular_compliance = LKS_FIXED_RATIO(4, 1000);
        neck.angular_damping = LKS_FIXED_RATIO(2, 10);
        return add_part("driver", shapes, 2, millimetres(start - 200, 900, 0), rgb(0xe0b184), head) &&
               join(neck, chassis_, head, millimetres(-200, 230, 0), millimetres(0, -110, 0));
    }

    bool add_crates() {
        bool good = true;
        for (int i = 0; i < 6; ++i) {
            const lks_body_shape shape = box({}, millimetres(200, 200, 200), 60);
            lks_body_def def = lks_default_body_def();
            def.shapes = &shape;
            def.shape_count = 1;
            const int row = i < 3 ? 0 : i < 5 ? 1 : 2;
            const int place = i < 3 ? i : i - (i < 5 ? 3 : 5);
            def.transform.position = millimetres(2400, 200 + 400 * row, -420 + 210 * row + 420 * place);
            good = good && add_body("crate", def, i % 2 == 0 ? rgb(0xb08a55) : rgb(0x9c7746));
        }
        return good;
    }

    lks_body_id chassis_{};
    lks_body_id hubs_[2]{}; // those of the last pair of wheels
};

} // namespace

std::unique_ptr<Scene> make_cart(const SceneInfo& info) {
    return std::make_unique<Cart>(info);
}

} // namespace lks_demo
