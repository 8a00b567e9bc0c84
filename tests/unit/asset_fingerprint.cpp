// The fingerprint and the hash below it.
#include "asset_inspection.h"
#include "state/hash.h"
#include "support/builders.h"

using support::Asset;

namespace {

template <typename Change>
std::uint64_t fingerprint_of_rope(Change change) {
    lks_rope_def def = lks_default_rope_def();
    change(def);
    return lks_asset_fingerprint(Asset(def));
}

template <typename Change>
std::uint64_t fingerprint_of_cloth(Change change) {
    lks_cloth_def def = lks_default_cloth_def();
    change(def);
    return lks_asset_fingerprint(Asset(def));
}

} // namespace

TEST_CASE("the same description has the same fingerprint and any change that matters another one") {
    std::set<std::uint64_t> all;
    const auto is_new = [&](std::uint64_t fingerprint) { return all.insert(fingerprint).second; };
    CHECK(is_new(fingerprint_of_cloth([](auto&) {})));
    CHECK_FALSE(is_new(fingerprint_of_cloth([](auto&) {})));
    CHECK(is_new(fingerprint_of_cloth([](auto& def) { def.columns = 22; })));
    CHECK(is_new(fingerprint_of_cloth([](auto& def) { def.width = 2.0000000000000004; })));
    CHECK(is_new(fingerprint_of_cloth([](auto& def) { def.area_density = 0.30000000000000004; })));
    CHECK(is_new(fingerprint_of_cloth([](auto& def) { def.friction = 0.75; })));
    CHECK(is_new(fingerprint_of_cloth([](auto& def) { def.particle_radius = 0.03125; })));
    CHECK(is_new(fingerprint_of_cloth([](auto& def) { def.stretch.compliance = 1e-15; })));
    CHECK(is_new(fingerprint_of_cloth([](auto& def) { def.shear.compliance = 1.1e-7; })));
    CHECK(is_new(fingerprint_of_cloth([](auto& def) { def.bend.damping = 1e-9; })));
    CHECK(is_new(fingerprint_of_cloth([](auto& def) { def.bend.enabled = 0; })));
    CHECK(is_new(fingerprint_of_rope([](auto&) {})));
    CHECK_FALSE(is_new(fingerprint_of_rope([](auto&) {})));
    CHECK(is_new(fingerprint_of_rope([](auto& def) { def.segments = 51; })));
    CHECK(is_new(fingerprint_of_rope([](auto& def) { def.linear_density = 0.21; })));
    CHECK(is_new(fingerprint_of_rope([](auto& def) { def.bend.compliance = 0; })));
    CHECK(is_new(fingerprint_of_rope([](auto& def) { def.solver = LKS_ROPE_SWEPT; })));
    // In a world with more substeps the automatic one is swept.
    CHECK(is_new(fingerprint_of_rope([](auto& def) { def.solver = LKS_ROPE_DIRECT; })));
    // In one with fewer it is not.
    const auto easy = [](auto& def) { def.segments = 4; };
    CHECK(is_new(fingerprint_of_rope(easy)));
    CHECK(is_new(fingerprint_of_rope([&](auto& def) {
        easy(def);
        def.solver = LKS_ROPE_SWEPT;
    })));
    // Two numberings of one polyline are two assets.
    const std::vector<double> there{0, 0, 0, 1, 0, 0, 3, 0, 0};
    const std::vector<double> back{3, 0, 0, 1, 0, 0, 0, 0, 0};
    for (const auto* points : {&there, &back}) {
        CHECK(is_new(fingerprint_of_rope([&](auto& def) {
            def.points = points->data();
            def.point_count = 3;
        })));
    }
    CHECK(all.count(0) == 0);
    CHECK(lks_asset_fingerprint(nullptr) == 0);
}

TEST_CASE("the hash is XXH3 of the little-endian bytes however they are handed over") {
    // XXH3_64bits with seed 0 of no bytes at all, as its specification lists it.
    CHECK(lks::Hash().finish() == 0x2d06800538d394c2u);

    std::vector<std::int64_t> values;
    std::vector<unsigned char> bytes;
    for (std::int64_t i = 0; i < 1000; ++i) {
        values.push_back(i * i * 0x123456789ab - 5000);
        for (int shift = 0; shift < 64; shift += 8) {
            bytes.push_back(static_cast<unsigned char>(static_cast<std::uint64_t>(values.back()) >> shift));
        }
    }
    const std::uint64_t whole = XXH3_64bits(bytes.data(), bytes.size());
    lks::Hash as_array;
    as_array.add_i64_array(values.data(), values.size());
    lks::Hash one_by_one;
    lks::Hash in_halves;
    for (const std::int64_t value : values) {
        one_by_one.add_i64(value);
        in_halves.add_u32(static_cast<std::uint32_t>(static_cast<std::uint64_t>(value)));
        in_halves.add_u32(static_cast<std::uint32_t>(static_cast<std::uint64_t>(value) >> 32));
    }
    lks::Hash as_bytes;
    as_bytes.add_bytes(bytes.data(), 77);
    as_bytes.add_bytes(bytes.data() + 77, bytes.size() - 77);
    CHECK(as_array.finish() == whole);
    CHECK(one_by_one.finish() == whole);
    CHECK(in_halves.finish() == whole);
    CHECK(as_bytes.finish() == whole);
    as_bytes.add_u32(0);
    CHECK(as_bytes.finish() != whole);
}
