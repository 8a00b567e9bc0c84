// Where the particles of an object are and were at the substep's start, while bodies move some of them.
#pragma once

#include "kernels/kernels.h"
#include "solver/object.h"

namespace lks {

// All are looked at once. Where one is moved its new way is added, which leaves the bounds of where it was:
// never too small.
class SweptParticles {
public:
    SweptParticles(const Object& object, const Kernels& kernels) : object_(object), kernels_(kernels) {}

    const Bounds& bounds();
    // By how much the box of any one's way is to grow at most (collide/collider_motion.h).
    std::int64_t greatest_growth();
    // Where it is by the time that anybody asks.
    void moved(std::uint32_t particle);

private:
    void add_moved();

    // Beyond which all are looked at anew.
    static constexpr std::uint32_t room = 32;

    const Object& object_;
    const Kernels& kernels_;
    Bounds bounds_{};
    std::int64_t growth_ = 0;
    std::uint32_t moved_[room];
    std::uint32_t moved_count_ = 0;
    bool bounds_known_ = false;
    bool growth_known_ = false;
};

} // namespace lks
