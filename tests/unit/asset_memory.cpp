// Building without memory: whichever allocation fails, the caller is told, gets nothing, and loses nothing.
#include "asset_inspection.h"
#include "support/allocator.h"
#include "support/builders.h"

namespace {

template <typename Create>
void survives_every_failure(const Create& create) {
    support::Allocator allocator(support::Allocator::Fill::random);
    auto* const untouched = reinterpret_cast<lks_asset*>(&allocator);
    std::uint64_t failures = 0;
    for (;; ++failures) {
        REQUIRE(failures < 1000);
        allocator.fail_after(failures);
        lks_error error{-1, "x"};
        lks_asset* asset = untouched;
        const lks_result result = create(allocator.interface(), &error, &asset);
        if (result == LKS_OK) {
            CHECK_FALSE(allocator.refused_any());
            CHECK(error.result == LKS_OK);
            CHECK(error.message[0] == '\0');
            allocator.never_fail();
            inspection::everything_holds(*asset);
            CHECK(allocator.live_blocks() > 0);
            lks_asset_release(asset);
            break;
        }
        CHECK(result == LKS_ERROR_OUT_OF_MEMORY);
        CHECK(error.result == LKS_ERROR_OUT_OF_MEMORY);
        CHECK(error.message[0] != '\0');
        CHECK(asset == untouched);
        CHECK(allocator.live_blocks() == 0);
    }
    CHECK(failures > 10); // it did fail, often
    CHECK(allocator.live_blocks() == 0);
    CHECK(allocator.misuses() == 0);
    CHECK(allocator.allocations() == allocator.releases() + failures);
}

} // namespace

TEST_CASE("a grid is built or refused whichever allocation fails") {
    survives_every_failure([](const lks_allocator& allocator, lks_error* error, lks_asset** asset) {
        lks_cloth_def def = lks_default_cloth_def();
        def.allocator = allocator;
        def.error = error;
        return lks_asset_create_cloth(&def, asset);
    });
}

TEST_CASE("a mesh is built or refused whichever allocation fails") {
    const support::Mesh mesh = support::wavy_mesh(9, 1);
    survives_every_failure([&](const lks_allocator& allocator, lks_error* error, lks_asset** asset) {
        lks_cloth_def def = mesh.def();
        def.allocator = allocator;
        def.error = error;
        return lks_asset_create_cloth(&def, asset);
    });
}

TEST_CASE("a cloth with tethers is built or refused whichever allocation fails") {
    const std::uint32_t anchors[] = {0, 20, 220};
    survives_every_failure([&](const lks_allocator& allocator, lks_error* error, lks_asset** asset) {
        lks_cloth_def def = lks_default_cloth_def();
        def.tether_anchors = anchors;
        def.tether_anchor_count = 3;
        def.allocator = allocator;
        def.error = error;
        return lks_asset_create_cloth(&def, asset);
    });
}

TEST_CASE("a rope is built or refused whichever allocation fails") {
    survives_every_failure([](const lks_allocator& allocator, lks_error* error, lks_asset** asset) {
        lks_rope_def def = lks_default_rope_def();
        def.allocator = allocator;
        def.error = error;
        return lks_asset_create_rope(&def, asset);
    });
}

TEST_CASE("a refused description takes no memory along") {
    support::Allocator allocator;
    support::Mesh mesh = support::wavy_mesh(9, 1);
    mesh.triangles.back() = 81;
    lks_cloth_def def = mesh.def();
    def.allocator = allocator.interface();
    lks_asset* asset = nullptr;
    CHECK(lks_asset_create_cloth(&def, &asset) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(asset == nullptr);
    CHECK(allocator.live_blocks() == 0);
    CHECK(allocator.misuses() == 0);
}
