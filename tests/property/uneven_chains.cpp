// Chains that a million times the mass of one of their links hangs on, at few substeps: what pulls there
// counts as hundreds of kilometres a substep (rigid/uneven_tree.h).
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/bodies.h"
#include "support/builders.h"
#include "support/sanitised.h"

using namespace support;

namespace {

constexpr double end_mass = 1e5;

struct HungChain {
    explicit HungChain(std::uint32_t rate, bool level) : world(world_def(rate, 1)) {
        constexpr int links = 3;
        lks_body_id above = add_anchor(world, {});
        for (int i = 0; i < links; ++i) {
            lks_body_def def = lks_default_body_def();
            def.mass = fixed(i + 1 == links ? end_mass : 0.1);
            def.transform.rotation = about(0, 0, 1, level ? 90 : 0);
            const double down = 0.15 + 0.3 * i;
            const lks_body_id link = add_body(world, capsule_shape(0.03, 0.12),
                                              level ? fixed(down, 0, 0) : fixed(0, -down, 0), def);
            lks_joint_def joint = lks_default_joint_def();
            joint.frame_a.position = fixed(0, i == 0 ? 0 : -0.15, 0);
            joint.frame_b.position = fixed(0, 0.15, 0);
            joints.push_back(add_joint(world, joint, above, link));
            above = link;
        }
    }
    HungChain(const HungChain&) = delete;
    HungChain& operator=(const HungChain&) = delete;

    double gap() const {
        double greatest = 0;
        for (const lks_joint_id joint : joints) {
            greatest = std::max(greatest, error_of(world, joint));
        }
        return greatest;
    }

    World world;
    std::vector<lks_joint_id> joints;
};

} // namespace

TEST_CASE("light links hold a million times their mass at any tick rate, and say what they bear") {
    for (const std::uint32_t rate : {10u, 30u, 60u}) {
        INFO(rate << " Hz");
        HungChain chain(rate, false);
        for (std::uint32_t tick = 0; tick < 2 * rate; ++tick) {
            chain.world.step();
            CHECK(chain.gap() < 1e-9);
        }
        for (const lks_joint_id joint : chain.joints) {
            lks_vec3 force{};
            REQUIRE(lks_joint_load(chain.world, joint, &force, nullptr) == LKS_OK);
            CHECK(std::abs(metres(force.y) / (9.81 * end_mass) - 1) < 1e-3);
        }
    }
}

TEST_CASE("a chain that a great mass swings on goes on as it was saved") {
    for (const std::uint32_t rate : {10u, 60u}) {
        HungChain chain(rate, true);
        chain.world.step(static_cast<int>(rate / 3));
        const Image image = chain.world.save();
        chain.world.step(static_cast<int>(rate));
        const std::uint64_t hash = chain.world.hash();
        REQUIRE(lks_world_load(chain.world, image.data(), image.size()) == LKS_OK);
        chain.world.step(static_cast<int>(rate));
        CHECK(chain.world.hash() == hash);
        // In a world of its own, where nothing is left of before.
        HungChain other(rate, true);
        REQUIRE(lks_world_load(other.world, image.data(), image.size()) == LKS_OK);
        other.world.step(static_cast<int>(rate));
        CHECK(other.world.hash() == hash);
        CHECK(other.gap() < 1);
    }
}

// Between a hundred and a thousand to one nothing told them apart from even ones: up to 11 m.
TEST_CASE("chains of a few hundred to one stay together while their hook is led") {
    for (const int links : {4, 8}) {
        for (const double ratio : {120.0, 500.0, 750.0, 990.0, 1010.0}) {
            for (const unsigned substeps : {3u, 8u}) {
                for (const double pace : {1.5, 2.3, 3.1}) {
                    if (sanitised && pace > 2) {
                        continue;
                    }
                    World world(world_def(60, substeps));
                    const lks_body_id hook = add_anchor(world, fixed(0, 6, 0));
                    lks_body_id last = hook;
                    std::vector<lks_joint_id> joints;
                    const auto hang = [&](const lks_body_shape& shape, double mass, double height, double up,
                                          double below) {
                        lks_body_def def = lks_default_body_def();
                        def.mass = fixed(mass);
                        def.filter.mask = 0;
                        const lks_body_id body = add_body(world, shape, fixed(0, height, 0), def);
                        lks_joint_def joint = lks_default_joint_def();
                        joint.frame_a.position = fixed(0, below, 0);
                        joint.frame_b.position = fixed(0, up, 0);
                        joints.push_back(add_joint(world, joint, last, body));
                        last = body;
                    };
                    for (int i = 0; i < links; ++i) {
                        hang(capsule_shape(0.04, 0.12), 2, 5.8 - 0.4 * i, 0.2, i > 0 ? -0.2 : 0);
                    }
                    hang(ball_shape(0.4), 2 * ratio, 5.6 - 0.4 * links, 0.4, -0.2);
                    double apart = 0;
                    for (int tick = 0; tick < 900; ++tick) {
                        const double seconds = tick / 60.0;
                        const double reach = 1.5 * std::min(1.0, seconds / 2);
                        const lks_transform to =
                            at(reach * std::sin(pace * seconds), 6, 0.7 * std::sin(1.3 * seconds));
                        REQUIRE(lks_body_move_to(world, hook, to) == LKS_OK);
                        world.step();
                        for (const lks_joint_id joint : joints) {
                            apart = std::max(apart, error_of(world, joint));
                        }
                    }
                    CAPTURE(links);
                    CAPTURE(ratio);
                    CAPTURE(substeps);
                    CAPTURE(pace);
                    CHECK(apart < 0.02);
                }
            }
        }
    }
}
