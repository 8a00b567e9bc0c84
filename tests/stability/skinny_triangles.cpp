// Triangles ten thousand times as long as they are wide.
#include <doctest/doctest.h>

#include <numeric>
#include <string>
#include <vector>

#include "stability/support/table.h"
#include "stability/support/trial.h"

using namespace support;
using namespace stability;

namespace {

// A ribbon of `length`, `width` wide, cut across into needles or lengthwise into slivers.
Mesh ribbon(std::uint32_t columns, std::uint32_t rows, double length, double width) {
    Mesh mesh;
    for (std::uint32_t row = 0; row <= rows; ++row) {
        for (std::uint32_t column = 0; column <= columns; ++column) {
            mesh.vertices.insert(mesh.vertices.end(), {length * column / columns, -width * row / rows, 0});
        }
    }
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t corner = row * (columns + 1) + column;
            const std::uint32_t below = corner + columns + 1;
            mesh.triangles.insert(mesh.triangles.end(), {corner, below, corner + 1});
            mesh.triangles.insert(mesh.triangles.end(), {corner + 1, below, below + 1});
        }
    }
    return mesh;
}

void hang(const std::string& name, const Mesh& mesh, std::uint32_t pins, std::uint32_t hz, int ticks,
          double stretch, const Aftermath& aftermath, double long_stretch, bool tethered) {
    const std::size_t count = mesh.vertices.size() / 3;
    const std::vector<double> masses(count, 0.01);
    lks_cloth_def def = mesh.def();
    def.mass = def.area_density = 0;
    def.vertex_masses = masses.data();
    def.stretch = def.shear = def.bend = stiff();
    std::vector<std::uint32_t> anchors(pins);
    std::iota(anchors.begin(), anchors.end(), 0u);
    if (tethered) {
        def.tether_anchors = anchors.data();
        def.tether_anchor_count = pins;
    }
    const Asset asset(def);
    Subject subject;
    subject.asset = &asset;
    subject.masses = masses;
    subject.materials = {stiff(), stiff(), stiff()};
    subject.world = world_def(hz, 20);
    subject.transform = turned(lks_transform_identity(), 1, 0, 0, 90);
    Trial trial(subject);
    for (std::uint32_t pin = 0; pin < pins; ++pin) {
        trial.pin(pin);
    }
    trial.run(ticks);
    expect_stretch_at_most(name, trial, stretch, aftermath);
    // Edges of 0.1 mm take the error of the long ones beside them: by length it is small.
    trial.meter().leave_out_shorter_than(0.5);
    trial.begin();
    expect_at_most(name, "stretch of long edges, at the end", "%", long_stretch,
                   100 * trial.fixed().last().stretch, 100 * trial.single().last().stretch);
    expect_gain_at_most(name, trial, 1);
    expect_nothing_clamped(trial);
}

} // namespace

TEST_CASE("triangles of 1:10,000 hold together") {
    // Held by one short side, by the first vertex of each sliver's end, and by a long side.
    for (const bool tethered : {false, true}) {
        const std::string what = tethered ? "30 tethered " : "30 ";
        hang(what + "slivers of 1 m × 0.1 mm, held at a long side", ribbon(1, 30, 1, 0.003), 2, 60, 300, 2000,
             tethered ? Aftermath{4} : Aftermath{0, 42}, 1e-3, tethered);
        hang(what + "needles of 0.1 mm × 1 m, held at one end", ribbon(30, 1, 0.003, 1), 31, 60, 300, 6, {},
             1e-4, tethered);
        hang(what + "needles of 0.1 mm × 1 m, held at a corner", ribbon(30, 1, 0.003, 1), 1, 60, 300, 2000,
             {0, tethered ? 30. : 32.}, 0.1, tethered);
    }
}
