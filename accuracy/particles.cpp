#include "particles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "bullet_peer.h"
#include "call_time.h"

namespace lks_accuracy {
namespace {

using reference::Engine;
using Positions = std::vector<support::Vector>;

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

// What is kept of a run.
struct Trace {
    Positions at_deviation;
    std::vector<Positions> later;
    double worst_stretch = 0;   // of all ticks
    double mean_stretch = 0;    // over constraints and ticks
    double height = 0;          // at the end, of what sags
    double energy = 0;          // at the end
    std::vector<double> forces; // what the first pin bears, by tick
    double nanoseconds = 0;
};

double largest_distance(const Positions& a, const Positions& b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double distance = (a[i] - b[i]).length();
        if (!(distance <= worst)) {
            worst = distance; // also where it is no number
        }
    }
    return worst;
}

// Bullet's soft body of the same constraints, but for those that are soft on purpose (bend): its links have
// no compliance.
class BulletSimulation final : public reference::Simulation {
public:
    BulletSimulation(const reference::ParticleScene& scene, const reference::Model& model,
                     const reference::Schedule& schedule) {
        constexpr double most_compliance = 1e-4;
        lks_bench::FloatCloth shape;
        for (std::size_t p = 0; p < scene.start.size(); ++p) {
            const support::Vector& x = scene.start[p];
            shape.particles.push_back({static_cast<float>(x.x), static_cast<float>(x.y),
                                       static_cast<float>(x.z), static_cast<float>(1 / scene.masses[p])});
        }
        for (const std::uint32_t pin : scene.pins) {
            shape.particles[pin].inverse_mass = 0;
        }
        for (const reference::Edge& edge : model.edges) {
            if (edge.compliance <= most_compliance) {
                shape.edges.push_back({edge.a, edge.b, static_cast<float>(edge.rest)});
            }
        }
        body_ = lks_bench::make_bullet_body(shape, static_cast<std::uint32_t>(schedule.substeps),
                                            static_cast<std::uint32_t>(schedule.iterations),
                                            scene.linear_damping, balls_of(scene));
    }

    void tick() override { body_->tick(); }
    Positions positions() const override {
        Positions found;
        for (const lks_bench::Point& point : body_->points()) {
            found.push_back({point.x, point.y, point.z});
        }
        return found;
    }
    Positions velocities() const override { return {}; }
    double force(std::size_t) const override { return undefined; }

private:
    static std::vector<lks_bench::FloatSphere> balls_of(const reference::ParticleScene& scene) {
        if (scene.ball.radius <= 0) {
            return {};
        }
        const support::Vector& centre = scene.ball.centre;
        return {{static_cast<float>(centre.x), static_cast<float>(centre.y), static_cast<float>(centre.z),
                 static_cast<float>(scene.ball.radius)}};
    }

    std::unique_ptr<lks_bench::Variant> body_;
};

// Those constraints that are not soft on purpose: what a player sees as stretch.
reference::Model stiff_part(const reference::Model& model, const MeasuredScene& measured) {
    reference::Model stiff = model;
    if (measured.has_compliance) {
        stiff.edges.erase(std::remove_if(stiff.edges.begin(), stiff.edges.end(),
                                         [](const reference::Edge& edge) { return edge.compliance > 0; }),
                          stiff.edges.end());
    }
    return stiff;
}

double height_of(const MeasuredScene& measured, const Positions& positions) {
    if (measured.lowest_vertex > 0) {
        return positions[measured.lowest_vertex].y;
    }
    double sum = 0; // all have the same mass
    for (const support::Vector& p : positions) {
        sum += p.y;
    }
    return sum / static_cast<double>(positions.size());
}

Trace trace(reference::Simulation& simulation, const MeasuredScene& measured, const reference::Model& stiff) {
    Trace result;
    double least = std::numeric_limits<double>::infinity();
    const int last = std::max(measured.ticks, measured.deviation_tick);
    for (int tick = 1; tick <= last; ++tick) {
        least = std::min(least, nanoseconds_of([&] { simulation.tick(); }));
        const Positions positions = simulation.positions();
        const reference::Stretch stretch = stretch_of(stiff, positions);
        result.worst_stretch = std::max(result.worst_stretch, stretch.worst);
        result.mean_stretch += stretch.mean / last;
        if (tick == measured.deviation_tick) {
            result.at_deviation = positions;
        }
        if (tick == last) {
            result.height = height_of(measured, positions);
            const Positions velocities = simulation.velocities();
            result.energy = velocities.empty() ? undefined : energy_of(measured.scene, positions, velocities);
        }
    }
    result.nanoseconds = least / static_cast<double>(measured.scene.start.size());
    int now = last;
    for (const int then : measured.later_ticks) {
        for (; now < then; ++now) {
            simulation.tick();
        }
        result.later.push_back(simulation.positions());
    }
    return result;
}

// A constraint at a pin, and its other end.
struct PinEdge {
    std::size_t edge;
    std::uint32_t away;
};

std::vector<PinEdge> edges_at(const reference::Model& model, std::uint32_t pin) {
    std::vector<PinEdge> found;
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        const reference::Edge& edge = model.edges[e];
        if (edge.a == pin || edge.b == pin) {
            found.push_back({e, edge.a == pin ? edge.b : edge.a});
        }
    }
    return found;
}

