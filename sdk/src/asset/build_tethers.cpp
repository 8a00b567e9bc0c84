// The nearest anchors of every vertex, by Dijkstra's algorithm from all anchors at once.
#include <algorithm>

#include "asset/create.h"

namespace lks {
namespace {

using fixed::Scaled;

// As the longest constraint: beyond it a tether is left out.
constexpr std::uint64_t greatest_length = static_cast<std::uint64_t>(coordinate_one) * 100;

// A way that was found from an anchor to a particle.
struct Way {
    std::uint64_t length; // Coordinate
    std::uint32_t anchor;
    std::uint32_t particle;
};

// For heaps, which have the greatest on top. Of two of the same length that from the lower anchor counts as
// shorter, so that the order is total.
bool is_longer(const Way& l, const Way& r) {
    return l.length != r.length   ? l.length > r.length
           : l.anchor != r.anchor ? l.anchor > r.anchor
                                  : l.particle > r.particle;
}

class NearestAnchors {
public:
    NearestAnchors(const lks_asset& asset, std::uint32_t wanted)
        : asset_(asset), wanted_(wanted), heap_(asset.allocator), best_(asset.allocator) {
        Scaled mass{};
        for (const Scaled& m : asset.masses) {
            mass = mass + m;
        }
        const Scaled weight = mass * Scaled::ratio(981, 100);
        for (std::uint32_t f = 0; f < family_count; ++f) {
            stretch_[f] = std::min((asset.families[f].compliance * weight).to_fixed(coordinate_fraction_bits),
                                   greatest_length);
        }
    }

    bool find() {
        if (!best_.resize(std::size_t{asset_.vertex_count()} * wanted_)) {
            return false;
        }
        std::fill(best_.begin(), best_.end(), Way{greatest_length, none, 0});
        for (std::uint32_t anchor = 0; anchor < asset_.tethers.anchors.size(); ++anchor) {
            if (!consider({0, anchor, asset_.tethers.anchors[anchor]})) {
                return false;
            }
        }
        while (!heap_.empty()) {
            const Way way = heap_[0];
            std::pop_heap(heap_.begin(), heap_.end(), is_longer);
            heap_.erase(heap_.size() - 1);
            if (!go_on(way)) {
                return false;
            }
        }
        return true;
    }

    // Of one particle, the nearest first; those behind the last one have no anchor.
    const Way* of(std::uint32_t particle) const { return best_.data() + std::size_t{particle} * wanted_; }

    static constexpr std::uint32_t none = UINT32_MAX;

private:
    bool go_on(const Way& way) {
        const Way* found = of(way.particle);
        const bool overtaken = std::none_of(found, found + wanted_, [&](const Way& other) {
            return other.anchor == way.anchor && other.length == way.length;
        });
        if (overtaken) {
            return true;
        }
        for (std::uint32_t i = asset_.incident_offsets[way.particle];
             i < asset_.incident_offsets[way.particle + 1]; ++i) {
            const std::uint32_t constraint = asset_.incident_constraints[i];
            const Constraint& ends = asset_.constraints[constraint];
            const std::uint32_t other = ends.a == way.particle ? ends.b : ends.a;
            // At most three times the greatest length: no overflow.
            const std::uint64_t length = way.length +
                                         static_cast<std::uint64_t>(asset_.rest_lengths[constraint]) +
                                         stretch_[family_of(constraint)];
            if (!consider({length, way.anchor, other})) {
                return false;
            }
        }
        return true;
    }

    // Keeps a way that is among the shortest to its particle, one an anchor. What is not among them there is
    // not either on any way further on.
    bool consider(const Way& way) {
        Way* found = best_.data() + std::size_t{way.particle} * wanted_;
        Way* end = found + wanted_;
        Way* last = std::find_if(found, end, [&](const Way& w) { return w.anchor == way.anchor; });
        last = last == end ? end - 1 : last;
        if (way.length >= greatest_length || !is_longer(*last, way)) {
            return true;
        }
        for (; last != found && is_longer(last[-1], way); --last) {
            *last = last[-1];
        }
        *last = way;
        if (!heap_.push(way)) {
            return false;
        }
        std::push_heap(heap_.begin(), heap_.end(), is_longer);
        return true;
    }

    std::uint32_t family_of(std::uint32_t constraint) const {
        const Batch* batch = std::upper_bound(asset_.batches.begin(), asset_.batches.end(), constraint,
                                              [](std::uint32_t i, const Batch& b) { return i < b.first; });
        return (batch - 1)->family;
    }

