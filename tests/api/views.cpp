// Views: floats for drawing, in any layout, interpolated, relative to a point of the world; and never written
// back.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "support/builders.h"
#include "support/refusals.h"
#include "support/scene.h"

using namespace support;

namespace {

constexpr unsigned char poison = 0xa5;

// A vertex buffer with everything poisoned that a view must not touch.
class Buffer {
public:
    Buffer(std::size_t vertices, std::size_t stride, std::size_t offset, std::size_t spare = 3)
        : stride_(stride), offset_(offset), words_((stride * (vertices + spare) + offset) / 4 + 4) {
        std::memset(words_.data(), poison, words_.size() * 4);
    }

    float* at_offset(std::size_t more = 0) { return words_.data() + (offset_ + more) / 4; }
    Vector read(std::size_t vertex, std::size_t more = 0) const {
        const float* p = words_.data() + (offset_ + more + vertex * stride_) / 4;
        return {p[0], p[1], p[2]};
    }
    // Whether every byte outside `used` bytes at the given offsets of each vertex is still poisoned.
    bool untouched_but(std::size_t vertices, const std::vector<std::size_t>& offsets) const {
        std::vector<bool> used(words_.size() * 4, false);
        for (std::size_t v = 0; v < vertices; ++v) {
            for (const std::size_t offset : offsets) {
                for (std::size_t b = 0; b < 12; ++b) {
                    used[offset_ + offset + v * stride_ + b] = true;
                }
            }
        }
        const auto* bytes = reinterpret_cast<const unsigned char*>(words_.data());
        for (std::size_t i = 0; i < used.size(); ++i) {
            if (!used[i] && bytes[i] != poison) {
                return false;
            }
        }
        return true;
    }

private:
    std::size_t stride_;
    std::size_t offset_;
    std::vector<float> words_;
};

lks_vertex_view packed(std::vector<float>& floats, std::uint32_t vertices) {
    floats.assign(std::size_t{3} * vertices, -1.0f);
    lks_vertex_view view = lks_default_vertex_view();
    view.positions = floats.data();
    view.position_stride = 12;
    view.vertex_capacity = vertices;
    return view;
}

std::vector<Vector> seen(const World& world, lks_object_id object, std::uint32_t interpolation,
                         const lks_vec3& view_origin = {}) {
    const std::uint32_t count = lks_asset_vertex_count(lks_object_asset(world, object));
    std::vector<float> floats;
    lks_vertex_view view = packed(floats, count);
    view.interpolation = interpolation;
    view.view_origin = view_origin;
    REQUIRE(lks_object_write_vertices(world, object, &view) == LKS_OK);
    std::vector<Vector> result;
    for (std::uint32_t i = 0; i < count; ++i) {
        result.push_back({floats[3 * i], floats[3 * i + 1], floats[3 * i + 2]});
    }
    return result;
}

} // namespace

TEST_CASE(
    "interleaved and separate buffers of any stride get the same floats and their padding stays untouched") {
    const SceneAssets assets;
    Scene scene(assets, {}, world_def(60, 4));
    scene.tick(20);
    const std::uint32_t count = assets.net.vertex_count();
    const std::vector<Vector> expected = seen(scene.world, scene.net, LKS_VIEW_LAST_TICK);
    for (const std::size_t stride : {24u, 28u, 32u, 36u, 64u, 100u}) {
        for (const std::size_t offset : {0u, 4u, 20u}) {
            Buffer buffer(count, stride, offset);
            lks_vertex_view view = lks_default_vertex_view();
            view.positions = buffer.at_offset();
            view.position_stride = stride;
            view.normals = buffer.at_offset(12);
            view.normal_stride = stride;
            view.vertex_capacity = count;
            REQUIRE(lks_object_write_vertices(scene.world, scene.net, &view) == LKS_OK);
            CHECK(buffer.untouched_but(count, {0, 12}));
            bool equal = true;
            for (std::uint32_t i = 0; i < count; ++i) {
                equal = equal && (buffer.read(i) - expected[i]).length() == 0;
            }
            CHECK(equal);
        }
    }
    // Positions alone, normals alone, and nothing.
    Buffer positions(count, 40, 8);
    lks_vertex_view view = lks_default_vertex_view();
    view.vertex_capacity = count + 2;
    CHECK(lks_object_write_vertices(scene.world, scene.net, &view) == LKS_OK);
    view.positions = positions.at_offset();
    view.position_stride = 40;
    REQUIRE(lks_object_write_vertices(scene.world, scene.net, &view) == LKS_OK);
    CHECK(positions.untouched_but(count, {0}));
    Buffer normals(count, 12, 4);
    view = lks_default_vertex_view();
    view.vertex_capacity = count;
    view.normals = normals.at_offset();
    view.normal_stride = 12;
    REQUIRE(lks_object_write_vertices(scene.world, scene.net, &view) == LKS_OK);
    CHECK(normals.untouched_but(count, {0}));
}

