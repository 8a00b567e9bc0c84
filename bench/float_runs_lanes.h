// float_runs.h over lanes: V has `width` of them.
#pragma once

#include <type_traits>

#include "float_rows_lanes.h"
#include "float_runs.h"

namespace lks_bench {
namespace {

inline void project_one(FloatRuns& cloth, std::uint32_t i, std::uint32_t a, std::uint32_t b) {
    const float x = cloth.x[a] - cloth.x[b];
    const float y = cloth.y[a] - cloth.y[b];
    const float z = cloth.z[a] - cloth.z[b];
    const float ratio = cloth.rests[i] / __builtin_sqrtf(x * x + y * y + z * z);
    const float f = (ratio < 2.0f ? ratio : 2.0f) - 1.0f;
    const float f_a = f * cloth.shares_a[i];
    const float f_b = f * cloth.shares_b[i];
    cloth.x[a] += x * f_a;
    cloth.y[a] += y * f_a;
    cloth.z[a] += z * f_a;
    cloth.x[b] -= x * f_b;
    cloth.y[b] -= y * f_b;
    cloth.z[b] -= z * f_b;
}

// Lanes from `count` on are left as they are.
template <typename V, bool equal_shares, bool whole>
inline void project_group(FloatRuns& cloth, std::uint32_t i, std::uint32_t a, std::uint32_t b,
                          std::uint32_t count) {
    using R = typename V::Register;
    float* const px = cloth.x.data();
    float* const py = cloth.y.data();
    float* const pz = cloth.z.data();
    const R xa = V::load(px + a), ya = V::load(py + a), za = V::load(pz + a);
    const R xb = V::load(px + b), yb = V::load(py + b), zb = V::load(pz + b);
    const R x = V::subtract(xa, xb), y = V::subtract(ya, yb), z = V::subtract(za, zb);
    const R u = V::multiply_add(x, x, V::multiply_add(y, y, V::multiply(z, z)));
    R f = factors_of<V>(V::load(cloth.rests.data() + i), u);
    if constexpr (!whole) {
        f = V::first(f, count);
    }
    const R f_a = V::multiply(f, V::load(cloth.shares_a.data() + i));
    R cx = V::multiply(x, f_a), cy = V::multiply(y, f_a), cz = V::multiply(z, f_a);
    V::store(px + a, V::add(xa, cx));
    V::store(py + a, V::add(ya, cy));
    V::store(pz + a, V::add(za, cz));
    if constexpr (!equal_shares) {
        const R f_b = V::multiply(f, V::load(cloth.shares_b.data() + i));
        cx = V::multiply(x, f_b);
        cy = V::multiply(y, f_b);
        cz = V::multiply(z, f_b);
    }
    V::store(px + b, V::subtract(xb, cx));
    V::store(py + b, V::subtract(yb, cy));
    V::store(pz + b, V::subtract(zb, cz));
}

// A run from its constraint i on.
template <typename V, bool equal_shares>
inline void project_run(FloatRuns& cloth, const lks::Run& run, std::uint32_t i) {
    for (; i + V::width <= run.count; i += V::width) {
        project_group<V, equal_shares, true>(cloth, run.first + i, run.a + i, run.b + i, V::width);
    }
    const std::uint32_t left = run.count - i;
    if (left != 0 && left + run.spare >= V::width) {
        project_group<V, equal_shares, false>(cloth, run.first + i, run.a + i, run.b + i, left);
        return;
    }
    if constexpr (std::is_void_v<typename V::Narrower>) {
        for (; i < run.count; ++i) {
            project_one(cloth, run.first + i, run.a + i, run.b + i);
        }
    } else {
        project_run<typename V::Narrower, equal_shares>(cloth, run, i);
    }
}

template <typename V, bool equal_shares>
inline void project_batch(FloatRuns& cloth, const FloatBatch& batch) {
    for (const lks::Run& run : batch.runs) {
        project_run<V, equal_shares>(cloth, run, 0);
    }
    for (std::uint32_t i = batch.first_single; i < batch.end; ++i) {
        project_one(cloth, i, cloth.constraints[i].a, cloth.constraints[i].b);
    }
}

template <typename V>
inline void project_all(FloatRuns& cloth) {
    if (is_in_rows(cloth)) {
        project_rows<typename V::OfRows>(cloth);
        return;
    }
    for (const FloatBatch& batch : cloth.batches) {
        if (batch.equal_shares) {
            project_batch<V, true>(cloth, batch);
        } else {
            project_batch<V, false>(cloth, batch);
        }
    }
}

// For the compiler to make vectors of.
inline void predict_axis(float* x, float* start, const float* moving, std::size_t count, float fall) {
    for (std::size_t i = 0; i < count; ++i) {
        const float before = x[i];
        x[i] = before + moving[i] * (before - start[i] + fall);
        start[i] = before;
    }
}

inline void predict_all(FloatRuns& cloth, float fall) {
    if (is_in_rows(cloth)) {
        predict_rows(cloth, fall);
        return;
    }
    const std::size_t count = cloth.count;
    predict_axis(cloth.x.data(), cloth.start_x.data(), cloth.moving.data(), count, 0);
    predict_axis(cloth.y.data(), cloth.start_y.data(), cloth.moving.data(), count, fall);
    predict_axis(cloth.z.data(), cloth.start_z.data(), cloth.moving.data(), count, 0);
}

template <typename V>
inline void push_out_all(FloatRuns& cloth, const FloatSphere& sphere) {
    using R = typename V::Register;
    if (is_in_rows(cloth)) {
        push_out_rows<typename V::OfRows>(cloth, sphere);
        return;
    }
    for (std::uint32_t i = 0; i < cloth.count; i += V::width) {
        float* const px = cloth.x.data() + i;
        float* const py = cloth.y.data() + i;
        float* const pz = cloth.z.data() + i;
        const R x0 = V::load(px), y0 = V::load(py), z0 = V::load(pz);
        const R x = V::subtract(x0, V::set(sphere.x));
        const R y = V::subtract(y0, V::set(sphere.y));
        const R z = V::subtract(z0, V::set(sphere.z));
        const R u = V::multiply_add(x, x, V::multiply_add(y, y, V::multiply(z, z)));
        const R inside = V::multiply(inside_of<V>(u, sphere.radius), V::load(cloth.moving.data() + i));
        V::store(px, V::subtract(x0, V::multiply(x, inside)));
        V::store(py, V::subtract(y0, V::multiply(y, inside)));
        V::store(pz, V::subtract(z0, V::multiply(z, inside)));
    }
}

} // namespace
} // namespace lks_bench
