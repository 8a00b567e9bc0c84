#include "float_runs.h"

#include "float_runs_lanes.h"
#include "masses.h"

namespace lks_bench {

FloatRuns make_float_runs(const lks_asset& asset, const std::vector<std::uint32_t>& pinned_vertices) {
    constexpr float metre = 1.0f / 72057594037927936.0f; // 2^-56
    const std::size_t padding = lks::widest_group;
    FloatRuns cloth;
    for (std::uint32_t particle = 0; particle < asset.vertex_count(); ++particle) {
        const lks::Coordinates& p = asset.rest_positions[particle];
        cloth.x.push_back(static_cast<float>(p.x) * metre);
        cloth.y.push_back(static_cast<float>(p.y) * metre);
        cloth.z.push_back(static_cast<float>(p.z) * metre);
        cloth.vertices.push_back(asset.particle_to_vertex[particle]);
    }
    cloth.inverse_masses = inverse_masses_of(asset, pinned_vertices);
    for (const double inverse_mass : cloth.inverse_masses) {
        cloth.moving.push_back(inverse_mass > 0 ? 1.0f : 0.0f);
    }
    for (std::uint32_t i = 0; i < asset.constraint_count(); ++i) {
        const lks::Constraint ends = asset.constraints[i];
        const double a = cloth.inverse_masses[ends.a];
        const double b = cloth.inverse_masses[ends.b];
        const auto share = [&](double own) { return own > 0 ? static_cast<float>(own / (a + b)) : 0.0f; };
        cloth.constraints.push_back(ends);
        cloth.rests.push_back(static_cast<float>(asset.rest_lengths[i]) * metre);
        cloth.shares_a.push_back(share(a));
        cloth.shares_b.push_back(share(b));
    }
    for (const lks::Batch& batch : asset.batches) {
        FloatBatch& made = cloth.batches.emplace_back();
        made.runs.assign(asset.runs.data() + batch.first_run,
                         asset.runs.data() + batch.first_run + batch.run_count);
        for (std::uint32_t i = batch.first_single; i < batch.first + batch.count; ++i) {
            made.singles.push_back(i);
        }
        for (std::uint32_t i = batch.first; i < batch.first + batch.count; ++i) {
            made.equal_shares = made.equal_shares && cloth.shares_a[i] == cloth.shares_b[i];
        }
    }
    for (std::vector<float>* values :
         {&cloth.x, &cloth.y, &cloth.z, &cloth.rests, &cloth.shares_a, &cloth.shares_b}) {
        values->resize(values->size() + padding, 1.0f);
    }
    cloth.moving.resize(cloth.moving.size() + padding, 0.0f);
    cloth.count = asset.vertex_count();
    cloth.start_x = cloth.x;
    cloth.start_y = cloth.y;
    cloth.start_z = cloth.z;
    return cloth;
}

void lay_level(FloatRuns& cloth) {
    cloth.y.swap(cloth.z);
    for (float& y : cloth.y) {
        y = -y;
    }
    cloth.start_y = cloth.y;
    cloth.start_z = cloth.z;
}

std::vector<Point> points_of(const FloatRuns& cloth) {
    std::vector<Point> found(cloth.vertices.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        found[cloth.vertices[i]] = {cloth.x[i], cloth.y[i], cloth.z[i]};
    }
    return found;
}

void project_double(const FloatRuns& cloth, std::vector<double>& x, std::vector<double>& y,
                    std::vector<double>& z) {
    for (std::size_t i = 0; i < cloth.constraints.size(); ++i) {
        const auto [a, b] = cloth.constraints[i];
        const double dx = x[a] - x[b], dy = y[a] - y[b], dz = z[a] - z[b];
        const double ratio = cloth.rests[i] / __builtin_sqrt(dx * dx + dy * dy + dz * dz);
        const double f = (ratio < 2 ? ratio : 2) - 1;
        const double sum = cloth.inverse_masses[a] + cloth.inverse_masses[b];
        const double f_a = sum > 0 ? f * cloth.inverse_masses[a] / sum : 0;
        const double f_b = sum > 0 ? f * cloth.inverse_masses[b] / sum : 0;
        x[a] += dx * f_a, y[a] += dy * f_a, z[a] += dz * f_a;
        x[b] -= dx * f_b, y[b] -= dy * f_b, z[b] -= dz * f_b;
    }
}

namespace {

void project_scalar(FloatRuns& cloth) {
    for (const FloatBatch& batch : cloth.batches) {
        for (const lks::Run& run : batch.runs) {
            for (std::uint32_t i = 0; i < run.count; ++i) {
                project_one(cloth, run.first + i, run.a + i, run.b + i);
            }
        }
        for (const std::uint32_t i : batch.singles) {
            project_one(cloth, i, cloth.constraints[i].a, cloth.constraints[i].b);
        }
    }
}

void push_out_scalar(FloatRuns& cloth, const FloatSphere& sphere) {
    for (std::uint32_t i = 0; i < cloth.count; ++i) {
        const float x = cloth.x[i] - sphere.x;
        const float y = cloth.y[i] - sphere.y;
        const float z = cloth.z[i] - sphere.z;
        const float square = x * x + y * y + z * z;
        if (square < sphere.radius * sphere.radius && square > 0) {
            const float factor = cloth.moving[i] * (sphere.radius / __builtin_sqrtf(square) - 1);
            cloth.x[i] += x * factor;
            cloth.y[i] += y * factor;
            cloth.z[i] += z * factor;
        }
    }
}

} // namespace

const FloatKernel float_runs_scalar = {"float32 runs, scalar", project_scalar, predict_all, push_out_scalar};

} // namespace lks_bench
