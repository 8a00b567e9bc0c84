// Bullet's soft body as a peer, from the package libbullet-dev; bullet_missing.cpp where it is not installed.
#pragma once

#include "variant.h"

namespace lks_bench {

inline constexpr const char* bullet_name = "Bullet soft body";

bool has_bullet();
std::unique_ptr<Variant> make_bullet_peer(const Workload& workload);

} // namespace lks_bench
