// How well ragdolls hold together: on stairs, and in a pile.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "support/bodies.h"
#include "support/sanitised.h"

using namespace support;

namespace {

constexpr std::uint32_t joint_count = LKS_HUMANOID_BONES - 1;

lks_transform at(double x, double y, double z, double turned) {
    lks_transform transform{fixed(x, y, z), {}};
    REQUIRE(lks_rotation_from_axis_angle(1, 0, 0, turned, &transform.rotation) == LKS_OK);
    return transform;
}

// Several of them, and what was seen of their joints.
class Ragdolls {
public:
    explicit Ragdolls(World& world) : world_(world) {}

    void add(const lks_transform& transform, const lks_vec3& velocity = {}) {
        human_.def.transform = transform;
        human_.def.velocity = velocity;
        lks_joint_id joints[joint_count];
        lks_body_id bodies[LKS_HUMANOID_BONES];
        REQUIRE(human_.add(world_, bodies, joints) == LKS_OK);
        bodies_.insert(bodies_.end(), bodies, bodies + LKS_HUMANOID_BONES);
        joints_.insert(joints_.end(), joints, joints + joint_count);
    }

    // Thirty above a pit, face down, five abreast, layers across each other, and each aside by what
    // `aside()` gives, metres.
    template <typename Aside>
    void add_pile(const Aside& aside) {
        for (int layer = 0; layer < 6; ++layer) {
            for (int i = 0; i < 5; ++i) {
                const bool across = layer % 2 == 1;
                const double beside = 0.56 * (i - 2) + 0.04 * layer - 0.1 + aside();
                const double along = 0.03 * i - 0.9 + aside();
                const double height = 0.9 + 1.15 * layer + 0.09 * i;
                lks_transform place = at(across ? along : beside, height, across ? beside : along, 90);
                if (across) {
                    place.rotation = {1 << 29, 1 << 29, -(1 << 29), 1 << 29}; // and by a quarter turn about y
                }
                add(place);
            }
        }
    }

    void step() {
        world_.step();
        limit_now_ = 0;
        for (std::size_t i = 0; i < joints_.size(); ++i) {
            const double error = error_of(world_, joints_[i]);
            sum_ += error;
            worst_ = std::max(worst_, error);
            ++count_;
            limit_now_ =
                std::max(limit_now_, degrees_beyond(world_, human_.bones[1 + i % joint_count], joints_[i]));
        }
        limit_ = std::max(limit_, limit_now_);
    }

    // No friction in the joints of those that are added from now on, and nobody sleeps.
    void slip() {
        for (lks_bone& bone : human_.bones) {
            bone.friction = 0;
            bone.body.never_sleeps = 1;
        }
    }

    // Kinetic and potential.
    double energy() const { return whole_energy(world_, bodies_.data(), bodies_.size()); }

    // How deep any of them is in another, or in what stands about, now: of balls along capsules' axes and of
    // boxes' corners. Neighbours share their joint's place.
    double overlap() const {
        double deepest = 0;
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            deepest = std::max(deepest, overlap_of(i));
        }
        return deepest;
    }

    const std::vector<lks_body_id>& bodies() const { return bodies_; }
    double mean() const { return sum_ / count_; }
    double worst() const { return worst_; }
    double limit() const { return limit_; }
    double limit_now() const { return limit_now_; }

private:
    double overlap_of(std::size_t body) const {
        const lks_body_shape& shape = human_.shapes[body % LKS_HUMANOID_BONES];
        const bool box = shape.shape == LKS_SHAPE_BOX;
        const double radius = box ? 0 : metres(shape.radius);
        const BodyState state = state_of(world_, bodies_[body]);
        double deepest = 0;
        for (int i = 0; i < 8; ++i) {
            const Vector corner{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0};
            const Vector half = metres(shape.half_extents);
            const Vector point = box ? Vector{corner.x * half.x, corner.y * half.y, corner.z * half.z}
                                     : Vector{0, metres(shape.half_length) * (2 * i / 7.0 - 1), 0};
            deepest =
                std::max(deepest, radius - nearest(body, state.position + rotate(state.rotation, point)));
        }
        return deepest;
    }

    // Metres from a point of a body to what it collides with.
    double nearest(std::size_t body, const Vector& point) const {
        lks_query query = lks_default_query();
        query.kinds = LKS_HIT_BIT(LKS_HIT_COLLIDER) | LKS_HIT_BIT(LKS_HIT_BODY);
        query.ignored = bodies_[body];
        query.radius = fixed(0.3);
        lks_hit hits[128];
        std::uint32_t count = 0;
        REQUIRE(lks_world_overlap(world_, &query, fixed(point.x, point.y, point.z), hits, 128, &count) ==
                LKS_OK);
        REQUIRE(count <= 128);
        double least = 1;
        for (std::uint32_t i = 0; i < count; ++i) {
            if (hits[i].kind == LKS_HIT_COLLIDER || !are_neighbours(body, hits[i].body.index)) {
                least = std::min(least, metres(hits[i].distance));
            }
        }
        return least;
    }

