// The crowd in our own engine.
#pragma once

#include "crowd.h"

namespace lks_bench {

class OurCrowd final : public CrowdWorld {
public:
    OurCrowd(const Crowd& crowd, std::uint32_t substeps, std::uint32_t iterations = 1,
             std::uint32_t workers = 1);
    ~OurCrowd() override { lks_world_destroy(world_); }

    void tick() override { lks_world_step(world_); }
    std::vector<double> joint_errors() const override;
    std::vector<double> limit_errors() const override;
    std::size_t contacts() const override { return lks_world_contact_count(world_); }
    double energy() const override;
    lks_world* world() const { return world_; }
    // Bone by bone, one humanoid after the other.
    const std::vector<lks_body_id>& bodies() const { return bodies_; }
    const std::vector<lks_joint_id>& joints() const { return joints_; }

private:
    lks_world* world_ = nullptr;
    std::vector<lks_body_id> bodies_;
    std::vector<lks_joint_id> joints_;
    std::vector<lks_bone> bones_; // of the joints
    std::vector<double> masses_;
};

} // namespace lks_bench
