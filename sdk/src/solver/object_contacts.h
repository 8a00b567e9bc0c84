// One object against the colliders that are near it in a tick.
#pragma once

#include <cstdint>

#include "collide/contact.h"
#include "collide/second_look.h"
#include "solver/object.h"
#include "solver/object_blocks.h"
#include "solver/tick_scratch.h"

struct lks_world;

namespace lks {

class ObjectContacts {
public:
    // number: among the objects that use this scratch at the same time.
    ObjectContacts(const lks_world& world, Object& object, TickScratch& scratch, const ObjectBlocks& blocks,
                   std::uint32_t number)
        : world_(world), object_(object), scratch_(scratch), blocks_(blocks),
          candidates_(scratch.candidates.data() +
                      scratch.candidates.capacity() / most_side_by_side * number) {}

    // Colliders that the object can reach from there in so many substeps at its speed limit; each substep
    // looks at its true bounds again.
    void find_candidates(Bounds bounds, std::uint32_t substeps);
    bool any() const { return candidate_count_ != 0; }

    // After the prediction.
    void begin_substep() {
        if (any()) {
            // Where the substep before has ended is where this one begins.
            knows_start_ = knows_bounds_;
            knows_bounds_ = false;
            if (knows_start_) {
                begin_where_it_ended();
            }
        }
    }
    // Pushes everybody out of what he is in. False: nothing has been touched.
    bool resolve(std::uint32_t substep);

private:
    bool is_near(std::uint32_t index, const Bounds& bounds) const;
    bool find_frame(std::uint32_t index, std::uint32_t substep, const Bounds& bounds,
                    ContactFrame& frame) const;
    void push_out(ContactFrame& frame, const FarPushes* far);
    void look_again(const FarPushes& far, std::uint32_t substep);
    void look_again(SecondLook& look, std::uint32_t substep) const;
    bool is_among_several_that_move_alike(const Bounds& bounds) const;
    void begin_where_it_ended();
    Bounds swept_bounds();
    template <typename BoundsOf>
    Bounds bounds_of_blocks(const BoundsOf& bounds_of) const;

    const lks_world& world_;
    Object& object_;
    TickScratch& scratch_;
    ObjectBlocks blocks_;
    std::uint32_t* candidates_; // colliders near the object
    std::uint32_t candidate_count_ = 0;
    // Where particles began the substep, and where they are since contacts looked, if nothing has moved them.
    Bounds start_bounds_;
    Bounds bounds_;
    bool knows_start_ = false;
    bool knows_bounds_ = false;
};

} // namespace lks
