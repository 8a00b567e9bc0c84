// Worlds made of values at the ends of their ranges and just beyond, in any combination. Each call is refused
// with a sentence and changes nothing, or the world goes on: whatever it came to, its image loads, and the
// loaded world has the same future.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "support/bodies.h"
#include "support/builders.h"
#include "support/random.h"
#include "support/sanitised.h"

using namespace support;

namespace {

// Values from a range: its ends as often as what lies between, small numbers as often as large ones. Some
// definitions have one beyond an end.
class EdgeValues {
public:
    explicit EdgeValues(std::uint64_t seed) : random_(seed) {}

    std::uint32_t below(std::size_t count) { return static_cast<std::uint32_t>(random_.next() % count); }
    bool chance(int percent) { return below(100) < static_cast<std::uint32_t>(percent); }

    // From here on values may lie beyond.
    void begin_definition() { beyond_ = chance(8); }

    std::int64_t whole(std::int64_t low, std::int64_t high) {
        if (beyond_ && chance(10)) {
            const std::int64_t outside[] = {low - 1, high + 1, INT64_MIN, INT64_MAX};
            return outside[below(4)];
        }
        switch (below(6)) {
        case 0:
            return low;
        case 1:
            return high;
        case 2:
            return std::clamp<std::int64_t>(0, low, high);
        default:
            return std::clamp(magnitude(), low, high);
        }
    }
    lks_fixed number(double low, double high) { return whole(fixed(low), fixed(high)); }
    // What a game would give, mostly.
    lks_fixed usual(double value, double low, double high) {
        return chance(60) ? fixed(value) : number(low, high);
    }
    std::uint32_t choice(std::uint32_t count) { return below(beyond_ && chance(10) ? count + 2 : count); }
    lks_vec3 vector(double reach) {
        return {number(-reach, reach), number(-reach, reach), number(-reach, reach)};
    }
    // In a room of a few metres, mostly.
    lks_vec3 place(double reach) {
        if (chance(10)) {
            return vector(reach);
        }
        const auto near = [&] { return static_cast<std::int64_t>(random_.next()) >> 21; };
        return chance(30) ? lks_vec3{0, 0, 0} : lks_vec3{near(), near(), near()};
    }
    lks_rotation rotation() {
        switch (below(5)) {
        case 0:
            return {0, 0, 0, LKS_ROTATION_ONE};
        case 1: {
            const lks_rotation half_turns[] = {
                {LKS_ROTATION_ONE, 0, 0, 0}, {0, -LKS_ROTATION_ONE, 0, 0}, {0, 0, 0, -LKS_ROTATION_ONE}};
            return half_turns[below(3)];
        }
        case 2:
            return beyond_ ? lks_rotation{INT32_MIN, INT32_MAX, 0, 1} : about(1, 0, 0, 180);
        default:
            return about(static_cast<double>(below(1001)) - 500, static_cast<double>(below(1001)) - 500, 1,
                         static_cast<double>(below(3600)) / 10);
        }
    }
    lks_transform transform(double reach) { return {place(reach), rotation()}; }
    lks_filter filter() {
        if (chance(70)) {
            return lks_default_body_def().filter;
        }
        return {static_cast<std::uint32_t>(random_.next()), static_cast<std::uint32_t>(random_.next()),
                static_cast<std::int32_t>(whole(INT32_MIN, INT32_MAX))};
    }
    // Of compliances and dampings.
    lks_fixed coefficient(double high) { return chance(50) ? 0 : number(0, high); }

private:
    std::int64_t magnitude() {
        const auto value = static_cast<std::int64_t>(random_.next() >> 1 >> below(63));
        return chance(50) ? -value : value;
    }

    Random random_;
    bool beyond_ = false;
};

struct Assets {
    std::vector<Asset> all;

