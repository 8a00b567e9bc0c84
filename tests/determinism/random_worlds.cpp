// Worlds made at random of figures, bodies, cloth, ropes and what ties them, with inputs at random: the same
// bits on every instruction set and with any number of workers. What is written for a purpose meets few of
// the ways in which parts can stand together: in version 29 figures that hang on ropes were bundled with
// others.
#include <doctest/doctest.h>

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "support/attachments.h"
#include "support/bodies.h"
#include "support/builders.h"
#include "support/sanitised.h"

using namespace support;

namespace {

struct Settings {
    std::uint32_t substeps, iterations;
};

class RandomWorld {
public:
    RandomWorld(std::uint32_t seed, std::uint32_t workers, lks_simd simd)
        : random_(seed), world_(definition(workers, simd)) {
        if (chance(0.7)) {
            add_ground(world_);
        }
        add_figures();
        add_bodies();
        add_ropes();
        if (chance(0.5)) {
            add_cloth();
        }
        attach();
    }

    std::vector<std::uint64_t> run() {
        std::vector<std::uint64_t> hashes;
        const int ticks = 10 + below(20);
        for (int tick = 0; tick < ticks; ++tick) {
            for (int inputs = below(4); inputs > 0; --inputs) {
                give_input();
            }
            world_.step();
            hashes.push_back(world_.hash());
        }
        return hashes;
    }

private:
    int below(std::size_t count) { return static_cast<int>(random_() % count); }
    double between(double low, double high) { return low + (high - low) * (random_() % 65536) / 65536.0; }
    bool chance(double share) { return between(0, 1) < share; }
    lks_vec3 place(double x) { return fixed(x + between(-0.1, 0.1), between(0.2, 1.5), between(-1, 1)); }
    lks_rotation turned() { return about(between(-1, 1), between(-1, 1), between(0.1, 1), between(0, 360)); }
    template <typename T>
    T any_of(const std::vector<T>& items) {
        return items[static_cast<std::size_t>(below(items.size()))];
    }

    lks_world_def definition(std::uint32_t workers, lks_simd simd) {
        const Settings all[] = {{1, 1}, {2, 1}, {4, 1}, {8, 1}, {20, 1}, {1, 8}, {4, 3}};
        const Settings& settings = all[below(std::size(all))];
        lks_world_def def = world_def(60, settings.substeps);
        def.iterations = settings.iterations;
        def.worker_count = workers;
        def.simd = static_cast<std::uint32_t>(simd);
        return def;
    }

    // Alike, so that they are solved side by side; often far enough from each other for nothing to touch.
    template <typename Figure>
    void add_figures_of(std::uint32_t bone_count) {
        const double apart = chance(0.5) ? 1.5 : 0.4;
        const int count = below(9);
        for (int i = 0; i < count; ++i) {
            Figure figure;
            figure.def.transform = {fixed(apart * i, between(0, 0.5), 0), about(0, 1, 0, 0)};
            if (chance(0.3)) {
                figure.def.transform.rotation = turned();
            }
            figure.def.velocity = fixed(between(-2, 2), between(-2, 2), between(-2, 2));
            std::vector<lks_body_id> bodies(bone_count);
            std::vector<lks_joint_id> joints(bone_count - 1);
            REQUIRE(figure.add(world_, bodies.data(), joints.data()) == LKS_OK);
            bodies_.insert(bodies_.end(), bodies.begin(), bodies.end());
            joints_.insert(joints_.end(), joints.begin(), joints.end());
        }
    }
    void add_figures() {
        if (chance(0.7)) {
            add_figures_of<Humanoid>(LKS_HUMANOID_BONES);
        } else {
            add_figures_of<Spider>(LKS_SPIDER_BONES);
        }
    }

    void add_bodies() {
        const int count = below(7) + (bodies_.empty() ? 1 : 0);
        for (int i = 0; i < count; ++i) {
            lks_body_def def = lks_default_body_def();
            def.restitution = chance(0.3) ? fixed(between(0, 1)) : 0;
            def.mass = chance(0.3) ? fixed(between(0.01, 500)) : 0;
            def.kind = chance(0.1) ? LKS_BODY_KINEMATIC : LKS_BODY_DYNAMIC;
            def.transform.rotation = turned();
            const double size = between(0.05, 0.3);
            const lks_body_shape shapes[] = {ball_shape(size), capsule_shape(size, between(0, 0.3)),
                                             box_shape(size, between(0.05, 0.3), between(0.05, 0.3))};
            bodies_.push_back(add_body(world_, shapes[below(3)], place(0.6 * i), def));
        }
    }

