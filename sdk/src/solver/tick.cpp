#include "solver/tick.h"

#include <algorithm>

#include "collide/broad_phase.h"
#include "collide/contact.h"
#include "fixed/formats.h"
#include "solver/distance.h"
#include "solver/local_frame.h"
#include "solver/pins.h"
#include "solver/prediction.h"
#include "solver/world.h"

namespace lks {
namespace {

// How one object moves through one tick.
class ObjectTick {
public:
    ObjectTick(lks_world& world, Object& object)
        : world_(world), object_(object), asset_(object.asset()), coefficients_(object.coefficients()),
          kept_(kept_share(world.rate, object.linear_damping)) {
        const std::int64_t gravity[3] = {world.gravity.x, world.gravity.y, world.gravity.z};
        for (int axis = 0; axis < 3; ++axis) {
            acceleration_[axis] = motion_from_acceleration(world.rate, gravity[axis], object.gravity_factor);
        }
    }

    void run() {
        Bounds bounds = object_.bounds();
        follow_object(object_, bounds, world_.counters);
        keep_previous();
        begin_pin_motion(object_);
        object_.record_pins();
        find_candidates(bounds);
        for (std::uint32_t substep = 1; substep <= world_.rate.substeps; ++substep) {
            run_substep(substep);
        }
    }

private:
    void keep_previous() {
        std::copy_n(object_.particles.data(), object_.previous.size(), object_.previous.data());
    }

    // Colliders that the object can reach in this tick at its speed limit; each substep looks at its true
    // bounds again.
    void find_candidates(Bounds bounds) {
        world_.candidates.clear();
        if (world_.colliders.empty()) {
            return;
        }
        for (const Pin& pin : object_.pins()) {
            include(bounds, pin.target);
        }
        const std::int64_t reach =
            std::min(world_.rate.motion_limit, coordinate_limit / world_.rate.substeps) *
            world_.rate.substeps;
        grow(bounds, reach);
        for (std::uint32_t i = 0; i < world_.colliders.size(); ++i) {
            const ColliderSlot& slot = world_.colliders[i];
            if (slot.used && may_touch(slot.collider, object_.origin, bounds, asset_.particle_radius)) {
                world_.candidates.push_reserved(i);
            }
        }
    }

    void run_substep(std::uint32_t substep) {
        predict();
        place_pins(object_, substep, world_.rate.substeps);
        if (!object_.multipliers.empty()) {
            std::fill(object_.multipliers.begin(), object_.multipliers.end(), 0);
        }
        for (std::uint32_t iteration = 0; iteration < world_.rate.iterations; ++iteration) {
            for (std::uint32_t index = 0; index < asset_.batches.size(); ++index) {
                const Batch& batch = asset_.batches[index];
                project_distances(asset_, coefficients_, index, {batch.first, batch.first + batch.count},
                                  distance_arrays(), *world_.kernels);
            }
            resolve_all_contacts(substep);
        }
    }

    void predict() {
        PredictionClamps clamps;
        for (int axis = 0; axis < 3; ++axis) {
            predict_axis(object_.axis(axis), object_.start_axis(axis), object_.count(), acceleration_[axis],
                         kept_, world_.rate.motion_limit, *world_.kernels, clamps);
        }
        world_.counters.position_clamps += clamps.positions;
        world_.counters.speed_clamps += clamps.speeds;
    }

    // Contacts come last in an iteration, so that a substep ends with nothing inside a collider.
    void resolve_all_contacts(std::uint32_t substep) {
        if (world_.candidates.empty()) {
            return;
        }
        const Bounds swept = swept_bounds();
        bool touched = false;
        for (const std::uint32_t index : world_.candidates) {
            const ColliderState& collider = world_.colliders[index].collider;
            if (!may_touch(collider, object_.origin, swept, asset_.particle_radius)) {
                continue;
            }
            const ContactFrame frame =
                make_contact_frame(collider, substep, world_.rate.substeps, object_.origin, swept,
                                   asset_.particle_radius, asset_.friction);
            resolve_contacts(frame, particle_arrays(), 0, object_.count(), *world_.kernels);
            touched = true;
        }
        if (touched) {
            place_pins(object_, substep, world_.rate.substeps);
        }
    }

    // Where the particles have been in this substep, from start to now.
    Bounds swept_bounds() const {
        Bounds bounds = object_.bounds();
        const auto include_starts = [this](int axis, std::int64_t& low, std::int64_t& high) {
            const std::int64_t* starts = object_.start_axis(axis);
            for (std::uint32_t i = 0; i < object_.count(); ++i) {
                low = std::min(low, starts[i]);
                high = std::max(high, starts[i]);
            }
        };
        include_starts(0, bounds.low.x, bounds.high.x);
        include_starts(1, bounds.low.y, bounds.high.y);
        include_starts(2, bounds.low.z, bounds.high.z);
        return bounds;
    }

    static void include(Bounds& bounds, const Coordinates& point) {
        bounds.low = {std::min(bounds.low.x, point.x), std::min(bounds.low.y, point.y),
                      std::min(bounds.low.z, point.z)};
        bounds.high = {std::max(bounds.high.x, point.x), std::max(bounds.high.y, point.y),
                       std::max(bounds.high.z, point.z)};
    }

    static void grow(Bounds& bounds, std::int64_t reach) {
        const auto lower = [reach](std::int64_t value) {
            return std::clamp(value, -coordinate_limit, coordinate_limit) - reach;
        };
        const auto higher = [reach](std::int64_t value) {
            return std::clamp(value, -coordinate_limit, coordinate_limit) + reach;
        };
        bounds.low = {lower(bounds.low.x), lower(bounds.low.y), lower(bounds.low.z)};
        bounds.high = {higher(bounds.high.x), higher(bounds.high.y), higher(bounds.high.z)};
    }

    DistanceArrays distance_arrays() {
        return {object_.axis(0),
                object_.axis(1),
                object_.axis(2),
                object_.start_axis(0),
                object_.start_axis(1),
                object_.start_axis(2),
                object_.multipliers.empty() ? nullptr : object_.multipliers.data()};
    }

    ParticleArrays particle_arrays() {
        return {object_.axis(0),       object_.axis(1),       object_.axis(2),
                object_.start_axis(0), object_.start_axis(1), object_.start_axis(2)};
    }

    lks_world& world_;
    Object& object_;
    const lks_asset& asset_;
    const Coefficients& coefficients_;
    std::uint32_t kept_;
    std::int64_t acceleration_[3];
};

// What a kinematic collider was moving to is where it now rests.
void finish_collider_motion(lks_world& world) {
    for (ColliderSlot& slot : world.colliders) {
        if (slot.used) {
            slot.collider.position = slot.collider.target_position;
            slot.collider.rotation = slot.collider.target_rotation;
        }
    }
}

} // namespace

void run_tick(lks_world& world) {
    if (world.before_tick.call != nullptr) {
        world.running = true;
        world.before_tick.call(world.before_tick.user, &world, world.tick);
        world.running = false;
    }
    for (ColliderSlot& slot : world.colliders) {
        slot.collider.previous_position = slot.collider.position;
        slot.collider.previous_rotation = slot.collider.rotation;
    }
    for (ObjectSlot& slot : world.objects) {
        if (slot.object != nullptr) {
            ObjectTick(world, *slot.object).run();
        }
    }
    finish_collider_motion(world);
    ++world.tick;
}

} // namespace lks
