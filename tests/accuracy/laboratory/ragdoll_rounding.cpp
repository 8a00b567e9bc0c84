// Rounding of ragdolls beside what their substeps are off: a humanoid, and four on stairs, against their twin
// in double precision.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "accuracy/stairs.h"
#include "reference/rigid_bounds.h"
#include "reference/rigid_xpbd.h"

using namespace support;
using namespace reference;

namespace {

constexpr int recommended_substeps = 5;

// The humanoid, turning over in the air and then on the ground. Its bones don't touch each other, and its
// joints have no friction, which the twin does not know.
void throw_humanoid(RigidScene& scene) {
    scene.add_ground(0.5, 0.5, false);
    const Humanoid humanoid;
    const Vector spin{3, 0.5, 1};
    const auto cross = [](const Vector& a, const Vector& b) {
        return Vector{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    };
    for (const lks_bone& bone : humanoid.bones) {
        lks_body_def def = bone.body;
        const Vector v = cross(spin, metres(def.transform.position) - Vector{0, 1, 0}) + Vector{0.5, 0, 1};
        def.velocity = fixed(v.x, v.y, v.z);
        def.angular_velocity = fixed(spin.x, spin.y, spin.z);
        def.transform.position = def.transform.position + fixed(0, 0.3, 0);
        const std::size_t body = scene.add(humanoid.shapes[&bone - humanoid.bones], def);
        if (bone.parent == LKS_NO_PARENT) {
            continue;
        }
        REQUIRE(bone.limit_compliance == 0);
        scene.join(joint_of_bone(humanoid.bones, static_cast<std::uint32_t>(body)), bone.parent, body);
    }
}

std::vector<Vector> bones_after(const RigidModel& model, int substeps, int ticks) {
    RigidSolver<double> solver(model, with_substeps(substeps));
    solver.tick(ticks);
    std::vector<Vector> bones;
    for (std::size_t i = 0; i < solver.size(); ++i) {
        bones.push_back(solver.position(i));
    }
    return bones;
}

} // namespace

TEST_CASE("rounding of a thrown humanoid at 5 substeps is below a tenth of the method's own error") {
    for (const int ticks : {15, 30, 45}) {
        RigidScene scene(with_substeps(recommended_substeps));
        throw_humanoid(scene);
        const std::vector<Vector> method = bones_after(scene.model(), recommended_substeps, ticks);
        const std::vector<Vector> converged = bones_after(scene.model(), long_runs() ? 1280 : 160, ticks);
        double off = 0;
        for (std::size_t i = 0; i < method.size(); ++i) {
            off = std::max(off, (method[i] - converged[i]).length());
        }
        const RigidDeviation rounding = scene.run({ticks}).back();
        std::printf("humanoid, 5 substeps, %2d ticks: method %.1e m, fixed-point %.1e m, float32 %.1e m\n",
                    ticks, off, rounding.fixed_point.metres, rounding.single.metres);
        INFO(ticks << " ticks");
        CHECK(off > 1e-3);
        CHECK(rounding.fixed_point.metres > 0);
        CHECK(rounding.fixed_point.metres < off / 10);
    }
}

TEST_CASE("rounding on the stairs is below a tenth of what places are off, and joints but with 20 substeps") {
    // As long as both stumble alike.
    const lks_accuracy::Experiment stairs = lks_accuracy::measure_stairs(
        {{recommended_substeps, 10, 20}, {1}, 20}, 18, [](const std::string&) {});
    for (const int substeps : {recommended_substeps, 10, 20}) {
        const auto errors_of = [&](const std::string& solver) {
            const auto row = std::find_if(stairs.rows.begin(), stairs.rows.end(), [&](const auto& candidate) {
                return candidate.solver == solver && candidate.schedule.substeps == substeps;
            });
            REQUIRE(row != stairs.rows.end());
            return row->errors;
        };
        const std::vector<double> method = errors_of("double");
        const std::vector<double> ours = errors_of("fixed-point");
        const double joints = std::abs(ours[0] - method[0]);
        const double places = ours[stairs.rounding];
        std::printf(
            "stairs, %d substeps, 18 ticks: joints %.1e mm, rounding of it %.1e; places %.1e m, %.1e; "
            "float32 %.1e\n",
            substeps, method[0], joints, method[stairs.discretisation()], places,
            errors_of("float32")[stairs.rounding]);
        INFO(substeps << " substeps");
        CHECK(joints > 0);
        // With 20 the method leaves a few nanometres.
        CHECK(joints < method[0] / (substeps == 20 ? 2 : 10));
        CHECK(places > 0);
        CHECK(places < method[stairs.discretisation()] / 10);
        CHECK(places < errors_of("float32")[stairs.rounding]);
    }
}
