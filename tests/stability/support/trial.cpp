#include "stability/support/trial.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "reference/asset_model.h"
#include "stability/support/table.h"

using support::operator+;
using support::operator-;
using support::Vector;

namespace stability {
namespace {

reference::Settings settings_of(const Subject& subject) {
    reference::Settings settings;
    settings.tick_rate_hz = subject.world.tick_rate_hz;
    settings.substeps = static_cast<int>(subject.world.substeps);
    settings.iterations = static_cast<int>(subject.world.iterations);
    settings.gravity = support::metres(subject.world.gravity);
    settings.linear_damping = subject.linear_damping;
    return settings;
}

lks_object_id add_to(support::World& world, const Subject& subject) {
    lks_object_def def = support::object_def(*subject.asset, subject.transform);
    def.velocity = support::fixed(subject.velocity.x, subject.velocity.y, subject.velocity.z);
    def.linear_damping = support::fixed(subject.linear_damping);
    return world.add(def);
}

lks_vec3 fixed_of(const Vector& v) {
    return support::fixed(v.x, v.y, v.z);
}

// The SDK's rule (docs/ropes.md).
bool is_solved_at_once(const reference::Model& rope, std::uint32_t solver, const lks_world_def& world) {
    if (solver != LKS_ROPE_AUTOMATIC) {
        return solver == LKS_ROPE_DIRECT;
    }
    const double substeps_per_second = static_cast<double>(world.tick_rate_hz) * world.substeps;
    const double greatest_swept_load = substeps_per_second * substeps_per_second * world.iterations / 3600;
    double mass = 0;
    for (const double of_point : rope.masses) {
        mass += of_point;
    }
    return rope.edges.size() > 1 &&
           std::any_of(rope.edges.begin(), rope.edges.end(), [&](const reference::Edge& edge) {
               return edge.family == LKS_CONSTRAINT_STRETCH &&
                      greatest_swept_load * std::min(rope.masses[edge.a], rope.masses[edge.b]) * edge.rest <
                          mass;
           });
}

reference::Model model_for(const support::World& world, lks_object_id object, const Subject& subject) {
    reference::Model model = reference::model_of(world, object, *subject.asset, subject.transform.position,
                                                 subject.masses, subject.materials);
    if (subject.rope && is_solved_at_once(model, subject.solver, subject.world)) {
        model.chain = segments_of(model.edges);
    }
    return model;
}

} // namespace

Subject subject_of(const support::Net& net, const support::Asset& asset) {
    Subject subject;
    subject.asset = &asset;
    subject.masses.assign(asset.vertex_count(), net.particle_mass);
    subject.materials = {net.stretch, net.shear, net.bend};
    subject.radius = net.radius;
    subject.friction = net.friction;
    return subject;
}

Subject subject_of(const support::Chain& chain, const support::Asset& asset) {
    Subject subject;
    subject.asset = &asset;
    subject.masses.assign(asset.vertex_count(), chain.particle_mass);
    subject.materials = {chain.stretch, support::off, chain.bend};
    subject.rope = true;
    subject.solver = chain.solver;
    return subject;
}

Trial::Trial(const Subject& subject)
    : subject_(subject), world_(subject.world), object_(add_to(world_, subject)),
      meter_(model_for(world_, object_, subject), support::metres(subject.world.gravity), subject.tolerance),
      twin_(std::make_unique<reference::Solver<float>>(meter_.model(), settings_of(subject),
                                                       subject.twin_place)) {
    for (std::size_t i = 0; i < size(); ++i) {
        twin_->set_velocity(i, subject.velocity);
    }
    measure(true);
}

void Trial::pin(std::uint32_t vertex) {
    world_.pin(object_, vertex);
    twin_->set_velocity(vertex, {});
    twin_->pin(vertex);
    meter_.set_pinned(vertex, true);
    measure(true);
}

void Trial::unpin(std::uint32_t vertex) {
    REQUIRE(lks_object_unpin(world_, object_, vertex) == LKS_OK);
    twin_->unpin(vertex);
    meter_.set_pinned(vertex, false);
}

void Trial::set_target(std::uint32_t vertex, const Vector& target) {
    world_.set_target(object_, vertex, subject_.transform.position + fixed_of(target));
    twin_->set_target(vertex, target);
}

void Trial::set_velocity(std::uint32_t vertex, const Vector& velocity) {
    REQUIRE(lks_object_set_velocity(world_, object_, vertex, fixed_of(velocity)) == LKS_OK);
    twin_->set_velocity(vertex, velocity);
}

void Trial::put(const std::vector<Vector>& places) {
    std::vector<std::uint32_t> moved;
    for (std::uint32_t vertex = 0; vertex < size(); ++vertex) {
        if (!meter_.is_pinned(vertex)) {
            moved.push_back(vertex);
            world_.pin(object_, vertex);
            twin_->pin(vertex);
            set_target(vertex, places[vertex]);
        }
    }
    world_.step();
    twin_->tick();
    for (const std::uint32_t vertex : moved) {
        REQUIRE(lks_object_unpin(world_, object_, vertex) == LKS_OK);
        twin_->unpin(vertex);
        set_velocity(vertex, {});
    }
    measure(true);
}

std::size_t Trial::add(const lks_collider_def& def) {
    const lks_vec3 place = subject_.transform.position;
    obstacles_.push_back({world_.add(def), def, Shape<float>(def, place), Shape<double>(def, place)});
    twin_->set_contact([this](auto& position, auto& start, float from, float to) {
        for (const Obstacle& obstacle : obstacles_) {
            if (obstacle.present) {
                obstacle.single.resolve(position, start, from, to, static_cast<float>(subject_.radius),
                                        static_cast<float>(subject_.friction));
            }
        }
    });
    return obstacles_.size() - 1;
}

void Trial::move_to(std::size_t collider, const lks_vec3& position) {
    Obstacle& obstacle = obstacles_[collider];
    lks_transform target = obstacle.def.transform;
    target.position = position;
    REQUIRE(lks_collider_move_to(world_, obstacle.id, target) == LKS_OK);
    const Vector centre = support::metres(position - subject_.transform.position);
    obstacle.single.move_to(centre);
    obstacle.exact.move_to(centre);
}

void Trial::remove(std::size_t collider) {
    REQUIRE(lks_world_remove_collider(world_, obstacles_[collider].id) == LKS_OK);
    obstacles_[collider].present = false;
}

void Trial::run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
        skip(1);
        measure(false);
    }
}

