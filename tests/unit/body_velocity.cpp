// How fast a body's points are (rigid/body_motion.h): also far out on a plane that turns.
#include <doctest/doctest.h>

#include "rigid/body_motion.h"

using namespace lks;
using fixed::Vec3;

namespace {

constexpr std::int64_t metre = std::int64_t{1} << world_fraction_bits;

Body turning(const Vec3& velocity, const Vec3& spin) {
    Body body{};
    body.velocity = velocity;
    body.angular_velocity = spin;
    return body;
}

} // namespace

TEST_CASE("a point moves with its body and by its spin across its lever") {
    const Body body = turning({metre, 0, -metre}, {0, 0, 2 * metre});
    CHECK(velocity_at(body, {0, 0, 5 * metre}) == body.velocity);
    CHECK(velocity_at(body, {3 * metre, 0, 0}) == Vec3{metre, 6 * metre, -metre});
    CHECK(velocity_at(body, {0, 3 * metre, 0}) == Vec3{-5 * metre, 0, -metre});
}

TEST_CASE("what would be faster than any number stays within a million metres a second") {
    // Where spin and lever add up along one axis both products leave 64 bits to the same side.
    constexpr std::int64_t far = std::int64_t{1} << 62; // 4,194 km
    const Body body = turning({1000 * metre, 1000 * metre, 1000 * metre}, {-1000 * metre, 0, 1000 * metre});
    const Vec3 speed = velocity_at(body, {far, far, far});
    constexpr std::int64_t most = (std::int64_t{1} << 19) * metre;
    CHECK(speed == Vec3{1000 * metre - most, 1000 * metre + 2 * most, 1000 * metre - most});
    CHECK(velocity_at(body, {-far, -far, -far}) ==
          Vec3{1000 * metre + most, 1000 * metre - 2 * most, 1000 * metre + most});
}