    explicit Assets(EdgeValues& values) {
        const double compliances[] = {0, 1e-12, 1e-7, 1e-3, 1, 1e3};
        const double masses[] = {1e-8, 1e-5, 1e-3, 1, 1e4, 1e6};
        const double lengths[] = {1e-6, 1e-3, 0.1, 1, 59};
        for (int i = 0; i < 3; ++i) {
            Chain chain;
            chain.segments = 1 + values.below(40);
            chain.length = lengths[values.below(5)];
            chain.particle_mass = masses[values.below(6)];
            chain.end_mass = values.chance(50) ? 0 : masses[values.below(6)];
            chain.stretch = soft(compliances[values.below(6)], values.chance(50) ? 0 : 1e9);
            chain.bend = values.chance(50) ? off : soft(compliances[values.below(6)]);
            chain.solver = values.below(3);
            all.push_back(chain.build());
        }
        Net net;
        net.side = 2 + values.below(12);
        net.width = lengths[values.below(5)];
        net.particle_mass = masses[values.below(6)];
        net.stretch = soft(compliances[values.below(6)], values.chance(70) ? 0 : 1e9);
        net.bend = soft(compliances[values.below(6)]);
        net.radius = values.chance(50) ? 0.01 : 1;
        net.friction = values.chance(50) ? 1 : 100;
        if (values.chance(30)) {
            net.anchors = {0};
        }
        all.push_back(net.build());
    }
};

class EdgeWorld {
public:
    EdgeWorld(std::uint64_t seed, std::uint32_t workers, lks_simd simd)
        : values_(seed), assets_(values_), def_(definition(workers, simd)), world_(def_) {}

    // The hashes behind its ticks.
    std::vector<std::uint64_t> run(int calls) {
        std::vector<std::uint64_t> hashes;
        for (int i = 0; i < calls; ++i) {
            if (i % 8 == 7) {
                world_.step(1 + values_.below(3));
                hashes.push_back(world_.hash());
            } else {
                call();
            }
        }
        return hashes;
    }

    // Of a world that is loaded from this one's image.
    void check_image() {
        const Image image = world_.save();
        World twin(def_);
        for (const Asset& asset : assets_.all) {
            REQUIRE(lks_world_register_asset(twin, asset) == LKS_OK);
        }
        const lks_result result = lks_world_load(twin, image.data(), image.size());
        INFO(twin.message());
        REQUIRE(result == LKS_OK);
        CHECK(twin.hash() == world_.hash());
        CHECK(twin.save() == image);
        for (int i = 0; i < 3; ++i) {
            world_.step();
            twin.step();
            CHECK(twin.hash() == world_.hash());
        }
    }

    int refused = 0;
    int accepted = 0;

private:
    lks_world_def definition(std::uint32_t workers, lks_simd simd) {
        const struct {
            std::uint32_t rate, substeps, iterations;
        } rates[] = {{60, 8, 1}, {60, 1, 1},    {60, 20, 1},   {1, 1, 1},  {1, 4, 2},
                     {10, 2, 3}, {10000, 1, 1}, {1000, 10, 1}, {30, 1, 20}};
        const auto& rate = rates[values_.chance(50) ? 0 : values_.below(std::size(rates))];
        lks_world_def def = world_def(rate.rate, rate.substeps, rate.iterations);
        def.worker_count = workers;
        def.simd = static_cast<std::uint32_t>(simd);
        def.keep_previous_positions = values_.below(2);
        if (values_.chance(30)) {
            def.gravity = values_.vector(1000);
        }
        return def;
    }

    template <typename Call>
    bool give(const Call& call) {
        const std::uint64_t before = world_.hash();
        const lks_result result = call();
        if (result == LKS_OK) {
            ++accepted;
            return true;
        }
        ++refused;
        CHECK(world_.hash() == before);
        CHECK(world_.message().size() > 10);
        CHECK(lks_world_last_error(world_)->result == result);
        return false;
    }

    void call() {
        values_.begin_definition();
        switch (values_.below(20)) {
        case 0:
        case 1:
        case 2:
            return add_body();
        case 3:
        case 4:
            return add_joint();
        case 5:
            return add_object();
        case 6:
            return add_collider();
        case 7:
            return add_attachment();
        case 8:
            return add_figure();
        case 9:
        case 10:
        case 11:
            return change_body();
        case 12:
        case 13:
            return change_joint();
        case 14:
        case 15:
            return change_object();
        case 16:
            return change_collider();
        case 17:
            return remove_one();
        case 18:
            return static_cast<void>(
                give([&] { return lks_world_set_gravity(world_, values_.vector(1000)); }));
        default:
            return query();
        }
    }

    double speed_limit() const { return metres(lks_world_speed_limit(world_)); }
    double spin_limit() const { return metres(lks_world_spin_limit(world_)); }
    lks_vec3 velocity() { return values_.chance(50) ? lks_vec3{0, 0, 0} : values_.vector(speed_limit()); }
    lks_vec3 spin() { return values_.chance(50) ? lks_vec3{0, 0, 0} : values_.vector(spin_limit()); }

