// Trees of joints side by side give the bits that each gives by itself, at the edges of every range, too; and
// only trees that are built alike go side by side.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "fixed_samples.h"
#include "rigid/articulation.h"
#include "rigid/figures.h"
#include "rigid/wide_trees.h"
#include "rigid_samples.h"
#include "wide_kernels.h"

using namespace lks;
using fixed::Vec3;
using test::any_orientation;
using test::any_vector;

namespace {

// Body i hangs on body parents[i − 1].
struct Build {
    std::vector<std::uint32_t> parents;
    std::vector<bool> child_is_a;
    std::vector<std::int32_t> scales;
    std::vector<std::int32_t> inverse_shifts;
    int spread; // bits: how far points are apart, World
    int pull;   // bits: of what was pushed before

    std::uint32_t bodies() const { return static_cast<std::uint32_t>(scales.size()); }
};

Build any_build(test::Random& random) {
    Build build{};
    const auto count = static_cast<std::uint32_t>(2 + random.below(14));
    for (std::uint32_t i = 0; i < count; ++i) {
        if (i != 0) {
            build.parents.push_back(static_cast<std::uint32_t>(random.below(i)));
            build.child_is_a.push_back(random.below(2) == 0);
        }
        build.scales.push_back(static_cast<std::int32_t>(random.below(14)) - 8);
        build.inverse_shifts.push_back(static_cast<std::int32_t>(random.below(20)) - 5);
    }
    build.spread = 10 + static_cast<int>(random.below(54));
    build.pull = 10 + static_cast<int>(random.below(41));
    return build;
}

class Forest {
public:
    explicit Forest(const TreeKernels& kernels) : scene(lks_allocator{}, kernels) {}

    void add(test::Random& random, const Build& build) {
        const std::size_t first = scene.bodies.size();
        REQUIRE(scene.reserve(first + build.bodies(), 0));
        REQUIRE(scene.reserve_joints(scene.joints.size() + build.bodies()));
        for (std::uint32_t i = 0; i < build.bodies(); ++i) {
            scene.body_slots.push_reserved({1, true});
            scene.bodies.push_reserved(any_body(random, build, i));
        }
        for (std::uint32_t i = 0; i + 1 < build.bodies(); ++i) {
            scene.joint_slots.push_reserved({1, true});
            Joint joint = any_joint(random, build, i, static_cast<std::uint32_t>(first));
            const JointDescription& d = joint.description;
            joint.constants.arm_a = swing_arm(scene.bodies[d.body_a], d.point_a);
            joint.constants.arm_b = swing_arm(scene.bodies[d.body_b], d.point_b);
            scene.joints.push_reserved(joint);
        }
    }

    void find() {
        find_articulations(scene);
        REQUIRE(scene.figures.resize(scene.bodies.size()));
        join_figures(scene);
        find_figures(scene);
        find_bundles(scene);
    }

    void for_each(const std::function<void(const ArticulatedTree&)>& plain,
                  const std::function<void(const FigureBundle&)>& wide) {
        for (const FigureBundle& bundle : scene.figure_bundles) {
            if (bundle.is_wide()) {
                wide(bundle);
                continue;
            }
            for_each_part(scene, scene.figure_ranges[bundle.first], Part::tree,
                          [&](std::uint32_t i) { plain(scene.trees[i]); });
        }
    }

    RigidScene scene;

private:
    static Body any_body(test::Random& random, const Build& build, std::uint32_t i) {
        Body body{};
        body.inverse_mass = {static_cast<std::uint32_t>(random.bits()) | 0x80000000u,
                             -static_cast<std::int32_t>(random.below(2))}; // of even masses
        body.scale = build.scales[i];
        body.inverse_shift = build.inverse_shifts[i];
        const auto entry = [&] { return static_cast<std::int32_t>(random.any_signed(28)); };
        const auto diagonal = [&] { return (1 << 28) + static_cast<std::int32_t>(random.any_magnitude(29)); };
        body.inverse_inertia = {diagonal(), entry(), entry(), diagonal(), entry(), diagonal()};
        body.orientation = any_orientation(random);
        body.rotation = fixed::to_matrix(narrow(body.orientation));
        if (random.below(8) == 0) {
            // Undoing leaves it behind.
            body.rotation = fixed::to_matrix(narrow(any_orientation(random)));
        }
        body.world_inverse = rotated(body.inverse_inertia, body.rotation);
        body.position = any_vector(random, build.spread);
        return body;
    }

