#include "scenes/pennant_mesh.h"

#include <cstddef>

namespace lks_demo {
namespace {

// In 1/1024 m.
constexpr std::int32_t spacing = 44;
constexpr std::int32_t columns = 60;
constexpr std::int32_t hoist_height = 1200;
constexpr std::int32_t fly_height = 330;
constexpr std::int32_t greatest_shake =
    11; // of each coordinate: a quarter of the spacing keeps triangles whole
constexpr double unit = 1.0 / 1024.0;

struct Point {
    std::int32_t x, y;
};

struct Column {
    std::uint32_t first;
    std::uint32_t count;
};

// A well-mixed number of two small ones (the finaliser of MurmurHash3, by its published constants).
std::uint32_t hash(std::uint32_t a, std::uint32_t b) {
    std::uint32_t h = a * 0x9e3779b1u + b * 0x85ebca77u + 1u;
    h = (h ^ h >> 16) * 0x85ebca6bu;
    h = (h ^ h >> 13) * 0xc2b2ae35u;
    return h ^ h >> 16;
}

std::int32_t shake(std::uint32_t a, std::uint32_t b) {
    return static_cast<std::int32_t>(hash(a, b) % (2 * greatest_shake + 1)) - greatest_shake;
}

class PennantMaker {
public:
    PennantMesh make() {
        for (std::int32_t i = 0; i < columns; ++i) {
            add_column(i);
        }
        for (std::size_t i = 0; i + 1 < columns_.size(); ++i) {
            join(columns_[i], columns_[i + 1]);
        }
        for (const Point& point : points_) {
            mesh_.vertices.insert(mesh_.vertices.end(), {point.x * unit, point.y * unit, 0.0});
        }
        mesh_.hoist_vertices = columns_[0].count;
        return mesh_;
    }

private:
    void add_column(std::int32_t i) {
        const std::int32_t height = hoist_height - (hoist_height - fly_height) * i / (columns - 1);
        const std::int32_t gaps = (height + spacing / 2) / spacing;
        columns_.push_back(
            {static_cast<std::uint32_t>(points_.size()), static_cast<std::uint32_t>(gaps + 1)});
        for (std::int32_t j = 0; j <= gaps; ++j) {
            const auto number = static_cast<std::uint32_t>(points_.size());
            Point point = {i * spacing, height / 2 - height * j / gaps};
            // The outline stays smooth: along it, only the direction of the edge is shaken.
            const bool rim = j == 0 || j == gaps;
            const bool end = i == 0 || i == columns - 1;
            point.x += end ? 0 : shake(number, 1);
            point.y += rim ? 0 : shake(number, 2);
            points_.push_back(point);
        }
    }

    // Goes down both columns and always takes the shorter of the two possible diagonals.
    void join(const Column& left, const Column& right) {
        std::uint32_t a = left.first;
        std::uint32_t b = right.first;
        const std::uint32_t last_a = left.first + left.count - 1;
        const std::uint32_t last_b = right.first + right.count - 1;
        while (a < last_a || b < last_b) {
            const bool down_left =
                b == last_b || (a < last_a && squared_distance(a + 1, b) <= squared_distance(a, b + 1));
            if (down_left) {
                mesh_.triangles.insert(mesh_.triangles.end(), {a, a + 1, b});
                ++a;
            } else {
                mesh_.triangles.insert(mesh_.triangles.end(), {a, b + 1, b});
                ++b;
            }
        }
    }

    std::int64_t squared_distance(std::uint32_t a, std::uint32_t b) const {
        const std::int64_t x = points_[a].x - points_[b].x;
        const std::int64_t y = points_[a].y - points_[b].y;
        return x * x + y * y;
    }

    std::vector<Point> points_;
    std::vector<Column> columns_;
    PennantMesh mesh_;
};

} // namespace

PennantMesh make_pennant() {
    return PennantMaker().make();
}

} // namespace lks_demo