    // Bodies have the indices in which they were added.
    bool are_neighbours(std::size_t a, std::size_t b) const {
        const std::size_t root = a - a % LKS_HUMANOID_BONES;
        const auto parent = [&](std::size_t i) { return root + human_.bones[i % LKS_HUMANOID_BONES].parent; };
        return b / LKS_HUMANOID_BONES == a / LKS_HUMANOID_BONES &&
               ((a != root && parent(a) == b) || (b != root && parent(b) == a));
    }

    World& world_;
    Humanoid human_;
    std::vector<lks_body_id> bodies_;
    std::vector<lks_joint_id> joints_;
    double sum_ = 0;
    double count_ = 0;
    double worst_ = 0;
    double limit_ = 0;
    double limit_now_ = 0;
};

void add_pit(World& world) {
    add_ground(world);
    for (const double side : {-1.9, 1.9}) {
        add_box(world, fixed(2.1, 0.45, 0.2), fixed(0, 0.45, side));
        add_box(world, fixed(0.2, 0.45, 1.7), fixed(side, 0.45, 0));
    }
}

// The last of a pile has fallen for 1.2 s when it meets the others.
constexpr int ticks_of_fall = 72;

} // namespace

TEST_CASE("a ragdoll tumbles down stairs in one piece, and falls asleep") {
    World world(world_def(60, 8));
    add_ground(world);
    for (int i = 0; i < 10; ++i) {
        add_box(world, fixed(0.15, 0.085 * (10 - i), 1.5), fixed(0.3 * i, 0.085 * (10 - i), 0));
    }
    Ragdolls ragdolls(world);
    ragdolls.add(at(0, 1.71, 0, 0), fixed(2.5, 0, 0.3));
    for (int tick = 0; tick < 600; ++tick) {
        ragdolls.step();
    }
    INFO("joints " << 1e3 * ragdolls.mean() << " mm, worst " << 1e3 * ragdolls.worst() << " mm; limits "
                   << ragdolls.limit() << ", at rest " << ragdolls.limit_now());
    CHECK(ragdolls.mean() < 1e-5);
    CHECK(ragdolls.worst() < 2e-3);
    CHECK(ragdolls.limit() < 5);
    CHECK(ragdolls.limit_now() < 0.5);
    CHECK(lks_world_awake_body_count(world) == 0);
}

TEST_CASE("thirty ragdolls that fall into a pit stay in one piece and fall asleep, for an hour" *
          doctest::skip(support::sanitised)) {
    World world(world_def(60, 8));
    add_pit(world);
    Ragdolls ragdolls(world);
    ragdolls.add_pile([] { return 0; });
    double least = ragdolls.energy();
    double rise = 0;
    int tick = 0;
    for (; tick < ticks_of_fall + 600 && (tick == 0 || lks_world_awake_body_count(world) > 0); ++tick) {
        ragdolls.step();
        const double energy = ragdolls.energy();
        rise = std::max(rise, energy - least);
        least = std::min(least, energy);
    }
    const double overlap = ragdolls.overlap();
    std::printf("30 ragdolls in a pit: joints %.2e mm, worst %.3f mm; limits %.2f, at rest %.2f degrees; "
                "%.2f J gained; %.2f mm of overlap at rest; asleep after %.1f s\n",
                1e3 * ragdolls.mean(), 1e3 * ragdolls.worst(), ragdolls.limit(), ragdolls.limit_now(), rise,
                1e3 * overlap, tick / 60.0);
    CHECK(ragdolls.mean() < 1e-5);
    CHECK(ragdolls.worst() < 5e-3);
    CHECK(ragdolls.limit() < 5);
    CHECK(ragdolls.limit_now() < 0.5);
    CHECK(overlap < 2e-3);
    CHECK(rise < 20); // of 60 kJ: what parts lifts what lies upon it
    CHECK(lks_world_awake_body_count(world) == 0);
    const std::uint64_t hash = world.local_hash();
    std::vector<BodyState> before;
    for (const lks_body_id body : ragdolls.bodies()) {
        before.push_back(state_of(world, body));
    }
    world.step(216000); // an hour
    CHECK(energy_of(world) == 0);
    CHECK(world.local_hash() != hash); // the tick is part of it
    for (std::size_t i = 0; i < before.size(); ++i) {
        const BodyState now = state_of(world, ragdolls.bodies()[i]);
        CHECK((now.position - before[i].position).length() == 0);
        CHECK(now.rotation.x == before[i].rotation.x);
        CHECK(now.rotation.y == before[i].rotation.y);
        CHECK(now.rotation.z == before[i].rotation.z);
        CHECK(now.rotation.w == before[i].rotation.w);
    }
}

