// Particles near a shape that turns are found by the kernels' question, too: what follows is the same as from
// looking at each of them.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "collide_support.h"
#include "kernels/compiled_kernels.h"
#include "wide_kernels.h"

using namespace collide_test;
using lks::ColliderState;
using lks::ContactFrame;
using lks::Shape;

namespace {

using Arrays = std::array<std::vector<std::int64_t>, 6>; // x, y, z, and where they were

// Around the origin, on ways of a centimetre, or from far on one side to the other.
Arrays random_particles(Dice& dice, bool far) {
    Arrays arrays;
    for (int i = 0; i < 150; ++i) {
        const Point start = dice.in_cube(far ? 30 : 1);
        const Point end = far ? start * -0.3L + dice.in_cube(4) : start + dice.in_cube(0.01L);
        const lks::fixed::Vec3 from = coordinates(start);
        const lks::fixed::Vec3 to = coordinates(end);
        const std::int64_t values[6] = {to.x, to.y, to.z, from.x, from.y, from.z};
        for (std::size_t k = 0; k < 6; ++k) {
            arrays[k].push_back(values[k]);
        }
    }
    return arrays;
}

void resolve(const ContactFrame& frame, Arrays& a, const lks::Kernels& kernels) {
    lks::resolve_contacts(frame,
                          {a[0].data(), a[1].data(), a[2].data(), a[3].data(), a[4].data(), a[5].data()}, 0,
                          static_cast<std::uint32_t>(a[0].size()), kernels);
}

// The least that greatest_growth may be.
std::int64_t greatest_growth(const Arrays& a) {
    std::int64_t greatest = 0;
    for (std::size_t i = 0; i < a[0].size(); ++i) {
        std::int64_t sum = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            sum += std::abs(a[axis][i] - a[axis + 3][i]);
        }
        greatest = std::max(greatest, sum / 2 + 1);
    }
    return greatest;
}

} // namespace

TEST_CASE("collide: a kernel finds the particles near a shape that turns as well as looking at each does") {
    Dice dice(9);
    int hits = 0;
    int asked = 0;
    for (int sample = 0; sample < 3000; ++sample) {
        const Shape shape = sample % 3 == 0   ? box(0.5L, 0.1L, 0.3L)
                            : sample % 3 == 1 ? capsule(0.1L, 0.4L)
                                              : box(0.02L, 0.6L, 0.02L);
        ColliderState collider = resting(shape, dice.in_cube(0.5L), dice.rotation(360));
        collider.target_position = collider.position + worlds(dice.in_cube(0.5L));
        collider.target_rotation =
            lks::fixed::normalise(lks::fixed::multiply(dice.rotation(19), collider.rotation));
        const Arrays start = random_particles(dice, sample % 2 == 0);
        ContactFrame frame = Particle::at({0, 0, 0}, {0, 0, 0}).frame(collider, 1, 1 + dice.below(2));
        frame.reachable = true;
        Arrays expected = start;
        resolve(frame, expected, lks::kernels_scalar);
        hits += expected == start ? 0 : 1;
        asked += frame.rotating && frame.has_box ? 1 : 0;
        frame.greatest_growth = greatest_growth(start);
        for (const lks::Kernels* kernels : lks::test::wide_kernels()) {
            Arrays found = start;
            resolve(frame, found, *kernels);
            REQUIRE(found == expected);
        }
        Arrays found = start;
        resolve(frame, found, lks::kernels_scalar);
        REQUIRE(found == expected);
    }
    CHECK(hits > 500);
    CHECK(asked > 500);
}
