// Mechanisms made at random: trees of bodies on joints of any kind, free or hanging, with springs, distances
// and loops as asked for.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/bodies.h"
#include "support/random.h"

namespace support {

struct MechanismDef {
    double heaviest = 10; // of masses from one kilogram on
    int springs = 30;     // of a hundred joints
    int distances = 0;    // of a hundred joints
    int loops = 0;        // at most
};

class Mechanism {
public:
    // Of `seed`, at 60 Hz.
    Mechanism(std::uint64_t seed, std::uint32_t substeps, const MechanismDef& def)
        : world_(world_def(60, substeps)), random_(seed), def_(def) {
        const int count = 2 + static_cast<int>(random_.between(0, 11));
        hangs_ = chance(50);
        for (int i = 0; i < count; ++i) {
            add(i);
        }
        close_loops();
        begin_ = energy();
    }

    void run(int ticks) {
        for (int tick = 0; tick < ticks; ++tick) {
            world_.step();
            gained_ = std::max(gained_, energy() - begin_);
            fastest_ = std::max(fastest_, energy_of(world_));
            for (const lks_joint_id joint : rigid_) {
                apart_ = std::max(apart_, error_of(world_, joint));
            }
            for (const lks_joint_id joint : distances_) {
                beyond_ = std::max(beyond_, error_of(world_, joint));
            }
        }
    }

    const World& world() const { return world_; }
    // Joules, and as a share of the greatest motion.
    double gained() const { return gained_; }
    double gained_share() const { return gained_ / std::max(fastest_, 1e-9); }
    double apart() const { return apart_; }   // m, of rigid joints
    double beyond() const { return beyond_; } // m, of rigid distances

private:
    struct Part {
        lks_body_id body;
        Vector place;
    };

    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(random_.between(0, 1000000)) / 1000000;
    }
    // From the logarithm of the one to that of the other.
    double magnitude(double low, double high) { return low * std::pow(high / low, between(0, 1)); }
    bool chance(int percent) { return random_.between(0, 99) < percent; }

    lks_body_shape shape() {
        switch (random_.between(0, 2)) {
        case 0:
            return ball_shape(between(0.03, 0.12));
        case 1:
            return capsule_shape(between(0.03, 0.08), between(0.02, 0.15));
        default:
            return box_shape(between(0.03, 0.15), between(0.03, 0.15), between(0.03, 0.15));
        }
    }

    // On the one before, or on any; the joint lies half-way.
    void add(int index) {
        const int parent = index == 0   ? 0
                           : chance(70) ? index - 1
                                        : static_cast<int>(random_.between(0, index - 1));
        Vector half;
        if (index > 0) {
            const double around = between(0, 6.28);
            const double up = between(-0.7, 0.7);
            half = Vector{std::cos(around) * std::cos(up), std::sin(up), std::sin(around) * std::cos(up)} *
                   between(0.1, 0.3);
        }
        const Vector place =
            index == 0 ? Vector{} : parts_[static_cast<std::size_t>(parent)].place + half * 2;
        lks_body_def def = lks_default_body_def();
        def.filter.mask = 0;
        def.kind = index == 0 && hangs_ ? LKS_BODY_KINEMATIC : LKS_BODY_DYNAMIC;
        def.transform.rotation = about(between(-1, 1), between(-1, 1), 1, between(0, 360));
        def.mass = fixed(magnitude(1, def_.heaviest));
        if (chance(30)) {
            def.velocity = fixed(between(-3, 3), between(-3, 3), between(-3, 3));
        }
        if (chance(30)) {
            def.angular_velocity = fixed(between(-5, 5), between(-5, 5), between(-5, 5));
        }
        const lks_body_id body = add_body(world_, shape(), fixed(place.x, place.y, place.z), def);
        parts_.push_back({body, place});
        if (def.kind == LKS_BODY_DYNAMIC) {
            moving_.push_back(body);
        }
        if (index > 0) {
            join(static_cast<std::size_t>(parent), parts_.size() - 1, place - half);
        }
    }

