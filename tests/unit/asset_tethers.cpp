// Tethers: the shortest ways to the nearest anchors, and how they are laid out.
#include <bit>
#include <cmath>
#include <map>

#include "asset_inspection.h"
#include "support/builders.h"

using namespace inspection;
using support::Asset;

namespace {

constexpr double far = 1e30;

// The shortest way from one vertex to all others, by going round the edges until nothing changes.
std::vector<double> distances(const lks_asset& asset, std::uint32_t from, const double (&compliance)[3]) {
    const double weight = 9.81 * total_mass(asset);
    std::vector<double> found(asset.vertex_count(), far);
    found[from] = 0;
    for (bool changed = true; changed;) {
        changed = false;
        for (std::uint32_t i = 0; i < asset.constraint_count(); ++i) {
            lks_constraint_info info{};
            REQUIRE(lks_asset_constraint(&asset, i, &info) == LKS_OK);
            const double length = support::metres(info.rest_length) + compliance[info.family] * weight;
            double& a = found[info.vertex_a];
            double& b = found[info.vertex_b];
            const double shorter_a = std::min(a, b + length);
            const double shorter_b = std::min(b, a + length);
            changed = changed || shorter_a < a - 1e-9 || shorter_b < b - 1e-9;
            a = shorter_a;
            b = shorter_b;
        }
    }
    return found;
}

std::vector<lks_tether> tethers_of(const lks_asset* asset, std::uint32_t vertex) {
    lks_tether found[LKS_MAX_TETHERS_PER_VERTEX];
    const std::uint32_t count = lks_asset_vertex_tethers(asset, vertex, found);
    return {found, found + count};
}

// Those of every vertex are the shortest ways to as many of its nearest anchors.
void check_tethers(const lks_cloth_def& def) {
    const Asset asset(def);
    const double compliance[3] = {def.stretch.compliance, def.shear.compliance, def.bend.compliance};
    std::vector<std::vector<double>> ways;
    for (std::uint32_t i = 0; i < def.tether_anchor_count; ++i) {
        ways.push_back(distances(*asset, def.tether_anchors[i], compliance));
    }
    std::uint32_t wrong = 0, unordered = 0;
    for (std::uint32_t v = 0; v < asset.vertex_count(); ++v) {
        std::vector<double> nearest;
        for (std::uint32_t i = 0; i < def.tether_anchor_count; ++i) {
            nearest.push_back(ways[i][v]);
        }
        std::sort(nearest.begin(), nearest.end());
        nearest.resize(std::min<std::size_t>(nearest.size(), def.tethers_per_vertex));
        // An anchor counts itself; what cannot be reached has none.
        nearest.erase(std::remove(nearest.begin(), nearest.end(), 0.0), nearest.end());
        nearest.erase(std::remove(nearest.begin(), nearest.end(), far), nearest.end());
        const std::vector<lks_tether> found = tethers_of(asset, v);
        std::vector<double> lengths;
        for (std::size_t i = 0; i < found.size(); ++i) {
            const auto* anchor =
                std::find(def.tether_anchors, def.tether_anchors + def.tether_anchor_count, found[i].anchor);
            REQUIRE(anchor != def.tether_anchors + def.tether_anchor_count);
            lengths.push_back(support::metres(found[i].length));
            const double way = ways[static_cast<std::size_t>(anchor - def.tether_anchors)][v];
            wrong += lengths.back() >= way && lengths.back() < way + 4e-7 ? 0 : 1;
            unordered += i > 0 && found[i].anchor <= found[i - 1].anchor ? 1 : 0;
        }
        std::sort(lengths.begin(), lengths.end());
        wrong += lengths.size() == nearest.size() ? 0 : 1;
        for (std::size_t i = 0; i < lengths.size() && i < nearest.size(); ++i) {
            wrong += std::abs(lengths[i] - nearest[i]) < 4e-7 ? 0 : 1;
        }
    }
    CHECK(wrong == 0);
    CHECK(unordered == 0);
}

// Each tether stands in one part, and pairs are the tightest of any particle.
void check_layout(const lks_asset& asset) {
    const lks::Tethers& tethers = asset.tethers;
    const std::uint32_t count = asset.vertex_count();
    REQUIRE(tethers.first_parts.size() == (count + 63) / 64 + 1);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> pairs;
    std::uint64_t members = 0, present = 0, wrong = 0;
    for (const std::uint32_t length : tethers.lengths) {
        present += length != lks::no_tether ? 1 : 0;
    }
    for (std::uint32_t group = 0; group + 1 < tethers.first_parts.size(); ++group) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> own; // of (particle, anchor), length
        for (std::uint32_t i = tethers.first_parts[group]; i < tethers.first_parts[group + 1]; ++i) {
            const lks::TetherPart& part = tethers.parts[i];
            members += static_cast<std::uint64_t>(std::popcount(part.members));
            for (std::uint32_t bit = 0; bit < 64; ++bit) {
                if ((part.members >> bit & 1) != 0) {
                    const std::uint32_t particle = group * 64 + bit;
                    REQUIRE(particle < count);
                    const std::uint32_t length = tethers.lengths[part.row * std::size_t{count} + particle];
                    wrong += length == lks::no_tether || length < 3 ? 1 : 0;
                    wrong += own.emplace(std::pair{particle, part.anchor}, length).second ? 0 : 1;
                }
            }
        }
        for (const auto& [a, length_a] : own) {
            for (const auto& [b, length_b] : own) {
                if (a.first == b.first && a.second < b.second) {
                    const std::uint64_t sum = std::uint64_t{length_a} + length_b;
                    auto& least = pairs.emplace(std::pair{a.second, b.second}, sum).first->second;
                    least = std::min(least, sum);
                }
            }
        }
    }
    CHECK(wrong == 0);
    CHECK(members == present);
    CHECK(tethers.pairs.size() == pairs.size());
    for (const lks::TetherPair& pair : tethers.pairs) {
        CHECK(pairs[{pair.a, pair.b}] == pair.length);
    }
}

} // namespace

