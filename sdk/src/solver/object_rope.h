// A rope that is solved at once, in the substeps of a tick: what tears is mended, and where contacts tear it
// again it gives way (solver/chain.h).
#pragma once

#include <cstdint>

#include "kernels/kernels.h"
#include "solver/kept_rope.h"
#include "solver/object.h"
#include "solver/tick_scratch.h"

namespace lks {

class ObjectRope {
public:
    ObjectRope(Object& object, TickScratch& scratch, const Kernels& kernels)
        : object_(object), scratch_(scratch), kernels_(kernels) {}

    bool is_solved_at_once() const { return !object_.coefficients().chain.empty(); }
    // Of the tasks of `scratch`.
    bool stretches(const DistanceTask& task) const;

    // near_colliders: contacts may tear it again.
    void solve(bool near_colliders);
    // After contacts. True: they have torn it again. It is now where it was before it was mended, only swept,
    // and contacts come again.
    bool gives_way_to_contacts();
    void end_substep(std::uint64_t substeps_per_second);

private:
    void keep_torn(bool near_colliders);
    void forget_multipliers();
    void sweep_twice();
    KeptRope kept() const;

    Object& object_;
    TickScratch& scratch_;
    const Kernels& kernels_;
    bool began_torn_ = false;   // where it was before it was mended is kept
    bool may_give_way_ = false; // it has been mended since
};

} // namespace lks