    lks_transform frame(std::size_t part, const Vector& place) {
        const BodyState state = state_of(world_, parts_[part].body);
        const lks_rotation back = conjugate(state.rotation);
        const Vector point = rotate(back, place - state.position);
        return {fixed(point.x, point.y, point.z), back};
    }

    void join(std::size_t a, std::size_t b, const Vector& place) {
        lks_joint_def def = lks_default_joint_def();
        def.kind = static_cast<std::uint32_t>(random_.between(LKS_JOINT_BALL, LKS_JOINT_FIXED));
        if (def_.distances != 0 && chance(def_.distances)) {
            join_by_distance(a, b, place);
            return;
        }
        def.frame_a = frame(a, place);
        def.frame_b = frame(b, place);
        if (chance(50)) {
            def.swing_limit = fixed(between(5, 120));
            def.swing_limit_z = chance(30) ? fixed(between(5, 120)) : def.swing_limit_z;
            def.twist_min = fixed(between(-120, -5));
            def.twist_max = fixed(between(5, 120));
        }
        const bool soft = chance(def_.springs);
        if (soft) {
            def.compliance = fixed(magnitude(1e-6, 1e-3));
            def.damping = fixed(between(0, 20));
        }
        def.friction = chance(20) ? fixed(between(0, 2)) : 0;
        if (chance(10)) {
            def.limit_compliance = fixed(magnitude(1e-4, 1e-1));
            def.limit_damping = fixed(between(0, 2));
        }
        const lks_joint_id id = add_joint(world_, def, parts_[a].body, parts_[b].body);
        if (!soft) {
            rigid_.push_back(id);
        }
    }

    // A rod, a rope, one that is both, or one that is taut; its points lie half-way to the joint's place.
    void join_by_distance(std::size_t a, std::size_t b, const Vector& place) {
        const Vector points[2] = {(parts_[a].place + place) * 0.5, (parts_[b].place + place) * 0.5};
        const double length = (points[1] - points[0]).length();
        double least = length;
        double most = length;
        switch (random_.between(0, 3)) {
        case 0:
            break;
        case 1:
            least = 0;
            most = length * between(1, 1.5);
            break;
        case 2:
            least = length * between(0.5, 0.95);
            most = length * between(1.05, 2);
            break;
        default:
            least = length * 0.8;
        }
        lks_joint_def def = lks_default_joint_def();
        def.kind = LKS_JOINT_DISTANCE;
        def.frame_a = frame(a, points[0]);
        def.frame_b = frame(b, points[1]);
        def.distance_min = fixed(least);
        def.distance_max = std::max(def.distance_min, fixed(most));
        const bool soft = chance(def_.springs);
        if (soft) {
            def.compliance = fixed(magnitude(1e-6, 1e-3));
            def.damping = fixed(between(0, 20));
        }
        const lks_joint_id id = add_joint(world_, def, parts_[a].body, parts_[b].body);
        if (!soft) {
            distances_.push_back(id);
        }
    }

    // Between any two, at their middle.
    void close_loops() {
        const auto count = static_cast<int>(parts_.size());
        if (def_.loops == 0 || count < 3) {
            return;
        }
        for (auto more = random_.between(1, def_.loops); more > 0; --more) {
            const auto a = static_cast<std::size_t>(random_.between(0, count - 1));
            auto b = static_cast<std::size_t>(random_.between(0, count - 2));
            b += b >= a ? 1 : 0;
            join(a, b, (parts_[a].place + parts_[b].place) * 0.5);
        }
    }

    // Springs begin without any.
    double energy() { return whole_energy(world_, moving_.data(), moving_.size()); }

    World world_;
    Random random_;
    MechanismDef def_;
    bool hangs_ = false;
    std::vector<Part> parts_;
    std::vector<lks_body_id> moving_;
    std::vector<lks_joint_id> rigid_;
    std::vector<lks_joint_id> distances_;
    double begin_ = 0;
    double gained_ = 0;
    double fastest_ = 0;
    double apart_ = 0;
    double beyond_ = 0;
};

} // namespace support
