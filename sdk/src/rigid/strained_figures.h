// Figures that an iteration has not brought to rest against what stops them have more of them.
//
// A hand that a wall has stopped is drawn on by the arm and the chest behind it: its contact knows its own
// mass only, and at 60 m/s it would be 8 cm in the wall before all of them have stopped. And limits know the
// masses of their two bones: those of a hand that all of a figure hangs on would find too little in one
// iteration, be exceeded, and in the end throw the figure about. Where that happens the figure, and nobody
// else, has some iterations more, with the ropes that it hangs on.
#pragma once

#include "rigid/figure_blocks.h"
#include "rigid/figure_contacts.h"

namespace lks {

class StrainedFigures {
public:
    StrainedFigures(lks_world& world, const FigureBlocks& blocks, const FigureContacts& contacts)
        : world_(world), scene_(world.rigid), blocks_(blocks), contacts_(contacts) {}

    // True: ropes that bear figures have moved by it.
    bool relieve() const;

private:
    template <typename Use>
    void in_strained(const Use& use) const;
    void mark(std::uint32_t body) const;
    void mark_hard_impacts() const;
    void mark_exceeded_limits() const;
    bool find() const;
    bool is_strained(const FigureRange& figure) const;
    bool are_strained(const Contact& shared) const;
    bool is_strained_rope(std::uint32_t object) const;
    void solve(const FigureRange& figure) const;
    void solve_trees(const FigureRange& figure) const;
    void project_back(const FigureRange& figure) const;

    lks_world& world_;
    RigidScene& scene_;
    const FigureBlocks& blocks_;
    const FigureContacts& contacts_;
};

} // namespace lks