    const lks_asset& asset_;
    std::uint32_t wanted_;
    std::uint64_t stretch_[family_count]; // what the weight of the whole adds to each constraint
    Array<Way> heap_;
    Array<Way> best_;
};

lks_result read_anchors(const Build& build, const lks_cloth_def& def) {
    lks_asset& asset = build.asset;
    if (def.tethers_per_vertex < 1 || def.tethers_per_vertex > LKS_MAX_TETHERS_PER_VERTEX) {
        return build.fail(LKS_ERROR_INVALID_ARGUMENT,
                          Sentence() << "The cloth's tethers_per_vertex is " << def.tethers_per_vertex
                                     << "; it must be from 1 to " << LKS_MAX_TETHERS_PER_VERTEX << ".");
    }
    if (def.tether_anchor_count > LKS_MAX_TETHER_ANCHORS) {
        return build.fail(LKS_ERROR_LIMIT, Sentence() << "The cloth has " << def.tether_anchor_count
                                                      << " tether anchors, more than "
                                                      << LKS_MAX_TETHER_ANCHORS << ".");
    }
    if (def.tether_anchor_count > 0 && def.tether_anchors == nullptr) {
        return build.fail(LKS_ERROR_NULL_ARGUMENT, Sentence() << "The cloth's tether_anchors are null.");
    }
    Array<std::uint32_t>& anchors = asset.tethers.anchors;
    if (!anchors.reserve(def.tether_anchor_count)) {
        return build.fail_out_of_memory();
    }
    for (std::uint32_t i = 0; i < def.tether_anchor_count; ++i) {
        const std::uint32_t vertex = def.tether_anchors[i];
        if (vertex >= asset.vertex_count()) {
            return build.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "Tether anchor " << i << " is vertex "
                                                                     << vertex << "; the cloth has "
                                                                     << asset.vertex_count() << " vertices.");
        }
        anchors.push_reserved(vertex);
    }
    // In ascending order of vertices, so that the order in which they are given does not matter.
    std::sort(anchors.begin(), anchors.end());
    const std::uint32_t* twice = std::adjacent_find(anchors.begin(), anchors.end());
    if (twice != anchors.end()) {
        return build.fail(LKS_ERROR_INVALID_ARGUMENT,
                          Sentence() << "Vertex " << *twice << " is a tether anchor twice.");
    }
    for (std::uint32_t& anchor : anchors) {
        anchor = asset.vertex_to_particle[anchor];
    }
    return LKS_OK;
}

// Rounded up, to three units at least, and by what a projection's reciprocal is off (2^-29): a cloth at rest
// is left alone to the bit.
std::uint32_t rounded_up(std::uint64_t length) {
    const auto units =
        static_cast<std::uint32_t>(length >> (coordinate_fraction_bits - tether_fraction_bits)) + 1;
    return units + (units >> 28) + 2;
}

// From the ways of all particles to what is kept of them.
class Placing {
public:
    Placing(lks_asset& asset, std::uint32_t rows)
        : tethers_(asset.tethers), count_(asset.vertex_count()), rows_(rows), anchor_of_(asset.allocator),
          pair_lengths_(asset.allocator) {}

    // False: no memory.
    bool run(const NearestAnchors& nearest) {
        const std::size_t total = std::size_t{count_} * rows_;
        if (!tethers_.lengths.resize(total) || !anchor_of_.resize(total)) {
            return false;
        }
        for (std::uint32_t p = 0; p < count_; ++p) {
            place(p, nearest.of(p));
        }
        return list_parts() && list_pairs();
    }

private:
    // The ways of one particle by ascending anchor: then neighbours mostly have the same one in the same row.
    void place(std::uint32_t particle, const Way* ways) {
        std::uint32_t next = 0; // anchor
        for (std::uint32_t row = 0; row < rows_; ++row) {
            const Way* lowest = nullptr;
            for (const Way* way = ways; way != ways + rows_; ++way) {
                const bool waits = way->anchor != NearestAnchors::none && way->anchor >= next;
                // Length zero: to itself.
                if (waits && way->length > 0 && (lowest == nullptr || way->anchor < lowest->anchor)) {
                    lowest = way;
                }
            }
            const std::size_t i = index(row, particle);
            tethers_.lengths[i] = lowest == nullptr ? no_tether : rounded_up(lowest->length);
            anchor_of_[i] = static_cast<std::uint8_t>(lowest == nullptr ? 0 : lowest->anchor);
            next = lowest == nullptr ? NearestAnchors::none : lowest->anchor + 1;
        }
    }

