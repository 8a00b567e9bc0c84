#include "asset/particle_numbering.h"

#include <algorithm>

namespace lks {
namespace {

constexpr std::uint32_t unvisited = UINT32_MAX;

// Breadth-first ranks of all vertices along the drafts [0, end), from the lowest vertex of each piece.
class BreadthFirst {
public:
    explicit BreadthFirst(const lks_allocator& allocator)
        : ranks(allocator), offsets_(allocator), neighbours_(allocator), queue_(allocator) {}

    bool run(const Build& build, std::size_t end) {
        const std::size_t count = build.positions.size();
        if (!list_neighbours(build, end) || !ranks.resize(count) || !queue_.reserve(count)) {
            return false;
        }
        std::fill(ranks.begin(), ranks.end(), unvisited);
        std::size_t next = 0;
        for (std::uint32_t start = 0; start < count; ++start) {
            visit(start);
            for (; next < queue_.size(); ++next) {
                const std::uint32_t vertex = queue_[next];
                for (std::uint32_t i = offsets_[vertex]; i < offsets_[vertex + 1]; ++i) {
                    visit(neighbours_[i]);
                }
            }
        }
        return true;
    }

    Array<std::uint32_t> ranks;

private:
    void visit(std::uint32_t vertex) {
        if (ranks[vertex] == unvisited) {
            ranks[vertex] = static_cast<std::uint32_t>(queue_.size());
            queue_.push_reserved(vertex);
        }
    }

    bool list_neighbours(const Build& build, std::size_t end) {
        const std::size_t count = build.positions.size();
        if (!offsets_.resize(count + 2) || !neighbours_.resize(2 * end)) {
            return false;
        }
        for (std::size_t i = 0; i < end; ++i) {
            ++offsets_[build.drafts[i].a + 2];
            ++offsets_[build.drafts[i].b + 2];
        }
        for (std::size_t v = 2; v < count + 2; ++v) {
            offsets_[v] += offsets_[v - 1];
        }
        for (std::size_t i = 0; i < end; ++i) {
            const Draft& draft = build.drafts[i];
            neighbours_[offsets_[draft.a + 1]++] = draft.b;
            neighbours_[offsets_[draft.b + 1]++] = draft.a;
        }
        return true;
    }

    Array<std::uint32_t> offsets_;
    Array<std::uint32_t> neighbours_;
    Array<std::uint32_t> queue_;
};

struct RankedEdge {
    std::uint32_t first;
    std::uint32_t second;
};

bool collect_matching(const Build& build, std::size_t end, const Array<std::uint32_t>& ranks,
                      Array<RankedEdge>& edges) {
    for (std::size_t i = 0; i < end; ++i) {
        const Draft& draft = build.drafts[i];
        if (draft.family == LKS_CONSTRAINT_STRETCH && draft.colour == 0) {
            const bool ascending = ranks[draft.a] < ranks[draft.b];
            if (!edges.push(ascending ? RankedEdge{draft.a, draft.b} : RankedEdge{draft.b, draft.a})) {
                return false;
            }
        }
    }
    std::sort(edges.begin(), edges.end(),
              [&](const RankedEdge& l, const RankedEdge& r) { return ranks[l.first] < ranks[r.first]; });
    return true;
}

} // namespace

bool number_rows(Build& build, std::uint32_t columns, std::uint32_t rows, std::uint32_t stride) {
    if (!build.order.reserve(std::size_t{columns} * rows)) {
        return false;
    }
    // One row in `stride`, and in it one in `stride` of the columns [first, last).
    const auto number_block = [&](std::uint32_t first_row, std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t row = first_row; row < rows; row += stride) {
            for (std::uint32_t column = first; column < last; column += stride) {
                build.order.push_reserved(row * columns + column);
            }
        }
    };
    const std::uint32_t even_columns = columns / stride * stride;
    for (std::uint32_t column = 0; column < stride && column < even_columns; ++column) {
        for (std::uint32_t row = 0; row < stride; ++row) {
            number_block(row, column, even_columns);
        }
    }
    for (std::uint32_t column = even_columns; column < columns; ++column) {
        for (std::uint32_t row = 0; row < stride; ++row) {
            number_block(row, column, column + 1);
        }
    }
    return true;
}

bool number_mesh(Build& build, std::size_t end) {
    const std::size_t count = build.positions.size();
    BreadthFirst breadth_first(build.asset.allocator);
    Array<RankedEdge> matching(build.asset.allocator);
    Array<std::uint32_t> by_rank(build.asset.allocator);
    if (!breadth_first.run(build, end) || !collect_matching(build, end, breadth_first.ranks, matching) ||
        !build.order.reserve(count) || !by_rank.resize(count)) {
        return false;
    }
    for (std::uint32_t vertex = 0; vertex < count; ++vertex) {
        by_rank[breadth_first.ranks[vertex]] = vertex;
    }
    for (const RankedEdge& edge : matching) {
        build.order.push_reserved(edge.first);
        breadth_first.ranks[edge.first] = unvisited;
    }
    for (const RankedEdge& edge : matching) {
        build.order.push_reserved(edge.second);
        breadth_first.ranks[edge.second] = unvisited;
    }
    for (const std::uint32_t vertex : by_rank) {
        if (breadth_first.ranks[vertex] != unvisited) {
            build.order.push_reserved(vertex);
        }
    }
    return true;
}

} // namespace lks
