// A figure that is driven against a thin wall: where the tick begins it stands still, and its contacts have
// to know of the wall before it is struck.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/overlaps.h"
#include "support/sanitised.h"

using namespace support;

namespace {

constexpr double half_thickness = 0.025;

enum class Striker { ball, figure, car };
enum class Wall { fixed, moved, loose };

struct Blow {
    Striker striker;
    Wall wall;
    double gap; // metres between the figure and the wall
    double speed;
    double turn;   // degrees about the vertical
    double height; // of a ball and of a car, beside the figure's middle
    bool asleep;
    std::uint32_t substeps;
};

// Where its surface is furthest to the right.
double right_end(const Solid& solid) {
    if (solid.box) {
        return solid.centre.x + std::abs(solid.axes[0].x) * solid.half.x +
               std::abs(solid.axes[1].x) * solid.half.y + std::abs(solid.axes[2].x) * solid.half.z;
    }
    return solid.centre.x + std::abs(solid.axes[1].x) * solid.half_length + solid.radius;
}

class Street {
public:
    explicit Street(const Blow& blow) : world_(weightless(blow.substeps)), blow_(blow) {
        Humanoid human;
        human.def.transform.rotation = about(0, 1, 0, blow.turn);
        for (lks_bone& bone : human.bones) {
            bone.body.never_sleeps = blow.asleep ? 0 : 1;
        }
        REQUIRE(human.add(world_, bones_) == LKS_OK);
        double front = -1e9;
        for (std::uint32_t i = 0; i < LKS_HUMANOID_BONES; ++i) {
            const BodyState state = state_of(world_, bones_[i]);
            front = std::max(front, right_end(solid_of(human.shapes[i], state)));
            middle_ += state.position.y / LKS_HUMANOID_BONES;
        }
        add_wall(front + blow.gap + half_thickness);
        for (int tick = 0; blow.asleep && tick < 600 && lks_world_awake_body_count(world_) != 0; ++tick) {
            world_.step();
        }
        REQUIRE((lks_world_awake_body_count(world_) == 0) == blow.asleep);
    }

    // How many bones are beyond the middle of the wall a second after the blow.
    int bones_behind() {
        if (blow_.striker == Striker::car) {
            drive();
        } else {
            throw_something();
            world_.step(75);
        }
        const double middle = blow_.wall == Wall::fixed ? wall_ : state_of(world_, wall_body_).position.x;
        return static_cast<int>(std::count_if(bones_, bones_ + LKS_HUMANOID_BONES, [&](lks_body_id bone) {
            return state_of(world_, bone).position.x > middle;
        }));
    }

private:
    void add_wall(double x) {
        wall_ = x;
        if (blow_.wall == Wall::fixed) {
            add_box(world_, fixed(half_thickness, 10, 10), fixed(x, 0, 0));
            return;
        }
        lks_body_def def = lks_default_body_def();
        def.kind = blow_.wall == Wall::moved ? LKS_BODY_KINEMATIC : LKS_BODY_DYNAMIC;
        wall_body_ = add_body(world_, box_shape(half_thickness, 10, 10, 100000), fixed(x, 0, 0), def);
    }

    void throw_something() {
        // It arrives in the middle of a tick.
        const double way = 0.25 * blow_.speed + 0.013;
        if (blow_.striker == Striker::figure) {
            Humanoid other;
            other.def.transform = {fixed(-1 - way, 0.1, 0), about(0, 1, 0, 77 + blow_.turn)};
            other.def.velocity = fixed(blow_.speed, 0, 0);
            REQUIRE(other.add(world_) == LKS_OK);
            return;
        }
        lks_body_def def = lks_default_body_def();
        def.mass = LKS_FIXED(60);
        def.velocity = fixed(blow_.speed, 0, 0);
        add_body(world_, ball_shape(0.2), fixed(-0.5 - way, middle_ + blow_.height, 0.02), def);
    }

    // Of 1 m × 1 m × 1.8 m; it stops 60 cm in front of the wall.
    void drive() {
        lks_body_def def = lks_default_body_def();
        def.kind = LKS_BODY_KINEMATIC;
        const double height = middle_ + blow_.height - 0.4;
        double x = -1.013 - blow_.speed / 4;
        const lks_body_id car = add_body(world_, box_shape(0.5, 0.5, 0.9), fixed(x, height, 0), def);
        for (int tick = 0; tick < 75; ++tick) {
            x = std::min(x + blow_.speed / 60, wall_ - half_thickness - 1.1);
            const lks_transform place{fixed(x, height, 0), {0, 0, 0, LKS_ROTATION_ONE}};
            REQUIRE(lks_body_move_to(world_, car, place) == LKS_OK);
            world_.step();
        }
    }

    World world_;
    Blow blow_;
    lks_body_id bones_[LKS_HUMANOID_BONES];
    double middle_ = 0; // height
    double wall_ = 0;
    lks_body_id wall_body_{};
};

void check(const Blow& blow) {
    INFO("striker " << static_cast<int>(blow.striker) << ", wall " << static_cast<int>(blow.wall) << ", "
                    << blow.gap << " m from it, " << blow.speed << " m/s, turned by " << blow.turn
                    << " degrees, " << blow.height << " m high, asleep: " << blow.asleep << ", "
                    << blow.substeps << " substeps");
    CHECK(Street(blow).bones_behind() == 0);
}

} // namespace

TEST_CASE("a figure that a ball of its weight drives against a thin wall stays in front of it") {
    for (const double gap : {0.03, 0.1, 0.25}) {
        for (const double height : {-0.3, 0.2, 0.4}) {
            for (const double turn : {0., 90.}) {
                for (const double speed : {20., 60.}) {
                    if (support::sanitised && (turn != 0 || speed < 60)) {
                        continue;
                    }
                    check({Striker::ball, Wall::fixed, gap, speed, turn, height, false, 8});
                    check({Striker::ball, Wall::fixed, gap, speed, turn, height, true, 20});
                }
            }
        }
    }
    for (const Wall wall : {Wall::moved, Wall::loose}) {
        for (const double gap : {0.03, 0.1, 0.25}) {
            check({Striker::ball, wall, gap, 60, 0, 0.4, false, 8});
            check({Striker::ball, wall, gap, 60, 0, -0.3, false, 4});
        }
    }
}

TEST_CASE("a figure that another one is thrown at stays in front of a thin wall") {
    for (const double gap : {0.03, 0.1, 0.25}) {
        for (const double turn : {0., 40., 90.}) {
            check({Striker::figure, Wall::fixed, gap, 60, turn, 0, false, 8});
            check({Striker::figure, Wall::loose, gap, 60, turn, 0, turn == 0, 4});
        }
    }
}

TEST_CASE("a figure that a car drives against a thin wall stays in front of it") {
    for (const double gap : {0.03, 0.1, 0.25, 0.4}) {
        for (const double turn : {0., 40., 90.}) {
            check({Striker::car, Wall::fixed, gap, 40, turn, -0.3, false, 8});
            check({Striker::car, Wall::fixed, gap, 60, turn, 0.4, true, 8});
        }
    }
}
