// Bullet's soft body as a peer, from the package libbullet-dev; bullet_missing.cpp where it is not installed.
#pragma once

#include "plain_float.h"
#include "variant.h"

namespace lks_bench {

inline constexpr const char* bullet_name = "Bullet soft body";

bool has_bullet();
std::unique_ptr<Variant> make_bullet_peer(const Workload& workload);
// What a body may meet: a frictionless ball that does not move.
struct BulletBall {
    Point centre{};
    double radius = 0; // 0: none
};
// Of one body; `damping` is the share of velocity that is lost a second. Null: no Bullet.
std::unique_ptr<Variant> make_bullet_body(const FloatCloth& shape, std::uint32_t substeps,
                                          std::uint32_t iterations, double damping,
                                          const BulletBall& ball = {});

} // namespace lks_bench
