// A rope's segments solved at once, as docs/ropes.md says it, in floating point: a tridiagonal system (XPBD
// eq. 16 and 26) and the implicit pass for what moves across the rope. Both by plain elimination, other than
// in the SDK: where nothing may cancel there, here a double has the bits to lose.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace reference {

// The pieces between pins need no care: a pinned particle has no inverse mass.
template <typename Scalar, typename Vec>
class ChainSystem {
public:
    struct Segment {
        Scalar rest, softness, change, multiplier; // softness is α̃/(1+γ); change is the right side; λ so far
    };

    // Inverse masses and positions along the rope.
    ChainSystem(std::vector<Scalar> inverse_masses, std::vector<Vec> positions)
        : w_(std::move(inverse_masses)), x_(std::move(positions)), segments_(x_.size() - 1),
          directions_(x_.size() - 1), lengths_(x_.size() - 1) {
        for (std::size_t j = 0; j + 1 < x_.size(); ++j) {
            const Vec d = x_[j + 1] - x_[j];
            const Scalar length = d.length();
            lengths_[j] = length;
            directions_[j] = length > 0 ? d * (1 / length) : Vec();
        }
    }

    Segment& segment(std::size_t j) { return segments_[j]; }
    const Vec& direction(std::size_t j) const { return directions_[j]; }

    // The changes of λ.
    std::vector<Scalar> solve() {
        const std::size_t n = segments_.size();
        std::vector<Scalar> diagonal(n), right(n), change(n);
        for (std::size_t j = n; j-- > 0;) {
            diagonal[j] = w_[j] + w_[j + 1] + segments_[j].softness;
            right[j] = segments_[j].change;
            if (j + 1 < n && diagonal[j + 1] > 0) {
                const Scalar off = w_[j + 1] * directions_[j].dot(directions_[j + 1]);
                diagonal[j] -= off * off / diagonal[j + 1];
                right[j] += off * right[j + 1] / diagonal[j + 1];
            }
        }
        for (std::size_t j = 0; j < n; ++j) {
            const Scalar before = j == 0 ? 0 : w_[j] * directions_[j].dot(directions_[j - 1]) * change[j - 1];
            change[j] = diagonal[j] > 0 ? (right[j] + before) / diagonal[j] : 0;
            segments_[j].multiplier += change[j];
        }
        return change;
    }

    // Whether the last movements left a segment off its length: it is to be solved again.
    bool is_off() const { return off_; }

    // How the particles move by these changes.
    std::vector<Vec> movements(const std::vector<Scalar>& change) {
        off_ = false;
        std::vector<Vec> moved(x_.size());
        for (std::size_t j = 0; j < change.size(); ++j) {
            moved[j] = moved[j] - directions_[j] * (w_[j] * change[j]);
            moved[j + 1] = moved[j + 1] + directions_[j] * (w_[j + 1] * change[j]);
        }
        const std::vector<Scalar> stiffness = excess_stiffness();
        if (std::all_of(stiffness.begin(), stiffness.end(), [](Scalar k) { return k == 0; })) {
            return moved;
        }
        const std::vector<Vec> spread = spread_implicitly(moved, stiffness);
        std::vector<Vec> across(x_.size());
        Vec momentum;
        Scalar mass = 0;
        for (std::size_t i = 0; i < x_.size(); ++i) {
            across[i] = across_rope(i, spread[i] - moved[i]);
            if (w_[i] > 0) {
                momentum = momentum + across[i] * (1 / w_[i]);
                mass += 1 / w_[i];
            }
        }
        const bool is_free = std::all_of(w_.begin(), w_.end(), [](Scalar w) { return w > 0; });
        for (std::size_t i = 0; i < x_.size(); ++i) {
            moved[i] = moved[i] + across[i] - (is_free ? momentum * (1 / mass) : Vec());
        }
        for (std::size_t j = 0; j < segments_.size(); ++j) {
            const Vec apart = moved[j + 1] - moved[j];
            const Scalar greatest = std::max({std::abs(apart.x), std::abs(apart.y), std::abs(apart.z)});
            const Scalar along = std::abs(directions_[j].dot(across[j + 1] - across[j]));
            off_ = off_ || greatest > segments_[j].rest / 32 || along > segments_[j].rest / 2048;
        }
        return moved;
    }

private:
    // |λ|/L beyond what κ = 1/4 is at the lighter end. Soft segments turn as long as they are.
    std::vector<Scalar> excess_stiffness() const {
        std::vector<Scalar> result(segments_.size());
        for (std::size_t j = 0; j < segments_.size(); ++j) {
            const Scalar lighter = std::max(w_[j], w_[j + 1]);
            if (lighter > 0) {
                const Segment& s = segments_[j];
                const Scalar length = s.softness > 0 ? std::max(s.rest, lengths_[j]) : s.rest;
                result[j] = std::max(std::abs(s.multiplier) / length - 1 / (4 * lighter), Scalar(0));
            }
        }
        return result;
    }

    std::vector<Vec> spread_implicitly(const std::vector<Vec>& moved,
                                       const std::vector<Scalar>& stiffness) const {
        const std::size_t n = x_.size();
        std::vector<Scalar> diagonal(n);
        std::vector<Vec> right = moved;
        for (std::size_t i = n; i-- > 0;) {
            const Scalar left_k = i == 0 ? 0 : stiffness[i - 1];
            const Scalar right_k = i + 1 == n ? 0 : stiffness[i];
            diagonal[i] = 1 + w_[i] * (left_k + right_k);
            if (i + 1 < n) {
                const Scalar factor = w_[i] * right_k / diagonal[i + 1];
                diagonal[i] -= factor * w_[i + 1] * right_k;
                right[i] = right[i] + right[i + 1] * factor;
            }
        }
        for (std::size_t i = 0; i < n; ++i) {
            const Vec before = i == 0 ? Vec() : right[i - 1] * (w_[i] * stiffness[i - 1]);
            right[i] = (right[i] + before) * (1 / diagonal[i]);
        }
        return right;
    }

    Vec across_rope(std::size_t i, const Vec& v) const {
        const Vec a = i == 0 ? Vec() : directions_[i - 1] * Scalar(0.5);
        const Vec b = i == segments_.size() ? Vec() : directions_[i] * Scalar(0.5);
        const Vec t = a + b;
        const Scalar squared = t.dot(t);
        return squared < Scalar(1) / 1024 ? v : v - t * (t.dot(v) / squared);
    }

    std::vector<Scalar> w_;
    std::vector<Vec> x_;
    std::vector<Segment> segments_;
    std::vector<Vec> directions_;
    std::vector<Scalar> lengths_;
    bool off_ = false;
};

} // namespace reference