    static Joint any_joint(test::Random& random, const Build& build, std::uint32_t i, std::uint32_t first) {
        const std::uint32_t child = i + 1;
        const std::uint32_t parent = build.parents[i];
        const bool child_is_a = build.child_is_a[i];
        Joint joint{};
        JointDescription& d = joint.description;
        d.kind = LKS_JOINT_BALL;
        d.body_a = first + (child_is_a ? child : parent);
        d.body_b = first + (child_is_a ? parent : child);
        d.frame_a = d.frame_b = fixed::identity_rotation();
        d.point_a = any_point(random, build.scales[child_is_a ? child : parent]);
        d.point_b = any_point(random, build.scales[child_is_a ? parent : child]);
        joint.constants.shares = {static_cast<std::int32_t>(random.below(direction_one)), direction_one};
        joint.constants.axis_a = joint.constants.axis_b = {0, direction_one, 0};
        // Some limits are exceeded, and undone in several rounds.
        joint.constants.swing_limited = random.below(4) == 0;
        joint.constants.swing_round = true;
        joint.constants.swing_cosine = direction_one - direction_one / 64;
        joint.constants.swing_limit = (std::int64_t{1} << world_fraction_bits) / 6;
        joint.tension = static_cast<std::int64_t>(random.any_magnitude(build.pull));
        joint.start = any_vector(random, build.spread);
        joint.push = any_vector(random, build.pull);
        return joint;
    }

    // Up to six units out.
    static Vec3 any_point(test::Random& random, std::int32_t scale) {
        return any_vector(random, world_fraction_bits + scale + 1);
    }
};

bool same(const RigidScene& a, const RigidScene& b) {
    bool all = true;
    for (std::size_t i = 0; i < a.bodies.size(); ++i) {
        const Body& p = a.bodies[i];
        const Body& q = b.bodies[i];
        all = all && p.position == q.position && p.orientation == q.orientation && p.rotation == q.rotation &&
              p.world_inverse == q.world_inverse;
    }
    for (std::size_t i = 0; i < a.joints.size(); ++i) {
        all = all && a.joints[i].push == b.joints[i].push;
    }
    return all;
}

std::vector<const Kernels*> tree_kernels() {
    std::vector<const Kernels*> found;
    for (const Kernels* kernels : test::wide_kernels()) {
        if (kernels->trees.solve != nullptr) {
            found.push_back(kernels);
        }
    }
    return found;
}

// For bundles that are found only.
constexpr TreeKernels any_kernels{[](const TreeTask&) {}, [](const TreeTask&) {}};

std::vector<std::uint32_t> sizes_of_bundles(Forest& forest) {
    forest.find();
    std::vector<std::uint32_t> sizes;
    for (const FigureBundle& bundle : forest.scene.figure_bundles) {
        sizes.push_back(bundle.end - bundle.first);
    }
    return sizes;
}

// What the sample has in it.
struct Seen {
    int far_turns = 0;
    int near_turns = 0;
    int full_bundles = 0;
};

void compare(const Kernels& kernels, std::uint64_t seed, Seen& seen) {
    Forest expected(no_tree_kernels);
    Forest found(kernels.trees);
    for (Forest* forest : {&expected, &found}) {
        test::Random random(seed);
        const Build build = any_build(random);
        const auto trees = least_trees_in_lanes + random.below(tree_lanes - least_trees_in_lanes + 1);
        for (std::uint64_t i = 0; i < trees; ++i) {
            forest->add(random, build);
        }
    }
    expected.find();
    found.find();
    RigidScene& scene = found.scene;
    REQUIRE(scene.figure_bundles.size() == 1);
    REQUIRE(scene.figure_bundles[0].is_wide());
    seen.full_bundles += scene.figure_ranges.size() == tree_lanes ? 1 : 0;

    const auto never = [](const ArticulatedTree&) { FAIL("a tree by itself"); };
    const auto none = [](const FigureBundle&) { FAIL("a bundle of plain integers"); };
    expected.for_each([&](const ArticulatedTree& t) { factor_articulation(expected.scene, t); }, none);
    found.for_each(never, [&](const FigureBundle& b) { factor_bundle(scene, b); });
    for (int i = 0; i < 2; ++i) {
        expected.for_each([&](const ArticulatedTree& t) { solve_articulation(expected.scene, t); }, none);
        found.for_each(never, [&](const FigureBundle& b) { solve_bundle(scene, b); });
        REQUIRE(same(expected.scene, scene));
        for (const WideTreeBody& body : scene.wide_bodies) {
            ++(body.turns_far != 0 ? seen.far_turns : seen.near_turns);
        }
    }
    expected.for_each([&](const ArticulatedTree& t) { undo_articulation(expected.scene, t); }, none);
    found.for_each(never, [&](const FigureBundle& b) { undo_bundle(scene, b); });
    REQUIRE(same(expected.scene, scene));
}

} // namespace

