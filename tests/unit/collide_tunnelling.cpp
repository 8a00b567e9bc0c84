// Nothing gets through: thousands of random shots at up to 100 m/s, against plates, balls and everything
// else, at rest and moving, each substep judged by a reference in long double.
#include "collide_support.h"
#include "support/sanitised.h"

#include <doctest/doctest.h>

using namespace collide_test;
using lks::ColliderState;
using lks::ContactFrame;
using lks::Shape;

namespace {

constexpr Real tolerance = 1e-6L;

struct Verdict {
    int substeps = 0;
    int hits = 0;
    int stray_pushes = 0; // moved although its way was free
    Real deepest = 1;     // the least distance of an end
    Real deepest_way = 1; // the least distance on a way that began outside
};

// One substep of the particle, predicted already.
void judge(Particle& particle, const ContactFrame& frame, Verdict& verdict) {
    const Real margin = from_coordinate(particle.margin);
    const Point start = local_start(frame, particle.start);
    const lks::fixed::Vec3 predicted = particle.position;
    const bool began_outside = reference_distance(frame.shape, start, margin) > -tolerance;
    const Real free = least_distance(frame.shape, start, local_end(frame, predicted), margin);

    particle.resolve(frame);

    ++verdict.substeps;
    const bool moved = !(particle.position == predicted);
    verdict.hits += moved ? 1 : 0;
    if (moved && free > tolerance) {
        ++verdict.stray_pushes;
    }
    const Point end = local_end(frame, particle.position);
    verdict.deepest = std::fmin(verdict.deepest, reference_distance(frame.shape, end, margin));
    if (began_outside) {
        verdict.deepest_way = std::fmin(verdict.deepest_way, least_distance(frame.shape, start, end, margin));
    }
}

void check(const Verdict& verdict, int least_hits) {
    CHECK(verdict.deepest >= -tolerance);
    CHECK(verdict.deepest_way >= -tolerance);
    CHECK(verdict.stray_pushes == 0);
    CHECK(verdict.hits >= least_hits);
}

struct Range {
    Real travel = 0;  // metres a tick
    Real degrees = 0; // a tick
    Real margin = 0;
    Real aim = 1; // shots go to a point within this many times the size
};

Shape random_solid(Dice& dice) {
    const auto size = [&dice] { return std::pow(Real(10), dice.between(-1.6L, 0.5L)); };
    switch (dice.below(3)) {
    case 0:
        return sphere(size());
    case 1:
        return capsule(size(), size());
    default:
        return box(size(), size(), size());
    }
}

Point size_of(const Shape& shape) {
    const Real r = from_coordinate(shape.radius);
    if (shape.kind == LKS_SHAPE_BOX) {
        return to_point(shape.half_extents);
    }
    return {r, r + from_coordinate(shape.half_length), r};
}

// A shot: the particle starts outside and would, with everything going on evenly, meet a random point in or
// about the shape after half a tick; then two ticks run.
void shoot(Dice& dice, const Shape& shape, const Range& range, Verdict& verdict) {
    const auto substeps = 1 + dice.below(20);
    ColliderState collider = resting(shape, dice.in_cube(1), dice.rotation(360));
    collider.static_friction = world(dice.between(0, 1));
    collider.dynamic_friction = collider.static_friction / 2;
    const Point motion = dice.direction() * dice.between(0, range.travel);
    collider.target_position = worlds(
        to_point(lks::fixed::Vec3{collider.position.x, collider.position.y, collider.position.z}) * 65536.0L +
        motion);
    collider.target_rotation =
        lks::fixed::normalise(lks::fixed::multiply(dice.rotation(range.degrees), collider.rotation));

    const Point size = size_of(shape);
    const Point target = {dice.between(-1, 1) * size.x * range.aim, dice.between(-1, 1) * size.y * range.aim,
                          dice.between(-1, 1) * size.z * range.aim};
    const Point centre = to_point(collider.position) * 65536.0L + motion * 0.5L;
    const Point goal = centre + rotated(lks::fixed::to_matrix(collider.rotation), target);
    const Point velocity = dice.direction() * dice.between(0.1L, 100); // m/s
    const Real margin = range.margin == 0 ? 0 : dice.between(0, range.margin);
    Particle particle = Particle::at(goal - velocity * (0.5L / 60), velocity * (1.0L / 60 / substeps));
    particle.margin = coordinate(margin);

    const ContactFrame first = particle.frame(collider, 1, substeps);
    if (reference_distance(
            shape,
            rotated_back(first.start_rotation, to_point(particle.position) - to_point(first.start_centre)),
            from_coordinate(particle.margin)) <= 0) {
        return; // not outside: no shot
    }
    for (int tick = 0; tick < 2; ++tick) {
        for (std::uint32_t substep = 1; substep <= substeps; ++substep) {
            particle.predict({0, 0, 0});
            judge(particle, particle.frame(collider, substep, substeps), verdict);
        }
        finish_motion(collider);
    }
}

Verdict shoot_many(std::uint64_t seed, int shots, const Range& range, const Shape* shape = nullptr) {
    Dice dice(seed);
    Verdict verdict;
    for (int shot = 0; shot < shots; ++shot) {
        shoot(dice, shape != nullptr ? *shape : random_solid(dice), range, verdict);
    }
    return verdict;
}

} // namespace

