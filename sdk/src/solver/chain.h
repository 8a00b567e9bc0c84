// All segments of a rope at once: XPBD eq. 16 with the damping of eq. 26 is tridiagonal for a chain, and is
// solved exactly, instead of one segment after the other.
//
// With inverse masses w, softness σ = α̃/(1+γ) and unit vectors n along the segments, the row of segment j is
//
//     (w_j + w_j+1 + σ)·λ_j − w_j·(n_j-1·n_j)·λ_j-1 − w_j+1·(n_j·n_j+1)·λ_j+1
//         = −c·C_j − σ·λ_j (so far) − γ'·n·(motion)
//
// It is eliminated from the far end. What hangs behind segment j then counts as one inverse mass t_j, and
// with d_j = w_j + t_j + σ, x_j = w_j/d_j, and s the sine between neighbours,
//
//     t_j-1 = x_j·(t_j + σ + w_j·s²)      a sum of what is positive: nothing cancels, for any mass ratio
//     λ_j   = (b_j + ...)/d_j + x_j·(n_j-1·n_j)·λ_j-1
//
// t is kept as a quotient w·p/q, so that no row waits for a division: with w_near of the particle at the near
// end and u = w·p of the one at the far end,
//
//     q' = (w_near + σ)·q + u        p' = (σ + w_near·s²)·q + u        d = q'/q, x = w_near/d
//
// p and q are shifted up together. The divisions follow, block by block, over lanes (kernels/chain_task.h).
//
// A pinned particle has w = 0, and cuts the chain in two by itself; so does a segment of length zero, which
// has no direction.
//
// Eq. 15 drops how a tension turns with its segment (the geometric stiffness). Beyond (hω)² = 1, ω² being
// four times the tension over mass and length, a chain that is solved exactly therefore swings itself to
// pieces. What κ = w·|λ|/L exceeds 1/4 by is taken implicitly: the movements Δ° = w·p of the solve become
//
//     (1 + κ_l + κ_r)·Δ_i − κ_l·Δ_i-1 − κ_r·Δ_i+1 = Δ°_i
//
// of which the part across the rope is kept: along it the solve is right already. The system is eliminated in
// means with weights in [0, 1], of movement with movement. Below 1/4 there is nothing to do, and it costs
// nothing. Of a soft rope L is how long the segment is, if that is more than at rest. In a rope without pins
// the mean of what it changed is taken off again: momentum is kept.
//
// The part across the rope is not quite across each of its segments, and long movements turn them: what that
// leaves of errors would be speed in the next substep, which heavy particles give to light ones between them
// until they are torn apart. Where it is more than 1/2048 of a segment the rope is solved again, at most
// 32 times in all, with the tensions of all solves: a segment that its pin holds back from what all others
// fall in a long substep stands askew to them, and the first solves find it easier to push a light particle
// aside than to hold the heavy one, each by a twentieth as much as the one before.
//
// Both hold while segments turn by little. A rope that was blown apart, its segments at all angles and far
// too long, a solve would blow further, for ever; sweeps are slow but bring it together from anywhere. So a
// torn rope is swept first, and then solved for changes that are short against its segments; both again
// until it is whole, or for so many times. One that contacts tear again is left swept
// (solver/object_tick.cpp).
//
// A soft rope that hangs from its load may be longer than that, and is not torn: one is only if the solve
// would move the ends of a segment that is too long by more than a sixteenth of its length against each
// other.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fixed/vector.h"
#include "kernels/kernels.h"
#include "solver/coefficients.h"

namespace lks {

// What one solve remembers of segments and of the particles at their near ends: an array each, all in one
// piece of memory. No state.
class ChainWork {
public:
    // Of a rope of so many segments.
    static constexpr std::size_t words(std::size_t segments) { return array_count * (length(segments) + 1); }

    ChainWork(std::int64_t* memory, std::size_t segments) : length_(length(segments)) {
        const auto array = [&] {
            std::int64_t* const first = memory;
            memory += length_;
            return first;
        };
        for (int axis = 0; axis < 3; ++axis) {
            *memory++ = 0;
            directions[axis] = array();
            movements[axis] = array();
            gathered[axis] = array();
        }
        carried = array();
        multipliers = array();
        tensions = array();
        near = array();
        far = array();
        gives = array();
        lengths = array();
    }

    // Zero behind so many, as far as kernels read.
    void end(std::size_t segments) const {
        for (std::size_t i = segments; i < length_; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                directions[axis][i] = 0;
                movements[axis][i] = 0;
                gathered[axis][i] = 0;
            }
            multipliers[i] = 0;
            tensions[i] = 0;
            near[i] = 0;
            far[i] = 0;
        }
    }

    std::int64_t* directions[3]; // zero: none; with room before the first
    std::int64_t* movements[3];  // Coordinate
    std::int64_t* gathered[3];
    std::int64_t* carried;     // this times the multiplier before, carried_bits ...
    std::int64_t* multipliers; // ... and this make the multiplier, which then replaces it
    std::int64_t* tensions;    // the multipliers of this substep so far
    std::int64_t* near;        // κ beyond what is stable by itself, of the ends
    std::int64_t* far;
    std::int64_t* gives;   // what the far end takes of the near one's movement, carried_bits
    std::int64_t* lengths; // Coordinate, of soft ropes only

private:
    static constexpr std::size_t array_count = 16;
    static constexpr std::size_t length(std::size_t segments) { return segments + 1 + chain_padding; }

    std::size_t length_;
};

// One iteration. `memory` has room for the work. False where a segment is torn, or the solve tore it: longer
// than twice its rest length, or where it is soft more, and about to move too far.
[[nodiscard]] bool solve_chain(const ChainCoefficients& chain, const FamilyCoefficients& family,
                               const DistanceArrays& arrays, const Kernels& kernels, std::int64_t* memory);

// Whether a segment is torn.
[[nodiscard]] bool is_torn(const ChainCoefficients& chain, const DistanceArrays& arrays);

// The same for a torn rope, whose segments have been swept: changes each by half its length at most.
void mend_chain(const ChainCoefficients& chain, const FamilyCoefficients& family,
                const DistanceArrays& arrays, const Kernels& kernels, std::int64_t* memory);

} // namespace lks
