#include "rigid/swept_particles.h"

#include <algorithm>

namespace lks {

const Bounds& SweptParticles::bounds() {
    add_moved();
    if (!bounds_known_) {
        bounds_ = joined(object_.bounds(kernels_), object_.start_bounds(kernels_, 0, object_.count()));
        bounds_known_ = true;
    }
    return bounds_;
}

std::int64_t SweptParticles::greatest_growth() {
    add_moved();
    if (!growth_known_) {
        growth_ = object_.greatest_growth(kernels_);
        growth_known_ = true;
    }
    return growth_;
}

void SweptParticles::moved(std::uint32_t particle) {
    if (moved_count_ < room) {
        moved_[moved_count_++] = particle;
    } else {
        bounds_known_ = growth_known_ = false;
    }
}

void SweptParticles::add_moved() {
    for (std::uint32_t k = 0; k < moved_count_; ++k) {
        const std::uint32_t i = moved_[k];
        include(bounds_, object_.position(i));
        include(bounds_, object_.start(i));
        growth_ = std::max(growth_, object_.growth_of(i));
    }
    moved_count_ = 0;
}

} // namespace lks