TEST_CASE("collide: shots at resting shapes end outside, and free ways stay as they are" *
          doctest::skip(support::sanitised)) {
    check(shoot_many(1, 4000, {0, 0, 0, 1}), 3000);
    check(shoot_many(2, 4000, {0, 0, 0.1L, 1.2L}), 3000);
}

TEST_CASE("collide: so do shots at a 5 cm plate and a 10 cm ball" * doctest::skip(support::sanitised)) {
    const Shape plate = box(1, 0.025L, 1);
    const Shape ball = sphere(0.05L);
    check(shoot_many(3, 3000, {0, 0, 0, 1}, &plate), 1500);
    check(shoot_many(4, 3000, {0, 0, 0, 1}, &ball), 1500);
    check(shoot_many(5, 3000, {1.5L, 0, 0.02L, 1}, &plate), 1500);
    check(shoot_many(6, 3000, {1.5L, 0, 0.02L, 1}, &ball), 1500);
}

TEST_CASE("collide: so do shots at shapes that move and turn") {
    check(shoot_many(7, 4000, {2, 0, 0, 1}), 2000);
    check(shoot_many(8, 4000, {0, 90, 0, 1}), 2000);
    check(shoot_many(9, 4000, {2, 90, 0.05L, 1}), 2000);
    check(shoot_many(10, 2000, {58, 90, 0.05L, 1}), 500);
}

TEST_CASE("collide: grazing shots along faces, edges and corners are kept outside") {
    Dice dice(21);
    Verdict verdict;
    for (int shot = 0; shot < samples(6000); ++shot) {
        const Shape shape = random_solid(dice);
        const Point size = size_of(shape);
        const auto substeps = 1 + dice.below(20);
        ColliderState collider = resting(shape, {}, dice.rotation(360));
        // A point of the surface, or of an edge or corner of the bounding box, a hair in or out.
        const auto edge = [&dice](Real s) { return (dice.below(3) == 0 ? dice.between(-1, 1) : 1) * s; };
        Point local = {edge(size.x), edge(size.y), edge(size.z)};
        const lks::SurfacePoint nearest = lks::nearest_surface(shape, coordinates(local), 0);
        const Real hair = std::pow(Real(10), dice.between(-9, -2)) * (dice.below(2) == 0 ? 1 : -1);
        local = local + to_point(nearest.normal) * (hair - from_coordinate(nearest.distance));
        // Nearly along the surface.
        Point way = to_point(nearest.normal).cross(dice.direction());
        way = way * (1 / way.length()) + to_point(nearest.normal) * dice.between(-0.001L, 0.001L);
        const Point velocity = rotated(lks::fixed::to_matrix(collider.rotation), way) * dice.between(1, 100);
        const Point goal = rotated(lks::fixed::to_matrix(collider.rotation), local);
        Particle particle = Particle::at(goal - velocity * (0.5L / 60), velocity * (1.0L / 60 / substeps));
        const Point begin =
            rotated_back(lks::fixed::to_matrix(collider.rotation), to_point(particle.position));
        if (reference_distance(shape, begin, 0) <= 0) {
            continue;
        }
        for (std::uint32_t substep = 1; substep <= substeps; ++substep) {
            particle.predict({0, 0, 0});
            judge(particle, particle.frame(collider, 1, 1), verdict);
        }
    }
    check(verdict, samples(1000));
}

