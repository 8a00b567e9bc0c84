#include "asset/spare_particles.h"

namespace lks {
namespace {

// Which particles the batch at work touches, or has given away as spare.
class Taken {
public:
    explicit Taken(const lks_allocator& allocator) : batches_(allocator) {}

    bool allocate(std::uint32_t particles) { return batches_.resize(particles); }

    void begin_batch() { ++batch_; }
    // False: it was taken before, or there is no such particle.
    bool take(std::uint32_t particle) {
        if (particle >= batches_.size() || batches_[particle] == batch_) {
            return false;
        }
        batches_[particle] = batch_;
        return true;
    }
    void give_back(std::uint32_t particle) { batches_[particle] = 0; }

private:
    Array<std::uint32_t> batches_; // the last one that took it, counted from one
    std::uint32_t batch_ = 0;
};

std::uint32_t take_spare(const Run& run, Taken& taken) {
    const std::uint32_t wanted = (widest_group - run.count % widest_group) % widest_group;
    std::uint32_t spare = 0;
    for (; spare < wanted; ++spare) {
        const std::uint32_t a = run.a + run.count + spare;
        if (!taken.take(a)) {
            break;
        }
        if (!taken.take(run.b + run.count + spare)) {
            taken.give_back(a);
            break;
        }
    }
    return spare;
}

} // namespace

bool find_spare_particles(lks_asset& asset) {
    Taken taken(asset.allocator);
    if (!taken.allocate(asset.vertex_count())) {
        return false;
    }
    for (const Batch& batch : asset.batches) {
        taken.begin_batch();
        for (std::uint32_t i = batch.first; i < batch.first + batch.count; ++i) {
            (void)taken.take(asset.constraints[i].a);
            (void)taken.take(asset.constraints[i].b);
        }
        for (std::uint32_t r = batch.first_run; r < batch.first_run + batch.run_count; ++r) {
            asset.runs[r].spare = take_spare(asset.runs[r], taken);
        }
    }
    return true;
}

} // namespace lks
