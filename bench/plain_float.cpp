#include "plain_float.h"

#include <algorithm>
#include <cmath>

namespace lks_bench {

FloatCloth make_float_cloth(const lks_asset& asset, bool by_colour) {
    constexpr float metre = 1.0f / 72057594037927936.0f; // 2^-56
    FloatCloth cloth;
    cloth.particles.resize(asset.vertex_count());
    for (std::uint32_t particle = 0; particle < asset.vertex_count(); ++particle) {
        const lks::Coordinates& p = asset.rest_positions[particle];
        // A little out of place, so that there is something to correct.
        const auto jitter = 1e-3f * static_cast<float>(particle * 2654435761u >> 24) / 256.0f;
        cloth.particles[asset.particle_to_vertex[particle]] = {
            static_cast<float>(p.x) * metre + jitter, static_cast<float>(p.y) * metre - jitter,
            static_cast<float>(p.z) * metre + jitter, 1000.0f};
    }
    cloth.particles.front().inverse_mass = 0;
    for (std::uint32_t i = 0; i < asset.constraint_count(); ++i) {
        const std::uint32_t a = asset.particle_to_vertex[asset.constraints[i].a];
        const std::uint32_t b = asset.particle_to_vertex[asset.constraints[i].b];
        cloth.edges.push_back(
            {std::min(a, b), std::max(a, b), static_cast<float>(asset.rest_lengths[i]) * metre});
    }
    if (!by_colour) {
        std::stable_sort(cloth.edges.begin(), cloth.edges.end(),
                         [](const FloatEdge& l, const FloatEdge& r) { return l.a < r.a; });
    }
    return cloth;
}

void project_float(FloatCloth& cloth) {
    for (const FloatEdge& edge : cloth.edges) {
        FloatParticle& a = cloth.particles[edge.a];
        FloatParticle& b = cloth.particles[edge.b];
        const float x = a.x - b.x;
        const float y = a.y - b.y;
        const float z = a.z - b.z;
        const float length = std::sqrt(x * x + y * y + z * z);
        const float sum = a.inverse_mass + b.inverse_mass;
        if (length == 0 || sum == 0) {
            continue;
        }
        const float factor = (edge.rest - length) / (length * sum);
        a.x += x * factor * a.inverse_mass;
        a.y += y * factor * a.inverse_mass;
        a.z += z * factor * a.inverse_mass;
        b.x -= x * factor * b.inverse_mass;
        b.y -= y * factor * b.inverse_mass;
        b.z -= z * factor * b.inverse_mass;
    }
}

} // namespace lks_bench
