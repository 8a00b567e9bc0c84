// Chains that are held level at one end, of fixed joints, in cones and with a distance joint: they gain
// nothing, and stand where they stand.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/bodies.h"
#include "support/builders.h"
#include "support/sanitised.h"

using namespace support;

namespace {

lks_body_def body_of(double mass) {
    lks_body_def def = lks_default_body_def();
    def.mass = fixed(mass);
    def.never_sleeps = 1;
    def.filter.mask = 0;
    return def;
}

// Of boxes of 0.4 m along x, from where it is held.
class LevelChain {
public:
    explicit LevelChain(std::uint32_t substeps) : world(world_def(60, substeps)) {
        bodies.push_back(add_anchor(world, {}));
    }

    lks_joint_id add(double mass, lks_joint_def joint) {
        const double x = 0.4 * static_cast<double>(bodies.size() - 1);
        const lks_body_id body =
            add_body(world, box_shape(0.2, 0.05, 0.05), fixed(x + 0.2, 0, 0), body_of(mass));
        joint.frame_a.position = fixed(bodies.size() == 1 ? 0 : 0.2, 0, 0);
        joint.frame_b.position = fixed(-0.2, 0, 0);
        const lks_joint_id id = add_joint(world, joint, bodies.back(), body);
        bodies.push_back(body);
        return id;
    }

    double energy() const { return whole_energy(world, bodies.data() + 1, bodies.size() - 1); }
    // By how much it is more than at the beginning, at the most.
    double gain(int ticks) {
        const double start = energy();
        double most = 0;
        for (int tick = 0; tick < ticks; ++tick) {
            world.step(1);
            most = std::max(most, energy() - start);
        }
        return most;
    }

    World world;
    std::vector<lks_body_id> bodies;
};

} // namespace

// What the joints of an arm were off was lifted without speed at the end of each substep, and the speed
// stayed: 1,000 kg behind two of a kilogram that stood there were told to fall at 1.6 m/s, with 1.2 kJ.
TEST_CASE("a level arm of fixed joints stands, and nearly has the speed of what stands") {
    for (const std::uint32_t substeps : {4u, 8u, 20u}) {
        for (const double mass : {1., 10., 100., 1000.}) {
            LevelChain chain(substeps);
            lks_joint_def joint = lks_default_joint_def();
            joint.kind = LKS_JOINT_FIXED;
            chain.add(1, joint);
            chain.add(1, joint);
            chain.add(mass, joint);
            double fastest = 0, lowest = 0;
            for (int tick = 0; tick < 120; ++tick) {
                chain.world.step(1);
                const BodyState end = state_of(chain.world, chain.bodies.back());
                fastest = std::max(fastest, end.velocity.length());
                lowest = std::min(lowest, end.position.y);
            }
            CAPTURE(substeps);
            CAPTURE(mass);
            CHECK(lowest > -0.004);
            CHECK(fastest < (mass == 1 && substeps == 4 ? 0.6 : 0.4));
        }
    }
}

// One distance joint in it, and nobody looked at what a held figure gained: up to 234 J.
TEST_CASE("a chain that ends in a distance joint gains nothing") {
    for (const std::uint32_t substeps : {4u, 8u, 20u}) {
        for (const double mass : {1., 10., 90.}) {
            for (const double cone : {0., 5., 30.}) {
                LevelChain chain(substeps);
                lks_joint_def joint = lks_default_joint_def();
                joint.kind = cone == 0 ? LKS_JOINT_FIXED : LKS_JOINT_BALL;
                // A cone about the chain.
                joint.frame_a.rotation = joint.frame_b.rotation = about(0, 0, 1, -90);
                joint.swing_limit = fixed(cone == 0 ? 180 : cone);
                for (int i = 0; i < 3; ++i) {
                    chain.add(1, joint);
                }
                lks_joint_def rope = lks_default_joint_def();
                rope.kind = LKS_JOINT_DISTANCE;
                rope.distance_min = rope.distance_max = fixed(0.4);
                const lks_body_id end =
                    add_body(chain.world, box_shape(0.2, 0.05, 0.05), fixed(1.6, 0, 0), body_of(mass));
                rope.frame_a.position = fixed(0.2, 0, 0);
                add_joint(chain.world, rope, chain.bodies.back(), end);
                chain.bodies.push_back(end);
                CAPTURE(substeps);
                CAPTURE(mass);
                CAPTURE(cone);
                CHECK(chain.gain(300) < 1);
            }
        }
    }
}

// It gained up to 3 J of 3.
TEST_CASE("a rod in a cone that points anywhere gains nothing") {
    for (const std::uint32_t substeps : {1u, 2u, 4u, 8u}) {
        for (const double cone : {5., 30., 60., 90.}) {
            for (int k = 0; k < (sanitised ? 2 : 12); ++k) {
                World world(world_def(60, substeps));
                const double a = 0.5 * k, b = 1.1 * k;
                const Vector along{std::cos(a) * std::cos(b), std::sin(b), std::sin(a) * std::cos(b)};
                lks_body_shape shape = capsule_shape(0.06, 0.2);
                const Vector across = cross({0, 1, 0}, along);
                const double length = across.length();
                shape.transform.rotation = about(across.x / length, across.y / length, across.z / length,
                                                 std::acos(along.y) * 180 / std::acos(-1.0));
                const lks_vec3 place = fixed(0.26 * along.x, 0.26 * along.y, 0.26 * along.z);
                const lks_body_id rod = add_body(world, shape, place, body_of(1));
                lks_joint_def joint = lks_default_joint_def();
                joint.frame_a.rotation = joint.frame_b.rotation = about(std::sin(b), 0, std::cos(b), 37. * k);
                joint.frame_b.position = {-place.x, -place.y, -place.z};
                joint.swing_limit = fixed(cone);
                add_joint(world, joint, add_anchor(world, {}), rod);
                const double start = whole_energy(world, &rod, 1);
                double most = 0;
                for (int tick = 0; tick < 300; ++tick) {
                    world.step(1);
                    most = std::max(most, whole_energy(world, &rod, 1) - start);
                }
                CAPTURE(substeps);
                CAPTURE(cone);
                CAPTURE(k);
                CHECK(most < 0.05);
            }
        }
    }
}
