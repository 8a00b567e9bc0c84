// The projections of a world by themselves, without prediction, contacts and the rest of a tick.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/distance.h"
#include "solver/world.h"

namespace lks_bench {

class Projections {
public:
    explicit Projections(lks_world* world);

    // All constraints of each object, as they stand, this many times: object by object, as in a tick.
    void run(std::uint32_t passes);
    // To where the particles were at the beginning.
    void restore();

private:
    lks_world* world_;
    std::vector<lks::DistanceWork> work_; // by object
    std::vector<std::vector<std::int64_t>> saved_;
};

} // namespace lks_bench
