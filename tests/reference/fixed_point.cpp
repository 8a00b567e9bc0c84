#include "reference/fixed_point.h"

#include <stdexcept>

namespace reference {
namespace {

lks_fixed fixed(double value) {
    lks_fixed result = 0;
    if (lks_fixed_from_double(value, &result) != LKS_OK) {
        throw std::runtime_error("The scene has a number that the SDK can't hold.");
    }
    return result;
}
lks_vec3 fixed(const support::Vector& v) {
    return {fixed(v.x), fixed(v.y), fixed(v.z)};
}

class FixedPoint final : public Simulation {
public:
    FixedPoint(const ParticleScene& scene, const Schedule& schedule) : asset_(scene) {
        lks_error error{};
        lks_world_def def = lks_default_world_def();
        def.tick_rate_hz = static_cast<std::uint32_t>(scene.tick_rate_hz);
        def.substeps = static_cast<std::uint32_t>(schedule.substeps);
        def.iterations = static_cast<std::uint32_t>(schedule.iterations);
        def.gravity = fixed(scene.gravity);
        def.keep_previous_positions = 0;
        def.error = &error;
        if (lks_world_create(&def, &world_) != LKS_OK) {
            throw std::runtime_error(error.message);
        }
        try {
            add(scene);
        } catch (...) {
            lks_world_destroy(world_);
            throw;
        }
    }
    ~FixedPoint() override { lks_world_destroy(world_); }
    FixedPoint(const FixedPoint&) = delete;
    FixedPoint& operator=(const FixedPoint&) = delete;

    void tick() override { accept(lks_world_step(world_)); }
    std::vector<support::Vector> positions() const override {
        std::vector<lks_raw_position> raw(lks_asset_vertex_count(asset_.get()));
        lks_vec3 origin{};
        accept(
            lks_object_raw_positions(world_, object_, 0, static_cast<std::uint32_t>(raw.size()), raw.data()));
        accept(lks_object_origin(world_, object_, &origin));
        std::vector<support::Vector> found;
        for (const lks_raw_position& p : raw) {
            found.push_back(support::Vector{support::raw_metres(p.x), support::raw_metres(p.y),
                                            support::raw_metres(p.z)} +
                            support::metres(origin));
        }
        return found;
    }
    std::vector<support::Vector> velocities() const override {
        std::vector<lks_vec3> velocities(lks_asset_vertex_count(asset_.get()));
        accept(lks_object_velocities(world_, object_, 0, static_cast<std::uint32_t>(velocities.size()),
                                     velocities.data()));
        std::vector<support::Vector> found;
        for (const lks_vec3& v : velocities) {
            found.push_back(support::metres(v));
        }
        return found;
    }
    double force(std::size_t edge) const override {
        lks_fixed force = 0;
        accept(lks_object_constraint_force(world_, object_, static_cast<std::uint32_t>(edge), &force));
        return support::metres(force);
    }

private:
    void accept(lks_result result) const {
        if (result != LKS_OK) {
            throw std::runtime_error(lks_world_last_error(world_)->message);
        }
    }

    void add(const ParticleScene& scene) {
        lks_object_def def = lks_default_object_def();
        def.asset = asset_.get();
        def.record_forces = scene.record_forces ? 1 : 0;
        def.linear_damping = fixed(scene.linear_damping);
        accept(lks_world_add_object(world_, &def, &object_));
        // To where they start: pinned, brought there in one tick, and let go without velocity.
        std::vector<bool> pinned(scene.start.size());
        for (const std::uint32_t pin : scene.pins) {
            pinned[pin] = true;
        }
        for (std::uint32_t v = 0; v < scene.start.size(); ++v) {
            accept(lks_object_pin(world_, object_, v));
            accept(lks_object_set_pin_target(world_, object_, v, fixed(scene.start[v])));
        }
        tick();
        for (std::uint32_t v = 0; v < scene.start.size(); ++v) {
            if (!pinned[v]) {
                accept(lks_object_unpin(world_, object_, v));
                accept(lks_object_set_velocity(world_, object_, v, {}));
            }
        }
        if (scene.ball.radius > 0) {
            lks_collider_def ball = lks_default_collider_def();
            ball.transform.position = fixed(scene.ball.centre);
            ball.radius = fixed(scene.ball.radius);
            ball.static_friction = 0;
            ball.dynamic_friction = 0;
            lks_collider_id collider{};
            accept(lks_world_add_collider(world_, &ball, &collider));
        }
    }

    SceneAsset asset_;
    lks_world* world_ = nullptr;
    lks_object_id object_{};
};

} // namespace

SceneAsset::SceneAsset(const ParticleScene& scene) {
    lks_error error{};
    lks_result result = LKS_OK;
    if (scene.columns > 0) {
        lks_cloth_def def = lks_default_cloth_def();
        def.columns = scene.columns;
        def.rows = scene.rows;
        def.width = scene.width;
        def.height = scene.height;
        def.mass = 0;
        def.area_density = 0;
        def.vertex_masses = scene.masses.data();
        def.stretch = scene.materials[LKS_CONSTRAINT_STRETCH];
        def.shear = scene.materials[LKS_CONSTRAINT_SHEAR];
        def.bend = scene.materials[LKS_CONSTRAINT_BEND];
        def.particle_radius = 0;
        if (scene.tethers > 0) {
            def.tethers_per_vertex = scene.tethers;
            def.tether_anchors = scene.pins.data();
            def.tether_anchor_count = static_cast<std::uint32_t>(scene.pins.size());
        }
        def.error = &error;
        result = lks_asset_create_cloth(&def, &asset_);
    } else {
        std::vector<double> points;
        for (const support::Vector& p : scene.rest) {
            points.insert(points.end(), {p.x, p.y, p.z});
        }
        lks_rope_def def = lks_default_rope_def();
        def.solver = scene.solver;
        def.segments = 0;
        def.length = 0;
        def.point_count = static_cast<std::uint32_t>(scene.rest.size());
        def.points = points.data();
        def.mass = 0;
        def.linear_density = 0;
        def.vertex_masses = scene.masses.data();
        def.stretch = scene.materials[LKS_CONSTRAINT_STRETCH];
        def.bend = scene.materials[LKS_CONSTRAINT_BEND];
        def.particle_radius = 0;
        def.error = &error;
        result = lks_asset_create_rope(&def, &asset_);
    }
    if (result != LKS_OK) {
        throw std::runtime_error(error.message);
    }
}

std::unique_ptr<Simulation> make_fixed_point(const ParticleScene& scene, const Schedule& schedule) {
    return std::make_unique<FixedPoint>(scene, schedule);
}

} // namespace reference
