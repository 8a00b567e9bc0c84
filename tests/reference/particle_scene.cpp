#include "reference/particle_scene.h"

#include <cmath>
#include <type_traits>

#include "reference/fixed_point.h"
#include "reference/implicit.h"
#include "reference/position_based.h"

namespace reference {
namespace {

Settings settings_of(const ParticleScene& scene, const Schedule& schedule) {
    return {scene.tick_rate_hz, schedule.substeps, schedule.iterations, scene.gravity, scene.linear_damping};
}

// As the SDK is told of it.
double representable(double metres) {
    return std::ldexp(std::nearbyint(std::ldexp(metres, LKS_FIXED_FRACTION_BITS)), -LKS_FIXED_FRACTION_BITS);
}

template <typename Scalar>
class Twin final : public Simulation {
public:
    Twin(const ParticleScene& scene, const Schedule& schedule)
        : solver_(model_of(scene), settings_of(scene, schedule)) {}

    void tick() override { solver_.tick(); }
    std::vector<support::Vector> positions() const override {
        std::vector<support::Vector> found;
        for (std::size_t p = 0; p < solver_.size(); ++p) {
            found.push_back(solver_.position(p));
        }
        return found;
    }
    std::vector<support::Vector> velocities() const override {
        std::vector<support::Vector> found;
        for (std::size_t p = 0; p < solver_.size(); ++p) {
            found.push_back(solver_.velocity(p));
        }
        return found;
    }
    double force(std::size_t edge) const override { return solver_.force(edge); }

private:
    Solver<Scalar> solver_;
};

// Of those that give their particles as a vector.
template <typename Solver>
class Wrapped final : public Simulation {
public:
    explicit Wrapped(Solver solver) : solver_(std::move(solver)) {}

    void tick() override {
        solver_.tick();
        if constexpr (std::is_same_v<Solver, ImplicitEuler>) {
            must_have_converged(solver_);
        }
    }
    std::vector<support::Vector> positions() const override { return widened(solver_.positions()); }
    std::vector<support::Vector> velocities() const override { return widened(solver_.velocities()); }
    double force(std::size_t edge) const override { return solver_.force(edge); }

private:
    template <typename Vectors>
    static std::vector<support::Vector> widened(const Vectors& vectors) {
        std::vector<support::Vector> found;
        found.reserve(vectors.size());
        for (const auto& v : vectors) {
            found.push_back(v.widened());
        }
        return found;
    }

    Solver solver_;
};

template <typename Solver>
std::unique_ptr<Simulation> wrap(Solver solver) {
    return std::make_unique<Wrapped<Solver>>(std::move(solver));
}

} // namespace

ParticleScene make_rope(std::uint32_t segments, double length, double particle_mass,
                        const lks_distance_material& stretch, const support::Vector& direction) {
    ParticleScene scene;
    const support::Vector step = direction * (length / segments / direction.length());
    for (std::uint32_t i = 0; i <= segments; ++i) {
        scene.rest.push_back(step * i);
    }
    scene.start = scene.rest;
    scene.masses.assign(segments + 1, particle_mass);
    scene.materials = {stretch, {}, {}};
    scene.pins = {0};
    return scene;
}

ParticleScene make_cloth(std::uint32_t side, double width, double mass, const Materials& materials,
                         bool lying) {
    ParticleScene scene;
    scene.columns = scene.rows = side;
    scene.width = scene.height = width;
    scene.masses.assign(std::size_t{side} * side, mass / (static_cast<double>(side) * side));
    scene.materials = materials;
    for (std::uint32_t row = 0; row < side; ++row) {
        for (std::uint32_t column = 0; column < side; ++column) {
            const double u = width * (static_cast<double>(column) / (side - 1) - 0.5);
            const double v = width * (0.5 - static_cast<double>(row) / (side - 1));
            scene.start.push_back(lying ? support::Vector{u, 0, -v} : support::Vector{u, v, 0});
        }
    }
    return scene;
}

const char* name_of(Engine engine) {
    switch (engine) {
    case Engine::fixed_point:
        return "fixed-point";
    case Engine::double_precision:
        return "double";
    case Engine::single_precision:
        return "float32";
    case Engine::pbd:
        return "PBD";
    case Engine::pbd_scaled:
        return "PBD, scaled";
    case Engine::xpbd:
        return "XPBD";
    case Engine::xpbd_single:
        return "XPBD, float32";
    case Engine::xpbd_jacobi:
        return "XPBD, Jacobi";
    case Engine::direct_constraints:
        return "eq. 16 solved directly";
    case Engine::newton:
        return "Newton";
    }
    return "";
}

Model model_of(const ParticleScene& scene) {
    const SceneAsset asset(scene);
    std::vector<support::Vector> start;
    for (const support::Vector& p : scene.start) {
        start.push_back({representable(p.x), representable(p.y), representable(p.z)});
    }
    Model model{start, scene.masses, edges_of(asset.get(), scene.materials), {}, {}, scene.pins, scene.ball};
    model.tethers = tethers_of(asset.get());
    if (scene.solver == LKS_ROPE_DIRECT) {
        model.chain = segments_of(model.edges);
    }
    return model;
}

std::unique_ptr<Simulation> simulate(Engine engine, const ParticleScene& scene, const Schedule& schedule,
                                     double stiffness) {
    const Settings settings = settings_of(scene, schedule);
    switch (engine) {
    case Engine::fixed_point:
        return make_fixed_point(scene, schedule);
    case Engine::double_precision:
        return std::make_unique<Twin<double>>(scene, schedule);
    case Engine::single_precision:
        return std::make_unique<Twin<float>>(scene, schedule);
    case Engine::pbd:
        return wrap(PositionBased<double>(model_of(scene), settings, Method::pbd, stiffness));
    case Engine::pbd_scaled:
        return wrap(PositionBased<double>(model_of(scene), settings, Method::pbd_scaled, stiffness));
    case Engine::xpbd:
        return wrap(PositionBased<double>(model_of(scene), settings, Method::xpbd));
    case Engine::xpbd_single:
        return wrap(PositionBased<float>(model_of(scene), settings, Method::xpbd));
    case Engine::xpbd_jacobi:
        return wrap(PositionBased<double>(model_of(scene), settings, Method::xpbd_jacobi));
    case Engine::direct_constraints:
        return wrap(ImplicitEuler(model_of(scene), settings, Linearisation::constraints));
    case Engine::newton:
        return wrap(ImplicitEuler(model_of(scene), settings, Linearisation::full));
    }
    return nullptr;
}

Stretch stretch_of(const Model& model, const std::vector<support::Vector>& positions) {
    Stretch stretch;
    for (const Edge& edge : model.edges) {
        const double off = std::abs((positions[edge.a] - positions[edge.b]).length() / edge.rest - 1);
        stretch.worst = std::isfinite(off) ? std::max(stretch.worst, off) : INFINITY;
        stretch.mean += off / static_cast<double>(model.edges.size());
    }
    return stretch;
}

double energy_of(const ParticleScene& scene, const std::vector<support::Vector>& positions,
                 const std::vector<support::Vector>& velocities) {
    double energy = 0;
    std::vector<bool> pinned(positions.size());
    for (const std::uint32_t pin : scene.pins) {
        pinned[pin] = true;
    }
    for (std::size_t p = 0; p < positions.size(); ++p) {
        if (!pinned[p]) {
            energy +=
                scene.masses[p] * (0.5 * velocities[p].dot(velocities[p]) - scene.gravity.dot(positions[p]));
        }
    }
    return energy;
}

} // namespace reference