    // Some that never were, or are no more.
    template <typename Id>
    Id any(const std::vector<Id>& ids) {
        return ids.empty() || values_.chance(2) ? Id{values_.below(50), values_.below(3)}
                                                : ids[values_.below(ids.size())];
    }

    lks_body_shape shape() {
        lks_body_shape shape = lks_default_body_shape();
        shape.shape = 1 + values_.choice(3);
        if (values_.chance(30)) {
            shape.transform = values_.transform(30);
        }
        const bool round = shape.shape != LKS_SHAPE_BOX;
        shape.radius = round ? values_.usual(0.1, 0.001, 30) : 0;
        shape.half_length = shape.shape == LKS_SHAPE_CAPSULE ? values_.usual(0.2, 0, 30) : 0;
        const auto half = [&] { return round ? 0 : values_.usual(0.2, 0.001, 30); };
        shape.half_extents = {half(), half(), half()};
        shape.density = values_.usual(1000, 0.001, 100000);
        return shape;
    }
    void set_surface(lks_fixed& static_friction, lks_fixed& dynamic_friction, lks_fixed& restitution) {
        static_friction = values_.usual(0.5, 0, 100);
        dynamic_friction = values_.chance(80) ? std::min(static_friction, fixed(0.4)) : static_friction;
        restitution = values_.usual(0, 0, 1);
    }
    lks_body_def body_def() {
        lks_body_def def = lks_default_body_def();
        def.kind = values_.chance(85) ? std::uint32_t{LKS_BODY_DYNAMIC} : values_.choice(2);
        def.transform = values_.transform(8388000);
        def.velocity = velocity();
        def.angular_velocity = spin();
        def.never_sleeps = values_.choice(2);
        def.mass = values_.chance(60) ? 0 : values_.number(0.000001, 1000000);
        def.gravity_factor = values_.usual(1, -100, 100);
        def.linear_damping = values_.coefficient(1000);
        def.angular_damping = values_.coefficient(1000);
        set_surface(def.static_friction, def.dynamic_friction, def.restitution);
        def.filter = values_.filter();
        return def;
    }
    void add_body() {
        lks_body_shape shapes[6];
        for (lks_body_shape& one : shapes) {
            one = shape();
        }
        lks_body_def def = body_def();
        def.shapes = shapes;
        def.shape_count = values_.chance(80) ? 1 : values_.choice(4);
        lks_body_id id{};
        if (give([&] { return lks_world_add_body(world_, &def, &id); })) {
            bodies_.push_back(id);
        }
    }

    void add_joint() {
        lks_joint_def def = lks_default_joint_def();
        def.kind = values_.choice(4);
        def.body_a = any(bodies_);
        def.body_b = any(bodies_);
        def.frame_a = {values_.chance(70) ? lks_vec3{0, fixed(0.2), 0} : values_.place(64),
                       values_.rotation()};
        def.frame_b = {values_.chance(70) ? lks_vec3{0, fixed(-0.2), 0} : values_.place(64),
                       values_.rotation()};
        def.bodies_collide = values_.choice(2);
        set_limits(def.swing_limit, def.swing_limit_z, def.twist_min, def.twist_max, def.distance_min,
                   def.distance_max);
        def.compliance = values_.coefficient(1000);
        def.damping = values_.coefficient(1000000);
        def.angular_compliance = values_.coefficient(1000);
        def.angular_damping = values_.coefficient(1000000);
        def.limit_compliance = values_.coefficient(1000);
        def.limit_damping = values_.coefficient(1000000);
        def.friction = values_.coefficient(1000000);
        def.break_force = values_.chance(80) ? 0 : values_.number(0, 8000000);
        def.break_torque = values_.chance(80) ? 0 : values_.number(0, 8000000);
        lks_joint_id id{};
        if (give([&] { return lks_world_add_joint(world_, &def, &id); })) {
            joints_.push_back(id);
        }
    }
    void set_limits(lks_fixed& swing, lks_fixed& swing_z, lks_fixed& twist_min, lks_fixed& twist_max,
                    lks_fixed& distance_min, lks_fixed& distance_max) {
        swing = values_.number(0, 180);
        swing_z = values_.chance(50) ? -1 : values_.number(0, 180);
        twist_min = values_.number(-180, 0);
        twist_max = values_.number(0, 180);
        distance_min = values_.coefficient(64);
        distance_max = std::max(distance_min, values_.number(0, 64));
    }

