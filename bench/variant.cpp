#include "variant.h"

#include "bullet_peer.h"
#include "float_peers.h"
#include "projections.h"

namespace lks_bench {
namespace {

class Ours final : public Variant {
public:
    Ours(const Workload& workload, lks_simd simd, std::uint32_t workers)
        : world_(workload, simd, workers), projections_(world_.world()),
          passes_(workload.substeps * workload.iterations) {}

    void project() override {
        projections_.run(passes_);
        projections_.restore();
    }
    void tick() override { lks_world_step(world_.world()); }
    std::vector<Point> points() const override {
        const lks::Object& object = *world_.world()->objects[0].object;
        constexpr double metre = 1.0 / 72057594037927936.0; // 2^-56
        std::vector<Point> found(object.count());
        for (std::uint32_t particle = 0; particle < object.count(); ++particle) {
            found[object.asset().particle_to_vertex[particle]] = {
                static_cast<double>(object.axis(0)[particle]) * metre,
                static_cast<double>(object.axis(1)[particle]) * metre,
                static_cast<double>(object.axis(2)[particle]) * metre};
        }
        return found;
    }

private:
    mutable BenchWorld world_;
    Projections projections_;
    std::uint32_t passes_;
};

} // namespace

std::vector<lks_simd> available_levels() {
    std::vector<lks_simd> levels;
    for (int level = LKS_SIMD_SCALAR; level <= LKS_SIMD_WASM; ++level) {
        if (lks_simd_is_available(static_cast<lks_simd>(level)) != 0) {
            levels.push_back(static_cast<lks_simd>(level));
        }
    }
    return levels;
}

std::vector<std::string> variant_names(const Workload& workload) {
    std::vector<std::string> names = our_names();
    // The peers know neither compliance nor damping.
    if (workload.compliance != 0) {
        return names;
    }
    for (const std::string& name : float_peer_names()) {
        names.push_back(name);
    }
    if (has_bullet()) {
        names.emplace_back(bullet_name);
    }
    return names;
}

std::vector<std::string> our_names() {
    std::vector<std::string> names;
    for (const lks_simd level : available_levels()) {
        names.emplace_back(lks_simd_name(level));
    }
    return names;
}

std::string with_two_workers(const std::string& name) {
    return name + ", 2 workers";
}

std::unique_ptr<Variant> make_variant(const Workload& workload, const std::string& name) {
    for (const lks_simd level : available_levels()) {
        const std::string ours = lks_simd_name(level);
        if (name == ours || name == with_two_workers(ours)) {
            return std::make_unique<Ours>(workload, level, name == ours ? 1 : 2);
        }
    }
    return name == bullet_name ? make_bullet_peer(workload) : make_float_peer(workload, name);
}

} // namespace lks_bench
