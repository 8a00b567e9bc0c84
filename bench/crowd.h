// A block of humanoids in the air, as bones that any engine can be given.
#pragma once

#include <lockstitch/lockstitch.h>

#include <cstdint>
#include <string>
#include <vector>

namespace lks_bench {

// The humanoid of lockstitch/ragdoll.h without head and hands: 12 bones, 11 joints.
inline constexpr std::uint32_t crowd_bones = 12;

struct Crowd {
    Crowd();
    Crowd(const Crowd&) = delete;
    Crowd& operator=(const Crowd&) = delete;

    lks_bone bones[LKS_HUMANOID_BONES];
    lks_body_shape shapes[LKS_HUMANOID_BONES];
    std::vector<lks_vec3> places; // of the humanoids' frames: 5 × 5 × 4
};

// An engine with the crowd in it.
class CrowdWorld {
public:
    virtual ~CrowdWorld() = default;
    virtual void tick() = 0;
    // How far each joint's points are apart, metres.
    virtual std::vector<double> joint_errors() const = 0;
};

} // namespace lks_bench
