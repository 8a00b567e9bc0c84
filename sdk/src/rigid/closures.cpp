#include "rigid/closures.h"

#include <algorithm>

#include "rigid/closure_matrix.h"
#include "rigid/figures.h"

namespace lks {
namespace {

using namespace tree_detail;

// How soft rows are: 2^-8 of what their bodies by themselves give way by. What that leaves is solved for
// again (rigid/closure_system.h); what is held twice, of which nothing is left, is not pushed much harder
// than what is not.
constexpr int give_shift = 8;
// Where that moves bodies further than they may be moved at once it is eight times as soft, twice.
constexpr int softer_shift = 3;
constexpr std::int64_t greatest_bend = 8;

class FigureClosures {
public:
    FigureClosures(RigidScene& scene, const FigureRange& figure, bool in_substep)
        : scene_(scene), figure_(figure), range_(scene.closure_ranges[figure.closures]),
          rows_(scene, range_, in_substep), in_substep_(in_substep) {}

    void factor() {
        for_each_tree([this](ClosureTree tree) { tree.factor(in_substep_); });
        rows_.place();
        find_closure_matrix(scene_, figure_, rows_, matrix());
    }

    // Once a substep.
    void begin() {
        if (range_.stands) {
            for_each_tree([](ClosureTree tree) { tree.take_motors(); });
        }
    }

    void carry_feet() {
        rows_.for_each_foot_push([this](const ClosureSide& side, const fixed::Vec3& push) {
            tree_of(side).carry(side.body, side.lever, push);
        });
    }

    // Again where motors are not capable of what it takes.
    void solve() {
        while (!solve_once()) { // which drops a motor at least each time
            factor();
        }
    }

    // By more than a tenth of what rows that don't push are let be.
    bool is_apart() {
        bool apart = false;
        for_each_tree([&apart](const ClosureTree& tree) { apart = apart || tree.is_apart(); });
        if (apart) {
            return true;
        }
        static_cast<void>(rows_.measure(unknowns_));
        return std::any_of(unknowns_, unknowns_ + rows_.count(), [](const ClosureUnknown& row) {
            const std::int64_t left =
                row.side == 0 ? row.left : std::max<std::int64_t>(-row.side * row.left, 0);
            return left > row.slack / 10 || left < -row.slack / 10;
        });
    }

    // What is undone strains none. True: the trees' factors have them.
    bool hold_springs() {
        rows_.hold_springs();
        bool any = false;
        for_each_part(scene_, figure_, Part::tree,
                      [&](std::uint32_t i) { any = any || scene_.trees[i].has_springs; });
        return any;
    }

    void make_units() {
        for_each_tree([](ClosureTree tree) { tree.make_units(); });
    }

private:
    // False: motors are not capable of it.
    bool solve_once() { return solve_trees() && solve_rows(); }

    bool drop_motors() {
        bool any = false;
        if (range_.stands && in_substep_) {
            for_each_tree([&any](ClosureTree tree) { any = tree.drop_motors() || any; });
        }
        return any;
    }

    // False: nothing was moved, as motors are not capable of that.
    bool solve_trees() {
        for_each_tree([this](ClosureTree tree) { tree.solve(in_substep_); });
        if (drop_motors()) {
            return false;
        }
        for_each_tree([this](ClosureTree tree) { move(tree); });
        return true;
    }

    bool solve_rows() {
        if (!rows_.measure(unknowns_)) {
            factor();
            static_cast<void>(rows_.measure(unknowns_));
        }
        for (int softer = give_shift;; softer -= softer_shift) {
            lks::solve_rows(matrix(), unknowns_, rows_.count(), softer);
            if (std::all_of(unknowns_, unknowns_ + rows_.count(),
                            [](const ClosureUnknown& row) { return row.more == 0; })) {
                return true;
            }
            push();
            if (!bends_too_far()) {
                break;
            }
            if (softer < softer_shift) {
                hold_back();
                break;
            }
        }
        if (drop_motors()) {
            return false;
        }
        for_each_tree([this](ClosureTree tree) { move(tree); });
        if (in_substep_) {
            rows_.keep_pushes(unknowns_);
        }
        return true;
    }

