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

    // All constraints of each object, as they stand, this many times: object by object, or several side by
    // side, as in a tick.
    void run(std::uint32_t passes);
    // To where the particles were at the beginning.
    void restore();

private:
    void put_side_by_side();

    lks_world* world_;
    std::vector<lks::DistanceWork> work_;   // by object
    std::vector<std::size_t> side_by_side_; // how many of them go with the first one, by object
    std::vector<std::ptrdiff_t> places_;    // of each from the first one
    std::vector<std::vector<std::int64_t>> saved_;
};

} // namespace lks_bench
