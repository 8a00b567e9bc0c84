#include "solver/object_rope.h"

#include "solver/chain.h"
#include "solver/object_arrays.h"

namespace lks {
namespace {

// Of a torn rope, in an iteration. What a substep of 0.1 s falls tears one that began whole: it has to be
// whole again at its end.
constexpr int most_mendings = 8;

} // namespace

bool ObjectRope::stretches(const DistanceTask& task) const {
    return object_.asset().batches[first_batch(task, scratch_.distances)].family == LKS_CONSTRAINT_STRETCH;
}

void ObjectRope::solve(bool near_colliders) {
    const Coefficients& coefficients = object_.coefficients();
    const FamilyCoefficients& stretch = coefficients.families[LKS_CONSTRAINT_STRETCH];
    const DistanceArrays arrays = distance_arrays(object_);
    std::int64_t* const memory = scratch_.chain.data();
    may_give_way_ = false;
    for (int mended = 0;
         mended < most_mendings && !solve_chain(coefficients.chain, stretch, arrays, kernels_, memory);
         ++mended) {
        if (mended == 0) {
            keep_torn(near_colliders);
        }
        sweep_twice();
        forget_multipliers();
        mend_chain(coefficients.chain, stretch, arrays, kernels_, memory);
    }
}

// What holds it apart then is neither its inertia nor its pins, and to mend it in each substep anew would
// make speed of it without end.
bool ObjectRope::gives_way_to_contacts() {
    if (!may_give_way_ || !is_torn(object_.coefficients().chain, distance_arrays(object_))) {
        return false;
    }
    may_give_way_ = false;
    kept().put_back();
    sweep_twice();
    return true;
}

void ObjectRope::end_substep(std::uint64_t substeps_per_second) {
    if (began_torn_) {
        kept().limit_speeds(substeps_per_second);
        began_torn_ = false;
    }
}

// Before it is mended for the first time, a rope that was torn when the substep began.
void ObjectRope::keep_torn(bool near_colliders) {
    if (!began_torn_) {
        began_torn_ = is_torn(object_.coefficients().chain, start_arrays(object_));
        if (began_torn_) {
            kept().keep();
        }
    }
    may_give_way_ = began_torn_ && near_colliders;
}

// What pushed it to where it is mended from is no tension of it.
void ObjectRope::forget_multipliers() {
    if (!object_.multipliers.empty()) {
        for (const std::uint32_t constraint : object_.coefficients().chain.constraints) {
            object_.multipliers[constraint] = 0;
        }
    }
}

// Its multipliers are the direct solve's alone.
void ObjectRope::sweep_twice() {
    for (int sweep = 0; sweep < 2; ++sweep) {
        for (DistanceTask task : scratch_.distances.tasks) {
            if (stretches(task)) {
                task.arrays.multipliers = nullptr;
                kernels_.project_distances(task);
            }
        }
    }
}

KeptRope ObjectRope::kept() const {
    return {object_, scratch_.chain.data() + ChainWork::words(object_.coefficients().chain.count())};
}

} // namespace lks