    void add_object(const Asset& asset, std::uint32_t vertices) {
        const lks_object_id object = world_.add(asset, {place(between(0, 3)), turned()});
        objects_.emplace_back(object, vertices);
        if (chance(0.4)) {
            world_.pin(object, static_cast<std::uint32_t>(below(vertices)));
        }
    }
    void add_ropes() {
        for (int kinds = below(4); kinds > 0; --kinds) {
            Chain chain;
            chain.segments = 2 + static_cast<std::uint32_t>(below(50));
            chain.length = between(0.3, 3);
            chain.particle_mass = between(0.001, 0.5);
            chain.solver = chance(0.7) ? LKS_ROPE_DIRECT : LKS_ROPE_AUTOMATIC;
            if (chance(0.3)) {
                chain.stretch = soft(between(1e-7, 1e-4));
            }
            assets_.push_back(chain.build());
            for (int count = 1 + below(4); count > 0; --count) {
                add_object(assets_.back(), chain.segments + 1);
            }
        }
    }
    void add_cloth() {
        Net net;
        net.side = 4 + static_cast<std::uint32_t>(below(10));
        net.width = 1;
        net.radius = 0.01;
        assets_.push_back(net.build());
        add_object(assets_.back(), net.side * net.side);
    }

    void attach() {
        for (int count = objects_.empty() ? 0 : below(10); count > 0; --count) {
            const auto [object, vertices] = any_of(objects_);
            const std::uint32_t vertex = chance(0.5) ? 0 : static_cast<std::uint32_t>(below(vertices));
            lks_attachment_def def = to_body(object, vertex, any_of(bodies_));
            def.compliance = chance(0.3) ? fixed(between(1e-6, 1e-3)) : 0;
            lks_attachment_id id{};
            if (lks_world_add_attachment(world_, &def, &id) == LKS_OK) {
                attachments_.push_back(id);
            }
        }
    }

    // What is refused is so in all of them.
    void give_input() {
        const lks_body_id body = any_of(bodies_);
        switch (below(8)) {
        case 0:
            lks_body_apply_impulse(world_, body, fixed(between(-50, 50), between(0, 50), between(-50, 50)),
                                   place(1));
            break;
        case 1:
            lks_body_set_kind(world_, body, chance(0.3) ? LKS_BODY_KINEMATIC : LKS_BODY_DYNAMIC);
            break;
        case 2:
            if (!joints_.empty() && chance(0.3)) {
                lks_world_remove_joint(world_, any_of(joints_));
            }
            break;
        case 3:
            if (!attachments_.empty() && chance(0.5)) {
                lks_world_remove_attachment(world_, any_of(attachments_));
            }
            break;
        case 4:
            if (!objects_.empty()) {
                const auto [object, vertices] = any_of(objects_);
                lks_object_apply_impulse(world_, object, static_cast<std::uint32_t>(below(vertices)),
                                         fixed(between(-0.1, 0.1), 0.1, between(-0.1, 0.1)));
            }
            break;
        case 5:
            if (!objects_.empty() && chance(0.3)) {
                const lks_transform from{place(1), turned()};
                const lks_transform to{place(between(0, 3)), chance(0.3) ? from.rotation : turned()};
                lks_object_teleport(world_, any_of(objects_).first, &from, &to);
            }
            break;
        case 6:
            if (!objects_.empty() && chance(0.3)) {
                const lks_vec3 places[] = {place(0.9), place(1), place(1.1)};
                const auto [object, vertices] = any_of(objects_);
                lks_object_set_positions(world_, object, static_cast<std::uint32_t>(below(vertices - 2)), 3,
                                         places);
            }
            break;
        default:
            if (chance(0.2)) {
                lks_world_remove_body(world_, body);
            }
        }
    }

    std::mt19937 random_;
    World world_;
    std::vector<Asset> assets_;
    std::vector<lks_body_id> bodies_;
    std::vector<lks_joint_id> joints_;
    std::vector<std::pair<lks_object_id, std::uint32_t>> objects_;
    std::vector<lks_attachment_id> attachments_;
};

} // namespace

TEST_CASE("worlds made at random have the same bits on every instruction set, with any number of workers") {
    const std::uint32_t worlds = sanitised ? 6 : long_runs() ? 3000 : 100;
    for (std::uint32_t seed = 1; seed <= worlds; ++seed) {
        INFO("seed ", seed);
        const std::vector<std::uint64_t> expected = RandomWorld(seed, 1, LKS_SIMD_SCALAR).run();
        CHECK(RandomWorld(seed, 2 + seed % 7, LKS_SIMD_SCALAR).run() == expected);
        for (const lks_simd simd :
             {LKS_SIMD_SSE41, LKS_SIMD_AVX2, LKS_SIMD_AVX512, LKS_SIMD_NEON, LKS_SIMD_WASM}) {
            if (lks_simd_is_available(simd) != 0) {
                INFO(std::string(lks_simd_name(simd)));
                CHECK(RandomWorld(seed, 1 + seed % 4, simd).run() == expected);
            }
        }
    }
}
