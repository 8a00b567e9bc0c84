#include "reference/comparison.h"

#include <doctest/doctest.h>

namespace reference {
namespace {

support::Vector velocity_of(const Scenario& scenario, const Model& model, std::size_t particle) {
    const support::Vector arm = model.positions[particle] - model.positions[0];
    return support::metres(scenario.velocity) +
           support::Vector{-arm.y * scenario.spin, arm.x * scenario.spin, 0};
}

template <typename Scalar>
Solver<Scalar> run(const Model& model, const Scenario& scenario, const support::Vector& place = {}) {
    Solver<Scalar> solver(model, scenario.settings, place);
    for (std::size_t particle = 0; particle < solver.size(); ++particle) {
        solver.set_velocity(particle, velocity_of(scenario, model, particle));
    }
    for (const std::uint32_t pin : scenario.pins) {
        solver.set_velocity(pin, {});
        solver.pin(pin);
    }
    solver.tick(scenario.ticks);
    return solver;
}

template <typename Position>
double distance_from(const Solver<double>& expected, const Position& position) {
    double worst = 0;
    for (std::size_t particle = 0; particle < expected.size(); ++particle) {
        const double distance = (position(particle) - expected.position(particle)).length();
        if (!(distance <= worst)) {
            worst = distance; // also where it is no number
        }
    }
    return worst;
}

} // namespace

Deviation deviation_of(const Scenario& scenario) {
    const Settings& settings = scenario.settings;
    lks_world_def def = support::world_def(static_cast<std::uint32_t>(settings.tick_rate_hz),
                                           static_cast<std::uint32_t>(settings.substeps),
                                           static_cast<std::uint32_t>(settings.iterations));
    def.gravity = support::fixed(settings.gravity.x, settings.gravity.y, settings.gravity.z);
    support::World world(def);
    lks_object_def object_def = support::object_def(*scenario.asset, scenario.transform);
    object_def.velocity = scenario.velocity;
    object_def.linear_damping = support::fixed(settings.linear_damping);
    const lks_object_id object = world.add(object_def);
    for (const std::uint32_t pin : scenario.pins) {
        world.pin(object, pin);
    }
    const lks_vec3 place = scenario.transform.position;
    Model model = model_of(world, object, *scenario.asset, place, scenario.masses, scenario.materials);
    if (scenario.spin != 0) {
        for (std::uint32_t particle = 0; particle < model.positions.size(); ++particle) {
            const support::Vector v = velocity_of(scenario, model, particle);
            REQUIRE(lks_object_set_velocity(world, object, particle, support::fixed(v.x, v.y, v.z)) ==
                    LKS_OK);
        }
    }
    if (scenario.direct) {
        model.chain = segments_of(model.edges);
    }
    world.step(static_cast<std::uint64_t>(scenario.ticks));

    const lks_world_counters counters = world.counters();
    REQUIRE(counters.position_clamps == 0);
    REQUIRE(counters.speed_clamps == 0);

    const Solver<double> expected = run<double>(model, scenario);
    const Solver<float> single = run<float>(model, scenario);
    const Solver<float> far = run<float>(model, scenario, {100, 100, 100});
    const std::vector<support::Vector> positions = world.positions_from(object, place);

    Deviation deviation;
    deviation.fixed_point = distance_from(expected, [&](std::size_t p) { return positions[p]; });
    deviation.single = distance_from(expected, [&](std::size_t p) { return single.position(p); });
    deviation.single_at_100_metres = distance_from(expected, [&](std::size_t p) { return far.position(p); });
    return deviation;
}

} // namespace reference
