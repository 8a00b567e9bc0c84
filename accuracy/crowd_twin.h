// A crowd of humanoids in the floating-point twin of the SDK's rigid solver.
#pragma once

#include <memory>
#include <vector>

#include "crowd.h"
#include "reference/particle_scene.h"
#include "support/numbers.h"

namespace lks_accuracy {

class CrowdTwin : public lks_bench::CrowdWorld {
public:
    // Of the bones' centres of mass.
    virtual std::vector<support::Vector> positions() const = 0;
};

// In double precision or float32. It begins as the SDK's does: places and masses are read from that.
std::unique_ptr<CrowdTwin> make_crowd_twin(const lks_bench::Crowd& crowd, const reference::Schedule& schedule,
                                           bool single);

} // namespace lks_accuracy