    void add_figure() {
        Humanoid human;
        human.def.transform = values_.transform(8388000);
        human.def.velocity = velocity();
        human.def.scale = values_.usual(1, 0.05, 20);
        human.def.group = static_cast<std::int32_t>(values_.whole(-1, 1));
        std::vector<lks_body_id> bodies(LKS_HUMANOID_BONES);
        std::vector<lks_joint_id> joints(LKS_HUMANOID_BONES - 1);
        if (figures_ < 3 && give([&] { return human.add(world_, bodies.data(), joints.data()); })) {
            ++figures_;
            bodies_.insert(bodies_.end(), bodies.begin(), bodies.end());
            joints_.insert(joints_.end(), joints.begin(), joints.end());
        }
    }

    void add_object() {
        lks_object_def def = lks_default_object_def();
        def.asset = assets_.all[values_.below(assets_.all.size())];
        def.record_forces = values_.choice(2);
        def.transform = values_.transform(8388000);
        def.velocity = velocity();
        def.gravity_factor = values_.usual(1, -100, 100);
        def.linear_damping = values_.coefficient(1000);
        lks_object_id id{};
        if (give([&] { return lks_world_add_object(world_, &def, &id); })) {
            objects_.push_back(id);
        }
    }

    void add_collider() {
        lks_collider_def def = lks_default_collider_def();
        const lks_body_shape like = shape();
        def.shape = values_.choice(4);
        def.transform = values_.transform(8388000);
        def.radius = like.radius == 0 ? fixed(0.1) : like.radius;
        def.half_length = like.half_length;
        def.half_extents = like.half_extents.x == 0 ? fixed(1, 0.1, 1) : like.half_extents;
        set_surface(def.static_friction, def.dynamic_friction, def.restitution);
        def.filter = values_.filter();
        lks_collider_id id{};
        if (give([&] { return lks_world_add_collider(world_, &def, &id); })) {
            colliders_.push_back(id);
        }
    }

    void add_attachment() {
        lks_attachment_def def = lks_default_attachment_def();
        def.kind = values_.choice(2);
        def.object = any(objects_);
        def.vertex = values_.below(values_.chance(80) ? 2 : 200);
        if (def.kind == LKS_ATTACHMENT_TO_VERTEX) {
            def.other_object = any(objects_);
            def.other_vertex = values_.below(values_.chance(80) ? 2 : 200);
        } else {
            def.body = any(bodies_);
            def.point = values_.place(64);
        }
        def.compliance = values_.coefficient(1000);
        def.damping = values_.coefficient(1000000);
        def.break_force = values_.chance(80) ? 0 : values_.number(0, 8000000);
        lks_attachment_id id{};
        if (give([&] { return lks_world_add_attachment(world_, &def, &id); })) {
            attachments_.push_back(id);
        }
    }

    void change_body() {
        const lks_body_id body = any(bodies_);
        give([&] {
            switch (values_.below(9)) {
            case 0:
                return lks_body_set_transform(world_, body, values_.transform(8388000));
            case 1:
                return lks_body_set_velocity(world_, body, values_.vector(speed_limit()),
                                             values_.vector(spin_limit()));
            case 2:
                return lks_body_apply_impulse(world_, body, values_.vector(8000000), values_.place(8388000));
            case 3:
                return lks_body_move_to(world_, body, values_.transform(8388000));
            case 4:
                return lks_body_set_kind(world_, body, values_.choice(2));
            case 5:
                return lks_body_set_gravity_factor(world_, body, values_.number(-100, 100));
            case 6:
                return lks_body_set_damping(world_, body, values_.number(0, 1000), values_.number(0, 1000));
            case 7: {
                lks_fixed still = 0, sliding = 0, restitution = 0;
                set_surface(still, sliding, restitution);
                return lks_body_set_surface(world_, body, still, sliding, restitution);
            }
            default:
                return lks_body_set_filter(world_, body, values_.filter());
            }
        });
    }

    void change_joint() {
        const lks_joint_id joint = any(joints_);
        give([&] {
            if (values_.chance(50)) {
                const lks_motor motor{values_.number(0, 1000000), values_.number(0, 100), values_.rotation()};
                return lks_joint_set_motor(world_, joint, &motor);
            }
            lks_limits limits{};
            set_limits(limits.swing_limit, limits.swing_limit_z, limits.twist_min, limits.twist_max,
                       limits.distance_min, limits.distance_max);
            return lks_joint_set_limits(world_, joint, &limits);
        });
    }