// What the constraint at a pin pulls with; of several how much they bear altogether, upwards. (To the side
// they pull more and more until threads are straight, which takes thousands of sweeps.)
double load_of(const reference::Simulation& simulation, const std::vector<PinEdge>& edges,
               std::uint32_t pin) {
    if (edges.size() == 1) {
        return simulation.force(edges[0].edge);
    }
    const Positions positions = simulation.positions();
    double borne = 0;
    for (const PinEdge& at : edges) {
        const support::Vector way = positions[at.away] - positions[pin];
        borne -= simulation.force(at.edge) * way.y / way.length();
    }
    return borne;
}

std::vector<double> forces_of(Engine engine, const MeasuredScene& measured,
                              const reference::Schedule& schedule) {
    reference::ParticleScene scene = measured.scene;
    scene.record_forces = true;
    const std::uint32_t pin = scene.pins[0];
    const std::vector<PinEdge> edges = edges_at(model_of(scene), pin);
    const auto simulation = simulate(engine, scene, schedule);
    std::vector<double> forces;
    for (int tick = 0; tick < measured.ticks; ++tick) {
        simulation->tick();
        forces.push_back(load_of(*simulation, edges, pin));
    }
    return forces;
}

// Root mean square of the difference, relative to that of what is right.
double force_error(const std::vector<double>& forces, const std::vector<double>& right) {
    double off = 0;
    double all = 0;
    for (std::size_t i = 0; i < right.size(); ++i) {
        off += (forces[i] - right[i]) * (forces[i] - right[i]);
        all += right[i] * right[i];
    }
    return std::sqrt(off / all);
}

double mean_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<reference::Schedule> schedules_of(const Grid& grid) {
    std::vector<reference::Schedule> schedules;
    for (const int substeps : grid.substeps) {
        for (const int iterations : grid.iterations) {
            if (substeps * iterations <= grid.most_passes) {
                schedules.push_back({substeps, iterations});
            }
        }
    }
    return schedules;
}

struct Measurer {
    const MeasuredScene& measured;
    reference::Model model = model_of(measured.scene);
    reference::Model stiff = stiff_part(model, measured);
    Trace converged;
    double start_energy = 0;
    double energy_scale = 0; // what falls through its own length

    explicit Measurer(const MeasuredScene& scene) : measured(scene) {
        const reference::Schedule schedule{measured.reference_substeps, 1};
        MeasuredScene until_later = measured;
        until_later.later_ticks.clear();
        converged = trace(*simulate(Engine::double_precision, measured.scene, schedule), until_later, stiff);
        if (!measured.later_ticks.empty()) {
            const MeasuredScene direct = at_once(measured);
            converged.later =
                trace(*simulate(Engine::double_precision, direct.scene, schedule), direct, stiff).later;
        }
        if (measured.is_pinned()) {
            // Of ropes solved at once: swept, forces jump from one substep to the next.
            converged.forces = forces_of(Engine::double_precision,
                                         measured.is_rope() ? at_once(measured) : measured, schedule);
        }
        start_energy =
            energy_of(measured.scene, measured.scene.start, Positions(measured.scene.start.size()));
        double length = 0;
        for (const support::Vector& p : measured.scene.start) {
            length = std::max(length, (p - measured.scene.start[0]).length());
        }
        for (const double mass : measured.scene.masses) {
            energy_scale += mass * 9.81 * length;
        }
    }

