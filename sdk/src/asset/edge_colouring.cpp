#include "asset/edge_colouring.h"

namespace lks {
namespace {

// For each vertex the edges that end there.
class Incidence {
public:
    explicit Incidence(const lks_allocator& allocator) : offsets_(allocator), edges_(allocator) {}

    bool build(const Build& build, std::size_t first, std::size_t end) {
        const std::size_t vertices = build.positions.size();
        if (!offsets_.resize(vertices + 2) || !edges_.resize(2 * (end - first))) {
            return false;
        }
        for (std::size_t i = first; i < end; ++i) {
            ++offsets_[build.drafts[i].a + 2];
            ++offsets_[build.drafts[i].b + 2];
        }
        for (std::size_t v = 2; v < vertices + 2; ++v) {
            offsets_[v] += offsets_[v - 1];
        }
        // offsets_[v + 1] is where v's list starts, and after this loop where it ends.
        for (std::size_t i = first; i < end; ++i) {
            edges_[offsets_[build.drafts[i].a + 1]++] = static_cast<std::uint32_t>(i);
            edges_[offsets_[build.drafts[i].b + 1]++] = static_cast<std::uint32_t>(i);
        }
        return true;
    }

    template <typename Visit>
    void visit_before(std::uint32_t vertex, std::uint32_t edge, const Visit& visit) const {
        for (std::uint32_t i = offsets_[vertex]; i < offsets_[vertex + 1] && edges_[i] < edge; ++i) {
            visit(edges_[i]);
        }
    }

    std::uint32_t largest_degree() const {
        std::uint32_t largest = 0;
        for (std::size_t v = 0; v + 2 < offsets_.size(); ++v) {
            const std::uint32_t degree = offsets_[v + 1] - offsets_[v];
            largest = degree > largest ? degree : largest;
        }
        return largest;
    }

private:
    Array<std::uint32_t> offsets_;
    Array<std::uint32_t> edges_;
};

} // namespace

bool colour_edges(Build& build, std::size_t first, std::size_t end) {
    if (first == end) {
        return true;
    }
    Incidence incidence(build.asset.allocator);
    // The last edge whose neighbours had each colour, plus one: no clearing between edges.
    Array<std::uint32_t> last_taken(build.asset.allocator);
    // A greedy colouring needs at most 2·degree - 1 colours.
    if (!incidence.build(build, first, end) ||
        !last_taken.resize(2 * std::size_t{incidence.largest_degree()})) {
        return false;
    }
    for (std::size_t i = first; i < end; ++i) {
        Draft& draft = build.drafts[i];
        const auto edge = static_cast<std::uint32_t>(i);
        const auto take = [&](std::uint32_t neighbour) {
            last_taken[build.drafts[neighbour].colour] = edge + 1;
        };
        incidence.visit_before(draft.a, edge, take);
        incidence.visit_before(draft.b, edge, take);
        std::uint32_t colour = 0;
        while (last_taken[colour] == edge + 1) {
            ++colour;
        }
        draft.colour = colour;
    }
    return true;
}

} // namespace lks
