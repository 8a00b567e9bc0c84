#include "spheres.h"

#include <algorithm>
#include <cmath>

namespace lks_bench {

std::vector<std::vector<FloatSphere>> spheres_of(const Workload& workload) {
    std::vector<std::vector<FloatSphere>> spheres(workload.objects);
    for (std::size_t object = 0; workload.colliders && object < spheres.size(); ++object) {
        for (const Ball& ball : balls) {
            const int x = ball.x - object_distance * static_cast<int>(object);
            const auto metres = [](int tenths) { return static_cast<float>(tenths) / 10; };
            spheres[object].push_back({metres(x), metres(ball.y), metres(ball.z), metres(ball.radius)});
        }
    }
    return spheres;
}

Resting resting(const std::vector<Point>& points, const std::vector<FloatSphere>& spheres) {
    constexpr double near = 1e-3;
    Resting found;
    for (const Point& p : points) {
        double height = near;
        for (const FloatSphere& sphere : spheres) {
            const double distance =
                std::hypot(p.x - static_cast<double>(sphere.x), p.y - static_cast<double>(sphere.y),
                           p.z - static_cast<double>(sphere.z));
            height = std::min(height, distance - static_cast<double>(sphere.radius));
        }
        found.deepest = std::max(found.deepest, -height);
        found.points += height < near ? 1 : 0;
    }
    return found;
}

} // namespace lks_bench
