#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "sections.h"

namespace lks_bench {
namespace {

constexpr std::uint32_t segments = 99;
constexpr double length = 2;

// One rope that is pinned at one end and let go level, its other end 1 or 10,000 times as heavy as a point.
class Swing {
public:
    Swing(std::string variant, double ratio, std::uint32_t substeps, std::uint32_t solver)
        : name(std::move(variant)), substeps_(substeps) {
        std::vector<double> masses(segments + 1, 0.01);
        masses.back() *= ratio;
        lks_rope_def rope = lks_default_rope_def();
        rope.segments = segments;
        rope.length = length;
        rope.linear_density = 0;
        rope.vertex_masses = masses.data();
        rope.bend = {};
        rope.solver = solver;
        lks_asset_create_rope(&rope, &asset_);
        lks_world_def def = lks_default_world_def();
        def.substeps = substeps;
        lks_world_create(&def, &world_);
        lks_object_def object = lks_default_object_def();
        object.asset = asset_;
        lks_world_add_object(world_, &object, &object_);
        lks_object_pin(world_, object_, 0);
    }
    Swing(Swing&& other) noexcept
        : name(std::move(other.name)), substeps_(other.substeps_), asset_(other.asset_), world_(other.world_),
          object_(other.object_) {
        other.asset_ = nullptr;
        other.world_ = nullptr;
    }
    ~Swing() {
        lks_world_destroy(world_);
        lks_asset_release(asset_);
    }

    void tick() {
        const auto start = std::chrono::steady_clock::now();
        lks_world_step(world_);
        const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
        times_.push_back(taken.count() / (segments * substeps_));
        std::vector<lks_vec3> positions(segments + 1);
        lks_object_positions(world_, object_, 0, segments + 1, positions.data());
        for (std::uint32_t i = 0; i < segments; ++i) {
            const auto along = [&](lks_fixed a, lks_fixed b) { return lks_fixed_to_double(b - a); };
            const lks_vec3& p = positions[i];
            const lks_vec3& q = positions[i + 1];
            const double now = std::hypot(along(p.x, q.x), along(p.y, q.y), along(p.z, q.z));
            worst_ = std::max(worst_, std::abs(now * segments / length - 1));
        }
    }

    // The median of a tick's nanoseconds a segment and substep.
    double nanoseconds() {
        std::nth_element(times_.begin(), times_.begin() + static_cast<std::ptrdiff_t>(times_.size() / 2),
                         times_.end());
        return times_[times_.size() / 2];
    }
    double worst_stretch() const { return worst_; }

    std::string name;

private:
    std::uint32_t substeps_;
    lks_asset* asset_ = nullptr;
    lks_world* world_ = nullptr;
    lks_object_id object_{};
    std::vector<double> times_;
    double worst_ = 0;
};

void measure_swings(double ratio, const char* measured, int ticks, Results& results) {
    std::vector<Swing> swings;
    for (const std::uint32_t substeps : {4u, 10u, 20u, 40u}) {
        const std::string end = std::to_string(substeps) + " substeps";
        swings.emplace_back("swept, " + end, ratio, substeps, LKS_ROPE_SWEPT);
        swings.emplace_back("at once, " + end, ratio, substeps, LKS_ROPE_DIRECT);
    }
    for (int tick = 0; tick < ticks; ++tick) {
        for (Swing& swing : swings) {
            swing.tick();
        }
    }
    for (std::size_t i = 0; i < swings.size(); ++i) {
        const double nanoseconds = swings[i].nanoseconds();
        const double swept = swings[i - i % 2].nanoseconds();
        results.push_back({ropes_name, std::string("tick a segment, ") + measured, swings[i].name,
                           nanoseconds, "ns", nanoseconds / swept});
        results.push_back({ropes_name, std::string("worst stretch, ") + measured, swings[i].name,
                           swings[i].worst_stretch(), ""});
    }
}

} // namespace

void measure_ropes(int rounds, Results& results) {
    // Three seconds, but where a quick look is asked for.
    constexpr int enough_rounds = 21;
    const int ticks = rounds < enough_rounds ? 3 * rounds : 180;
    measure_swings(1, "1:1", ticks, results);
    measure_swings(1e4, "1:10,000", ticks, results);
}

} // namespace lks_bench
