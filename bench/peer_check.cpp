#include "peer_check.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "masses.h"

namespace lks_bench {
namespace {

// How far the centre of mass moves, relative to how far particles do.
double drift_of_centre(const lks_asset& asset, const std::vector<Point>& before,
                       const std::vector<Point>& after) {
    const std::vector<double> masses = masses_of(asset);
    Point sum{};
    double all = 0;
    for (std::size_t vertex = 0; vertex < before.size(); ++vertex) {
        const double mass = masses[asset.vertex_to_particle[vertex]];
        const double x = after[vertex].x - before[vertex].x;
        const double y = after[vertex].y - before[vertex].y;
        const double z = after[vertex].z - before[vertex].z;
        sum = {sum.x + mass * x, sum.y + mass * y, sum.z + mass * z};
        all += mass * std::hypot(x, y, z);
    }
    return std::hypot(sum.x, sum.y, sum.z) / all;
}

} // namespace

Point out_of_place(const Point& rest) {
    const auto moved = [](double x) { return x + 0.01 * x * x; };
    return {moved(rest.x), moved(rest.y), moved(rest.z)};
}

void put_out_of_place(FloatCloth& cloth) {
    for (FloatParticle& particle : cloth.particles) {
        const Point place = out_of_place({particle.x, particle.y, particle.z});
        particle.x = static_cast<float>(place.x);
        particle.y = static_cast<float>(place.y);
        particle.z = static_cast<float>(place.z);
    }
}

void demand_centre_kept(const lks_asset& asset, const std::string& peer, const std::vector<Point>& before,
                        const std::vector<Point>& after) {
    // Rounding to float32 moves it by up to 1e-5, equal masses in place of those by area by 2e-2 to 1e-1.
    constexpr double most = 1e-3;
    const double drift = drift_of_centre(asset, before, after);
    if (!(drift < most)) {
        std::fprintf(stderr,
                     "lockstitch: the benchmark's %s does not share corrections out by the asset's masses: a "
                     "free body's centre moves %g times as far as its particles.\n",
                     peer.c_str(), drift);
        std::exit(1);
    }
}

} // namespace lks_bench
