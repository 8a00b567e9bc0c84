#include "mesh_shape.h"

#include <numeric>
#include <random>
#include <utility>

namespace lks_bench {
namespace {

// Only what the standard fixes to the bit: the engine, and no distribution.
class Chance {
public:
    std::uint32_t below(std::uint32_t limit) { return static_cast<std::uint32_t>(engine_() % limit); }
    double around_zero() { return (static_cast<double>(engine_() % 65536) - 32768) / 32768; }

private:
    std::mt19937 engine_{12345};
};

} // namespace

MeshShape make_mesh(std::uint32_t side) {
    Chance chance;
    std::vector<std::uint32_t> place(std::size_t{side} * side); // of a point of the grid among the vertices
    std::iota(place.begin(), place.end(), 0u);
    for (std::uint32_t i = side * side; i > 1; --i) {
        std::swap(place[i - 1], place[chance.below(i)]);
    }
    MeshShape mesh;
    mesh.vertices.resize(3 * place.size());
    const double spacing = 2.0 / (side - 1);
    for (std::uint32_t row = 0; row < side; ++row) {
        for (std::uint32_t column = 0; column < side; ++column) {
            double* vertex = &mesh.vertices[3 * place[std::size_t{row} * side + column]];
            vertex[0] = spacing * (column + 0.25 * chance.around_zero());
            vertex[1] = -spacing * (row + 0.25 * chance.around_zero());
        }
    }
    for (std::uint32_t row = 0; row + 1 < side; ++row) {
        for (std::uint32_t column = 0; column + 1 < side; ++column) {
            const std::uint32_t* upper = &place[std::size_t{row} * side + column];
            const std::uint32_t* lower = upper + side;
            if (chance.below(2) == 0) {
                mesh.triangles.insert(mesh.triangles.end(),
                                      {lower[0], lower[1], upper[1], lower[0], upper[1], upper[0]});
            } else {
                mesh.triangles.insert(mesh.triangles.end(),
                                      {lower[0], lower[1], upper[0], lower[1], upper[1], upper[0]});
            }
        }
    }
    mesh.corners[0] = place[0];
    mesh.corners[1] = place[side - 1];
    return mesh;
}

} // namespace lks_bench
