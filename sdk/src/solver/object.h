// One cloth or rope in a world: its particles, its pins, and where its local frame is.
#pragma once

#include <lockstitch/object.h>

#include <algorithm>
#include <cstdint>

#include "asset/asset.h"
#include "fixed/vector.h"
#include "memory/array.h"
#include "solver/coefficients.h"

namespace lks {

struct Kernels;

struct Pin {
    std::uint32_t particle;
    std::uint32_t reserved;
    Coordinates target; // at the end of the next tick
};

// Least and greatest coordinates.
struct Bounds {
    fixed::Vec3 low;
    fixed::Vec3 high;
};

inline void include(Bounds& bounds, const Coordinates& point) {
    bounds.low = {std::min(bounds.low.x, point.x), std::min(bounds.low.y, point.y),
                  std::min(bounds.low.z, point.z)};
    bounds.high = {std::max(bounds.high.x, point.x), std::max(bounds.high.y, point.y),
                   std::max(bounds.high.z, point.z)};
}

inline Bounds joined(const Bounds& a, const Bounds& b) {
    Bounds both = a;
    include(both, {b.low.x, b.low.y, b.low.z});
    include(both, {b.high.x, b.high.y, b.high.z});
    return both;
}

// Position and start of the substep, x, y, z each.
inline constexpr int axis_count = 6;

class Object {
public:
    Object(const lks_allocator& allocator, const lks_asset& asset, const Coefficients& shared);
    ~Object();
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;

    // Takes down where the particles are, for views.
    void keep_previous();

    // All memory that the object needs while nothing is pinned. False: none left.
    [[nodiscard]] bool allocate(bool record_forces, bool need_multipliers, bool keep_previous);

    const lks_asset& asset() const { return *asset_; }
    std::uint32_t count() const { return asset_->vertex_count(); }

    // From one axis to the next.
    std::size_t axis_stride() const { return axis_stride_; }
    std::int64_t* axis(int index) {
        return particles.data() + static_cast<std::size_t>(index) * axis_stride_;
    }
    const std::int64_t* axis(int index) const {
        return particles.data() + static_cast<std::size_t>(index) * axis_stride_;
    }
    std::int64_t* start_axis(int index) { return axis(index + 3); }
    const std::int64_t* start_axis(int index) const { return axis(index + 3); }

    Coordinates position(std::uint32_t particle) const {
        return {axis(0)[particle], axis(1)[particle], axis(2)[particle]};
    }

    // Where the substep began for it.
    Coordinates start(std::uint32_t particle) const {
        return {start_axis(0)[particle], start_axis(1)[particle], start_axis(2)[particle]};
    }

    // The coefficients in force: the shared ones until something is pinned.
    const Coefficients& coefficients() const { return owns_coefficients_ ? own_ : *shared_; }

    // Pins are kept in ascending order of particle.
    const Pin* find_pin(std::uint32_t particle) const;
    Pin* find_pin(std::uint32_t particle);
    // Takes down which particles are pinned in the tick that begins.
    void record_pins();
    PinnedParticles pinned() const { return {pinned_particles_.data(), pinned_particles_.size()}; }
    const Array<Pin>& pins() const { return pins_; }
    // Memory for `pin_count` pins and for coefficients of its own. False: none left, nothing changed.
    [[nodiscard]] bool reserve_pins(std::size_t pin_count);
    // Memory for coefficients of its own. False: none left, nothing changed.
    [[nodiscard]] bool reserve_coefficients();
    // Its particles bear these, or other, loads from now on, or none any more: within the reserved memory.
    void bear(const StepRate& rate, const ParticleLoad* loads, std::size_t count);
    void bear_no_more(const StepRate& rate, const ParticleLoad* loads, std::size_t count);
    // Within the reserved memory.
    void add_pin(const StepRate& rate, std::uint32_t particle, const Coordinates& target);
    void remove_pin(const StepRate& rate, std::uint32_t particle);
    // Replaces all pins by `pin_count` others, within the reserved memory; `next` gives them in ascending
    // order. Coefficients are recomputed only where the set of pinned particles changes.
    template <typename Next>
    void replace_pins(const StepRate& rate, std::size_t pin_count, const Next& next) {
        bool same = pin_count == pins_.size();
        pins_.clear();
        for (std::size_t i = 0; i < pin_count; ++i) {
            pins_.push_reserved(next());
            same = same && pinned_particles_[i] == pins_[i].particle;
        }
        if (!same) {
            follow_pins(rate);
        }
    }

    // After the origin moved; a target that leaves the range by it is clamped. How many were.
    std::uint64_t shift_pin_targets(int axis, std::int64_t shift);

    // Of all particles, or some.
    Bounds bounds(const Kernels& kernels) const;
    Bounds bounds(const Kernels& kernels, std::uint32_t first, std::uint32_t count) const;
    // Of where they were at the start of the substep.
    Bounds start_bounds(const Kernels& kernels, std::uint32_t first, std::uint32_t count) const;
    // Of any particle on any axis in the last substep, at most substep_motion_limit.
    std::int64_t greatest_motion(const Kernels& kernels) const;
    // By how much the box of any particle's way through the substep is to grow at most where a shape turns
    // (collide/collider_motion.h).
    std::int64_t greatest_growth(const Kernels& kernels) const;
    // The same of one.
    std::int64_t growth_of(std::uint32_t particle) const;

    // State.
    fixed::Vec3 origin{};            // World
    std::int64_t gravity_factor = 0; // World
    std::int64_t linear_damping = 0; // World, 1/s
    bool record_forces = false;
    // x, y, z, then the starts of x, y, z, Coordinate: axis() says where each begins. State is only their
    // first count() values; kernels read, and write back, some behind.
    Array<std::int64_t> particles;
    Array<std::int64_t> multipliers; // Λ by constraint, Coordinate; state only where forces are recorded

    // Where forces are recorded: the particles that were pinned in the last tick, whose forces multipliers
    // are.
    Array<std::uint32_t> recorded_pins;

    // For views.
    Array<std::int64_t> previous; // x, y, z at the tick before; empty where not wanted
    // Of the tick that is running: where each pin started, by pin.
    Array<Coordinates> pin_starts;

private:
    void follow_loads(const StepRate& rate, const ParticleLoad* loads, std::size_t count,
                      const PinnedParticles& masses);
    // After pins_ was replaced: brings the list of pinned particles and the coefficients up to date.
    void follow_pins(const StepRate& rate);

    const lks_asset* asset_;
    std::size_t axis_stride_ = 0;
    const Coefficients* shared_;
    Coefficients own_;
    bool owns_coefficients_ = false;
    Array<Pin> pins_;
    Array<std::uint32_t> pinned_particles_; // the particles of pins_, for a quick search
};

} // namespace lks
