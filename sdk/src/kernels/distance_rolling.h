// Groups of runs that roll: between the steps of one's square root, which wait for each other, the
// differences of the group behind it are found and the group before it moves.
//
// In stages (kernels/distance_lanes.h) groups keep in memory what the next stage needs. Here most of it stays
// in registers. That pays where many groups follow each other: the first and the last have nobody to share
// their time with.
//
// Lengths of one octave are shifted by one count, and their ratios are not limited. So groups roll as long as
// they are in the octave of the longest rest length, and behind the first that is not by counts of their own.
#pragma once

#include <algorithm>

#include "kernels/distance_groups.h"

namespace lks {
namespace {

// How the ends of groups move that roll.
enum class Ends : std::uint8_t {
    // Those that don't are rare, and go apart: that there may be some costs all others 2 % of their time.
    alike,
    mixed,    // some do not
    by_parts, // each by its part, which may be the same
};

template <typename L, Ends ends, typename Access, typename Groups, typename Stage>
class Rolling {
public:
    Rolling(const Groups& groups, const Stage& stages) : groups_(groups), stages_(stages) {}

    template <typename Runs>
    LKS_FORCE_INLINE void project(Runs& runs) {
        if (!runs.take_one(now_->at)) {
            return;
        }
        begin();
        while (runs.take_one(next_->at)) {
            roll_through(runs);
        }
        // Nobody is behind the last one: its own differences again.
        next_->at = now_->at;
        roll_through(runs);
        settle(*before_);
    }

private:
    // Before the first one it moves itself, by nothing.
    void begin() {
        before_->at = now_->at;
        groups_.begin(*now_, sums_);
        in_octave_ = now_->staged.in_octave;
        look_at(*now_);
        std::copy_n(now_->staged.d, 3, before_->staged.d);
        f_ = FactorsOf<L>::none();
        before_->apart = before_->unequal = false;
    }

    // A group and those that follow it in its run, until one is to move apart, or is not of the octave.
    template <typename Runs>
    LKS_FORCE_INLINE void roll_through(Runs& runs) {
        in_octave_ ? roll_through<true>(runs) : roll_through<false>(runs);
    }
    // There is no call among them: compilers would keep in memory what lives longer than a call.
    template <bool in_octave, typename Runs>
    LKS_NEVER_INLINE void roll_through(Runs& runs) {
        if (before_->apart) {
            settle(*before_);
            f_ = FactorsOf<L>::none();
        }
        const Groups groups = groups_; // so that what is stored can't be thought to change it
        RollingGroup<L, Access>* before = before_;
        RollingGroup<L, Access>* now = now_;
        RollingGroup<L, Access>* next = next_;
        auto sums = sums_;
        Factors<L> f = f_;
        do {
            if (ends == Ends::mixed && before->unequal) {
                groups.move_unequal(before->at, before->staged, f);
                f = FactorsOf<L>::none();
            }
            groups.template roll<in_octave, ends == Ends::by_parts>(*before, *now, *next, sums, f);
            look_at(*next);
            RollingGroup<L, Access>* const free = before;
            before = now;
            now = next;
            next = free;
        } while (!before->apart && now->staged.in_octave == in_octave && runs.take_more(next->at));
        in_octave_ = now->staged.in_octave;
        before_ = before;
        now_ = now;
        next_ = next;
        sums_ = sums;
        f_ = f;
    }

    LKS_FORCE_INLINE void look_at(RollingGroup<L, Access>& group) const {
        const auto unequal = [&] { return stages_.may_differ(group.at) && !groups_.alike(group.at); };
        group.apart = group.staged.plain || (ends == Ends::alike && unequal());
        group.unequal = ends == Ends::mixed && !group.apart && unequal();
    }

    LKS_NEVER_INLINE void settle(RollingGroup<L, Access>& group) {
        group.staged.f = f_;
        stages_.move_apart(group.at, group.staged);
    }

    const Groups& groups_;
    const Stage& stages_;
    RollingGroup<L, Access> slots_[3];
    RollingGroup<L, Access>* before_ = &slots_[0];
    RollingGroup<L, Access>* now_ = &slots_[1];
    RollingGroup<L, Access>* next_ = &slots_[2];
    typename Groups::OfDifferences sums_; // of the group whose turn it is
    Factors<L> f_;                        // of the one before
    bool in_octave_ = false;              // all until now
};

} // namespace
} // namespace lks
