// Bounds for what rigid bodies in fixed point may be off by from the double-precision twin, for tests.
#pragma once

#include <doctest/doctest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "reference/rigid_comparison.h"
#include "support/bodies.h"

namespace reference {

inline constexpr int second = 60; // in ticks

inline Settings with_substeps(int substeps) {
    Settings settings;
    settings.substeps = substeps;
    return settings;
}

// What fixed point may be off by, and how many times further float32 is off at least.
struct RigidBounds {
    double metres;
    double radians;
    double better_metres;
};

inline void check(const std::string& name, const RigidDeviation& d, const RigidBounds& bounds) {
    char line[160];
    std::snprintf(line, sizeof line, "%-36s fixed %8.1e m %8.1e rad, float32 %8.1e m %8.1e rad", name.c_str(),
                  d.fixed_point.metres, d.fixed_point.radians, d.single.metres, d.single.radians);
    MESSAGE(line);
    CHECK(d.fixed_point.metres <= bounds.metres);
    CHECK(d.fixed_point.radians <= bounds.radians);
    CHECK(d.single.metres >= bounds.better_metres * d.fixed_point.metres);
}

// After one second and after ten.
inline void check_run(const std::string& name, RigidScene& scene, const RigidBounds& one,
                      const RigidBounds& ten, const RigidScene::Leading& leading = {}) {
    const std::vector<RigidDeviation> d = scene.run({second, 10 * second}, leading);
    check(name + ", 1 s", d[0], one);
    check(name + ", 10 s", d[1], ten);
}

inline std::string substeps_name(int substeps) {
    return ", " + std::to_string(substeps) + " substeps";
}

inline lks_body_def at_rest(const lks_vec3& position) {
    lks_body_def def = lks_default_body_def();
    def.transform.position = position;
    return def;
}

inline lks_body_def with_friction(const lks_vec3& position, double friction = 0.5) {
    lks_body_def def = at_rest(position);
    def.static_friction = def.dynamic_friction = support::fixed(friction);
    return def;
}

inline lks_joint_def joint(std::uint32_t kind, const lks_vec3& point_a, const lks_vec3& point_b) {
    lks_joint_def def = lks_default_joint_def();
    def.kind = kind;
    def.frame_a.position = point_a;
    def.frame_b.position = point_b;
    return def;
}

} // namespace reference
