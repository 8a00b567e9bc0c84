// Prediction over lanes: kernels/prediction_scalar.h. Where a lane might be clamped, all of its group go the
// plain way. "Might" is told from powers of two, which take one addition: a motion that stays within the
// limit whatever is added to it, and a place within 2^61 (objects are kept around their origin).
#pragma once

#include <algorithm>
#include <bit>
#include <type_traits>

#include "kernels/prediction_scalar.h"

namespace lks {
namespace {

template <typename L, bool damped>
class PredictionLanes {
    using R = typename L::Register;

public:
    explicit PredictionLanes(const PredictionTask& task) : task_(task), kept_(L::set(task.kept)) {
        std::int64_t room = task.motion_limit;
        for (const std::int64_t acceleration : task.accelerations) {
            room = std::min(room, task.motion_limit - (acceleration < 0 ? -acceleration : acceleration));
        }
        const std::int64_t safe =
            room > 0 ? std::int64_t{1} << (63 - std::countl_zero(static_cast<std::uint64_t>(room))) : 0;
        motion_bias_ = L::set(safe);
        motion_beyond_ = L::set(safe > 0 ? ~(2 * safe - 1) : -1);
    }

    // From particle i on, in whole groups; returns where the rest begins.
    std::size_t run(const PredictionAxis& axis, std::size_t i, PredictionClamps& clamps) const {
        constexpr std::size_t lanes = 2 * L::half;
        const R acceleration = L::set(axis.acceleration);
        for (; i + lanes <= task_.count; i += lanes) {
            const Prediction first = predict(axis, acceleration, i);
            const Prediction second = predict(axis, acceleration, i + L::half);
            if (might_be_clamped(L::bit_or(first.motion, second.motion),
                                 L::bit_or(first.place, second.place))) {
                predict_in_turn<damped>(task_, axis, i, i + lanes, clamps);
            } else {
                store(axis, i, first);
                store(axis, i + L::half, second);
            }
        }
        return i;
    }

    // To the end.
    void finish(const PredictionAxis& axis, std::size_t i, PredictionClamps& clamps) const {
        if (i + L::half <= task_.count) {
            const Prediction last = predict(axis, L::set(axis.acceleration), i);
            if (!might_be_clamped(last.motion, last.place)) {
                store(axis, i, last);
                i += L::half;
            }
        }
        if (i != task_.count) {
            predict_in_turn<damped>(task_, axis, i, task_.count, clamps);
        }
    }

private:
    static constexpr std::int64_t safe_place = std::int64_t{1} << 61;

    struct Prediction {
        R start, x;
        R motion, place; // lifted by what is safe: from zero to below twice that
    };

    bool might_be_clamped(R motion, R place) const {
        return L::any(
            L::bit_or(L::bit_and(motion, motion_beyond_), L::bit_and(place, L::set(~(2 * safe_place - 1)))));
    }

    Prediction predict(const PredictionAxis& axis, R acceleration, std::size_t i) const {
        const R x = L::load(axis.x + i);
        const R motion = L::subtract(x, L::load(axis.start + i));
        R kept = motion;
        if constexpr (damped) {
            kept = damp_lanes(motion);
        }
        return {x, L::add(x, L::add(kept, acceleration)), L::add(motion, motion_bias_),
                L::add(x, L::set(safe_place))};
    }

    // Within the limit (2^60 at most) the high part has 30 bits, so its sign may be lost above.
    R damp_lanes(R motion) const {
        const R high = L::template shift_right<unit_fraction_bits>(motion);
        const R low = L::bit_and(motion, L::set(unit_one - 1));
        return L::add(L::multiply_signed(high, kept_),
                      L::template shift_right<unit_fraction_bits>(
                          L::add(L::multiply_unsigned(low, kept_), L::set(unit_one >> 1))));
    }

    static void store(const PredictionAxis& axis, std::size_t i, const Prediction& prediction) {
        L::store(axis.start + i, prediction.start);
        L::store(axis.x + i, prediction.x);
    }

    PredictionTask task_; // a copy, so that what is stored can't be thought to change it
    R kept_;
    R motion_bias_;
    R motion_beyond_;
};

// `Narrow`: the lanes for what does not fill a group.
template <typename L, typename Narrow, bool damped>
inline PredictionClamps predict_in_groups(const PredictionTask& task) {
    PredictionClamps clamps;
    const PredictionLanes<Narrow, damped> narrow(task);
    if constexpr (!std::is_same_v<L, Narrow>) {
        if (task.count >= 8 * L::half) {
            const PredictionLanes<L, damped> wide(task);
            for_each_axis(task, [&](const PredictionAxis& axis) {
                const std::size_t rest = wide.run(axis, 0, clamps);
                if (rest != task.count) {
                    narrow.finish(axis, narrow.run(axis, rest, clamps), clamps);
                }
            });
            return clamps;
        }
    }
    for_each_axis(
        task, [&](const PredictionAxis& axis) { narrow.finish(axis, narrow.run(axis, 0, clamps), clamps); });
    return clamps;
}

template <typename L, typename Narrow = L>
inline PredictionClamps predict_lanes(const PredictionTask& task) {
    return task.kept == unit_one ? predict_in_groups<L, Narrow, false>(task)
                                 : predict_in_groups<L, Narrow, true>(task);
}

} // namespace
} // namespace lks
