#include <algorithm>
#include <chrono>
#include <memory>
#include <numeric>

#include "bullet_crowd.h"
#include "sections.h"

namespace lks_bench {
namespace {

class OurCrowd final : public CrowdWorld {
public:
    OurCrowd(const Crowd& crowd, std::uint32_t substeps) {
        lks_world_def def = lks_default_world_def();
        def.substeps = substeps;
        lks_world_create(&def, &world_);
        lks_collider_def ground = lks_default_collider_def();
        ground.shape = LKS_SHAPE_PLANE;
        lks_collider_id collider{};
        lks_world_add_collider(world_, &ground, &collider);
        lks_ragdoll_def ragdoll = lks_default_ragdoll_def();
        ragdoll.bones = crowd.bones;
        ragdoll.bone_count = crowd_bones;
        for (const lks_vec3& place : crowd.places) {
            ragdoll.transform.position = place;
            lks_body_id bodies[crowd_bones];
            lks_joint_id joints[crowd_bones - 1];
            lks_world_add_ragdoll(world_, &ragdoll, bodies, joints);
            joints_.insert(joints_.end(), joints, joints + crowd_bones - 1);
        }
    }
    ~OurCrowd() override { lks_world_destroy(world_); }

    void tick() override { lks_world_step(world_); }
    std::vector<double> joint_errors() const override {
        std::vector<double> errors;
        for (const lks_joint_id joint : joints_) {
            lks_fixed error = 0;
            lks_joint_error(world_, joint, &error);
            errors.push_back(lks_fixed_to_double(error));
        }
        return errors;
    }

private:
    lks_world* world_ = nullptr;
    std::vector<lks_joint_id> joints_;
};

struct Run {
    std::string name;
    std::unique_ptr<CrowdWorld> world;
    double milliseconds = 0;
    double sum = 0;
    std::size_t count = 0;
    double worst = 0;
};

} // namespace

void measure_ragdolls(int rounds, Results& results) {
    const Crowd crowd;
    // A round is a hundredth of the fall, so that a quick look is quick.
    const int ticks = std::min(300, 3 * rounds);
    std::vector<Run> runs;
    runs.push_back({"8 substeps", std::make_unique<OurCrowd>(crowd, 8)});
    runs.push_back({"4 substeps", std::make_unique<OurCrowd>(crowd, 4)});
    for (const int steps : {1, 4}) {
        if (std::unique_ptr<CrowdWorld> bullet = make_bullet_crowd(crowd, steps)) {
            runs.push_back(
                {"Bullet, " + std::to_string(steps) + (steps == 1 ? " step" : " steps"), std::move(bullet)});
        }
    }
    // All take turns, tick by tick.
    for (int tick = 0; tick < ticks; ++tick) {
        for (Run& run : runs) {
            const auto start = std::chrono::steady_clock::now();
            run.world->tick();
            run.milliseconds +=
                std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
            const std::vector<double> errors = run.world->joint_errors();
            run.sum = std::accumulate(errors.begin(), errors.end(), run.sum);
            run.count += errors.size();
            run.worst = std::max(run.worst, *std::max_element(errors.begin(), errors.end()));
        }
    }
    for (const Run& run : runs) {
        results.push_back({ragdolls_name, "whole tick", run.name, run.milliseconds / ticks, "ms",
                           run.milliseconds / runs.front().milliseconds});
    }
    for (const Run& run : runs) {
        results.push_back({ragdolls_name, "joint error, mean", run.name,
                           1000 * run.sum / static_cast<double>(run.count), "mm"});
        results.push_back({ragdolls_name, "joint error, worst", run.name, 1000 * run.worst, "mm"});
    }
}

} // namespace lks_bench
