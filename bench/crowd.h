// Humanoids in the air and what they fall on, as bones and boxes that any engine can be given.
#pragma once

#include <lockstitch/lockstitch.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lks_bench {

inline lks_vec3 millimetres(int x, int y, int z) {
    return {LKS_FIXED_RATIO(x, 1000), LKS_FIXED_RATIO(y, 1000), LKS_FIXED_RATIO(z, 1000)};
}

struct CrowdWall {
    lks_vec3 position;
    lks_vec3 half_extents;
};

// Nobody sleeps, joints have no friction; the ground is the plane y = 0.
struct Crowd {
    Crowd(const Crowd&) = delete;
    Crowd& operator=(const Crowd&) = delete;

    std::uint32_t bone_count = 0;
    lks_bone bones[LKS_HUMANOID_BONES];
    lks_body_shape shapes[LKS_HUMANOID_BONES];
    std::vector<lks_transform> places; // of the humanoids' frames
    lks_vec3 velocity{};               // of all
    std::vector<CrowdWall> walls;

protected:
    explicit Crowd(bool with_head_and_hands);
};

// 100 of 12 bones (without head and hands), 5 × 5 × 4.
struct CrowdBlock : Crowd {
    CrowdBlock();
};

// 30 of 15 bones, lying above a walled pit, as in the scene ragdoll_pile.
struct CrowdPile : Crowd {
    CrowdPile();
};

// 4 of 15 bones abreast, who stumble off the top of a flight of ten steps, as in the scene ragdoll_stairs.
struct CrowdStairs : Crowd {
    CrowdStairs();
};

// 12 of 15 bones, standing in three rows of four and pushed forward. Neighbours in a row have their hands
// rope_length apart.
struct CrowdRows : Crowd {
    static constexpr int columns = 4;
    static constexpr int rows = 3;
    static constexpr int rope_length = 750; // mm
    static constexpr int hand_height = 860; // of the hands' middle, mm

    CrowdRows();
};

// By how much a bone's joint is beyond its limits, of its swing and its twist: all in degrees. The axes of a
// hinge may not swing apart at all.
double degrees_beyond(const lks_bone& bone, double swing, double twist);

// An engine with the crowd in it.
class CrowdWorld {
public:
    virtual ~CrowdWorld() = default;
    virtual void tick() = 0;
    // How far each joint's points are apart, metres.
    virtual std::vector<double> joint_errors() const = 0;
    // How far each joint is beyond its limits, degrees; none where nobody asks this engine.
    virtual std::vector<double> limit_errors() const { return {}; }
    // Pairs of shapes that touch.
    virtual std::size_t contacts() const { return 0; }
    // Kinetic and potential, joules.
    virtual double energy() const = 0;
};

} // namespace lks_bench
