#include "float_runs.h"

#include "float_rows_lanes.h"
#include "float_runs_lanes.h"
#include "masses.h"
#include "memory_count.h"

namespace lks_bench {
namespace {

Floats rows_of(const Floats& x, const Floats& y, const Floats& z) {
    Floats rows;
    for (std::size_t i = 0; i < x.size(); ++i) {
        rows.insert(rows.end(), {x[i], y[i], z[i], 0.0f});
    }
    return rows;
}

void put_in_rows(FloatRuns& cloth) {
    cloth.rows = rows_of(cloth.x, cloth.y, cloth.z);
    cloth.rows[float_row * cloth.count] = 0; // away from the next one
    cloth.start_rows = cloth.rows;
    cloth.moving_rows = rows_of(cloth.moving, cloth.moving, cloth.moving);
    for (const lks::Constraint& ends : cloth.constraints) {
        cloth.places.push_back({float_row * ends.a, float_row * ends.b});
    }
    for (Floats* axis : {&cloth.x, &cloth.y, &cloth.z}) {
        axis->clear();
    }
}

} // namespace

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
        made.first = batch.first;
        made.first_single = batch.first_single;
        made.end = batch.first + batch.count;
        for (std::uint32_t i = batch.first; i < made.end; ++i) {
            made.equal_shares = made.equal_shares && cloth.shares_a[i] == cloth.shares_b[i];
        }
    }
    for (Floats* values : {&cloth.x, &cloth.y, &cloth.z, &cloth.rests, &cloth.shares_a, &cloth.shares_b}) {
        values->resize(values->size() + padding, 1.0f);
    }
    cloth.moving.resize(cloth.moving.size() + padding, 0.0f);
    cloth.count = asset.vertex_count();
    if (share_in_runs(asset) < 0.5) {
        put_in_rows(cloth);
    }
    cloth.start_x = cloth.x;
    cloth.start_y = cloth.y;
    cloth.start_z = cloth.z;
    return cloth;
}

Point place_of(const FloatRuns& cloth, std::uint32_t particle) {
    if (is_in_rows(cloth)) {
        const float* row = cloth.rows.data() + float_row * particle;
        return {row[0], row[1], row[2]};
    }
    return {cloth.x[particle], cloth.y[particle], cloth.z[particle]};
}

void put(FloatRuns& cloth, std::uint32_t particle, const Point& place) {
    const auto x = static_cast<float>(place.x);
    const auto y = static_cast<float>(place.y);
    const auto z = static_cast<float>(place.z);
    if (is_in_rows(cloth)) {
        float* row = cloth.rows.data() + float_row * particle;
        row[0] = x, row[1] = y, row[2] = z;
    } else {
        cloth.x[particle] = x, cloth.y[particle] = y, cloth.z[particle] = z;
    }
}

void lay_level(FloatRuns& cloth) {
    for (std::uint32_t particle = 0; particle < cloth.count; ++particle) {
        const Point upright = place_of(cloth, particle);
        put(cloth, particle, {upright.x, -upright.z, upright.y});
    }
    cloth.start_y = cloth.y;
    cloth.start_z = cloth.z;
    cloth.start_rows = cloth.rows;
}

std::vector<Point> points_of(const FloatRuns& cloth) {
    std::vector<Point> found(cloth.vertices.size());
    for (std::uint32_t particle = 0; particle < cloth.count; ++particle) {
        found[cloth.vertices[particle]] = place_of(cloth, particle);
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
    if (is_in_rows(cloth)) {
        for (std::uint32_t i = 0; i < cloth.constraints.size(); ++i) {
            project_one_in_rows(cloth, i);
        }
        return;
    }
    for (const FloatBatch& batch : cloth.batches) {
        for (const lks::Run& run : batch.runs) {
            for (std::uint32_t i = 0; i < run.count; ++i) {
                project_one(cloth, run.first + i, run.a + i, run.b + i);
            }
        }
        for (std::uint32_t i = batch.first_single; i < batch.end; ++i) {
            project_one(cloth, i, cloth.constraints[i].a, cloth.constraints[i].b);
        }
    }
}

void push_out_one(const FloatSphere& sphere, float moving, float& px, float& py, float& pz) {
    const float x = px - sphere.x;
    const float y = py - sphere.y;
    const float z = pz - sphere.z;
    const float square = x * x + y * y + z * z;
    if (square < sphere.radius * sphere.radius && square > 0) {
        const float factor = moving * (sphere.radius / __builtin_sqrtf(square) - 1);
        px += x * factor;
        py += y * factor;
        pz += z * factor;
    }
}

void push_out_scalar(FloatRuns& cloth, const FloatSphere& sphere) {
    for (std::uint32_t i = 0; i < cloth.count; ++i) {
        if (is_in_rows(cloth)) {
            float* row = cloth.rows.data() + float_row * i;
            push_out_one(sphere, cloth.moving[i], row[0], row[1], row[2]);
        } else {
            push_out_one(sphere, cloth.moving[i], cloth.x[i], cloth.y[i], cloth.z[i]);
        }
    }
}

} // namespace

const FloatKernel float_runs_scalar = {"float32 runs, scalar", project_scalar, predict_all, push_out_scalar};

} // namespace lks_bench