TEST_CASE("trees of joints: side by side they are solved to the bit as by themselves") {
    const std::uint64_t most = test::sample_count() / 100;
    const std::uint64_t samples = test::long_run() ? 200'000 : std::min<std::uint64_t>(most, 2'000);
    for (const Kernels* kernels : tree_kernels()) {
        INFO(simd_name(kernels->level));
        Seen seen;
        for (std::uint64_t seed = 1; seed <= samples; ++seed) {
            CAPTURE(seed);
            compare(*kernels, seed, seen);
        }
        CHECK(seen.far_turns > 1000);
        CHECK(seen.near_turns > 1000);
        CHECK(seen.full_bundles > 100);
    }
}

TEST_CASE("trees of joints: those that follow each other and are built alike go side by side") {
    test::Random random(1);
    Build limb{};
    limb.parents = {0, 1, 1};
    limb.child_is_a = {false, true, false};
    limb.scales = {0, -1, -1, -2};
    limb.inverse_shifts = {3, 3, 4, 4};
    limb.spread = limb.pull = 30;

    Forest crowd(any_kernels);
    Forest plain(no_tree_kernels);
    for (int i = 0; i < 19; ++i) {
        crowd.add(random, limb);
        plain.add(random, limb);
    }
    CHECK(sizes_of_bundles(crowd) == std::vector<std::uint32_t>{8, 8, 3});
    CHECK(sizes_of_bundles(plain) == std::vector<std::uint32_t>(19, 1));

    Forest pair(any_kernels);
    pair.add(random, limb);
    pair.add(random, limb);
    CHECK(sizes_of_bundles(pair) == std::vector<std::uint32_t>{1, 1});

    const auto with_a_stranger = [&](const std::function<void(Build&)>& change) {
        Forest forest(any_kernels);
        Build other = limb;
        change(other);
        for (int i = 0; i < 7; ++i) {
            forest.add(random, i == 3 ? other : limb);
        }
        return sizes_of_bundles(forest);
    };
    const std::vector<std::uint32_t> apart{3, 1, 3};
    CHECK(with_a_stranger([](Build&) {}) == std::vector<std::uint32_t>{7});
    CHECK(with_a_stranger([](Build& s) { s.parents[2] = 0; }) == apart);
    CHECK(with_a_stranger([](Build& s) { s.child_is_a[0] = true; }) == apart);
    CHECK(with_a_stranger([](Build& s) { s.scales[2] = 0; }) == apart);
    CHECK(with_a_stranger([](Build& s) { s.inverse_shifts[0] = 2; }) == apart);
    CHECK(with_a_stranger([](Build& s) {
              s.parents.pop_back();
              s.scales.pop_back();
          }) == apart);

    // One hangs on what does not move.
    Forest held(any_kernels);
    for (int i = 0; i < 7; ++i) {
        held.add(random, limb);
    }
    held.scene.bodies[3 * 4 + 3].inverse_mass = {0, 0};
    CHECK(sizes_of_bundles(held) == apart);

    // One has a heavy end.
    Forest uneven(any_kernels);
    for (int i = 0; i < 7; ++i) {
        uneven.add(random, limb);
    }
    uneven.scene.bodies[3 * 4 + 3].inverse_mass.exponent = -20;
    CHECK(sizes_of_bundles(uneven) == apart);
}
