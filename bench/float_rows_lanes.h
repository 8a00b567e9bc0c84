// float_runs.h in rows over lanes: whole rows are loaded, subtracted and moved, and only the squares of
// lengths and what follows from them go one constraint a lane. Register k of a group's four holds the rows of
// constraints k, k + 4 and so on, each in its quarter.
#pragma once

#include "float_runs.h"

namespace lks_bench {
namespace {

inline void project_one_in_rows(FloatRuns& cloth, std::uint32_t i) {
    float* const a = cloth.rows.data() + cloth.places[i].a;
    float* const b = cloth.rows.data() + cloth.places[i].b;
    const float x = a[0] - b[0];
    const float y = a[1] - b[1];
    const float z = a[2] - b[2];
    const float ratio = cloth.rests[i] / __builtin_sqrtf(x * x + y * y + z * z);
    const float f = (ratio < 2.0f ? ratio : 2.0f) - 1.0f;
    const float f_a = f * cloth.shares_a[i];
    const float f_b = f * cloth.shares_b[i];
    a[0] += x * f_a;
    a[1] += y * f_a;
    a[2] += z * f_a;
    b[0] -= x * f_b;
    b[1] -= y * f_b;
    b[2] -= z * f_b;
}

// 1/√u, y0·(3/2 − u/2·y0²).
template <typename V>
inline typename V::Register inverse_of_root(typename V::Register u) {
    using R = typename V::Register;
    const R y0 = V::reciprocal_sqrt_estimate(u);
    const R half_u = V::multiply(u, V::set(-0.5f));
    return V::multiply(y0, V::multiply_add(V::multiply(half_u, y0), y0, V::set(1.5f)));
}

// What a difference of square u is moved by, of itself.
template <typename V>
inline typename V::Register factors_of(typename V::Register rests, typename V::Register u) {
    const typename V::Register ratio = V::least(V::multiply(rests, inverse_of_root<V>(u)), V::set(2.0f));
    return V::subtract(ratio, V::set(1.0f));
}

// The same out of a sphere, negated; nothing outside, where the ratio is below one.
template <typename V>
inline typename V::Register inside_of(typename V::Register u, float radius) {
    const typename V::Register ratio = V::multiply(V::set(-radius), inverse_of_root<V>(u));
    return V::least(V::add(ratio, V::set(1.0f)), V::set(0.0f));
}

// Of rows, one a lane.
template <typename V>
inline typename V::Register squares_of(const typename V::Register (&rows)[4]) {
    using R = typename V::Register;
    const auto pair = [](R even, R odd) {
        const R xy = V::unpack_low(even, odd);
        const R z0 = V::unpack_high(even, odd);
        return V::multiply_add(xy, xy, V::multiply(z0, z0));
    };
    const R first = pair(rows[0], rows[1]);
    const R second = pair(rows[2], rows[3]);
    return V::add(V::low_halves(first, second), V::high_halves(first, second));
}

template <typename V, int k>
inline void move_row(float* rows, const lks::Constraint* places, typename V::Register a,
                     typename V::Register b, typename V::Register difference, typename V::Register f_a,
                     typename V::Register f_b) {
    V::store_rows(rows, &places[k].a, V::multiply_add(difference, V::template spread<k>(f_a), a));
    V::store_rows(rows, &places[k].b, V::subtract_product(difference, V::template spread<k>(f_b), b));
}

// Constraints from i on with their ends; those from `count` on do not move.
template <typename V, bool equal_shares, bool whole>
inline void project_group_in_rows(FloatRuns& cloth, std::uint32_t i, const lks::Constraint* places,
                                  std::uint32_t count) {
    using R = typename V::Register;
    float* const rows = cloth.rows.data();
    R a[4], b[4], difference[4];
    for (int k = 0; k < 4; ++k) {
        a[k] = V::load_rows(rows, &places[k].a);
        b[k] = V::load_rows(rows, &places[k].b);
        difference[k] = V::subtract(a[k], b[k]);
    }
    R f = factors_of<V>(V::load(cloth.rests.data() + i), squares_of<V>(difference));
    if constexpr (!whole) {
        f = V::first(f, count);
    }
    const R f_a = V::multiply(f, V::load(cloth.shares_a.data() + i));
    const R f_b = equal_shares ? f_a : V::multiply(f, V::load(cloth.shares_b.data() + i));
    move_row<V, 0>(rows, places, a[0], b[0], difference[0], f_a, f_b);
    move_row<V, 1>(rows, places, a[1], b[1], difference[1], f_a, f_b);
    move_row<V, 2>(rows, places, a[2], b[2], difference[2], f_a, f_b);
    move_row<V, 3>(rows, places, a[3], b[3], difference[3], f_a, f_b);
}

// What is left of a batch; lanes without a constraint are between two rows behind the particles'.
template <typename V, bool equal_shares>
inline void project_rest_in_rows(FloatRuns& cloth, std::uint32_t i, std::uint32_t count) {
    lks::Constraint places[V::width];
    for (std::uint32_t lane = 0; lane < V::width; ++lane) {
        places[lane] = lane < count ? cloth.places[i + lane]
                                    : lks::Constraint{float_row * cloth.count, float_row * (cloth.count + 1)};
    }
    project_group_in_rows<V, equal_shares, false>(cloth, i, places, count);
}

template <typename V, bool equal_shares>
inline void project_batch_in_rows(FloatRuns& cloth, const FloatBatch& batch) {
    std::uint32_t i = batch.first;
    for (; i + V::width <= batch.end; i += V::width) {
        project_group_in_rows<V, equal_shares, true>(cloth, i, cloth.places.data() + i, V::width);
    }
    if (i < batch.end) {
        project_rest_in_rows<V, equal_shares>(cloth, i, batch.end - i);
    }
}

template <typename V>
inline void project_rows(FloatRuns& cloth) {
    for (const FloatBatch& batch : cloth.batches) {
        if (batch.equal_shares) {
            project_batch_in_rows<V, true>(cloth, batch);
        } else {
            project_batch_in_rows<V, false>(cloth, batch);
        }
    }
}

// For the compiler to make vectors of.
inline void predict_rows(FloatRuns& cloth, float fall) {
    constexpr std::size_t together = 4 * float_row;
    const float falls[together] = {0, fall, 0, 0, 0, fall, 0, 0, 0, fall, 0, 0, 0, fall, 0, 0};
    float* const rows = cloth.rows.data();
    float* const starts = cloth.start_rows.data();
    const float* const moving = cloth.moving_rows.data();
    for (std::size_t i = 0; i < float_row * cloth.count; i += together) {
        float before[together];
        for (std::size_t k = 0; k < together; ++k) {
            before[k] = rows[i + k];
        }
        for (std::size_t k = 0; k < together; ++k) {
            rows[i + k] = before[k] + moving[i + k] * (before[k] - starts[i + k] + falls[k]);
        }
        for (std::size_t k = 0; k < together; ++k) {
            starts[i + k] = before[k];
        }
    }
}

// Of rows that follow each other.
template <typename V>
inline void push_out_group_of_rows(float* rows, const float* moving, typename V::Register centre,
                                   float radius) {
    using R = typename V::Register;
    R row[4], difference[4];
    for (int k = 0; k < 4; ++k) {
        row[k] = V::load(rows + V::width * k);
        difference[k] = V::subtract(row[k], centre);
    }
    const R inside = inside_of<V>(squares_of<V>(difference), radius);
    const R spread[4] = {V::template spread<0>(inside), V::template spread<1>(inside),
                         V::template spread<2>(inside), V::template spread<3>(inside)};
    for (int k = 0; k < 4; ++k) {
        const R factor = V::multiply(spread[k], V::load(moving + V::width * k));
        V::store(rows + V::width * k, V::subtract_product(difference[k], factor, row[k]));
    }
}

template <typename V>
inline void push_out_rows(FloatRuns& cloth, const FloatSphere& sphere) {
    const float centre[16] = {sphere.x, sphere.y, sphere.z, 0, sphere.x, sphere.y, sphere.z, 0,
                              sphere.x, sphere.y, sphere.z, 0, sphere.x, sphere.y, sphere.z, 0};
    const typename V::Register centres = V::load(centre);
    for (std::uint32_t i = 0; i < cloth.count; i += V::width) {
        push_out_group_of_rows<V>(cloth.rows.data() + float_row * i, cloth.moving_rows.data() + float_row * i,
                                  centres, sphere.radius);
    }
}

} // namespace
} // namespace lks_bench