void Trial::skip(int ticks) {
    for (int i = 0; i < ticks; ++i) {
        world_.step();
        twin_->tick();
        for (Obstacle& obstacle : obstacles_) {
            obstacle.single.end_tick();
            obstacle.exact.end_tick();
        }
    }
}

void Trial::begin() {
    measure(true);
}

std::vector<Vector> Trial::positions() const {
    return world_.positions_from(object_, subject_.transform.position);
}

std::vector<Vector> Trial::twin_positions() const {
    std::vector<Vector> positions;
    for (std::uint32_t i = 0; i < size(); ++i) {
        positions.push_back(twin_->position(i));
    }
    return positions;
}

double Trial::depth_of(const std::vector<Vector>& positions) const {
    double deepest = 0;
    for (const Obstacle& obstacle : obstacles_) {
        for (std::size_t i = 0; i < positions.size() && obstacle.present; ++i) {
            if (!meter_.is_pinned(i)) {
                deepest = std::max(
                    deepest, obstacle.exact.depth(reference::Vector3<double>(positions[i]), subject_.radius));
            }
        }
    }
    return deepest;
}

void Trial::measure(bool begins) {
    const double tick_seconds = 1.0 / subject_.world.tick_rate_hz;
    const auto record = [&](Course& course, const std::vector<Vector>& places,
                            const std::vector<Vector>& velocities) {
        Measured now = meter_.measure(places, velocities);
        now.depth = depth_of(places);
        if (begins) {
            course = Course(now, tick_seconds);
        } else {
            course.add(now);
        }
    };
    std::vector<Vector> velocities;
    for (const lks_vec3& velocity : world_.velocities(object_)) {
        velocities.push_back(support::metres(velocity));
    }
    record(fixed_, positions(), velocities);
    velocities.clear();
    for (std::size_t i = 0; i < size(); ++i) {
        velocities.push_back(twin_->velocity(i));
    }
    record(single_, twin_positions(), velocities);
}

