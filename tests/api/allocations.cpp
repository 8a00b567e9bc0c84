// Memory: none is taken inside a tick, none is lost, and where there is none a call fails and changes
// nothing.
#include <doctest/doctest.h>

#include <functional>
#include <memory>
#include <vector>

#include "support/refusals.h"
#include "support/scene.h"

using namespace support;

namespace {

// A world whose memory is watched, with something of everything in it.
struct Watched {
    Allocator allocator;
    std::unique_ptr<SceneAssets> assets;
    std::unique_ptr<Scene> scene;

    Watched() {
        assets = std::make_unique<SceneAssets>(allocator.interface());
        lks_world_def def = world_def(60, 3, 2);
        def.allocator = allocator.interface();
        scene = std::make_unique<Scene>(*assets, lks_vec3{}, def);
        scene->tick(2);
    }
    ~Watched() {
        scene.reset();
        assets.reset();
        CHECK(allocator.live_blocks() == 0);
        CHECK(allocator.misuses() == 0);
    }

    // Makes every allocation of the call fail in turn, until one try needs no further one.
    void fail_each_allocation(const std::function<lks_result()>& call) {
        World& world = scene->world;
        const std::uint64_t hash = world.hash();
        const Image image = world.save();
        std::size_t live_after_failure = 0;
        int failures = 0;
        for (std::uint64_t n = 0; n < 1000; ++n) {
            allocator.fail_after(n);
            const lks_result result = call();
            const bool refused = allocator.refused_any();
            allocator.never_fail();
            if (!refused) {
                CHECK(result == LKS_OK);
                CHECK(failures > 0);
                return;
            }
            ++failures;
            INFO("allocation number " << n);
            REQUIRE(result == LKS_ERROR_OUT_OF_MEMORY);
            CHECK(lks_world_last_error(world)->result == LKS_ERROR_OUT_OF_MEMORY);
            check_sentence(world.message(), "memory");
            CHECK(world.hash() == hash);
            CHECK(world.save() == image);

            // The same failure again takes nothing more: what a failed call keeps is room it can use, no
            // leak.
            live_after_failure = allocator.live_blocks();
            allocator.fail_after(0);
            REQUIRE(call() == LKS_ERROR_OUT_OF_MEMORY);
            allocator.never_fail();
            CHECK(allocator.live_blocks() == live_after_failure);
        }
        FAIL("never had enough memory");
    }
};

} // namespace

TEST_CASE("no tick allocates or releases with pins and colliders and recorded forces and inputs") {
    Watched watched;
    Scene& scene = *watched.scene;
    for (const bool by_clock : {false, true}) {
        const std::uint64_t allocations = watched.allocator.allocations();
        const std::uint64_t releases = watched.allocator.releases();
        for (int i = 0; i < 120; ++i) {
            scene.give_inputs(scene.world.tick());
            const lks_transform from = at(0, 0, 0);
            const lks_transform to = turned(at(0.01, 0, 0), 0, 1, 0, 90);
            REQUIRE(lks_object_teleport(scene.world, scene.mesh, &from, &to) == LKS_OK);
            const lks_vec3 place = fixed(1, 1, 0.001 * i);
            REQUIRE(lks_object_set_positions(scene.world, scene.rope, 3, 1, &place) == LKS_OK);
            if (by_clock) {
                REQUIRE(lks_world_advance(scene.world, 40000000, nullptr) == LKS_OK);
            } else {
                scene.world.step();
            }
            (void)scene.world.hash();
            (void)lks_object_hash(scene.world, scene.net);
        }
        CHECK(watched.allocator.allocations() == allocations);
        CHECK(watched.allocator.releases() == releases);
    }
}

TEST_CASE("saving and loading into the same objects and viewing allocate nothing") {
    Watched watched;
    Scene& scene = *watched.scene;
    const Image first = scene.world.save();
    scene.tick(5);
    REQUIRE(lks_world_load(scene.world, first.data(), first.size()) == LKS_OK);
    const std::uint64_t allocations = watched.allocator.allocations();
    for (int i = 0; i < 20; ++i) {
        const Image image = scene.world.save();
        scene.tick(3);
        REQUIRE(lks_world_load(scene.world, image.data(), image.size()) == LKS_OK);
        scene.tick(1);
        std::vector<float> floats(std::size_t{6} * watched.assets->net.vertex_count());
        lks_vertex_view view = lks_default_vertex_view();
        view.positions = floats.data();
        view.position_stride = 24;
        view.normals = floats.data() + 3;
        view.normal_stride = 24;
        view.vertex_capacity = watched.assets->net.vertex_count();
        REQUIRE(lks_object_write_vertices(scene.world, scene.net, &view) == LKS_OK);
    }
    CHECK(watched.allocator.allocations() == allocations);
}

TEST_CASE("a world that cannot be made for lack of memory leaves nothing behind") {
    Allocator allocator;
    lks_error error{};
    lks_world_def def = world_def(60, 2);
    def.allocator = allocator.interface();
    def.error = &error;
    lks_world* world = nullptr;
    std::uint64_t n = 0;
    for (; n < 100; ++n) {
        allocator.fail_after(n);
        const lks_result result = lks_world_create(&def, &world);
        if (result == LKS_OK) {
            break;
        }
        CHECK(result == LKS_ERROR_OUT_OF_MEMORY);
        CHECK(error.result == result);
        check_sentence(error.message, "memory");
        CHECK(world == nullptr);
        CHECK(allocator.live_blocks() == 0);
    }
    CHECK(n > 0);
    REQUIRE(world != nullptr);
    lks_world_destroy(world);
    CHECK(allocator.live_blocks() == 0);
    CHECK(allocator.misuses() == 0);
}

