// One description of a scene of particles, and every solver that it can be given to: the SDK through its C
// API, its form in double and float, PBD, XPBD by Jacobi, and the exact implicit step.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "reference/model.h"
#include "reference/xpbd.h"

namespace reference {

// A rope through `rest`, or a cloth of columns × rows vertices where there are columns.
struct ParticleScene {
    std::uint32_t columns = 0, rows = 0;
    double width = 0, height = 0;        // of a cloth at rest, metres
    std::vector<support::Vector> rest{}; // of a rope
    std::vector<double> masses{};        // one a vertex
    Materials materials{};
    std::vector<support::Vector> start{}; // where the vertices begin, without velocity
    std::vector<std::uint32_t> pins{};
    Ball ball{};
    double tick_rate_hz = 60;
    support::Vector gravity{0, -9.81, 0};
    double linear_damping = 0;
    // Of a rope; followed by the SDK and xpbd.h, and automatic by the SDK alone.
    lks_rope_solver solver = LKS_ROPE_SWEPT;
    bool record_forces = false; // in the SDK
    // Of a cloth: how many tethers a vertex, to the nearest of its pins; 0: none. Followed by the SDK and
    // xpbd.h.
    std::uint32_t tethers = 0;
};

ParticleScene make_rope(std::uint32_t segments, double length, double particle_mass,
                        const lks_distance_material& stretch, const support::Vector& direction);
// Vertices row by row from the top, in the plane of x and y; `lying` in that of x and z.
ParticleScene make_cloth(std::uint32_t side, double width, double mass, const Materials& materials,
                         bool lying);

struct Schedule {
    int substeps = 1;
    int iterations = 1;
};

enum class Engine {
    fixed_point,      // the SDK
    double_precision, // xpbd.h
    single_precision, // xpbd.h
    pbd,              // position_based.h, with a stiffness of 1 or what is given
    pbd_scaled,
    xpbd,
    xpbd_single,
    xpbd_jacobi,
    direct_constraints, // implicit.h
    newton
};
const char* name_of(Engine engine);

class Simulation {
public:
    virtual ~Simulation() = default;
    virtual void tick() = 0;
    virtual std::vector<support::Vector> positions() const = 0;
    virtual std::vector<support::Vector> velocities() const = 0;
    // Newtons, tension positive; edges as in model_of.
    virtual double force(std::size_t edge) const = 0;
};

// The scene's constraints in the SDK's order. Throws std::runtime_error where the SDK refuses.
Model model_of(const ParticleScene& scene);
// `stiffness` is PBD's k.
std::unique_ptr<Simulation> simulate(Engine engine, const ParticleScene& scene, const Schedule& schedule,
                                     double stiffness = 1);

// |length / rest - 1| of the stretch constraints: the worst, and the mean.
struct Stretch {
    double worst = 0;
    double mean = 0;
};
Stretch stretch_of(const Model& model, const std::vector<support::Vector>& positions);
// Kinetic and in the field of gravity, joules, without what springs hold.
double energy_of(const ParticleScene& scene, const std::vector<support::Vector>& positions,
                 const std::vector<support::Vector>& velocities);

} // namespace reference