TEST_CASE("collide: a particle stays on its side of a large plate that comes and turns at it") {
    Dice dice(31);
    int hits = 0;
    for (int shot = 0; shot < samples(3000); ++shot) {
        const auto substeps = 1 + dice.below(20);
        const Real thickness = 0.025L;
        ColliderState collider = resting(box(30, thickness, 30), dice.in_cube(1), dice.rotation(360));
        const Real side = dice.below(2) == 0 ? 1 : -1;
        const lks::fixed::Matrix3 matrix = lks::fixed::to_matrix(collider.rotation);
        const Point centre = to_point(collider.position) * 65536.0L;
        const Point place = {dice.between(-3, 3), side * (thickness + dice.between(0, 1.5L)),
                             dice.between(-3, 3)};
        Point velocity = dice.direction() * dice.between(0, 100);
        const Point normal = rotated(matrix, {0, side, 0});
        if (velocity.dot(normal) > 0) {
            velocity = velocity * -1;
        }
        Particle particle = Particle::at(centre + rotated(matrix, place), velocity * (1.0L / 60 / substeps));
        for (int tick = 0; tick < 3; ++tick) {
            collider.target_position =
                worlds(to_point(collider.position) * 65536.0L + normal * dice.between(0, 1));
            collider.target_rotation =
                lks::fixed::normalise(lks::fixed::multiply(dice.rotation(10), collider.rotation));
            for (std::uint32_t substep = 1; substep <= substeps; ++substep) {
                particle.predict({0, 0, 0});
                const lks::fixed::Vec3 predicted = particle.position;
                const ContactFrame frame = particle.frame(collider, substep, substeps);
                particle.resolve(frame);
                hits += particle.position == predicted ? 0 : 1;
                const Point end = local_end(frame, particle.position);
                REQUIRE(end.y * side >= thickness - tolerance);
            }
            finish_motion(collider);
        }
    }
    CHECK(hits > samples(5000));
}

TEST_CASE("collide: a particle that is resting on a plate is not shot through it") {
    Dice dice(41);
    for (int shot = 0; shot < samples(2000); ++shot) {
        const ColliderState collider = resting(box(5, 0.025L, 5), {}, dice.rotation(360));
        const lks::fixed::Matrix3 matrix = lks::fixed::to_matrix(collider.rotation);
        // On the surface, give or take what rounding or the tolerance of a hit may leave.
        const Point place = {dice.between(-1, 1), 0.025L + dice.between(-2e-6L, 2e-6L), dice.between(-1, 1)};
        Particle particle = Particle::at(rotated(matrix, place), {0, 0, 0});
        particle.start = particle.position;
        const Point shot_way = {dice.between(-1, 1), dice.between(-1.7L, 0), dice.between(-1, 1)};
        particle.position = particle.position + coordinates(rotated(matrix, shot_way));
        const ContactFrame frame = particle.frame(collider, 1, 1);
        particle.resolve(frame);
        REQUIRE(local_end(frame, particle.position).y >= 0.025L - 1e-8L);
    }
}