    bool list_parts() {
        const std::uint32_t groups = (count_ + tether_group - 1) / tether_group;
        if (!tethers_.first_parts.reserve(std::size_t{groups} + 1)) {
            return false;
        }
        for (std::uint32_t group = 0; group < groups; ++group) {
            tethers_.first_parts.push_reserved(static_cast<std::uint32_t>(tethers_.parts.size()));
            for (std::uint32_t row = 0; row < rows_; ++row) {
                if (!list_parts(group * tether_group, row)) {
                    return false;
                }
            }
        }
        tethers_.first_parts.push_reserved(static_cast<std::uint32_t>(tethers_.parts.size()));
        return true;
    }

    bool list_parts(std::uint32_t first, std::uint32_t row) {
        const std::size_t own = tethers_.parts.size();
        for (std::uint32_t i = 0; i < tether_group && first + i < count_; ++i) {
            if (tethers_.lengths[index(row, first + i)] == no_tether) {
                continue;
            }
            const std::uint32_t anchor = anchor_of_[index(row, first + i)];
            TetherPart* part = std::find_if(tethers_.parts.begin() + own, tethers_.parts.end(),
                                            [&](const TetherPart& p) { return p.anchor == anchor; });
            if (part == tethers_.parts.end()) {
                if (!tethers_.parts.push({0, anchor, row})) {
                    return false;
                }
                part = tethers_.parts.end() - 1;
            }
            part->members |= std::uint64_t{1} << i;
        }
        std::sort(tethers_.parts.begin() + own, tethers_.parts.end(),
                  [](const TetherPart& l, const TetherPart& r) { return l.anchor < r.anchor; });
        return true;
    }

    bool list_pairs() {
        const std::size_t anchors = tethers_.anchors.size();
        if (!pair_lengths_.resize(anchors * anchors)) {
            return false;
        }
        for (std::uint32_t p = 0; p < count_; ++p) {
            for (std::uint32_t row = 1; row < rows_; ++row) {
                for (std::uint32_t other = 0; other < row; ++other) {
                    note_pair(index(other, p), index(row, p));
                }
            }
        }
        for (std::size_t i = 0; i < pair_lengths_.size(); ++i) {
            if (pair_lengths_[i] != 0 &&
                !tethers_.pairs.push({static_cast<std::uint32_t>(i / anchors),
                                      static_cast<std::uint32_t>(i % anchors), pair_lengths_[i]})) {
                return false;
            }
        }
        return true;
    }

    void note_pair(std::size_t first, std::size_t second) {
        if (tethers_.lengths[first] == no_tether || tethers_.lengths[second] == no_tether) {
            return;
        }
        const std::uint64_t length = std::uint64_t{tethers_.lengths[first]} + tethers_.lengths[second];
        std::uint64_t& shortest =
            pair_lengths_[anchor_of_[first] * tethers_.anchors.size() + anchor_of_[second]];
        shortest = shortest == 0 ? length : std::min(shortest, length);
    }

    std::size_t index(std::uint32_t row, std::uint32_t particle) const {
        return std::size_t{row} * count_ + particle;
    }

    Tethers& tethers_;
    std::uint32_t count_;
    std::uint32_t rows_;
    Array<std::uint8_t> anchor_of_;     // as Tethers::lengths
    Array<std::uint64_t> pair_lengths_; // by pair of anchors, 0: none
};

} // namespace

lks_result build_tethers(Build& build, const lks_cloth_def& def) {
    lks_asset& asset = build.asset;
    if (const lks_result result = read_anchors(build, def);
        result != LKS_OK || asset.tethers.anchors.empty()) {
        return result;
    }
    // An anchor counts itself as its nearest one, and so has one less.
    const auto rows = std::min<std::uint32_t>(def.tethers_per_vertex,
                                              static_cast<std::uint32_t>(asset.tethers.anchors.size()));
    NearestAnchors nearest(asset, rows);
    if (!nearest.find() || !Placing(asset, rows).run(nearest)) {
        return build.fail_out_of_memory();
    }
    return LKS_OK;
}

} // namespace lks
