// A hinge's friction acts about its axis: what the hinge bears across takes nothing of it.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

constexpr double g = 9.81;

// A level beam of one metre on a hinge at its end, whose axis leans by `lean` degrees from the vertical in
// the plane across the beam: gravity turns the beam about the axis by the sine of that, and the hinge bears
// the cosine.
class LeaningHinge {
public:
    LeaningHinge(std::uint32_t substeps, double lean) : world_(world_def(60, substeps)) {
        lks_body_def def = lks_default_body_def();
        def.never_sleeps = 1;
        anchor_ = add_anchor(world_, {});
        beam_ = add_body(world_, box_shape(0.05, 0.05, 0.5), fixed(0, 0, 0.5), def);
        joint_.kind = LKS_JOINT_HINGE;
        joint_.frame_a.rotation = joint_.frame_b.rotation = about(0, 0, 1, -lean);
        joint_.frame_b.position = fixed(0, 0, -0.5);
        const double mass = mass_of(world_, beam_);
        inertia_ = mass * ((1 + 0.01) / 12 + 0.25);
        moment_ = mass * g * 0.5 * std::sin(lean * std::numbers::pi / 180);
    }

    // As a share of what gravity turns it by.
    void rub(double share) {
        joint_.friction = fixed(share * moment_);
        hinge_ = add_joint(world_, joint_, anchor_, beam_);
    }

    void step(int ticks) { world_.step(ticks); }
    // Degrees.
    double turned() const {
        lks_fixed twist = 0;
        REQUIRE(lks_joint_angles(world_, hinge_, nullptr, &twist) == LKS_OK);
        return metres(twist);
    }
    double speed() const { return state_of(world_, beam_).spin.length(); }
    // Of a share of friction that it slips under, rad/s².
    double acceleration(double share) const { return (1 - share) * moment_ / inertia_; }

private:
    World world_;
    lks_body_id anchor_{}, beam_{};
    lks_joint_id hinge_{};
    lks_joint_def joint_ = lks_default_joint_def();
    double inertia_ = 0, moment_ = 0;
};

} // namespace

TEST_CASE("a hinge's friction holds what turns about its axis, whatever the hinge bears across") {
    for (const std::uint32_t substeps : {1u, 4u, 8u, 20u}) {
        for (const double lean : {3., 10., 45., 90.}) {
            INFO(substeps << " substeps, leaning by " << lean << " degrees");
            LeaningHinge held(substeps, lean);
            held.rub(1.05);
            held.step(30); // it takes up the load
            const double before = held.turned();
            held.step(600);
            INFO("turned by " << before << ", then by " << held.turned() - before << " degrees");
            CHECK(std::abs(before) < 1.2 / (substeps * substeps));
            CHECK(std::abs(held.turned() - before) < 1e-3);

            LeaningHinge slipping(substeps, lean);
            slipping.rub(0.8);
            slipping.step(5);
            const double slow = slipping.speed();
            slipping.step(5);
            const double gained = slipping.speed() - slow;
            const double expected = slipping.acceleration(0.8) * 5 / 60;
            INFO("gains " << gained << " of " << expected << " rad/s");
            CHECK(std::abs(gained / expected - 1) < (substeps == 1 ? 0.03 : 0.01));
        }
    }
}
