#include "solver/chain_across.h"

#include <bit>

#include "fixed/int128.h"
#include "fixed/vector.h"
#include "kernels/bounded.h"
#include "solver/chain_passes.h"

namespace lks {
namespace {

using fixed::multiply_shift;
using fixed::Vec3;

constexpr std::uint64_t spread_one = std::uint64_t{1} << 63;

// What a movement is with a share of another.
Vec3 mean_with(std::int64_t share, const Vec3& other, const Vec3& own) {
    return {own.x + carry(share, other.x - own.x), own.y + carry(share, other.y - own.y),
            own.z + carry(share, other.z - own.z)};
}

class AcrossPass {
public:
    AcrossPass(const ChainCoefficients& chain, const Kernels& kernels, const ChainWork& work, int units)
        : chain_(chain), kernels_(kernels), work_(work), units_(units), count_(chain.count()) {}

    bool run() const {
        gather();
        spread();
        const bool off = cross();
        if (units_ != 0) {
            leave_units();
        }
        return off;
    }

private:
    // What the pass leaves of movements, in coordinate units, and by the limit at most.
    void leave_units() const {
        const std::int64_t limit = substep_motion_limit >> units_;
        for (std::int64_t* const movements : work_.movements) {
            for (std::uint32_t i = 0; i <= count_; ++i) {
                movements[i] = bounded(movements[i], limit) * (std::int64_t{1} << units_);
            }
        }
    }

    // The mean of what a particle and all behind it would do, from the far end to the near one.
    void gather() const {
        std::uint64_t scale = spread_one;
        std::uint64_t part = spread_one;
        for (int axis = 0; axis < 3; ++axis) {
            work_.gathered[axis][count_] = work_.movements[axis][count_];
        }
        each_block_back(count_, [&](std::uint32_t first, std::uint32_t count) {
            ChainShares shares;
            std::int64_t takes[chain_block];
            shares.count = count;
            shares.takes = takes;
            shares.gives = work_.gives + first;
            scale_spread(shares, first, scale, part);
            kernels_.chain.share(shares);
            gather_block(takes, first, count);
        });
    }

    // The system for the movements, eliminated as that for the multipliers.
    void scale_spread(ChainShares& shares, std::uint32_t first, std::uint64_t& scale,
                      std::uint64_t& part) const {
        const int one_down = 64 - chain_.stiffness_bits;
        const std::int64_t* const near = work_.near + first;
        const std::int64_t* const far = work_.far + first;
        std::uint64_t q = scale;
        std::uint64_t p = part;
        for (std::uint32_t i = shares.count; i-- > 0;) {
            if (far[i] == 0) {
                q = spread_one; // nothing is carried across a pin, not even the scale
                p = spread_one;
            }
            const std::uint64_t taken = upper_half(static_cast<std::uint64_t>(far[i]), p);
            p = (q >> one_down) + taken;
            q = p + upper_half(static_cast<std::uint64_t>(near[i]), q);
            const int up = std::countl_zero(q);
            q <<= up;
            p <<= up;
            shares.scales[i] = static_cast<std::int64_t>(q);
            shares.parts[i] = static_cast<std::int64_t>(p);
            shares.fars[i] = static_cast<std::int64_t>(taken << up);
        }
        scale = q;
        part = p;
    }

    void gather_block(const std::int64_t* takes, std::uint32_t first, std::uint32_t count) const {
        const std::int64_t* const x = work_.movements[0] + first;
        const std::int64_t* const y = work_.movements[1] + first;
        const std::int64_t* const z = work_.movements[2] + first;
        std::int64_t* const to_x = work_.gathered[0] + first;
        std::int64_t* const to_y = work_.gathered[1] + first;
        std::int64_t* const to_z = work_.gathered[2] + first;
        Vec3 behind{to_x[count], to_y[count], to_z[count]};
        for (std::uint32_t i = count; i-- > 0;) {
            behind = mean_with(takes[i], behind, {x[i], y[i], z[i]});
            to_x[i] = behind.x;
            to_y[i] = behind.y;
            to_z[i] = behind.z;
        }
    }

    // What each does with all that is before it.
    void spread() const {
        const std::int64_t* const gives = work_.gives;
        std::int64_t* const x = work_.gathered[0];
        std::int64_t* const y = work_.gathered[1];
        std::int64_t* const z = work_.gathered[2];
        const std::uint32_t count = count_;
        Vec3 near{x[0], y[0], z[0]};
        for (std::uint32_t i = 1; i <= count; ++i) {
            near = mean_with(gives[i - 1], near, {x[i], y[i], z[i]});
            x[i] = near.x;
            y[i] = near.y;
            z[i] = near.z;
        }
    }

    // Of the change, what is across the rope. Without pins the mean of the changes is taken off again.
    bool cross() const {
        ChainAcross task;
        task.count = count_ + 1;
        task.rest_lengths = units_ == 0 ? chain_.rest_lengths.data() : rest_lengths_in_units();
        for (int axis = 0; axis < 3; ++axis) {
            std::int64_t* const directions = work_.directions[axis];
            *(directions - 1) = directions[0]; // ends have that of their one segment
            directions[count_] = directions[count_ - 1];
            task.directions[axis] = directions;
            task.movements[axis] = work_.movements[axis];
            task.changes[axis] = work_.gathered[axis];
        }
        const bool off = kernels_.chain.cross(task);
        for (std::int64_t* const directions : work_.directions) {
            directions[count_] = 0;
        }
        if (chain_.pinned_count == 0) {
            for (int axis = 0; axis < 3; ++axis) {
                take_mean_off(work_.movements[axis], work_.gathered[axis]);
            }
        }
        return off;
    }

    // Where the multipliers' factors were, which nothing reads any more.
    const std::int64_t* rest_lengths_in_units() const {
        std::int64_t* const lengths = work_.carried;
        for (std::uint32_t i = 0; i < count_ + chain_padding; ++i) {
            lengths[i] = chain_.rest_lengths[i] >> units_;
        }
        return lengths;
    }

    void take_mean_off(std::int64_t* movements, const std::int64_t* changes) const {
        std::int64_t mean = 0;
        for (std::uint32_t i = 0; i <= count_; ++i) {
            mean += multiply_shift(chain_.mass_shares[i], changes[i], 63);
        }
        for (std::uint32_t i = 0; i <= count_; ++i) {
            movements[i] -= mean;
        }
    }

    const ChainCoefficients& chain_;
    const Kernels& kernels_;
    const ChainWork& work_;
    int units_; // of movements: 2^units_ coordinate units
    std::uint32_t count_;
};

} // namespace

bool move_across(const ChainCoefficients& chain, const Kernels& kernels, const ChainWork& work, int units) {
    return AcrossPass(chain, kernels, work, units).run();
}

} // namespace lks
