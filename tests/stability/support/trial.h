// One cloth or rope in a world of the SDK, and the float32 twin beside it: the same constraints in the same
// order, the same substeps, pins, velocities and colliders. Both are measured after every tick.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "reference/xpbd.h"
#include "stability/support/course.h"
#include "stability/support/shapes.h"
#include "support/builders.h"

namespace stability {

// What is put into the world, and where.
struct Subject {
    const support::Asset* asset = nullptr;
    std::vector<double> masses{};
    reference::Materials materials{};
    lks_world_def world = lks_default_world_def();
    lks_transform transform = lks_transform_identity();
    support::Vector velocity{};
    double linear_damping = 0;
    double radius = 0;                         // of a particle
    double friction = 1;                       // of the asset
    double tolerance = 0.05;                   // of the stretch that counts as recovered
    bool rope = false;                         // the twin solves it at once where the SDK does
    std::uint32_t solver = LKS_ROPE_AUTOMATIC; // that a rope asks for
    support::Vector twin_place{}; // how far from its origin the twin has it; the SDK does not care
};

// A net, of which builders.h knows the materials and masses.
Subject subject_of(const support::Net& net, const support::Asset& asset);
Subject subject_of(const support::Chain& chain, const support::Asset& asset);

class Trial {
public:
    explicit Trial(const Subject& subject);
    Trial(const Trial&) = delete;

    const support::World& world() const { return world_; }
    lks_object_id object() const { return object_; }
    std::size_t size() const { return meter_.model().masses.size(); }
    Meter& meter() { return meter_; }

    // Places are relative to that of the subject.
    void pin(std::uint32_t vertex);
    void unpin(std::uint32_t vertex);
    void set_target(std::uint32_t vertex, const support::Vector& target);
    void set_velocity(std::uint32_t vertex, const support::Vector& velocity);
    // Puts every free vertex there within a tick, and leaves it without speed.
    void put(const std::vector<support::Vector>& places);

    std::size_t add(const lks_collider_def& def); // its place is one of the world
    // Over the next tick, without a turn; a place of the world.
    void move_to(std::size_t collider, const lks_vec3& position);
    void remove(std::size_t collider);

    void run(int ticks);
    // The same, without a look at what happens.
    void skip(int ticks);
    // Forgets what was worst until now.
    void begin();

    const Course& fixed() const { return fixed_; }
    const Course& single() const { return single_; }
    std::vector<support::Vector> positions() const;
    std::vector<support::Vector> twin_positions() const;
    support::Vector twin_position(std::uint32_t vertex) const { return twin_->position(vertex); }

private:
    struct Obstacle {
        lks_collider_id id;
        lks_collider_def def;
        Shape<float> single;
        Shape<double> exact; // measures how deep particles are
        bool present = true;
    };

    void measure(bool begins);
    double depth_of(const std::vector<support::Vector>& positions) const;

    Subject subject_;
    support::World world_;
    lks_object_id object_;
    Meter meter_;
    std::unique_ptr<reference::Solver<float>> twin_;
    std::vector<Obstacle> obstacles_;
    Course fixed_, single_;
};

// The largest distance of a particle.
double farthest(const std::vector<support::Vector>& a, const std::vector<support::Vector>& b);

// The rows that nearly every case has. `what` of both courses, in percent where it is a stretch.
// The worst alone: of what is still pulled apart, and where other rows say what becomes of it.
void expect_worst_stretch_at_most(const std::string& scene, const Trial& trial, double percent);

// What becomes of a stretch beyond the tolerance. Where nothing is said, no more than one of 100 edges is
// ever beyond it.
struct Aftermath {
    double seconds = 0; // until it has recovered; 0: it has not by the end
    double off = 0;     // percent of the edges, then
};

// The worst, and what becomes of it.
void expect_stretch_at_most(const std::string& scene, const Trial& trial, double percent,
                            const Aftermath& aftermath = {});
void expect_last_stretch_at_most(const std::string& scene, const Trial& trial, double percent);
// Of the edges, percent that are beyond the tolerance.
void expect_last_off_at_most(const std::string& scene, const Trial& trial, double percent);
void expect_recovery_within(const std::string& scene, const Trial& trial, double seconds);
// Nothing is inside of a collider any more.
void expect_out_within(const std::string& scene, const Trial& trial, double seconds);
void expect_kinetic_energy_at_most(const std::string& scene, const Trial& trial, double joules);
void expect_last_kinetic_energy_at_most(const std::string& scene, const Trial& trial, double joules);
// The energy above what there was at the start, percent of the greatest kinetic energy.
void expect_gain_at_most(const std::string& scene, const Trial& trial, double percent);
void expect_depth_at_most(const std::string& scene, const Trial& trial, double metres);
// None of the counters has moved.
void expect_nothing_clamped(const Trial& trial);

} // namespace stability
