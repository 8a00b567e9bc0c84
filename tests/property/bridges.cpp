// Bars on hinges and ball joints between two places that stand: they stay together, and gain nothing.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/bodies.h"
#include "support/builders.h"
#include "support/sanitised.h"

using namespace support;

namespace {

constexpr double length = 0.5; // of a bar

class Bridge {
public:
    // Hangs in an arc; its bars are thrown about.
    Bridge(int count, std::uint32_t substeps, std::uint64_t seed, bool balls)
        : world_(world_def(60, substeps)), bits_(seed) {
        double x = 0, y = 0;
        lks_body_id last = add_anchor(world_, {});
        for (int i = 0; i < count; ++i) {
            const double angle = 0.12 * (i - 0.5 * (count - 1));
            const Vector along{std::cos(angle), std::sin(angle), 0};
            lks_body_def def = lks_default_body_def();
            def.mass = fixed(std::exp(any(0, 1.6))); // 1 to 5 kg
            def.never_sleeps = 1;
            def.filter.mask = 0;
            def.transform.rotation = about(0, 0, 1, angle * 180 / pi());
            def.velocity = fixed(any(-1, 1), any(-1, 1), any(-1, 1));
            def.angular_velocity = fixed(any(-2, 2), any(-2, 2), any(-2, 2));
            const lks_body_id bar =
                add_body(world_, box_shape(0.5 * length, 0.04, 0.08),
                         fixed(x + 0.5 * length * along.x, y + 0.5 * length * along.y, 0), def);
            join(last, i == 0 ? 0 : 0.5 * length, bar, balls);
            x += length * along.x;
            y += length * along.y;
            last = bar;
            bars_.push_back(bar);
        }
        join(last, 0.5 * length, add_anchor(world_, fixed(x, y, 0)), balls, 0);
    }

    // Metres that joints part, and joules gained, at the most.
    void run(int ticks) {
        world_.step(1); // speeds that its joints do not allow end
        const double start = energy();
        for (int tick = 0; tick < ticks; ++tick) {
            world_.step(1);
            for (const lks_joint_id joint : joints_) {
                apart = std::max(apart, error_of(world_, joint));
            }
            gain = std::max(gain, energy() - start);
        }
    }

    double apart = 0, gain = 0;

private:
    static double pi() { return std::acos(-1.0); }
    double any(double low, double high) {
        bits_ = bits_ * 6364136223846793005u + 1442695040888963407u;
        return low + (high - low) * static_cast<double>(bits_ >> 33) / 0x1p31;
    }
    double energy() const { return whole_energy(world_, bars_.data(), bars_.size()); }

    // A third of them by balls where that is asked for; hinges turn about z.
    void join(lks_body_id a, double at_a, lks_body_id b, bool balls, double at_b = -0.5 * length) {
        lks_joint_def joint = lks_default_joint_def();
        joint.kind = balls && any(0, 1) < 0.3 ? LKS_JOINT_BALL : LKS_JOINT_HINGE;
        joint.frame_a.rotation = joint.frame_b.rotation = about(1, 0, 0, 90);
        joint.frame_a.position = fixed(at_a, 0, 0);
        joint.frame_b.position = fixed(at_b, 0, 0);
        joints_.push_back(add_joint(world_, joint, a, b));
    }

    World world_;
    std::uint64_t bits_;
    std::vector<lks_body_id> bars_;
    std::vector<lks_joint_id> joints_;
};

} // namespace

// Solved together their rows, which hold the same twice, threw half of them apart by up to 150 m at one
// substep, and with balls between them a tenth at four.
TEST_CASE("bridges of bars that are thrown about stay together and gain nothing") {
    for (const std::uint32_t substeps : {2u, 4u, 8u}) {
        for (const bool balls : {false, true}) {
            for (int count = 3; count <= 6; ++count) {
                for (std::uint64_t seed = 1; seed <= (sanitised ? 1 : 8); ++seed) {
                    Bridge bridge(count, substeps, seed * 100 + static_cast<std::uint64_t>(count), balls);
                    bridge.run(300);
                    CAPTURE(substeps);
                    CAPTURE(balls);
                    CAPTURE(count);
                    CAPTURE(seed);
                    CHECK(bridge.apart < 1e-3);
                    CHECK(bridge.gain < 1.5);
                }
            }
        }
    }
}
