// Bullet's soft body as a peer, from the package libbullet-dev; bullet_missing.cpp where it is not installed.
#pragma once

#include "plain_float.h"
#include "variant.h"

namespace lks_bench {

inline constexpr const char* bullet_name = "Bullet soft body";

bool has_bullet();
std::unique_ptr<Variant> make_bullet_peer(const Workload& workload);
// Of one body, which meets frictionless spheres that do not move; `damping` is the share of velocity that is
// lost a second. Null: no Bullet.
std::unique_ptr<Variant> make_bullet_body(const FloatCloth& shape, std::uint32_t substeps,
                                          std::uint32_t iterations, double damping,
                                          const std::vector<FloatSphere>& met);

} // namespace lks_bench
