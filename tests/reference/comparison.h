// The SDK, the double-precision solver and its float32 twin run the same scene; how far apart do they end?
#pragma once

#include <cstdint>
#include <vector>

#include "reference/asset_model.h"
#include "reference/xpbd.h"
#include "support/handles.h"

namespace reference {

struct Scenario {
    const support::Asset* asset = nullptr;
    lks_transform transform = lks_transform_identity();
    std::vector<double> masses{};
    Materials materials{};
    std::vector<std::uint32_t> pins{};
    Settings settings{};
    int ticks = 60;
    lks_vec3 velocity{}; // of every particle at the start
    double spin = 0;     // and about z through the first particle, rad/s: v += spin × (x − x_0)
    bool direct = false; // a rope whose segments are solved at once
};

// Largest distance of any particle from where the double-precision solver has it, metres.
struct Deviation {
    double fixed_point = 0;
    double single = 0;
    double single_at_100_metres = 0;
};

Deviation deviation_of(const Scenario& scenario);

} // namespace reference