TEST_CASE("the last tick is seen to float precision") {
    const SceneAssets assets;
    Scene scene(assets, {}, world_def(60, 4));
    scene.tick(10);
    for (const lks_object_id object : {scene.net, scene.mesh, scene.rope}) {
        const std::vector<Vector> exact = scene.world.positions_from(object, {});
        const std::vector<Vector> floats = seen(scene.world, object, LKS_VIEW_LAST_TICK);
        for (std::size_t i = 0; i < exact.size(); ++i) {
            CHECK(std::abs(floats[i].x - exact[i].x) <= 1.5e-7 * (std::abs(exact[i].x) + 1e-6));
            CHECK(std::abs(floats[i].y - exact[i].y) <= 1.5e-7 * (std::abs(exact[i].y) + 1e-6));
            CHECK(std::abs(floats[i].z - exact[i].z) <= 1.5e-7 * (std::abs(exact[i].z) + 1e-6));
        }
    }
}

TEST_CASE("interpolation goes from the tick before the last to the last") {
    const SceneAssets assets;
    Scene scene(assets, {}, world_def(60, 4));
    scene.tick(9);
    const std::vector<Vector> before = scene.world.positions_from(scene.net, {});
    scene.tick();
    const std::vector<Vector> after = scene.world.positions_from(scene.net, {});
    double moved = 0;
    for (const std::uint32_t interpolation : {0u, 0x40000000u, 0x80000000u, 0xc0000000u, 0xfffffffeu}) {
        const double share = interpolation / 4294967296.0;
        const std::vector<Vector> floats = seen(scene.world, scene.net, interpolation);
        for (std::size_t i = 0; i < floats.size(); ++i) {
            const Vector expected = before[i] + (after[i] - before[i]) * share;
            REQUIRE((floats[i] - expected).length() < 4e-7);
            moved = std::max(moved, (after[i] - before[i]).length());
        }
    }
    CHECK(moved > 0.01);
}

TEST_CASE("an object whose frame has just followed it is interpolated without a jump") {
    lks_world_def settings = world_def(60, 4);
    settings.gravity = {};
    World world(settings);
    const Asset asset = Chain().build();
    lks_object_def def = object_def(asset, at(0, 0, 0));
    def.velocity = fixed(30, 0, 0);
    const lks_object_id object = world.add(def);
    bool followed = false;
    for (int tick = 1; tick <= 60; ++tick) {
        const lks_vec3 origin = world.origin(object);
        world.step();
        followed = followed || !same(origin, world.origin(object));
        const std::vector<Vector> floats = seen(world, object, 0x80000000u);
        REQUIRE(floats[0].x == doctest::Approx(30.0 / 60 * (tick - 0.5)).epsilon(1e-6));
    }
    CHECK(followed);
}

TEST_CASE("a world that keeps no previous positions shows the last tick") {
    const SceneAssets assets;
    lks_world_def def = world_def(60, 4);
    def.keep_previous_positions = 0;
    Scene scene(assets, {}, def);
    scene.tick(10);
    const std::vector<Vector> last = seen(scene.world, scene.net, LKS_VIEW_LAST_TICK);
    const std::vector<Vector> half = seen(scene.world, scene.net, 0x80000000u);
    for (std::size_t i = 0; i < last.size(); ++i) {
        CHECK((last[i] - half[i]).length() == 0);
    }
}

TEST_CASE("an object that was just added is seen where it was put at any interpolation") {
    const SceneAssets assets;
    World world;
    const lks_object_id object = world.add(assets.net, at(1, 2, 3));
    for (const std::uint32_t interpolation : {0u, 0x80000000u, LKS_VIEW_LAST_TICK}) {
        const std::vector<Vector> exact = world.positions_from(object, {});
        const std::vector<Vector> floats = seen(world, object, interpolation);
        for (std::size_t i = 0; i < exact.size(); ++i) {
            CHECK((floats[i] - exact[i]).length() < 5e-7);
        }
    }
}

