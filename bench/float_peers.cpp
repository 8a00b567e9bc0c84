#include "float_peers.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "float_runs.h"
#include "peer_check.h"
#include "plain_float.h"
#include "spheres.h"

namespace lks_bench {
namespace {

constexpr const char* coloured_name = "float32 plain, coloured";
constexpr const char* indexed_name = "float32 plain, by index";

std::vector<const FloatKernel*> float_kernels() {
    std::vector<const FloatKernel*> found = {&float_runs_scalar};
#if defined(LKS_BENCH_X86)
    if (lks_simd_is_available(LKS_SIMD_AVX2) != 0) {
        found.push_back(&float_runs_avx2);
    }
    if (lks_simd_is_available(LKS_SIMD_AVX512) != 0) {
        found.push_back(&float_runs_avx512);
    }
#endif
    return found;
}

// g·h² in metres.
float fall_of(const Workload& workload) {
    const double h = 1.0 / 60 / workload.substeps;
    return static_cast<float>(-9.81 * h * h);
}

// Whether a kernel comes in ten passes to what double precision comes to.
void demand_right(const FloatRuns& cloth, const FloatKernel& kernel) {
    FloatRuns work = cloth;
    std::vector<double> x, y, z;
    // A little out of place, so that there is something to correct.
    for (std::uint32_t i = 0; i < work.count; ++i) {
        const float jitter = 1e-3f * static_cast<float>(i * 2654435761u >> 24) / 256.0f;
        const Point rest = place_of(cloth, i);
        put(work, i, {rest.x + jitter, rest.y - jitter, rest.z + jitter});
        const Point place = place_of(work, i);
        x.push_back(place.x), y.push_back(place.y), z.push_back(place.z);
    }
    for (int pass = 0; pass < 10; ++pass) {
        kernel.project(work);
        project_double(cloth, x, y, z);
    }
    double worst = 0;
    double sum = 0; // not a number where one is not, which a maximum would pass over
    for (std::uint32_t i = 0; i < work.count; ++i) {
        const Point place = place_of(work, i);
        for (const double off : {x[i] - place.x, y[i] - place.y, z[i] - place.z}) {
            worst = std::fmax(worst, std::abs(off));
            sum += off;
        }
    }
    // Rounding brings up to 3e-7, a constraint left out at the end of each batch 1e-5.
    if (!(worst < 1e-6) || std::isnan(sum)) {
        std::fprintf(stderr, "lockstitch: the benchmark's %s is %g m from what double precision comes to.\n",
                     kernel.name, worst);
        std::exit(1);
    }
}

void demand_masses(const lks_asset& asset, const FloatKernel& kernel) {
    FloatRuns body = make_float_runs(asset, {});
    for (std::uint32_t i = 0; i < body.count; ++i) {
        put(body, i, out_of_place(place_of(body, i)));
    }
    const std::vector<Point> before = points_of(body);
    kernel.project(body);
    demand_centre_kept(asset, kernel.name, before, points_of(body));
}

void demand_masses(const lks_asset& asset, EdgeOrder order) {
    FloatCloth body = make_float_cloth(asset, {}, order);
    put_out_of_place(body);
    const std::vector<Point> before = points_of(body);
    project_float(body);
    demand_centre_kept(asset, order == EdgeOrder::by_colour ? coloured_name : indexed_name, before,
                       points_of(body));
}

class Runs final : public Variant {
public:
    Runs(const Workload& workload, const FloatKernel& kernel)
        : kernel_(kernel), substeps_(workload.substeps), iterations_(workload.iterations),
          fall_(fall_of(workload)), spheres_(spheres_of(workload)) {
        const WorkloadAsset asset(workload);
        FloatRuns one = make_float_runs(*asset.get(), asset.pinned());
        demand_right(one, kernel);
        demand_masses(*asset.get(), kernel);
        if (workload.colliders) {
            lay_level(one);
        }
        objects_.assign(workload.objects, one);
        for (std::uint32_t i = 0; i < workload.warm_ticks; ++i) {
            tick();
        }
    }

    void project() override {
        for (FloatRuns& object : objects_) {
            for (std::uint32_t pass = 0; pass < substeps_ * iterations_; ++pass) {
                kernel_.project(object);
            }
        }
    }
    void tick() override {
        for (std::size_t i = 0; i < objects_.size(); ++i) {
            FloatRuns& object = objects_[i];
            for (std::uint32_t substep = 0; substep < substeps_; ++substep) {
                kernel_.predict(object, fall_);
                for (std::uint32_t iteration = 0; iteration < iterations_; ++iteration) {
                    kernel_.project(object);
                }
                for (const FloatSphere& sphere : spheres_[i]) {
                    kernel_.push_out(object, sphere);
                }
            }
        }
    }
    std::vector<Point> points() const override { return points_of(objects_.front()); }

private:
    const FloatKernel& kernel_;
    std::uint32_t substeps_;
    std::uint32_t iterations_;
    float fall_;
    std::vector<std::vector<FloatSphere>> spheres_;
    std::vector<FloatRuns> objects_;
};

class Plain final : public Variant {
public:
    Plain(const Workload& workload, EdgeOrder order)
        : substeps_(workload.substeps), iterations_(workload.iterations), fall_(fall_of(workload)),
          spheres_(spheres_of(workload)) {
        const WorkloadAsset asset(workload);
        demand_masses(*asset.get(), order);
        FloatCloth one = make_float_cloth(*asset.get(), asset.pinned(), order);
        if (workload.colliders) {
            lay_level(one);
        }
        objects_.assign(workload.objects, one);
        for (std::uint32_t i = 0; i < workload.warm_ticks; ++i) {
            tick();
        }
    }

    void project() override {
        for (FloatCloth& object : objects_) {
            for (std::uint32_t pass = 0; pass < substeps_ * iterations_; ++pass) {
                project_float(object);
            }
        }
    }
    void tick() override {
        for (std::size_t i = 0; i < objects_.size(); ++i) {
            FloatCloth& object = objects_[i];
            for (std::uint32_t substep = 0; substep < substeps_; ++substep) {
                predict_float(object, fall_);
                for (std::uint32_t iteration = 0; iteration < iterations_; ++iteration) {
                    project_float(object);
                }
                for (const FloatSphere& sphere : spheres_[i]) {
                    push_out_float(object, sphere);
                }
            }
        }
    }
    std::vector<Point> points() const override { return points_of(objects_.front()); }

private:
    std::uint32_t substeps_;
    std::uint32_t iterations_;
    float fall_;
    std::vector<std::vector<FloatSphere>> spheres_;
    std::vector<FloatCloth> objects_;
};

} // namespace

std::vector<std::string> float_peer_names() {
    std::vector<std::string> names;
    for (const FloatKernel* kernel : float_kernels()) {
        names.emplace_back(kernel->name);
    }
    names.emplace_back(coloured_name);
    names.emplace_back(indexed_name);
    return names;
}

std::unique_ptr<Variant> make_float_peer(const Workload& workload, const std::string& name) {
    for (const FloatKernel* kernel : float_kernels()) {
        if (name == kernel->name) {
            return std::make_unique<Runs>(workload, *kernel);
        }
    }
    return std::make_unique<Plain>(workload,
                                   name == coloured_name ? EdgeOrder::by_colour : EdgeOrder::by_index);
}

} // namespace lks_bench