namespace {

// `create` makes an asset with the allocator given.
void fail_each_allocation_of_an_asset(
    const std::function<lks_result(const lks_allocator&, lks_error*, lks_asset**)>& create) {
    Allocator allocator;
    lks_error error{};
    lks_asset* asset = nullptr;
    std::uint64_t n = 0;
    for (; n < 10000; ++n) {
        allocator.fail_after(n);
        const lks_result result = create(allocator.interface(), &error, &asset);
        if (result == LKS_OK) {
            break;
        }
        INFO("allocation number " << n);
        REQUIRE(result == LKS_ERROR_OUT_OF_MEMORY);
        CHECK(error.result == result);
        check_sentence(error.message, "memory");
        REQUIRE(asset == nullptr);
        REQUIRE(allocator.live_blocks() == 0);
    }
    CHECK(n > 5);
    REQUIRE(asset != nullptr);
    allocator.never_fail();
    lks_asset_release(asset);
    CHECK(allocator.live_blocks() == 0);
    CHECK(allocator.misuses() == 0);
}

} // namespace

TEST_CASE("an asset that cannot be made for lack of memory leaves nothing behind") {
    fail_each_allocation_of_an_asset([](const lks_allocator& allocator, lks_error* error, lks_asset** asset) {
        lks_cloth_def def = lks_default_cloth_def();
        def.columns = 7;
        def.rows = 9;
        def.allocator = allocator;
        def.error = error;
        return lks_asset_create_cloth(&def, asset);
    });
    const Mesh mesh = wavy_mesh(6, 1);
    fail_each_allocation_of_an_asset(
        [&](const lks_allocator& allocator, lks_error* error, lks_asset** asset) {
            lks_cloth_def def = mesh.def();
            def.allocator = allocator;
            def.error = error;
            return lks_asset_create_cloth(&def, asset);
        });
    fail_each_allocation_of_an_asset([](const lks_allocator& allocator, lks_error* error, lks_asset** asset) {
        lks_rope_def def = lks_default_rope_def();
        def.allocator = allocator;
        def.error = error;
        return lks_asset_create_rope(&def, asset);
    });
}

TEST_CASE("objects that cannot be added for lack of memory change nothing") {
    Watched watched;
    Chain chain;
    chain.stretch = soft(1e-4, 10);
    const Asset asset = chain.build(); // not yet known to the world
    for (const std::uint32_t record : {0u, 1u}) {
        lks_object_def def = object_def(asset, at(0, 3, 0));
        def.record_forces = record;
        watched.fail_each_allocation([&] {
            lks_object_id id{};
            const lks_result result = lks_world_add_object(watched.scene->world, &def, &id);
            CHECK((id.generation == 0) == (result != LKS_OK));
            return result;
        });
    }
    watched.scene->world.step(2);
}

TEST_CASE("colliders and pins and assets that cannot be added for lack of memory change nothing") {
    Watched watched;
    World& world = watched.scene->world;
    // Until the room that is there is used up and the next one has to allocate.
    const auto next_allocates = [&](const std::function<lks_result()>& call) {
        for (int i = 0; i < 200; ++i) {
            watched.allocator.fail_after(0);
            const lks_result result = call();
            watched.allocator.never_fail();
            if (result == LKS_ERROR_OUT_OF_MEMORY) {
                return;
            }
            REQUIRE(result == LKS_OK);
        }
        FAIL("never allocates");
    };
    const auto add_collider = [&] {
        const lks_collider_def def = lks_default_collider_def();
        lks_collider_id id{};
        return lks_world_add_collider(world, &def, &id);
    };
    next_allocates(add_collider);
    watched.fail_each_allocation(add_collider);

    std::uint32_t vertex = 0;
    const auto pin = [&] {
        const lks_result result = lks_object_pin(world, watched.scene->mesh, vertex);
        vertex += result == LKS_OK ? 1 : 0;
        return result;
    };
    next_allocates(pin);
    watched.fail_each_allocation(pin);
    CHECK(lks_object_pin_count(world, watched.scene->mesh) == vertex);

    Net net;
    net.side = 5;
    const Asset unknown = net.build();
    watched.fail_each_allocation([&] { return lks_world_register_asset(world, unknown); });
}

TEST_CASE("an image that cannot be loaded for lack of memory changes nothing") {
    const SceneAssets assets;
    const lks_world_def plain = world_def(60, 3, 2);
    Scene source(assets, {}, plain);
    for (int i = 0; i < 20; ++i) {
        source.world.add(lks_default_collider_def());
        const lks_object_id extra = source.world.add(assets.rope, at(0, 4, i));
        source.world.pin(extra, 2);
    }
    source.tick(4);
    const Image image = source.world.save();

    Watched watched;
    World& world = watched.scene->world;
    watched.fail_each_allocation([&] { return lks_world_load(world, image.data(), image.size()); });
    CHECK(world.hash() == source.world.hash());
    CHECK(world.save() == image);
}
