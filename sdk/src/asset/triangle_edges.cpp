#include "asset/triangle_edges.h"

#include <algorithm>

namespace lks {
namespace {

using fixed::Scaled;

struct SortedTriangle {
    std::uint32_t corners[3];
    std::uint32_t triangle;
};

lks_result check_indices(const Build& build) {
    const Array<std::uint32_t>& triangles = build.asset.triangles;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (triangles[i] >= build.positions.size()) {
            return build.fail(LKS_ERROR_INVALID_ARGUMENT,
                              Sentence()
                                  << "Triangle " << static_cast<std::uint64_t>(i / 3) << " names vertex "
                                  << triangles[i] << ", but there are "
                                  << static_cast<std::uint64_t>(build.positions.size()) << " vertices.");
        }
    }
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
        if (triangles[i] == triangles[i + 1] || triangles[i] == triangles[i + 2] ||
            triangles[i + 1] == triangles[i + 2]) {
            return build.fail(LKS_ERROR_INVALID_ARGUMENT,
                              Sentence() << "Triangle " << static_cast<std::uint64_t>(i / 3) << " ("
                                         << triangles[i] << ", " << triangles[i + 1] << ", "
                                         << triangles[i + 2] << ") names a vertex twice.");
        }
    }
    return LKS_OK;
}

lks_result check_duplicates(const Build& build) {
    const Array<std::uint32_t>& triangles = build.asset.triangles;
    Array<SortedTriangle> sorted(build.asset.allocator);
    if (!sorted.resize(triangles.size() / 3)) {
        return build.fail_out_of_memory();
    }
    for (std::uint32_t t = 0; t < sorted.size(); ++t) {
        std::copy_n(&triangles[std::size_t{3} * t], 3, sorted[t].corners);
        std::sort(std::begin(sorted[t].corners), std::end(sorted[t].corners));
        sorted[t].triangle = t;
    }
    const auto compare = [](const SortedTriangle& l, const SortedTriangle& r) {
        for (int i = 0; i < 3; ++i) {
            if (l.corners[i] != r.corners[i]) {
                return l.corners[i] < r.corners[i];
            }
        }
        return l.triangle < r.triangle;
    };
    std::sort(sorted.begin(), sorted.end(), compare);
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        if (std::equal(std::begin(sorted[i].corners), std::end(sorted[i].corners), sorted[i - 1].corners)) {
            return build.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "Triangles " << sorted[i - 1].triangle
                                                                     << " and " << sorted[i].triangle
                                                                     << " are the same one.");
        }
    }
    return LKS_OK;
}

lks_result check_every_vertex_used(const Build& build) {
    Array<unsigned char> used(build.asset.allocator);
    if (!used.resize(build.positions.size())) {
        return build.fail_out_of_memory();
    }
    for (const std::uint32_t vertex : build.asset.triangles) {
        used[vertex] = 1;
    }
    for (std::size_t vertex = 0; vertex < used.size(); ++vertex) {
        if (used[vertex] == 0) {
            return build.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "Vertex "
                                                                     << static_cast<std::uint64_t>(vertex)
                                                                     << " belongs to no triangle.");
        }
    }
    return LKS_OK;
}

} // namespace

lks_result list_triangle_sides(Build& build, Array<TriangleSide>& sides) {
    if (const lks_result result = check_indices(build); result != LKS_OK) {
        return result;
    }
    if (const lks_result result = check_duplicates(build); result != LKS_OK) {
        return result;
    }
    if (const lks_result result = check_every_vertex_used(build); result != LKS_OK) {
        return result;
    }
    const Array<std::uint32_t>& triangles = build.asset.triangles;
    if (!sides.reserve(triangles.size())) {
        return build.fail_out_of_memory();
    }
    for (std::uint32_t t = 0; t < triangles.size() / 3; ++t) {
        const std::uint32_t* corners = &triangles[std::size_t{3} * t];
        fixed::UInt128 squared[3];
        for (std::uint32_t i = 0; i < 3; ++i) {
            squared[i] = squared_distance(build.positions[corners[i]], build.positions[corners[(i + 1) % 3]]);
            if (squared[i] == fixed::UInt128{0, 0}) {
                return build.fail(LKS_ERROR_INVALID_ARGUMENT,
                                  Sentence() << "Vertices " << corners[i] << " and " << corners[(i + 1) % 3]
                                             << " of triangle " << t << " are in the same place.");
            }
        }
        for (std::uint32_t i = 0; i < 3; ++i) {
            const std::uint32_t a = corners[i];
            const std::uint32_t b = corners[(i + 1) % 3];
            const bool longest = squared[i] > squared[(i + 1) % 3] && squared[i] > squared[(i + 2) % 3];
            sides.push_reserved({std::min(a, b), std::max(a, b), t, corners[(i + 2) % 3], longest ? 1u : 0u});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const TriangleSide& l, const TriangleSide& r) {
        return l.low != r.low ? l.low < r.low : l.high != r.high ? l.high < r.high : l.triangle < r.triangle;
    });
    return LKS_OK;
}

} // namespace lks
