// How what closes loops moves by pushes in it (rigid/closure_matrix.h): as trees that are pushed move.
#include "rigid/closure_matrix.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "rigid/closures.h"
#include "solver/world.h"
#include "support/mechanism.h"

using namespace lks;

namespace {

class Pushed {
public:
    Pushed(RigidScene& scene, const FigureRange& figure)
        : scene_(scene), figure_(figure), range_(scene.closure_ranges[figure.closures]),
          rows_(scene, range_, true) {}

    // The worst that an entry is off, in the greatest of its row and column.
    double check() {
        factor_closures(scene_, figure_);
        double worst = 0;
        rows_.for_each_row([&](const Closure& closure, const ClosureRow& row, std::uint32_t column) {
            push(closure, row);
            rows_.for_each_row([&](const Closure& other, const ClosureRow& moved, std::uint32_t number) {
                if (number >= column) {
                    const double off = static_cast<double>(entry(number, column)) -
                                       static_cast<double>(scaled_by(motion_of(other, moved), moved.scale));
                    const double whole =
                        std::sqrt(static_cast<double>(moved.own) * static_cast<double>(row.own));
                    worst = std::max(worst, std::abs(off) / whole);
                    ++entries;
                }
            });
        });
        return worst;
    }

    int entries = 0;

private:
    std::int64_t entry(std::uint32_t row, std::uint32_t column) const {
        return scene_.closure_matrix[range_.first_entry + entry_of(row, column)];
    }
    ClosureTree tree_of(const ClosureSide& side) { return {scene_, scene_.trees[side.tree]}; }
    template <typename Use>
    void for_each_tree(const Use& use) {
        for_each_part(scene_, figure_, Part::tree, [&](std::uint32_t i) {
            if (scene_.trees[i].has_closures()) {
                use(ClosureTree(scene_, scene_.trees[i]));
            }
        });
    }

    // By one of the row's scale: passes of all trees.
    void push(const Closure& closure, const ClosureRow& row) {
        const auto for_each_push = [&](const auto& use) {
            ClosureRows::for_each_side(closure, [&](const ClosureSide& side, bool is_a) {
                use(side, push_times(ClosureRows::push_of(row, is_a),
                                     rows_.in_tree(side, scaled_by(world_one, row.scale))));
            });
        };
        for_each_tree([](ClosureTree tree) { tree.begin(); });
        for_each_push([this](const ClosureSide& side, const Wrench& push) {
            tree_of(side).add_own_motion(side.body, push);
        });
        for_each_tree([](ClosureTree tree) { tree.spread(); });
        for_each_push(
            [this](const ClosureSide& side, const Wrench& push) { tree_of(side).add_push(side.body, push); });
    }
    std::int64_t motion_of(const Closure& closure, const ClosureRow& row) {
        std::int64_t motion = 0;
        ClosureRows::for_each_side(closure, [&](const ClosureSide& side, bool is_a) {
            const ArticulatedBody& part = scene_.articulated[side.body];
            const OwnMotion moved = tree_of(side).own_motion(side.body, {part.force, part.torque});
            motion += RowAlgebra<FineRows>::along(ClosureRows::push_of(row, is_a), moved.shift, moved.turn);
        });
        return motion;
    }

    RigidScene& scene_;
    const FigureRange& figure_;
    ClosureRange& range_;
    ClosureRows rows_;
};

// The worst of mechanisms made at random.
double worst_of(const support::MechanismDef& def, int ticks) {
    double worst = 0;
    int entries = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        support::Mechanism mechanism(seed, 4, def);
        mechanism.run(ticks);
        lks_world* const world = mechanism.world();
        for (const FigureRange& figure : world->rigid.figure_ranges) {
            if (figure.closures != no_closures) {
                Pushed pushed(world->rigid, figure);
                worst = std::max(worst, pushed.check());
                entries += pushed.entries;
            }
        }
    }
    CHECK(entries > 500);
    MESSAGE(entries << " entries, off by " << worst);
    return worst;
}

} // namespace

TEST_CASE("followed to the root, pushes move what closes loops as passes of the tree do") {
    CHECK(worst_of({10, 0, 30, 3}, 20) < 1e-9);
    CHECK(worst_of({10, 30, 30, 3}, 20) < 1e-9);
    CHECK(worst_of({1000, 0, 30, 3}, 20) < 1e-8);
}