TEST_CASE("tethers are the shortest ways along the constraints, as the cloth's weight would stretch them") {
    const std::vector<std::uint32_t> anchors{20, 0, 430, 7, 133};
    for (const std::uint32_t wanted : {1u, 2u, 4u}) {
        for (const double compliance : {0.0, 1e-4, 1e-2}) {
            CAPTURE(wanted);
            CAPTURE(compliance);
            lks_cloth_def def = lks_default_cloth_def();
            def.shear.compliance = compliance;
            def.tether_anchors = anchors.data();
            def.tether_anchor_count = static_cast<std::uint32_t>(anchors.size());
            def.tethers_per_vertex = wanted;
            check_tethers(def);
            check_layout(*Asset(def));
        }
    }
}

TEST_CASE("tethers of a mesh, of a cloth of separate pieces, and of a row of anchors") {
    const support::Mesh mesh = support::wavy_mesh(17, 1);
    const std::vector<std::uint32_t> corners{0, 16};
    lks_cloth_def def = mesh.def();
    def.tether_anchors = corners.data();
    def.tether_anchor_count = 2;
    check_tethers(def);
    check_layout(*Asset(def));

    // Two triangles that do not know of each other.
    const std::vector<double> vertices{0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0};
    const std::vector<std::uint32_t> triangles{0, 1, 2, 3, 4, 5};
    lks_cloth_def pieces = mesh.def();
    pieces.vertex_count = 6;
    pieces.triangle_count = 2;
    pieces.vertices = vertices.data();
    pieces.triangles = triangles.data();
    const std::uint32_t one = 1;
    pieces.tether_anchors = &one;
    pieces.tether_anchor_count = 1;
    check_tethers(pieces);
    const Asset apart(pieces);
    CHECK(tethers_of(apart, 0).size() == 1);
    CHECK(tethers_of(apart, 1).empty());
    CHECK(tethers_of(apart, 4).empty());

    std::vector<std::uint32_t> row(21);
    for (std::uint32_t i = 0; i < row.size(); ++i) {
        row[i] = i;
    }
    lks_cloth_def curtain = lks_default_cloth_def();
    curtain.tether_anchors = row.data();
    curtain.tether_anchor_count = 21;
    check_tethers(curtain);
    check_layout(*Asset(curtain));
}

TEST_CASE("the order of anchors does not matter, and what is asked of tethers without anchors neither") {
    const std::vector<std::uint32_t> there{3, 440, 20, 0};
    const std::vector<std::uint32_t> back{0, 20, 440, 3};
    std::set<std::uint64_t> all;
    for (const auto* anchors : {&there, &back}) {
        lks_cloth_def def = lks_default_cloth_def();
        def.tether_anchors = anchors->data();
        def.tether_anchor_count = 4;
        all.insert(lks_asset_fingerprint(Asset(def)));
    }
    CHECK(all.size() == 1);
    lks_cloth_def def = lks_default_cloth_def();
    const std::uint64_t plain = lks_asset_fingerprint(Asset(def));
    def.tethers_per_vertex = 4;
    def.tether_anchors = there.data(); // none of them
    CHECK(lks_asset_fingerprint(Asset(def)) == plain);
    def.tether_anchor_count = 3;
    CHECK(all.insert(lks_asset_fingerprint(Asset(def))).second);
    def.tethers_per_vertex = 1;
    CHECK(all.insert(lks_asset_fingerprint(Asset(def))).second);
}

TEST_CASE("a tether that would be longer than 100 m is left out") {
    std::uint32_t anchor = 0;
    lks_cloth_def def = lks_default_cloth_def();
    def.width = 110;
    def.height = 1;
    def.columns = 12;
    def.rows = 2;
    def.tether_anchors = &anchor;
    def.tether_anchor_count = 1;
    const Asset asset(def);
    CHECK(tethers_of(asset, 9).size() == 1);
    CHECK(tethers_of(asset, 11).empty());
}
