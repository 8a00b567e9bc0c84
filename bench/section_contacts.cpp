#include <lockstitch/lockstitch.h>

#include <cmath>
#include <memory>
#include <vector>

#include "demand.h"
#include "measure.h"
#include "sections.h"
#include "variant.h"

namespace lks_bench {
namespace {

constexpr lks_fixed hundredths(int count) {
    return LKS_FIXED_RATIO(count, 100);
}

lks_rotation turn_about_x(double degrees) {
    const double half = degrees * std::acos(-1.0) / 360;
    const double one = 1 << 30;
    return {static_cast<std::int32_t>(std::lround(one * std::sin(half))), 0, 0,
            static_cast<std::int32_t>(std::lround(one * std::cos(half)))};
}

lks_collider_def solid(lks_shape_kind kind) {
    lks_collider_def def = lks_default_collider_def();
    def.shape = kind;
    return def;
}
lks_collider_def ball(int radius) {
    lks_collider_def def = solid(LKS_SHAPE_SPHERE);
    def.radius = hundredths(radius);
    def.transform.position.y = -hundredths(radius + 1);
    return def;
}
lks_collider_def capsule(int radius, int half_length, int x, int y, int z) {
    lks_collider_def def = solid(LKS_SHAPE_CAPSULE);
    def.radius = hundredths(radius);
    def.half_length = hundredths(half_length);
    def.transform.position = {hundredths(x), hundredths(y), hundredths(z)};
    def.transform.rotation = turn_about_x(90);
    return def;
}

// What the cloth lies on.
struct Support {
    const char* name;
    std::vector<lks_collider_def> colliders;
    bool turning; // a little in each tick, there and back
};

std::vector<Support> supports() {
    lks_collider_def plane = solid(LKS_SHAPE_PLANE);
    plane.transform.position.y = -hundredths(1);
    lks_collider_def box = solid(LKS_SHAPE_BOX);
    box.half_extents = {hundredths(500), hundredths(100), hundredths(500)};
    box.transform.position.y = -hundredths(101);
    std::vector<lks_collider_def> limbs;
    limbs.reserve(15);
    for (int i = 0; i < 15; ++i) {
        limbs.push_back(capsule(8, 20, 40 * (i % 5) - 80, -10, 60 * (i / 5) - 60));
    }
    return {{"nothing, without weight", {}, false},
            {"plane", {plane}, false},
            {"ball of 20 m", {ball(2000)}, false},
            {"box", {box}, false},
            {"capsule of 15 m", {capsule(1500, 500, 0, -1501, 0)}, false},
            {"in part on a ball of 50 cm", {ball(50)}, false},
            {"15 capsules that turn", limbs, true}};
}

// A cloth that was laid down flat on something 40 ticks ago.
class LyingCloth {
public:
    LyingCloth(const WorkloadAsset& asset, const Support& support, lks_simd simd) : support_(support) {
        lks_world_def def = lks_default_world_def();
        def.simd = static_cast<std::uint32_t>(simd);
        lks_error error{};
        def.error = &error;
        demand(lks_world_create(&def, &world_), "a world", error.message);
        lks_object_def object_def = lks_default_object_def();
        object_def.asset = asset.get();
        object_def.transform.rotation = turn_about_x(90);
        object_def.gravity_factor = support.colliders.empty() ? 0 : object_def.gravity_factor;
        lks_object_id object{};
        demand(lks_world_add_object(world_, &object_def, &object), "a cloth",
               lks_world_last_error(world_)->message);
        for (const lks_collider_def& collider : support.colliders) {
            demand(lks_world_add_collider(world_, &collider, &colliders_.emplace_back()), "a collider",
                   lks_world_last_error(world_)->message);
        }
        for (int i = 0; i < 40; ++i) {
            step();
        }
    }
    ~LyingCloth() { lks_world_destroy(world_); }
    LyingCloth(const LyingCloth&) = delete;
    LyingCloth& operator=(const LyingCloth&) = delete;

    void step() {
        ++tick_;
        for (std::size_t i = 0; support_.turning && i < colliders_.size(); ++i) {
            lks_transform to = support_.colliders[i].transform;
            to.rotation = turn_about_x(90 + (tick_ % 2 == 0 ? 3 : -3));
            demand(lks_collider_move_to(world_, colliders_[i], to), "a motion",
                   lks_world_last_error(world_)->message);
        }
        lks_world_step(world_);
    }

private:
    const Support& support_;
    lks_world* world_ = nullptr;
    std::vector<lks_collider_id> colliders_;
    int tick_ = 0;
};

} // namespace

void measure_contacts(int rounds, Results& results) {
    const WorkloadAsset asset(*find_workload("cloth_64"));
    for (const Support& support : supports()) {
        std::vector<std::unique_ptr<LyingCloth>> cloths;
        std::vector<Contender> contenders;
        for (const lks_simd level : available_levels()) {
            cloths.push_back(std::make_unique<LyingCloth>(asset, support, level));
            contenders.push_back({lks_simd_name(level), [cloth = cloths.back().get()] { cloth->step(); }});
        }
        for (const Measurement& m : measure_in_turns(contenders, rounds)) {
            results.push_back(
                {contacts_name, support.name, m.name, m.nanoseconds / 1e6, "ms", m.ratio, m.least / 1e6});
        }
    }
}

} // namespace lks_bench
