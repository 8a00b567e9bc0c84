#include "rigid/overlaps.h"

#include <algorithm>

namespace lks {

Overlaps::Overlaps(const lks_allocator& allocator)
    : boxes_(allocator), levels_(allocator), buckets_(allocator), starts_(allocator), sorted_(allocator) {}

bool Overlaps::reserve(std::uint32_t count) {
    std::size_t buckets = 16;
    while (buckets < 4 * std::size_t{count}) {
        buckets *= 2;
    }
    return boxes_.reserve(count) && levels_.reserve(count) && buckets_.reserve(count) &&
           sorted_.reserve(count) && starts_.reserve(buckets + 1);
}

void Overlaps::sort_into_cells() {
    const auto count = static_cast<std::uint32_t>(boxes_.size());
    std::uint32_t bucket_count = 16;
    while (bucket_count < 4 * count) {
        bucket_count *= 2;
    }
    bucket_mask_ = bucket_count - 1;
    present_ = 0;
    // Within what reserve() made room for.
    static_cast<void>(levels_.resize(count) && buckets_.resize(count) && sorted_.resize(count) &&
                      starts_.resize(bucket_count + 1));
    std::fill(starts_.begin(), starts_.end(), 0u);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Box& box = boxes_[i];
        const std::int64_t size =
            std::max({box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z});
        std::uint32_t level = 0;
        while (level < greatest_level && size >> (least_size_bits + level) != 0) {
            ++level;
        }
        levels_[i] = static_cast<std::uint8_t>(level);
        present_ |= std::uint64_t{1} << level;
        buckets_[i] = bucket_of(cell_of(box.low, level), level);
        ++starts_[buckets_[i] + 1];
    }
    for (std::uint32_t b = 0; b < bucket_count; ++b) {
        starts_[b + 1] += starts_[b];
    }
    // From the last to the first, so that a bucket holds its boxes in ascending order; each start ends up
    // where its bucket begins.
    for (std::uint32_t i = count; i-- > 0;) {
        sorted_[--starts_[buckets_[i] + 1]] = {boxes_[i], i, levels_[i]};
    }
    for (std::uint32_t b = 0; b < bucket_count; ++b) {
        starts_[b] = starts_[b + 1];
    }
    starts_[bucket_count] = count;
}

} // namespace lks