    template <typename Use>
    void for_each_tree(const Use& use) {
        for_each_part(scene_, figure_, Part::tree, [&](std::uint32_t i) {
            if (scene_.trees[i].has_closures()) {
                use(ClosureTree(scene_, scene_.trees[i]));
            }
        });
    }
    ClosureTree tree_of(const ClosureSide& side) const {
        return ClosureTree(scene_, scene_.trees[side.tree]);
    }
    std::int64_t* matrix() { return scene_.closure_matrix.begin() + range_.first_entry; }

    // use(side, push)
    template <typename Use>
    void for_each_push(const Use& use) {
        rows_.for_each_row([&](const Closure& closure, const ClosureRow& row, std::uint32_t number) {
            const std::int64_t push = scaled_by(unknowns_[number].more, row.scale);
            if (push == 0) {
                return;
            }
            rows_.for_each_side(closure, [&](const ClosureSide& side, bool is_a) {
                use(side, push_times(rows_.push_of(side, row, number, is_a), rows_.in_tree(side, push)));
            });
        });
    }

    void push() {
        for_each_tree([](ClosureTree tree) { tree.begin(); });
        for_each_push([this](const ClosureSide& side, const Wrench& push) {
            tree_of(side).add_own_motion(side.body, push);
        });
        for_each_tree([](ClosureTree tree) { tree.spread(); });
        for_each_push(
            [this](const ClosureSide& side, const Wrench& push) { tree_of(side).add_push(side.body, push); });
    }

    // So far that what turns aside from the first order is several times what was to be moved: near to a pose
    // in which the rows can't be brought to zero at all.
    bool bends_too_far() {
        std::int64_t bent = 0;
        for_each_tree([&](const ClosureTree& tree) { bent = std::max(bent, tree.greatest_bend()); });
        return bent / greatest_bend > to_be_moved();
    }
    std::int64_t to_be_moved() {
        std::int64_t most = 0;
        rows_.for_each_row([&](const Closure&, const ClosureRow& row, std::uint32_t i) {
            const ClosureUnknown& unknown = unknowns_[i];
            const std::int64_t moved =
                unknown.pushes ? unknown.left : multiply_40(matrix()[entry_of(i, i)], unknown.more);
            const std::int64_t size = scaled_by(moved < 0 ? -moved : moved, -row.scale);
            most = std::max(most, size);
        });
        return most;
    }

    // To so much of it that it doesn't.
    void hold_back() {
        constexpr int most_halvings = 8;
        for (int i = 0; i < most_halvings && bends_too_far(); ++i) {
            std::for_each(unknowns_, unknowns_ + rows_.count(), [](ClosureUnknown& row) { row.more /= 2; });
            push();
        }
    }

    void move(ClosureTree tree) const {
        tree.move();
        if (in_substep_) {
            tree.keep_pushes();
        }
    }

    RigidScene& scene_;
    const FigureRange& figure_;
    ClosureRange& range_;
    ClosureRows rows_;
    bool in_substep_;
    ClosureUnknown unknowns_[most_closure_rows];
};

} // namespace

void factor_closures(RigidScene& scene, const FigureRange& figure) {
    if (figure.closures != no_closures) {
        FigureClosures closures(scene, figure, true);
        closures.begin();
        closures.factor();
    }
}

void carry_feet(RigidScene& scene, const FigureRange& figure) {
    if (stands_on_light_feet(scene, figure)) {
        FigureClosures(scene, figure, true).carry_feet();
    }
}

void solve_closures(RigidScene& scene, const FigureRange& figure) {
    if (figure.closures != no_closures) {
        FigureClosures(scene, figure, true).solve();
    }
}

void undo_closures(RigidScene& scene, const FigureRange& figure) {
    if (figure.closures == no_closures) {
        return;
    }
    constexpr int rounds = 3;
    FigureClosures closures(scene, figure, false);
    if (closures.hold_springs()) {
        closures.factor();
    }
    for (int round = 0; round < rounds && (round == 0 || closures.is_apart()); ++round) {
        closures.solve();
    }
    closures.make_units();
}

} // namespace lks
