// The checksum of an image (kernels/lane_sums.h): against what happens to bytes on a disk or in a network, at
// the speed of memory. It keeps nobody out: values are checked behind it.
#pragma once

#include "kernels/kernels.h"
#include "state/hash.h"

namespace lks {

// Bytes in one piece of memory, aligned to 8 bytes, are handed over in any number of parts.
class Checksum {
public:
    explicit Checksum(const Kernels& kernels) : sum_stripes_(kernels.sum_stripes) {}

    // Takes what whole stripes there are, and returns how many bytes: the next part begins behind them.
    std::size_t add(const unsigned char* bytes, std::size_t size) {
        const std::size_t stripes = size / stripe_size;
        sum_stripes_(sums_, bytes, stripes);
        size_ += stripes * stripe_size;
        return stripes * stripe_size;
    }

    // Of all that was added and the last part, behind which zeros are summed up to a stripe's end.
    std::uint64_t finish(const unsigned char* bytes, std::size_t size) {
        const std::size_t added = add(bytes, size);
        const std::size_t left = size - added;
        alignas(std::uint64_t) unsigned char last[stripe_size]{};
        if (left != 0) {
            std::memcpy(last, bytes + added, left);
            sum_stripes_(sums_, last, 1);
        }
        Hash hash;
        for (std::uint32_t lane = 0; lane < sum_lanes; ++lane) {
            hash.add_u64(sums_.sums[lane]);
            hash.add_u64(sums_.sums_of_sums[lane]);
        }
        hash.add_u64(size_ + left);
        return hash.finish();
    }

private:
    LaneSums sums_{};
    std::uint64_t size_ = 0;
    void (*sum_stripes_)(LaneSums& sums, const unsigned char* bytes, std::size_t stripes);
};

} // namespace lks