    // `twin` is the trace that rounding is told from; null: this is it, or there is none.
    Row row_of(const std::string& solver, const reference::Schedule& schedule, const Trace& found,
               const Trace* twin) const {
        Row row{solver, schedule, found.nanoseconds};
        const double deviation = largest_distance(found.at_deviation, converged.at_deviation);
        const auto add = [&](double error) { row.errors.push_back(error); };
        add(100 * found.worst_stretch);
        add(100 * found.mean_stretch);
        add(deviation);
        add(twin == nullptr ? undefined : largest_distance(found.at_deviation, twin->at_deviation));
        add(std::abs(found.height - converged.height));
        if (measured.is_pinned()) {
            const bool known = !found.forces.empty();
            add(known ? 100 * force_error(found.forces, converged.forces) : undefined);
            add(known ? 100 * std::abs(mean_of(found.forces) / mean_of(converged.forces) - 1) : undefined);
        }
        const double right_energy = measured.keeps_energy ? start_energy : converged.energy;
        add(100 * std::abs(found.energy - right_energy) / energy_scale);
        for (std::size_t i = 0; i < measured.later_ticks.size(); ++i) {
            add(largest_distance(found.later[i], converged.later[i]));
            add(twin == nullptr ? undefined : largest_distance(found.later[i], twin->later[i]));
        }
        return row;
    }
};

// In the order of Measurer::row_of.
std::vector<Quantity> quantities_of(const MeasuredScene& measured) {
    std::vector<Quantity> quantities = {
        {"stretch, worst", "%",
         "the most that any inextensible constraint is off its length in any tick; 0 is right", 1},
        {"stretch, mean", "%",
         "how far inextensible constraints are off their length, on the average over constraints and ticks; "
         "0 is right",
         0.1},
        {"deviation", "m",
         "the farthest that any particle is from the converged solution after " +
             seconds_of(measured.deviation_tick),
         0.05},
        {"rounding", "m",
         "the farthest that any particle is after " + seconds_of(measured.deviation_tick) +
             " from where the same method in double precision has it at the same setting",
         0, 2}};
    quantities.push_back({"sag", "m",
                          std::string("how far ") + measured.sag_of + " is from its right height at the end",
                          0.05});
    if (measured.is_pinned()) {
        quantities.push_back({"support force, a tick", "%",
                              "root mean square error of what the pin bears as it is read at the "
                              "end of a tick, relative to it",
                              20});
        quantities.push_back(
            {"support force, mean", "%", "error of the mean of all readings of what the pin bears", 5});
    }
    quantities.push_back(
        {"energy drift", "%",
         std::string(measured.keeps_energy ? "energy gained or lost at the end"
                                           : "how far the energy at the end is from the right one") +
             ", relative to what the whole would get by falling through its length",
         5});
    for (const int tick : measured.later_ticks) {
        const std::string when = seconds_of(tick);
        const int deviation = static_cast<int>(quantities.size());
        quantities.push_back(
            {"deviation, " + when, "m",
             "the farthest that any particle is from the converged solution, a rope at once, after " + when});
        quantities.push_back({"rounding, " + when, "m",
                              "the farthest that any particle is after " + when +
                                  " from where the same method in double precision has it",
                              0, deviation});
    }
    return quantities;
}

Trace trace_of(Engine engine, const MeasuredScene& measured, const reference::Model& stiff,
               const reference::Schedule& schedule) {
    Trace found = trace(*simulate(engine, measured.scene, schedule), measured, stiff);
    if (measured.is_pinned() && measured.scene.tethers == 0 && engine != Engine::pbd) {
        found.forces = forces_of(engine, measured, schedule);
    }
    return found;
}

