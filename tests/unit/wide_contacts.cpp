// Contacts side by side give the bits that each gives by itself, at the edges of every range, too.
#include <doctest/doctest.h>

#include <bit>
#include <cstdint>

#include "fixed_samples.h"
#include "rigid/wide_contacts.h"
#include "rigid_samples.h"
#include "wide_kernels.h"

using namespace lks;
using fixed::Direction;
using fixed::Vec3;
using test::any_orientation;
using test::any_vector;

namespace {

const MotionRate rate{make_step_rate(60, 8, 1)};

Direction any_direction(test::Random& random) {
    fixed::NormalisedVector found{};
    fixed::normalise(Vec3{random.any_signed(40), random.any_signed(40) | 1, random.any_signed(40)}, found);
    return found.direction;
}

void pose(test::Random& random, Body& body, int spread) {
    body.position = any_vector(random, spread);
    body.orientation = any_orientation(random);
    body.follow_orientation();
    body.world_inverse = rotated(body.inverse_inertia, body.rotation);
}

Body any_body(test::Random& random, bool heavy, int spread) {
    Body body{};
    body.inverse_mass = {static_cast<std::uint32_t>(random.bits()) | 0x80000000u,
                         -static_cast<std::int32_t>(random.below(random.below(4) == 0 ? 60 : 6))};
    if (heavy) {
        body.inverse_mass = {0, 0};
    }
    const bool odd = random.below(8) == 0;
    body.scale = static_cast<std::int32_t>(odd ? random.below(30) : random.below(8)) - (odd ? 12 : 6);
    body.inverse_shift = static_cast<std::int32_t>(odd ? random.below(70) : random.below(6)) - (odd ? 40 : 0);
    const auto entry = [&] { return static_cast<std::int32_t>(random.any_signed(28)); };
    const auto diagonal = [&] { return (1 << 29) + static_cast<std::int32_t>(random.any_magnitude(28)); };
    body.inverse_inertia = {diagonal(), entry(), entry(), diagonal(), entry(), diagonal()};
    body.jointed = random.below(2) == 0;
    pose(random, body, spread);
    return body;
}

// A tick's contacts in a scene of a few bodies.
class Heap {
public:
    Heap(std::uint64_t seed) : scene(lks_allocator{}, no_tree_kernels) {
        test::Random random(seed);
        constexpr std::uint32_t bodies = 6;
        constexpr std::uint32_t contacts = 12;
        REQUIRE(scene.reserve(bodies, 0));
        // Near each other somewhere, or as far apart as they can be.
        spread_ = random.below(8) == 0 ? 50 + static_cast<int>(random.below(14))
                                       : 30 + static_cast<int>(random.below(12));
        for (std::uint32_t i = 0; i < bodies; ++i) {
            scene.bodies.push_reserved(any_body(random, i >= 4, spread_));
        }
        REQUIRE(scene.contacts.resize(contacts));
        REQUIRE(scene.contact_points.resize(greatest_point_count * contacts));
        for (std::uint32_t i = 0; i < contacts; ++i) {
            add_contact(random, scene.contacts[i], i);
        }
    }

    // What joints and other contacts do meanwhile.
    void move_bodies(std::uint64_t seed) {
        test::Random random(seed);
        for (Body& body : scene.bodies) {
            if (random.below(4) == 0) {
                pose(random, body, spread_);
            } else {
                body.position = body.position + any_vector(random, 36);
            }
        }
    }

    void run(ContactStage stage, const ContactPointKernels& kernels) {
        WideContacts wide(scene, kernels, stage, rate);
        for (std::uint32_t i = 0; i < scene.contacts.size(); ++i) {
            if (stage != ContactStage::measure || scene.contacts[i].active_count != 0) {
                wide.add(i);
            }
        }
    }

    RigidScene scene;

private:
    void add_contact(test::Random& random, Contact& contact, std::uint32_t i) {
        const auto a = static_cast<std::uint32_t>(random.below(4));
        contact.key = {a, a + 1 + static_cast<std::uint32_t>(random.below(5 - a)), i};
        const Body& body_a = scene.bodies[a];
        const Body& body_b = scene.bodies[contact.key.other];
        contact.shares = pair_shares(body_a.effective_inverse_mass(), body_b.effective_inverse_mass());
        contact.radius_a = static_cast<std::int64_t>(random.any_magnitude(40));
        contact.radius_b = static_cast<std::int64_t>(random.any_magnitude(40));
        contact.restitution = random.below(8) == 0 ? 1 << 20 : 0;
        contact.every_substep = random.below(8) == 0;
        for (Direction& direction : contact.directions) {
            direction = any_direction(random);
        }
        contact.count = 1 + static_cast<std::uint32_t>(random.below(greatest_point_count));
        contact.points = &scene.contact_points[greatest_point_count * i];
        for (std::uint32_t k = 0; k < contact.count; ++k) {
            ContactPoint& point = contact.points[k];
            point.core_a = any_core(random, body_a);
            point.core_b = any_core(random, body_b);
            point.push = {k, 0, point.core_a, 0, {0, 0}};
            if (random.below(2) == 0) {
                point.push.normal = static_cast<std::int64_t>(random.any_magnitude(45));
                point.push.across[0] = random.any_signed(40);
            }
        }
    }