TEST_CASE("far from the origin a near view origin gives full precision") {
    const SceneAssets assets;
    const lks_vec3 camera = fixed(6000000.25, -1234567.5, 7999999.125);
    Scene here(assets, {}, world_def(60, 4));
    Scene there(assets, camera, world_def(60, 4));
    here.tick(15);
    there.tick(15);
    for (const std::uint32_t interpolation : {0x80000000u, LKS_VIEW_LAST_TICK}) {
        const std::vector<Vector> near = seen(here.world, here.net, interpolation);
        const std::vector<Vector> far = seen(there.world, there.net, interpolation, camera);
        for (std::size_t i = 0; i < near.size(); ++i) {
            CHECK((near[i] - far[i]).length() == 0);
        }
    }
}

TEST_CASE("normals have unit length and look out of the front") {
    Net description;
    description.side = 9;
    const Asset asset = description.build();
    World world;
    const auto normals_of = [&](lks_object_id object) {
        std::vector<float> floats(std::size_t{3} * asset.vertex_count());
        lks_vertex_view view = lks_default_vertex_view();
        view.normals = floats.data();
        view.normal_stride = 12;
        view.vertex_capacity = asset.vertex_count();
        REQUIRE(lks_object_write_vertices(world, object, &view) == LKS_OK);
        std::vector<Vector> result;
        for (std::size_t i = 0; i < asset.vertex_count(); ++i) {
            result.push_back({floats[3 * i], floats[3 * i + 1], floats[3 * i + 2]});
        }
        return result;
    };
    const lks_object_id flat = world.add(asset, at(0, 0, 0));
    for (const Vector& normal : normals_of(flat)) {
        CHECK((normal - Vector{0, 0, 1}).length() < 1e-6);
    }
    // Turned about x by 90°, the front looks down.
    const lks_object_id turned_down = world.add(asset, turned(at(0, 0, 0), 1, 0, 0, 90));
    for (const Vector& normal : normals_of(turned_down)) {
        CHECK((normal - Vector{0, -1, 0}).length() < 1e-6);
    }
    world.pin(flat, 0);
    world.pin(flat, 8);
    REQUIRE(lks_object_apply_impulse(world, flat, 40, fixed(0.01, 0, 0.02)) == LKS_OK);
    world.step(30);
    const std::vector<Vector> normals = normals_of(flat);
    for (const Vector& normal : normals) {
        CHECK(normal.length() == doctest::Approx(1).epsilon(1e-5));
    }
    // Area-weighted sums of the triangles' own normals, in double precision.
    std::vector<Vector> expected(asset.vertex_count());
    const std::vector<Vector> p = world.positions_from(flat, {});
    const std::vector<std::uint32_t> indices = asset.triangles();
    for (std::size_t t = 0; t < indices.size(); t += 3) {
        const Vector u = p[indices[t + 1]] - p[indices[t]];
        const Vector v = p[indices[t + 2]] - p[indices[t]];
        const Vector n{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
        for (int corner = 0; corner < 3; ++corner) {
            expected[indices[t + corner]] = expected[indices[t + corner]] + n;
        }
    }
    for (std::size_t i = 0; i < normals.size(); ++i) {
        CHECK((normals[i] - expected[i] * (1 / expected[i].length())).length() < 1e-4);
    }
}

TEST_CASE("viewing changes nothing") {
    const SceneAssets assets;
    Scene viewed(assets, {}, world_def(60, 4));
    Scene unseen(assets, {}, world_def(60, 4));
    for (int tick = 0; tick < 20; ++tick) {
        viewed.tick();
        unseen.tick();
        const std::uint64_t hash = viewed.world.hash();
        (void)seen(viewed.world, viewed.net, 0x30000000u, fixed(1, 2, 3));
        (void)seen(viewed.world, viewed.rope, LKS_VIEW_LAST_TICK);
        float matrix[16];
        REQUIRE(lks_collider_write_matrix(viewed.world, viewed.crate, 0x30000000u, {}, matrix) == LKS_OK);
        CHECK(viewed.world.hash() == hash);
        REQUIRE(viewed.world.hash() == unseen.world.hash());
    }
    CHECK(viewed.world.save() == unseen.world.save());
}

TEST_CASE("views that don't fit are refused and nothing is written") {
    const SceneAssets assets;
    Scene scene(assets, {}, world_def(60, 4));
    const std::uint32_t count = assets.net.vertex_count();
    std::vector<float> floats(std::size_t{8} * count, 3.5f);
    const auto refused = [&](lks_result expected, const std::string& value, lks_object_id object,
                             auto change) {
        lks_vertex_view view = lks_default_vertex_view();
        view.positions = floats.data();
        view.position_stride = 12;
        view.vertex_capacity = count;
        change(view);
        check_call_refused(scene.world, expected, value,
                           [&] { return lks_object_write_vertices(scene.world, object, &view); });
        CHECK(floats[0] == 3.5f);
    };
    constexpr lks_result invalid = LKS_ERROR_INVALID_ARGUMENT;
    refused(LKS_ERROR_BUFFER_TOO_SMALL, std::to_string(count), scene.net,
            [&](auto& view) { view.vertex_capacity = count - 1; });
    for (const std::size_t stride : {0u, 4u, 8u, 11u, 13u, 14u, 31u}) {
        refused(invalid, std::to_string(stride), scene.net,
                [&](auto& view) { view.position_stride = stride; });
        refused(invalid, std::to_string(stride), scene.net, [&](auto& view) {
            view.normals = floats.data();
            view.normal_stride = stride;
        });
    }
    refused(LKS_ERROR_UNSUPPORTED, "normals", scene.rope, [&](auto& view) {
        view.normals = floats.data();
        view.normal_stride = 12;
    });
    refused(LKS_ERROR_MISALIGNED, "4", scene.net, [&](auto& view) {
        view.positions = reinterpret_cast<float*>(reinterpret_cast<unsigned char*>(floats.data()) + 2);
    });
}

TEST_CASE("a collider's matrix is its pose and goes halfway at half a tick") {
    World world(world_def(60, 4));
    lks_collider_def def = lks_default_collider_def();
    def.transform = turned(at(10, 20, 30), 0, 1, 0, 90);
    const lks_collider_id collider = world.add(def);
    float m[16] = {};
    const lks_vec3 view_origin = fixed(10, 0, 0);
    REQUIRE(lks_collider_write_matrix(world, collider, LKS_VIEW_LAST_TICK, view_origin, m) == LKS_OK);
    // Columns: where local x, y and z point, and the place. +90° about y takes x to -z and z to x.
    const float expected[16] = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 20, 30, 1};
    for (int i = 0; i < 16; ++i) {
        CHECK(std::abs(m[i] - expected[i]) < 1e-6f);
    }
    REQUIRE(lks_collider_move_to(world, collider, turned(at(12, 20, 30), 0, 1, 0, 150)) == LKS_OK);
    world.step();
    REQUIRE(lks_collider_write_matrix(world, collider, 0x80000000u, view_origin, m) == LKS_OK);
    CHECK(m[12] == doctest::Approx(1).epsilon(1e-6));
    // Half of the way from 90° to 150°.
    CHECK(m[0] == doctest::Approx(std::cos(120 * 3.14159265358979 / 180)).epsilon(1e-4));
    CHECK(m[2] == doctest::Approx(-std::sin(120 * 3.14159265358979 / 180)).epsilon(1e-4));
    REQUIRE(lks_collider_write_matrix(world, collider, 0, view_origin, m) == LKS_OK);
    CHECK(std::abs(m[12]) < 1e-6f);
    CHECK(std::abs(m[0]) < 1e-5f);
}

TEST_CASE("a mesh whose triangles look the other way is another asset, and its normals do, too") {
    const Mesh mesh = wavy_mesh(5, 1);
    Mesh reversed = mesh;
    for (std::size_t i = 0; i < reversed.triangles.size(); i += 3) {
        std::swap(reversed.triangles[i], reversed.triangles[i + 1]);
    }
    const Asset front(mesh.def());
    const Asset back(reversed.def());
    CHECK(lks_asset_fingerprint(front) != lks_asset_fingerprint(back));
    World world(world_def(60, 4));
    const auto normals_of = [&](const Asset& asset) {
        const lks_object_id id = world.add(asset, at(0, 0, 0));
        std::vector<float> floats(3 * std::size_t{asset.vertex_count()});
        lks_vertex_view view = lks_default_vertex_view();
        view.normals = floats.data();
        view.normal_stride = 12;
        view.vertex_capacity = asset.vertex_count();
        REQUIRE(lks_object_write_vertices(world, id, &view) == LKS_OK);
        return floats;
    };
    const std::vector<float> one = normals_of(front);
    const std::vector<float> other = normals_of(back);
    for (std::size_t i = 0; i < one.size(); ++i) {
        CHECK(one[i] == doctest::Approx(-other[i]));
    }
}
