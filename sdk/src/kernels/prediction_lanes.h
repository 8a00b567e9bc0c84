// Prediction over lanes: kernels/prediction_scalar.h. Where a lane might be clamped, all of its group go the
// plain way. "Might" is told from powers of two, which take one addition: a motion that stays within the
// limit whatever is added to it, and a place within 2^61 (objects are kept around their origin).
#pragma once

#include <bit>
#include <type_traits>

#include "kernels/prediction_scalar.h"

namespace lks {
namespace {

template <typename L, bool damped>
class PredictionLanes {
    using R = typename L::Register;

public:
    explicit PredictionLanes(const PredictionTask& task)
        : task_(task), acceleration_(L::set(task.acceleration_motion)), kept_(L::set(task.kept)) {
        const std::int64_t room =
            task.motion_limit -
            (task.acceleration_motion < 0 ? -task.acceleration_motion : task.acceleration_motion);
        const std::int64_t safe =
            room > 0 ? std::int64_t{1} << (63 - std::countl_zero(static_cast<std::uint64_t>(room))) : 0;
        motion_bias_ = L::set(safe);
        motion_beyond_ = L::set(safe > 0 ? ~(2 * safe - 1) : -1);
    }

    // From particle i on, in whole groups; returns where the rest begins.
    std::size_t run(std::size_t i, PredictionClamps& clamps) const {
        constexpr std::size_t lanes = 2 * L::half;
        for (; i + lanes <= task_.count; i += lanes) {
            const Prediction first = predict(i);
            const Prediction second = predict(i + L::half);
            if (might_be_clamped(L::bit_or(first.motion, second.motion),
                                 L::bit_or(first.place, second.place))) {
                predict_in_turn<damped>(task_, i, i + lanes, clamps);
            } else {
                store(i, first);
                store(i + L::half, second);
            }
        }
        return i;
    }

    // To the end.
    void finish(std::size_t i, PredictionClamps& clamps) const {
        if (i + L::half <= task_.count) {
            const Prediction last = predict(i);
            if (!might_be_clamped(last.motion, last.place)) {
                store(i, last);
                i += L::half;
            }
        }
        if (i != task_.count) {
            predict_in_turn<damped>(task_, i, task_.count, clamps);
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

    Prediction predict(std::size_t i) const {
        const R x = L::load(task_.x + i);
        const R motion = L::subtract(x, L::load(task_.start + i));
        R kept = motion;
        if constexpr (damped) {
            kept = damp_lanes(motion);
        }
        return {x, L::add(x, L::add(kept, acceleration_)), L::add(motion, motion_bias_),
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

    void store(std::size_t i, const Prediction& prediction) const {
        L::store(task_.start + i, prediction.start);
        L::store(task_.x + i, prediction.x);
    }

    PredictionTask task_; // a copy, so that what is stored can't be thought to change it
    R acceleration_;
    R kept_;
    R motion_bias_;
    R motion_beyond_;
};

// `Narrow`: the lanes for what does not fill a group.
template <typename L, typename Narrow, bool damped>
inline PredictionClamps predict_in_groups(const PredictionTask& task) {
    PredictionClamps clamps;
    std::size_t i = 0;
    if constexpr (!std::is_same_v<L, Narrow>) {
        if (task.count >= 8 * L::half) {
            i = PredictionLanes<L, damped>(task).run(0, clamps);
        }
    }
    if (i != task.count) {
        const PredictionLanes<Narrow, damped> narrow(task);
        narrow.finish(narrow.run(i, clamps), clamps);
    }
    return clamps;
}

template <typename L, typename Narrow = L>
inline PredictionClamps predict_lanes(const PredictionTask& task) {
    return task.kept == unit_one ? predict_in_groups<L, Narrow, false>(task)
                                 : predict_in_groups<L, Narrow, true>(task);
}

} // namespace
} // namespace lks