    // Within the body's unit, at times just beyond it, or as far out as a plane's may be.
    static Vec3 any_core(test::Random& random, const Body& body) {
        const std::uint64_t kind = random.below(16);
        return any_vector(random, kind == 0 ? 60 : world_fraction_bits + body.scale - (kind < 3 ? 0 : 2));
    }

    int spread_;
};

bool same(const ContactRowSide& p, const ContactRowSide& q, int count) {
    bool all = p.turn_shift == q.turn_shift && p.arm_shift == q.arm_shift;
    for (int i = 0; i < count; ++i) {
        all = all && p.rows[i].arm == q.rows[i].arm && p.rows[i].turn == q.rows[i].turn;
    }
    return all;
}

bool same(const ContactRows& p, const ContactRows& q, int count) {
    bool all = same(p.a, q.a, count) && same(p.b, q.b, count);
    for (int i = 0; i < count; ++i) {
        all = all && p.inverses[i].mantissa == q.inverses[i].mantissa &&
              p.inverses[i].shift == q.inverses[i].shift;
    }
    return all;
}

bool same(const ContactPoint& p, const ContactPoint& q) {
    return p.core_a == q.core_a && p.core_b == q.core_b && p.material_a == q.material_a &&
           p.material_b == q.material_b && p.start == q.start && p.core_start == q.core_start &&
           p.separation == q.separation && p.allowed == q.allowed && p.approach == q.approach &&
           p.active == q.active && p.push.feature == q.push.feature && p.push.place == q.push.place &&
           p.push.normal == q.push.normal && p.push.across[0] == q.push.across[0] &&
           p.push.across[1] == q.push.across[1];
}

bool same(const Heap& a, const Heap& b, ContactStage stage) {
    for (std::size_t i = 0; i < a.scene.contacts.size(); ++i) {
        const Contact& p = a.scene.contacts[i];
        const Contact& q = b.scene.contacts[i];
        bool all = p.active_count == q.active_count;
        for (std::uint32_t k = 0; k < p.count; ++k) {
            const ContactPoint& s = p.points[k];
            const ContactPoint& t = q.points[k];
            all = all && same(s, t);
            if (stage != ContactStage::begin && s.active) {
                all = all && same(s.rows, t.rows, 3);
            }
            if (stage == ContactStage::measure && s.active) {
                all = all && s.gap == t.gap && s.slip[0] == t.slip[0] && s.slip[1] == t.slip[1];
            }
        }
        if (stage != ContactStage::begin && p.active_count > 1) {
            all = all && same(p.middle, q.middle, 1);
        }
        if (stage == ContactStage::measure && p.active_count > 1) {
            all = all && p.middle_gap == q.middle_gap;
        }
        if (!all) {
            return false;
        }
    }
    return true;
}

// Counts what lanes do and what they leave.
struct Counts {
    std::uint64_t done = 0;
    std::uint64_t left = 0;
};
Counts counts[3];
ContactPointKernels counted;

std::uint32_t count(ContactStage stage, std::uint32_t lanes, std::uint32_t left) {
    const auto of_them = static_cast<std::uint64_t>(std::popcount(left & ((1u << lanes) - 1)));
    counts[static_cast<int>(stage)].left += of_them;
    counts[static_cast<int>(stage)].done += lanes - of_them;
    return left;
}

constexpr ContactPointKernels counting{
    [](const ContactPointTask& task) { return count(ContactStage::begin, task.count, counted.begin(task)); },
    [](const ContactPointTask& task, WideRows& rows) {
        return count(ContactStage::make_rows, task.count, counted.make_rows(task, rows));
    },
    [](const ContactPointTask& task) {
        return count(ContactStage::measure, task.count, counted.measure(task));
    }};

} // namespace

TEST_CASE("contacts: side by side they are measured, and their rows made, to the bit as by themselves") {
    // Some 20 points that lanes take of each: 10^7 in long runs.
    const std::uint64_t samples = test::long_run() ? 600'000 : 5'000;
    for (const Kernels* kernels : test::wide_kernels()) {
        if (kernels->contact_points.begin == nullptr) {
            continue;
        }
        INFO(simd_name(kernels->level));
        counted = kernels->contact_points;
        for (Counts& of_stage : counts) {
            of_stage = {};
        }
        for (std::uint64_t seed = 1; seed <= samples; ++seed) {
            CAPTURE(seed);
            Heap expected(seed);
            Heap found(seed);
            std::uint64_t moved = seed << 32;
            for (const ContactStage stage :
                 {ContactStage::begin, ContactStage::make_rows, ContactStage::measure}) {
                CAPTURE(static_cast<int>(stage));
                expected.run(stage, no_contact_point_kernels);
                found.run(stage, counting);
                REQUIRE(same(expected, found, stage));
                ++moved;
                expected.move_bodies(moved);
                found.move_bodies(moved);
            }
        }
        for (const Counts& of_stage : counts) {
            CHECK(of_stage.done > 5 * samples);
            CHECK(of_stage.left > samples / 20);
        }
    }
}
