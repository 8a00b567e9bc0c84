// The projections of a world by themselves, without prediction, contacts and the rest of a tick.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solver/distance.h"
#include "solver/particle_rows.h"
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
    // Of one object, or of several side by side.
    struct Work {
        lks::DistanceWork distances;
        std::vector<std::ptrdiff_t> places;
        // Where they are swept in rows, which are taken and given back in each pass, as in each substep.
        lks::Array<std::int64_t> scratch;
        std::optional<lks::ParticleRows> rows;
        std::uint32_t particles = 0;
    };
    Work work_of(lks::Object* const* objects, std::uint32_t count) const;

    lks_world* world_;
    std::vector<Work> work_;
    std::vector<std::vector<std::int64_t>> saved_;
};

} // namespace lks_bench