double farthest(const std::vector<Vector>& a, const std::vector<Vector>& b) {
    double distance = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double apart = (a[i] - b[i]).length();
        if (!(apart <= distance)) {
            distance = apart; // also where it is no number
        }
    }
    return distance;
}

void expect_worst_stretch_at_most(const std::string& scene, const Trial& trial, double percent) {
    expect_at_most(scene, "stretch, worst", "%", percent, 100 * trial.fixed().worst().stretch,
                   100 * trial.single().worst().stretch);
}

void expect_stretch_at_most(const std::string& scene, const Trial& trial, double percent,
                            const Aftermath& aftermath) {
    expect_worst_stretch_at_most(scene, trial, percent);
    if (aftermath.seconds > 0) {
        expect_recovery_within(scene, trial, aftermath.seconds);
    } else if (aftermath.off > 0) {
        expect_last_off_at_most(scene, trial, aftermath.off);
    } else {
        INFO(scene << ": recovered after, s");
        CHECK(trial.fixed().recovery() == 0);
    }
}

void expect_last_stretch_at_most(const std::string& scene, const Trial& trial, double percent) {
    expect_at_most(scene, "stretch, at the end", "%", percent, 100 * trial.fixed().last().stretch,
                   100 * trial.single().last().stretch);
}

void expect_last_off_at_most(const std::string& scene, const Trial& trial, double percent) {
    expect_at_most(scene, "edges still off, at the end", "%", percent, 100 * trial.fixed().last().off,
                   100 * trial.single().last().off);
}

void expect_recovery_within(const std::string& scene, const Trial& trial, double seconds) {
    expect_at_most(scene, "recovered after", "s", seconds, trial.fixed().recovery(),
                   trial.single().recovery());
}

void expect_out_within(const std::string& scene, const Trial& trial, double seconds) {
    expect_at_most(scene, "out of the collider after", "s", seconds, trial.fixed().way_out(),
                   trial.single().way_out());
}

void expect_kinetic_energy_at_most(const std::string& scene, const Trial& trial, double joules) {
    expect_at_most(scene, "kinetic energy, worst", "J", joules, trial.fixed().worst().kinetic_energy,
                   trial.single().worst().kinetic_energy);
}

void expect_last_kinetic_energy_at_most(const std::string& scene, const Trial& trial, double joules) {
    expect_at_most(scene, "kinetic energy, at the end", "J", joules, trial.fixed().last().kinetic_energy,
                   trial.single().last().kinetic_energy);
}

void expect_gain_at_most(const std::string& scene, const Trial& trial, double percent) {
    expect_at_most(scene, "energy gained, of the greatest motion", "%", percent,
                   100 * trial.fixed().gained_share(), 100 * trial.single().gained_share());
}

void expect_depth_at_most(const std::string& scene, const Trial& trial, double metres) {
    expect_at_most(scene, "inside a collider, worst", "m", metres, trial.fixed().worst().depth,
                   trial.single().worst().depth);
}

void expect_nothing_clamped(const Trial& trial) {
    const lks_world_counters counters = trial.world().counters();
    CHECK(counters.position_clamps == 0);
    CHECK(counters.speed_clamps == 0);
    CHECK(counters.target_clamps == 0);
    CHECK(counters.world_edge_hits == 0);
}

} // namespace stability