// Those of our own engines; the scene may be solved at once or tethered, and `suffix` says so.
void add_own_rows(std::vector<Row>& rows, const Measurer& measurer, const MeasuredScene& scene,
                  const reference::Schedule& schedule, const std::string& suffix) {
    const Trace twin = trace_of(Engine::double_precision, scene, measurer.stiff, schedule);
    for (const Engine engine : {Engine::fixed_point, Engine::single_precision}) {
        const Trace found = trace_of(engine, scene, measurer.stiff, schedule);
        rows.push_back(measurer.row_of(name_of(engine) + suffix, schedule, found, &twin));
    }
    rows.push_back(measurer.row_of(name_of(Engine::double_precision) + suffix, schedule, twin, nullptr));
}

void add_rows(std::vector<Row>& rows, const Measurer& measurer, const reference::Schedule& schedule) {
    const MeasuredScene& measured = measurer.measured;
    add_own_rows(rows, measurer, measured, schedule, "");
    if (measured.is_rope()) {
        add_own_rows(rows, measurer, at_once(measured), schedule, at_once_suffix);
    }
    if (measured.may_be_tethered()) {
        add_own_rows(rows, measurer, tethered(measured), schedule, tethered_suffix);
    }
    // Where nothing is soft, PBD of stiffness 1 is XPBD.
    if (measured.has_compliance) {
        const Trace found = trace_of(Engine::pbd, measured, measurer.stiff, schedule);
        rows.push_back(measurer.row_of(name_of(Engine::pbd), schedule, found, nullptr));
    }
    if (lks_bench::has_bullet()) {
        BulletSimulation bullet(measured.scene, measurer.model, schedule);
        rows.push_back(measurer.row_of("Bullet", schedule, trace(bullet, measured, measurer.stiff), nullptr));
    }
}

} // namespace

Grid whole_grid() {
    return {{1, 2, 5, 10, 20, 40, 80, 160}, {1, 2, 4, 10, 40}, 160};
}

Grid quick_grid() {
    return {{1, 5, 20}, {1, 4}, 20};
}

bool has_bullet_curves() {
    return lks_bench::has_bullet();
}

Experiment measure_particles(const MeasuredScene& measured, const Grid& grid, const Progress& progress) {
    Experiment experiment{measured.name, measured.title, measured.what, "particle"};
    experiment.quantities = quantities_of(measured);
    experiment.has_rounding = true;
    experiment.rounding = 3;

    progress(measured.name + ": reference, " + std::to_string(measured.reference_substeps) + " substeps");
    const Measurer measurer(measured);
    const std::vector<reference::Schedule> schedules = schedules_of(grid);
    for (std::size_t i = 0; i < schedules.size(); ++i) {
        progress(measured.name + ": " + label_of(schedules[i]) + " (" + std::to_string(i + 1) + " of " +
                 std::to_string(schedules.size()) + ")");
        add_rows(experiment.rows, measurer, schedules[i]);
    }
    return experiment;
}

reference::Stretch stretch_over_time(const MeasuredScene& measured, Engine engine,
                                     const reference::Schedule& schedule) {
    const Trace found = trace(*simulate(engine, measured.scene, schedule), measured,
                              stiff_part(model_of(measured.scene), measured));
    return {found.worst_stretch, found.mean_stretch};
}

Rounding rounding_of(const MeasuredScene& measured, const reference::Schedule& schedule) {
    const auto positions = [&](Engine engine, const reference::Schedule& at) {
        const auto simulation = simulate(engine, measured.scene, at);
        for (int tick = 0; tick < measured.deviation_tick; ++tick) {
            simulation->tick();
        }
        return simulation->positions();
    };
    const Positions twin = positions(Engine::double_precision, schedule);
    return {largest_distance(positions(Engine::fixed_point, schedule), twin),
            largest_distance(positions(Engine::single_precision, schedule), twin),
            largest_distance(twin, positions(Engine::double_precision, {measured.reference_substeps, 1}))};
}

} // namespace lks_accuracy