// Feet under chests, which nothing frees as long as only they are pushed: where figures are not moved as
// wholes, the first of these layouts is awake after 10 s, and the others end with 5 to 10 mm.
TEST_CASE("piles in which feet are jammed come apart and fall asleep, too" *
          doctest::skip(support::sanitised)) {
    for (const std::uint32_t seed : {16u, 21u, 33u, 44u, 48u}) {
        World world(world_def(60, 8));
        add_pit(world);
        Ragdolls ragdolls(world);
        std::mt19937 random(seed);
        ragdolls.add_pile([&] {
            const double low = random();
            return 0.04 * ((low + random() * 0x1p32) * 0x1p-64 - 0.5);
        });
        int tick = 0;
        for (; tick < ticks_of_fall + 600 && (tick == 0 || lks_world_awake_body_count(world) > 0); ++tick) {
            ragdolls.step();
        }
        const double overlap = ragdolls.overlap();
        INFO("layout " << seed << ": asleep after " << tick / 60.0 << " s, " << 1e3 * overlap
                       << " mm of overlap");
        CHECK(lks_world_awake_body_count(world) == 0);
        CHECK(overlap < 2e-3); // of 192 layouts 171 are, the worst has 4.9
        CHECK(ragdolls.worst() < 5e-3);
        CHECK(ragdolls.limit() < 5);
    }
}

TEST_CASE("a crowd that falls upon each other gains no energy") {
    World world(world_def(60, 8));
    add_ground(world);
    Ragdolls ragdolls(world);
    ragdolls.slip();
    for (int layer = 0; layer < 4; ++layer) {
        for (int i = 0; i < 4; ++i) {
            ragdolls.add(at(0.9 * (i % 2) + 0.1 * layer, 0.5 + 1.9 * layer, 0.6 * (i / 2) + 0.1 * layer, 0));
        }
    }
    double least = ragdolls.energy();
    double rise = 0;
    for (int tick = 0; tick < 240; ++tick) {
        ragdolls.step();
        const double energy = ragdolls.energy();
        rise = std::max(rise, energy - least);
        least = std::min(least, energy);
    }
    INFO("joints " << 1e3 * ragdolls.mean() << " mm, worst " << 1e3 * ragdolls.worst() << " mm; limits "
                   << ragdolls.limit() << "; " << rise << " J gained");
    CHECK(ragdolls.worst() < 10e-3);
    CHECK(ragdolls.limit() < 12);
    CHECK(rise < 60); // of 47 kJ: what parts lifts what lies upon it
}

// A hand of 0.45 kg bears 78 kg, and its limits, which know the masses of their two bones, what swings below.
// With rows alone joints came 47 to 130 cm apart, and 1.6 MJ came of nothing.
TEST_CASE("a ragdoll that is held by a hand and led about stays in one piece" *
          doctest::skip(support::sanitised)) {
    for (const double speed : {0.0, 2.0, 6.0}) {
        for (const std::uint32_t substeps : {4u, 8u}) {
            for (const bool soft : {false, true}) {
                if (soft && substeps < 8) {
                    continue; // what a swept joint has stretched it gives back: 200 to 400 J
                }
                World world(world_def(60, substeps));
                add_ground(world);
                Ragdolls ragdolls(world);
                ragdolls.add(at(0, 1.5, 0, 0));
                const lks_body_id hand = ragdolls.bodies()[LKS_HUMANOID_HAND_LEFT];
                const Vector place = state_of(world, hand).position;
                const lks_body_id anchor = add_anchor(world, fixed(place.x, place.y, place.z));
                lks_joint_def def = lks_default_joint_def();
                def.kind = LKS_JOINT_BALL;
                def.compliance = soft ? fixed(1e-7) : 0;
                add_joint(world, def, anchor, hand);
                double greatest = 0;
                double least = 1e9;
                double rise = 0;
                for (int tick = 0; tick < 600; ++tick) {
                    if (tick < 300 && speed != 0) {
                        const double turned = speed * tick / 60; // on a circle of a metre
                        const lks_transform to{
                            fixed(place.x + std::sin(turned), place.y, place.z + 1 - std::cos(turned)),
                            {0, 0, 0, 1 << 30}};
                        REQUIRE(lks_body_move_to(world, anchor, to) == LKS_OK);
                    }
                    ragdolls.step();
                    const double energy = ragdolls.energy();
                    greatest = std::max(greatest, energy);
                    if (speed == 0 || tick > 300) {
                        rise = std::max(rise, energy - least);
                        least = std::min(least, energy);
                    }
                }
                MESSAGE(speed << " m/s, " << substeps << " substeps"
                              << std::string(soft ? ", softly: " : ": ") << 1e3 * ragdolls.worst()
                              << " mm apart at the worst, limits exceeded by " << ragdolls.limit()
                              << " degrees, " << rise << " J gained, " << greatest << " J at the most");
                CHECK(ragdolls.worst() < (soft ? 1e-3 : 0.5e-3));
                CHECK(ragdolls.limit() < (soft ? 4 : 1));
                CHECK(rise < (soft ? 40 : 8));
                CHECK(greatest < (speed == 6 ? 18e3 : 3e3));
            }
        }
    }
}
