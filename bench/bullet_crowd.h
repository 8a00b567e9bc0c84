// Bullet's rigid bodies with cone-twist and hinge joints as a peer; bullet_missing.cpp where it is not
// installed.
#pragma once

#include <memory>

#include "crowd.h"

namespace lks_bench {

// Null: no Bullet. Each tick is cut into so many steps of ten iterations.
std::unique_ptr<CrowdWorld> make_bullet_crowd(const Crowd& crowd, int steps);

} // namespace lks_bench
