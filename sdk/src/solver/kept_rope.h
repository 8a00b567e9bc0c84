// Where the particles of a rope that began its substep torn were before it was mended (solver/chain.h), and
// what keeps mending from being motion.
#pragma once

#include <cstdint>

#include "solver/object.h"

namespace lks {

// Room for particles now and where the substep began, and multipliers.
inline std::size_t kept_words(const lks_asset& asset) {
    return 6 * std::size_t{asset.vertex_count()} + asset.constraints.size();
}

class KeptRope {
public:
    // `memory` has room for kept_words().
    KeptRope(Object& object, std::int64_t* memory) : object_(object), memory_(memory) {}

    // Particles now and where the substep began, and multipliers.
    void keep();
    void put_back();
    // At the end of the substep. Nobody leaves it faster than they came when the rope was kept, or than 4 m/s
    // if that is more: what brings a rope together from anywhere would fling it about.
    void limit_speeds(std::uint64_t substeps_per_second);

private:
    template <typename Use>
    void each(const Use& use);

    Object& object_;
    std::int64_t* memory_;
};

} // namespace lks
