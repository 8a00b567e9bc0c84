// Figures of which a bone is kinematic: all of it hangs on that bone's joints and limits.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/bodies.h"
#include "support/hanging_figure.h"
#include "support/sanitised.h"

using namespace support;

namespace {

// A figure of lockstitch/ragdoll.h high above everything, its bones thrown all ways, but one that is led.
template <typename Ready>
class LedFigure {
public:
    LedFigure(World& world, std::uint32_t bone) : world_(world) {
        constexpr std::uint32_t bones = sizeof(Ready::bones) / sizeof(lks_bone);
        bodies_.resize(bones);
        joints_.resize(bones - 1);
        ready_.def.transform.position = fixed(0, 10, 0);
        REQUIRE(ready_.add(world, bodies_.data(), joints_.data()) == LKS_OK);
        for (std::uint32_t i = 0; i < bones; ++i) {
            const auto part = [i](double by) { return 3 * std::sin(i * by); };
            REQUIRE(lks_body_set_velocity(world, bodies_[i], fixed(part(1.7), part(2.9), part(4.3)), {}) ==
                    LKS_OK);
        }
        led_ = bodies_[bone];
        REQUIRE(lks_body_set_kind(world, led_, LKS_BODY_KINEMATIC) == LKS_OK);
        REQUIRE(lks_body_transform(world, led_, &start_) == LKS_OK);
        first_ = energy();
    }

    // On a circle of a metre.
    void lead(int tick, double speed) {
        REQUIRE(lks_body_move_to(world_, led_, on_circle(start_, speed * tick / 60)) == LKS_OK);
    }

    void step() {
        world_.step();
        for (std::size_t i = 0; i < joints_.size(); ++i) {
            apart_ = std::max(apart_, error_of(world_, joints_[i]));
            // Joints are those of the bones behind the first.
            beyond_ = std::max(beyond_, degrees_beyond(world_, ready_.bones[i + 1], joints_[i]));
        }
        kinetic_ = std::max(kinetic_, motion());
        gained_ = std::max(gained_, energy() - first_);
    }

    double apart() const { return apart_; }
    double beyond() const { return beyond_; }   // of limits: degrees
    double kinetic() const { return kinetic_; } // joules, the most
    double gained() const { return gained_; }

private:
    double motion() const { return energy_of(world_); }
    double energy() const { return whole_energy(world_, bodies_.data(), bodies_.size()); }

    World& world_;
    Ready ready_;
    std::vector<lks_body_id> bodies_;
    std::vector<lks_joint_id> joints_;
    lks_body_id led_{};
    lks_transform start_{};
    double first_ = 0;
    double apart_ = 0;
    double beyond_ = 0;
    double kinetic_ = 0;
    double gained_ = 0;
};

struct Bounds {
    double apart;   // m
    double beyond;  // degrees
    double gained;  // J
    double kinetic; // J
};

template <typename Ready>
void check_bones(const std::string& name, std::uint32_t substeps, double speed, int ticks,
                 const Bounds& bounds) {
    constexpr std::uint32_t bones = sizeof(Ready::bones) / sizeof(lks_bone);
    Bounds worst{};
    for (std::uint32_t bone = 0; bone < bones; ++bone) {
        World world(world_def(60, substeps));
        LedFigure<Ready> figure(world, bone);
        for (int tick = 0; tick < ticks; ++tick) {
            if (speed != 0) {
                figure.lead(tick, speed);
            }
            figure.step();
        }
        INFO(name << ", bone " << bone << ", " << speed << " m/s, " << substeps << " substeps");
        CHECK(figure.apart() < bounds.apart);
        CHECK(figure.beyond() < bounds.beyond);
        CHECK(figure.kinetic() < bounds.kinetic);
        CHECK((speed != 0 || figure.gained() < bounds.gained));
        worst = {std::max(worst.apart, figure.apart()), std::max(worst.beyond, figure.beyond()),
                 std::max(worst.gained, figure.gained()), std::max(worst.kinetic, figure.kinetic())};
    }
    MESSAGE(name << ", " << speed << " m/s, " << substeps << " substeps: " << 1e3 * worst.apart
                 << " mm apart, limits exceeded by " << worst.beyond << " degrees, " << worst.gained
                 << " J gained, " << worst.kinetic << " J at the most");
}

} // namespace

TEST_CASE("a figure of which any bone is kinematic keeps together and gains nothing" *
          doctest::skip(support::sanitised)) {
    check_bones<Humanoid>("humanoid", 8, 0, 400, {0.2e-3, 4, 1, 1200});
    check_bones<Humanoid>("humanoid", 4, 0, 400, {0.5e-3, 5, 1, 1200});
    check_bones<Humanoid>("humanoid", 2, 0, 400, {0.5e-3, 5, 1, 1200});
    check_bones<Spider>("spider", 8, 0, 400, {0.2e-3, 1, 1, 100});
}

TEST_CASE("a figure of which any bone is led about keeps together" * doctest::skip(support::sanitised)) {
    check_bones<Humanoid>("humanoid", 8, 2, 400, {0.5e-3, 5, 0, 2e3});
    check_bones<Humanoid>("humanoid", 8, 6, 400, {1e-3, 8, 0, 18e3});
    check_bones<Humanoid>("humanoid", 4, 6, 400, {3e-3, 15, 0, 18e3});
    check_bones<Spider>("spider", 8, 6, 400, {0.5e-3, 3, 0, 3e3});
}

// Arms that whip straight between a hand that is held and a body of 78 kg once gained as much as the figure
// had.
TEST_CASE("a figure that hangs by any of its bones, turned any way, gains little") {
    for (const std::uint32_t substeps : {3u, 4u, 8u}) {
        Random random(7);
        const auto chance = [&random](double low, double high) {
            return low + (high - low) * 1e-6 * static_cast<double>(random.between(0, 1000000));
        };
        double apart = 0;
        double most = 0;
        for (int figure = 0; figure < 16; ++figure) {
            World world(world_def(60, substeps));
            HangingFigure hanging(world, figure % static_cast<int>(LKS_HUMANOID_BONES),
                                  about(chance(-1, 1), chance(-1, 1), chance(-1, 1), chance(0, 360)));
            for (int tick = 0; tick < 300; ++tick) {
                hanging.step();
            }
            apart = std::max(apart, hanging.apart());
            most = std::max(most, hanging.rise());
        }
        MESSAGE(substeps << " substeps: " << 1e3 * apart << " mm apart, " << most << " J gained");
        CHECK(apart < 3e-3);
        CHECK(most < 60); // of 1 to 2 kJ: what parts lifts what lies upon it
    }
}
