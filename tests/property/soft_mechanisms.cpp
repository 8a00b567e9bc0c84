// Trees of bodies made at random on joints of any kind, some of them springs, free or hanging: the springs
// hold their loads with all that hangs on them, rigid joints stay together, and nothing gains energy.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/bodies.h"
#include "support/random.h"
#include "support/sanitised.h"

using namespace support;

namespace {

class Mechanism {
public:
    Mechanism(std::uint64_t seed, std::uint32_t substeps, double heaviest)
        : world_(world_def(60, substeps)), random_(seed), heaviest_(heaviest) {
        const int count = 2 + static_cast<int>(random_.between(0, 11));
        hangs_ = chance(50);
        for (int i = 0; i < count; ++i) {
            add(i);
        }
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
        }
    }

    // Joules, and as a share of the greatest motion.
    double gained() const { return gained_; }
    double gained_share() const { return gained_ / std::max(fastest_, 1e-9); }
    double apart() const { return apart_; } // m, of rigid joints

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
        def.mass = fixed(magnitude(1, heaviest_));
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
        def.frame_a = frame(a, place);
        def.frame_b = frame(b, place);
        if (chance(50)) {
            def.swing_limit = fixed(between(5, 120));
            def.swing_limit_z = chance(30) ? fixed(between(5, 120)) : def.swing_limit_z;
            def.twist_min = fixed(between(-120, -5));
            def.twist_max = fixed(between(5, 120));
        }
        const bool soft = chance(30);
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

    // Springs begin without any.
    double energy() { return whole_energy(world_, moving_.data(), moving_.size()); }

    World world_;
    Random random_;
    double heaviest_;
    bool hangs_ = false;
    std::vector<Part> parts_;
    std::vector<lks_body_id> moving_;
    std::vector<lks_joint_id> rigid_;
    double begin_ = 0;
    double gained_ = 0;
    double fastest_ = 0;
    double apart_ = 0;
};

struct Found {
    int made;
    int gaining = 0; // by a joule and a twentieth
    int apart = 0;   // rigid joints, by more than a millimetre at any time
};

Found look_at(std::uint32_t substeps, double heaviest) {
    const int made = sanitised ? 10 : long_runs() ? 60 : 24;
    const int ticks = sanitised ? 120 : long_runs() ? 600 : 300;
    Found found{made};
    double gained = 0;
    double apart = 0;
    for (int seed = 0; seed < made; ++seed) {
        Mechanism mechanism(static_cast<std::uint64_t>(seed), substeps, heaviest);
        mechanism.run(ticks);
        const double share = mechanism.gained() > 1 ? mechanism.gained_share() : 0;
        found.gaining += share > 0.05 ? 1 : 0;
        found.apart += mechanism.apart() > 0.001 ? 1 : 0;
        gained = std::max(gained, share);
        apart = std::max(apart, mechanism.apart());
    }
    MESSAGE(substeps << " substeps, 1:" << heaviest << ": " << found.gaining << " gain, at most " << gained
                     << " of their motion; rigid joints of " << found.apart
                     << " are apart by more than a millimetre, at most by " << apart * 1000);
    return found;
}

} // namespace

// With soft points swept beside the trees of rigid ones 2, 1 and 3 of 60 gained up to 93 % of their motion in
// ten seconds, and 26, 18 and 9 were apart, by up to 163, 85 and 19 mm.
TEST_CASE("springs and rigid joints of one mechanism hold together and gain nothing") {
    const struct {
        std::uint32_t substeps;
        double apart; // of those that are made
    } cases[] = {{4, 0.15}, {8, 0.05}, {20, 0}};
    for (const auto& at : cases) {
        const Found found = look_at(at.substeps, 10);
        CHECK(found.gaining == 0);
        CHECK(found.apart <= at.apart * found.made);
    }
}

// Then one gained, and 31 were apart.
TEST_CASE("so they do with masses of one to a thousand") {
    const Found found = look_at(8, 1000);
    CHECK(found.gaining == 0);
    CHECK(found.apart <= 0.1 * found.made + 1);
}
