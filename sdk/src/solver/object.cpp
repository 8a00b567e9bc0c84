#include "solver/object.h"

#include <algorithm>

#include "kernels/kernels.h"

namespace lks {
namespace {

// Of ways along the axes; rounded up.
std::int64_t half_of_way(const std::uint64_t (&gaps)[3]) {
    std::uint64_t quarters = 0; // their sum may have 66 bits
    for (const std::uint64_t gap : gaps) {
        quarters += gap / 4 + 1;
    }
    const std::int64_t way = quarters > INT64_MAX / 4 ? INT64_MAX : static_cast<std::int64_t>(4 * quarters);
    return way / 2 + 1;
}

// Axes begin at cache lines, and those of large objects not at the same place of a 4 kB page, where
// processors take a load from one for a load of what was just stored to another.
std::size_t stride_for(std::size_t count) {
    constexpr std::size_t line = 8;
    constexpr std::size_t page = 512;
    constexpr std::size_t offset = 11 * line;
    const std::size_t whole = (count + line - 1) / line * line;
    return whole < 2 * page ? whole : (whole - offset + page - 1) / page * page + offset;
}

} // namespace

Object::Object(const lks_allocator& allocator, const lks_asset& asset, const Coefficients& shared)
    : particles(allocator), multipliers(allocator), recorded_pins(allocator), previous(allocator),
      pin_starts(allocator), asset_(&asset), shared_(&shared), own_(allocator), pins_(allocator),
      pinned_particles_(allocator) {
    retain_asset(asset_);
}

Object::~Object() {
    release_asset(asset_);
}

bool Object::allocate(bool with_forces, bool need_multipliers, bool keep_previous) {
    record_forces = with_forces;
    const std::size_t n = count();
    axis_stride_ = stride_for(n);
    return particles.resize(axis_count * axis_stride_ + widest_group) &&
           (!need_multipliers || multipliers.resize(asset_->constraints.size())) &&
           (!keep_previous || previous.resize(3 * n));
}

void Object::keep_previous() {
    if (!previous.empty()) {
        for (int i = 0; i < 3; ++i) {
            std::copy_n(axis(i), count(), previous.data() + static_cast<std::size_t>(i) * count());
        }
    }
}

const Pin* Object::find_pin(std::uint32_t particle) const {
    const auto* found = std::lower_bound(pinned_particles_.begin(), pinned_particles_.end(), particle);
    if (found == pinned_particles_.end() || *found != particle) {
        return nullptr;
    }
    return &pins_[static_cast<std::size_t>(found - pinned_particles_.begin())];
}

Pin* Object::find_pin(std::uint32_t particle) {
    return const_cast<Pin*>(static_cast<const Object*>(this)->find_pin(particle));
}

bool Object::reserve_pins(std::size_t pin_count) {
    if (pin_count == 0) {
        return true;
    }
    // Room for twice as many, so that pinning one after the other does not allocate each time.
    const std::size_t wanted = std::min<std::size_t>(std::max<std::size_t>(2 * pin_count, 4), count());
    const std::size_t capacity = pin_count <= pins_.capacity() ? pins_.capacity() : wanted;
    if (!pins_.reserve(capacity) || !pinned_particles_.reserve(capacity) || !pin_starts.reserve(capacity) ||
        (record_forces && !recorded_pins.reserve(capacity))) {
        return false;
    }
    return reserve_coefficients();
}

bool Object::reserve_coefficients() {
    owns_coefficients_ = owns_coefficients_ || own_.copy(*shared_);
    return owns_coefficients_;
}

void Object::bear(const StepRate& rate, const ParticleLoad* loads, std::size_t count) {
    PinnedParticles masses = pinned();
    masses.loads = loads;
    masses.load_count = count;
    follow_loads(rate, loads, count, masses);
}

void Object::bear_no_more(const StepRate& rate, const ParticleLoad* loads, std::size_t count) {
    follow_loads(rate, loads, count, pinned());
}

void Object::follow_loads(const StepRate& rate, const ParticleLoad* loads, std::size_t count,
                          const PinnedParticles& masses) {
    for (std::size_t i = 0; i < count; ++i) {
        own_.update_particle(*asset_, rate, masses, loads[i].particle);
    }
    own_.chain.share_mass(*asset_, masses, shared_->chain);
}

void Object::add_pin(const StepRate& rate, std::uint32_t particle, const Coordinates& target) {
    const auto* place = std::lower_bound(pinned_particles_.begin(), pinned_particles_.end(), particle);
    const auto index = static_cast<std::size_t>(place - pinned_particles_.begin());
    pinned_particles_.insert_reserved(index, particle);
    pins_.insert_reserved(index, Pin{particle, 0, target});
    own_.update_particle(*asset_, rate, pinned(), particle);
}

void Object::remove_pin(const StepRate& rate, std::uint32_t particle) {
    const auto* place = std::lower_bound(pinned_particles_.begin(), pinned_particles_.end(), particle);
    const auto index = static_cast<std::size_t>(place - pinned_particles_.begin());
    pinned_particles_.erase(index);
    pins_.erase(index);
    own_.update_particle(*asset_, rate, pinned(), particle);
}

void Object::follow_pins(const StepRate& rate) {
    while (!pinned_particles_.empty()) {
        const std::uint32_t particle = pinned_particles_[pinned_particles_.size() - 1];
        pinned_particles_.erase(pinned_particles_.size() - 1);
        own_.update_particle(*asset_, rate, pinned(), particle);
    }
    for (const Pin& pin : pins_) {
        pinned_particles_.push_reserved(pin.particle);
    }
    for (const Pin& pin : pins_) {
        own_.update_particle(*asset_, rate, pinned(), pin.particle);
    }
}

void Object::record_pins() {
    if (!record_forces) {
        return;
    }
    recorded_pins.clear();
    for (const std::uint32_t particle : pinned_particles_) {
        recorded_pins.push_reserved(particle);
    }
}

std::uint64_t Object::shift_pin_targets(int axis, std::int64_t shift) {
    std::uint64_t clamped = 0;
    for (Pin& pin : pins_) {
        std::int64_t& target = fixed::component(pin.target, axis);
        // Both within ±64 m, so the difference fits.
        const std::int64_t shifted = target - shift;
        target = std::clamp(shifted, -coordinate_limit, coordinate_limit);
        clamped += static_cast<std::uint64_t>(target != shifted);
    }
    return clamped;
}

namespace {

Bounds make_bounds(const CoordinateRanges& ranges) {
    const auto& [x, y, z] = ranges.axes;
    return {{x.low, y.low, z.low}, {x.high, y.high, z.high}};
}

} // namespace

Bounds Object::bounds(const Kernels& kernels) const {
    return bounds(kernels, 0, count());
}

Bounds Object::bounds(const Kernels& kernels, std::uint32_t first, std::uint32_t particle_count) const {
    return make_bounds(kernels.ranges(axis(0) + first, axis_stride_, particle_count));
}

Bounds Object::start_bounds(const Kernels& kernels, std::uint32_t first, std::uint32_t particle_count) const {
    return make_bounds(kernels.ranges(start_axis(0) + first, axis_stride_, particle_count));
}

std::int64_t Object::greatest_motion(const Kernels& kernels) const {
    std::uint64_t greatest = 0;
    for (int i = 0; i < 3; ++i) {
        greatest = std::max(greatest, kernels.greatest_gap(axis(i), start_axis(i), count()));
    }
    return static_cast<std::int64_t>(std::min<std::uint64_t>(greatest, substep_motion_limit));
}

std::int64_t Object::greatest_growth(const Kernels& kernels) const {
    std::uint64_t gaps[3];
    for (int i = 0; i < 3; ++i) {
        gaps[i] = kernels.greatest_gap(axis(i), start_axis(i), count());
    }
    return half_of_way(gaps);
}

std::int64_t Object::growth_of(std::uint32_t particle) const {
    std::uint64_t gaps[3];
    for (int i = 0; i < 3; ++i) {
        const std::int64_t x = axis(i)[particle];
        const std::int64_t start = start_axis(i)[particle];
        gaps[i] =
            static_cast<std::uint64_t>(std::max(x, start)) - static_cast<std::uint64_t>(std::min(x, start));
    }
    return half_of_way(gaps);
}

} // namespace lks