    void change_object() {
        const lks_object_id object = any(objects_);
        const std::uint32_t vertex = values_.below(values_.chance(80) ? 2 : 200);
        give([&] {
            switch (values_.below(9)) {
            case 0:
                return lks_object_pin(world_, object, vertex);
            case 1:
                return lks_object_unpin(world_, object, vertex);
            case 2:
                return lks_object_set_pin_target(world_, object, vertex, values_.place(8388000));
            case 3:
                return lks_object_set_velocity(world_, object, vertex, values_.vector(speed_limit()));
            case 4:
                return lks_object_apply_impulse(world_, object, vertex, values_.vector(8000000));
            case 5:
                return lks_object_add_velocity(world_, object, values_.vector(speed_limit()));
            case 6: {
                const lks_transform from = values_.transform(8388000);
                const lks_transform to = values_.transform(8388000);
                return lks_object_teleport(world_, object, &from, &to);
            }
            case 7: {
                const lks_vec3 position = values_.place(8388000);
                return lks_object_set_positions(world_, object, vertex, 1, &position);
            }
            default:
                return lks_object_set_gravity_factor(world_, object, values_.number(-100, 100));
            }
        });
    }

    void change_collider() {
        const lks_collider_id collider = any(colliders_);
        give([&] {
            const lks_transform transform = values_.transform(8388000);
            return values_.chance(70) ? lks_collider_move_to(world_, collider, transform)
                                      : lks_collider_set_transform(world_, collider, transform);
        });
    }

    template <typename Id, typename Remove>
    void remove_any(std::vector<Id>& ids, const Remove& remove) {
        const Id id = any(ids);
        give([&] { return remove(world_, id); });
    }
    void remove_one() {
        switch (values_.below(5)) {
        case 0:
            return remove_any(bodies_, lks_world_remove_body);
        case 1:
            return remove_any(joints_, lks_world_remove_joint);
        case 2:
            return remove_any(objects_, lks_world_remove_object);
        case 3:
            return remove_any(attachments_, lks_world_remove_attachment);
        default:
            return remove_any(colliders_, lks_world_remove_collider);
        }
    }

    // Changes nothing, whatever it finds.
    void query() {
        const std::uint64_t before = world_.hash();
        lks_query query = lks_default_query();
        query.radius = values_.coefficient(30);
        lks_hit hits[8];
        std::uint32_t count = 0;
        static_cast<void>(
            lks_world_cast(world_, &query, values_.place(8388000), values_.place(8388000), hits, 8, &count));
        static_cast<void>(lks_world_overlap(world_, &query, values_.place(8388000), hits, 8, &count));
        static_cast<void>(lks_world_closest(world_, &query, values_.place(8388000), hits, &count));
        for (const lks_joint_id joint : joints_) {
            lks_vec3 force{}, torque{};
            lks_fixed angle = 0, other = 0;
            static_cast<void>(lks_joint_load(world_, joint, &force, &torque));
            static_cast<void>(lks_joint_angles(world_, joint, &angle, &other));
            static_cast<void>(lks_joint_error(world_, joint, &angle));
        }
        static_cast<void>(lks_world_kinetic_energy(world_, &query.radius));
        CHECK(world_.hash() == before);
    }

    EdgeValues values_;
    Assets assets_;
    lks_world_def def_;
    World world_;
    int figures_ = 0;
    std::vector<lks_body_id> bodies_;
    std::vector<lks_joint_id> joints_;
    std::vector<lks_object_id> objects_;
    std::vector<lks_attachment_id> attachments_;
    std::vector<lks_collider_id> colliders_;
};

} // namespace

// Under a sanitizer as many as take some seconds.
TEST_CASE("what is at the ends of ranges is refused, or gives an image that loads and has the same future") {
    const std::uint64_t seeds = sanitised ? 6 : long_runs() ? 2000 : 16;
    int refused = 0;
    int accepted = 0;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        INFO("seed " << seed);
        constexpr int calls = 120;
        EdgeWorld world(seed, 1, LKS_SIMD_AUTO);
        const std::vector<std::uint64_t> hashes = world.run(calls);
        world.check_image();
        CHECK(EdgeWorld(seed, 2, LKS_SIMD_SCALAR).run(calls) == hashes);
        refused += world.refused;
        accepted += world.accepted;
    }
    // Neither is rare.
    CHECK(refused > 10 * static_cast<int>(seeds));
    CHECK(accepted > 40 * static_cast<int>(seeds));
}