TEST_CASE("collide: planes keep everything above, at rest, moving and turning") {
    Dice dice(51);
    int hits = 0;
    for (int shot = 0; shot < samples(4000); ++shot) {
        const auto substeps = 1 + dice.below(20);
        const Real far = std::pow(Real(10), dice.between(0, 3));
        ColliderState collider = resting(plane(), {}, dice.rotation(360));
        const lks::fixed::Matrix3 matrix = lks::fixed::to_matrix(collider.rotation);
        // The plane's own position lies anywhere in it.
        collider.position = worlds(rotated(matrix, {dice.between(-far, far), 0, dice.between(-far, far)}));
        collider.target_position = collider.position;
        Point velocity = dice.direction() * dice.between(0, 100);
        Particle particle = Particle::at(rotated(matrix, {dice.between(-5, 5), dice.between(0.1L, 1), 0}),
                                         velocity * (1.0L / 60 / substeps));
        particle.margin = coordinate(dice.between(0, 0.05L));
        const bool turns = shot % 2 == 1;
        for (int tick = 0; tick < 3; ++tick) {
            if (turns) {
                collider.target_position =
                    lks::fixed::Vec3{collider.position.x, collider.position.y, collider.position.z} +
                    worlds(dice.in_cube(0.5L));
                collider.target_rotation =
                    lks::fixed::normalise(lks::fixed::multiply(dice.rotation(20 / far), collider.rotation));
            }
            for (std::uint32_t substep = 1; substep <= substeps; ++substep) {
                particle.predict({0, 0, 0});
                const lks::fixed::Vec3 predicted = particle.position;
                const ContactFrame frame = particle.frame(collider, substep, substeps);
                particle.resolve(frame);
                hits += particle.position == predicted ? 0 : 1;
                // The height from the plane's own position, not from where the frame anchors it.
                const std::int64_t raw[3] = {collider.position.x, collider.position.y, collider.position.z};
                const std::int64_t goal[3] = {collider.target_position.x, collider.target_position.y,
                                              collider.target_position.z};
                Real anchor[3];
                for (int i = 0; i < 3; ++i) {
                    anchor[i] = std::ldexp(raw[i] + (Real(goal[i]) - raw[i]) * substep / substeps, -40);
                }
                const Point relative = to_point(particle.position) - Point{anchor[0], anchor[1], anchor[2]};
                const Real height = rotated_back(frame.end_rotation, relative).y;
                REQUIRE(height >= from_coordinate(particle.margin) - tolerance);
            }
            finish_motion(collider);
        }
    }
    CHECK(hits > samples(5000));
}

TEST_CASE("collide: the largest shapes push from beyond the range of relative positions") {
    // Within one substep the tip comes from 15 m above the particle, centre 75 m away, to 10 m below it.
    ColliderState collider = resting(capsule(30, 30), {0, 75, 0});
    collider.target_position = worlds({0, 50, 0});
    Particle particle = Particle::at({0.5L, 0, 0}, {0, 0, 0});
    const ContactFrame frame = particle.frame(collider, 1, 1);
    REQUIRE(frame.reachable);
    particle.resolve(frame);
    CHECK(std::fabs(to_point(particle.position).y + 10) < 0.01L);
    CHECK(reference_distance(frame.shape, local_end(frame, particle.position), 0) >= -tolerance);

    // A particle at the range's edge, a centre on the other side: the difference has more than 64 bits.
    collider = resting(capsule(30, 30), {0, -125, 0});
    collider.target_position = worlds({0, -45, 0});
    particle = Particle::at({0, 10, 0}, {0, 0, 0});
    particle.start = coordinates({0, 63, 0});
    const ContactFrame wide = particle.frame(collider, 1, 1);
    REQUIRE(wide.reachable);
    particle.resolve(wide);
    CHECK(reference_distance(wide.shape, local_end(wide, particle.position), 0) >= -tolerance);
    CHECK(to_point(particle.position).y > 14.9L);
}
