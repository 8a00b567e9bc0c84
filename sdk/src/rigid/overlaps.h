// Which boxes overlap, of any number and of any sizes, in about linear time.
//
// A hashed grid for each power of two of sizes: a box stands in the cell of its lowest corner, in the grid
// whose cells are just larger than it. Whatever it overlaps at its own level begins at most one cell before
// it, and so does, at a coarser level, whatever is larger. A pair is found once: by the smaller one, or by
// the one in the earlier cell.
#pragma once

#include <algorithm>
#include <cstdint>

#include "collide/saturation.h"
#include "fixed/vector.h"
#include "memory/array.h"

namespace lks {

// World; the ends belong to it.
struct Box {
    fixed::Vec3 low;
    fixed::Vec3 high;

    bool overlaps(const Box& other) const {
        // All of it, without branches: which of them fails can't be foretold.
        return ((low.x <= other.high.x) & (other.low.x <= high.x) & (low.y <= other.high.y) &
                (other.low.y <= high.y) & (low.z <= other.high.z) & (other.low.z <= high.z)) != 0;
    }
};

inline constexpr Box empty_box{{INT64_MAX, INT64_MAX, INT64_MAX}, {INT64_MIN, INT64_MIN, INT64_MIN}};

// And what is within `reach` of a point along each axis.
inline void include(Box& box, const fixed::Vec3& p, const fixed::Vec3& reach) {
    const fixed::Vec3 low = saturating_subtract(p, reach);
    const fixed::Vec3 high = saturating_add(p, reach);
    box.low = {std::min(box.low.x, low.x), std::min(box.low.y, low.y), std::min(box.low.z, low.z)};
    box.high = {std::max(box.high.x, high.x), std::max(box.high.y, high.y), std::max(box.high.z, high.z)};
}

class Overlaps {
public:
    explicit Overlaps(const lks_allocator& allocator);

    // Room for so many boxes. False: no memory.
    [[nodiscard]] bool reserve(std::uint32_t count);

    void clear() { boxes_.clear(); }
    void add(const Box& box) { boxes_.push_reserved(box); }
    // Calls use(i, j) for each overlapping pair, i < j, in an order that depends on the boxes only.
    template <typename Use>
    void for_each_pair(const Use& use) {
        sort_into_cells();
        for_each_search([&](std::uint32_t i, std::uint32_t level, const Row& row) {
            for_each_part(row, level, [&](std::uint32_t first, std::uint32_t end) {
                search(i, level, row, first, end, use);
            });
        });
    }

    // How often the last for_each_pair has looked at a box in a cell: its work, whatever the machine.
    std::uint64_t looks() const {
        std::uint64_t sum = 0;
        for_each_search([&](std::uint32_t, std::uint32_t level, const Row& row) {
            for_each_part(row, level, [&sum](std::uint32_t first, std::uint32_t end) { sum += end - first; });
        });
        return sum;
    }

private:
    // 2^-10 m: everything smaller is at the first level. 2^20 m: no cell is larger.
    static constexpr int least_size_bits = 30;
    static constexpr std::uint32_t greatest_level = 30;

    struct Cell {
        std::int64_t x, y, z;
        friend constexpr bool operator==(const Cell&, const Cell&) = default;
    };

    static Cell cell_of(const fixed::Vec3& point, std::uint32_t level) {
        const int shift = least_size_bits + static_cast<int>(level);
        return {point.x >> shift, point.y >> shift, point.z >> shift};
    }
    // A box where its bucket is looked through: one behind the other in memory.
    struct Entry {
        Box box;
        std::uint32_t index;
        std::uint32_t level;
    };

    // Cells that follow each other along z stand in buckets that do.
    std::uint32_t bucket_of(const Cell& cell, std::uint32_t level) const {
        std::uint64_t hash = static_cast<std::uint64_t>(cell.x) * 0x9e3779b97f4a7c15u;
        hash = (hash ^ static_cast<std::uint64_t>(cell.y)) * 0xc2b2ae3d27d4eb4fu;
        hash += level * std::uint64_t{0x27d4eb2f165667c5u};
        return (static_cast<std::uint32_t>(hash >> 32) + static_cast<std::uint32_t>(cell.z)) & bucket_mask_;
    }
    void sort_into_cells();

    // Cells along z, which are searched at once.
    struct Row {
        Cell first;
        std::int64_t last_z;
        bool own; // `first` is the cell in which the box begins: only what follows it is found there
    };

    // At its own level a pair is found by the one in the earlier cell, or else by the lower index.
    // visit(row)
    template <typename Visit>
    void for_each_row(std::uint32_t i, std::uint32_t level, const Visit& visit) const {
        const Box& box = boxes_[i];
        const Cell first = cell_of(box.low, level);
        const Cell last = cell_of(box.high, level);
        const bool own = level == levels_[i];
        for (std::int64_t x = own ? first.x : first.x - 1; x <= last.x; ++x) {
            const bool own_x = own && x == first.x;
            for (std::int64_t y = own_x ? first.y : first.y - 1; y <= last.y; ++y) {
                const bool own_y = own_x && y == first.y;
                visit(Row{{x, y, own_y ? first.z : first.z - 1}, last.z, own_y});
            }
        }
    }

    // visit(i, level, row)
    template <typename Visit>
    void for_each_search(const Visit& visit) const {
        for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
            for (std::uint32_t level = levels_[i]; level <= greatest_level; ++level) {
                if ((present_ >> level & 1) != 0) {
                    for_each_row(i, level, [&](const Row& row) { visit(i, level, row); });
                }
            }
        }
    }

    // use(first, end): a row's buckets in sorted_. They may go on at the first one.
    template <typename Use>
    void for_each_part(const Row& row, std::uint32_t level, const Use& use) const {
        const std::uint32_t first = bucket_of(row.first, level);
        const std::uint32_t end = first + static_cast<std::uint32_t>(row.last_z - row.first.z) + 1;
        const std::uint32_t buckets = bucket_mask_ + 1;
        use(starts_[first], starts_[std::min(end, buckets)]);
        if (end > buckets) [[unlikely]] {
            use(0, starts_[std::min(end - buckets, first)]);
        }
    }

    template <typename Use>
    void search(std::uint32_t i, std::uint32_t level, const Row& row, std::uint32_t first, std::uint32_t end,
                const Use& use) const {
        const Box box = boxes_[i];
        for (std::uint32_t place = first; place < end; ++place) {
            const Entry& entry = sorted_[place];
            if (entry.level != level || !box.overlaps(entry.box)) {
                continue;
            }
            const std::uint32_t j = entry.index;
            const Cell cell = cell_of(entry.box.low, level);
            if (cell.x != row.first.x || cell.y != row.first.y || cell.z < row.first.z ||
                cell.z > row.last_z || (row.own && cell.z == row.first.z && j <= i)) {
                continue;
            }
            use(i < j ? i : j, i < j ? j : i);
        }
    }

    Array<Box> boxes_;
    Array<std::uint8_t> levels_;
    Array<std::uint32_t> buckets_; // by box
    Array<std::uint32_t> starts_;  // by bucket, into sorted_
    Array<Entry> sorted_;
    std::uint32_t bucket_mask_ = 0;
    std::uint64_t present_ = 0; // levels
};

} // namespace lks
