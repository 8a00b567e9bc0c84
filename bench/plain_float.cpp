#include "plain_float.h"

#include <algorithm>
#include <cmath>

#include "masses.h"

namespace lks_bench {

FloatCloth make_float_cloth(const lks_asset& asset, const std::vector<std::uint32_t>& pinned,
                            EdgeOrder order) {
    constexpr float metre = 1.0f / 72057594037927936.0f; // 2^-56
    const std::vector<double> weights = inverse_masses_of(asset, pinned);
    FloatCloth cloth;
    cloth.particles.resize(asset.vertex_count());
    for (std::uint32_t particle = 0; particle < asset.vertex_count(); ++particle) {
        const lks::Coordinates& p = asset.rest_positions[particle];
        cloth.particles[asset.particle_to_vertex[particle]] = {
            static_cast<float>(p.x) * metre, static_cast<float>(p.y) * metre, static_cast<float>(p.z) * metre,
            static_cast<float>(weights[particle])};
    }
    cloth.starts = cloth.particles;
    for (std::uint32_t i = 0; i < asset.constraint_count(); ++i) {
        const std::uint32_t a = asset.particle_to_vertex[asset.constraints[i].a];
        const std::uint32_t b = asset.particle_to_vertex[asset.constraints[i].b];
        cloth.edges.push_back(
            {std::min(a, b), std::max(a, b), static_cast<float>(asset.rest_lengths[i]) * metre});
    }
    if (order == EdgeOrder::by_index) {
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

void push_out_float(FloatCloth& cloth, const FloatSphere& sphere) {
    for (FloatParticle& particle : cloth.particles) {
        const float x = particle.x - sphere.x;
        const float y = particle.y - sphere.y;
        const float z = particle.z - sphere.z;
        const float square = x * x + y * y + z * z;
        if (particle.inverse_mass > 0 && square < sphere.radius * sphere.radius && square > 0) {
            const float factor = sphere.radius / std::sqrt(square) - 1;
            particle.x += x * factor;
            particle.y += y * factor;
            particle.z += z * factor;
        }
    }
}

void predict_float(FloatCloth& cloth, float fall) {
    for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
        FloatParticle& now = cloth.particles[i];
        FloatParticle& start = cloth.starts[i];
        const FloatParticle before = now;
        if (now.inverse_mass > 0) {
            now.x += now.x - start.x;
            now.y += now.y - start.y + fall;
            now.z += now.z - start.z;
        }
        start = before;
    }
}

void lay_level(FloatCloth& cloth) {
    for (FloatParticle& particle : cloth.particles) {
        const float upright = particle.y;
        particle.y = -particle.z;
        particle.z = upright;
    }
    cloth.starts = cloth.particles;
}

std::vector<Point> points_of(const FloatCloth& cloth) {
    std::vector<Point> found;
    for (const FloatParticle& particle : cloth.particles) {
        found.push_back({particle.x, particle.y, particle.z});
    }
    return found;
}

} // namespace lks_bench
