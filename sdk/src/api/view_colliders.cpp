// lockstitch/view.h: colliders as matrices. Reads only; no tick calls it.
#include <lockstitch/view.h>

#include "api/checks.h"
#include "api/view_units.h"

using namespace lks;

namespace {

double blend(double before, double now, double share) {
    return before + (now - before) * share;
}

// The shorter way from one quaternion to the other, normalised by the matrix below.
struct Quaternion {
    double x, y, z, w;
};

Quaternion blend(const fixed::Rotation& before, const fixed::Rotation& now, double share) {
    const double dot = static_cast<double>(before.x) * now.x + static_cast<double>(before.y) * now.y +
                       static_cast<double>(before.z) * now.z + static_cast<double>(before.w) * now.w;
    const double sign = dot < 0.0 ? -1.0 : 1.0;
    return {blend(before.x, sign * now.x, share), blend(before.y, sign * now.y, share),
            blend(before.z, sign * now.z, share), blend(before.w, sign * now.w, share)};
}

void write_rotation(const Quaternion& q, float matrix[16]) {
    const double scale = 2.0 / (q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    const double columns[3][3] = {
        {1.0 - scale * (q.y * q.y + q.z * q.z), scale * (q.x * q.y + q.w * q.z),
         scale * (q.x * q.z - q.w * q.y)},
        {scale * (q.x * q.y - q.w * q.z), 1.0 - scale * (q.x * q.x + q.z * q.z),
         scale * (q.y * q.z + q.w * q.x)},
        {scale * (q.x * q.z + q.w * q.y), scale * (q.y * q.z - q.w * q.x),
         1.0 - scale * (q.x * q.x + q.y * q.y)},
    };
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            matrix[4 * column + row] = static_cast<float>(columns[column][row]);
        }
        matrix[4 * column + 3] = 0.0f;
    }
}

} // namespace

extern "C" lks_result lks_collider_write_matrix(const lks_world* world, lks_collider_id collider,
                                                uint32_t interpolation, lks_vec3 view_origin,
                                                float matrix[16]) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    const ColliderState* found = world->find_collider(collider);
    if (found == nullptr) {
        return world->stale_collider(collider);
    }
    if (matrix == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_collider_write_matrix", "matrix"));
    }
    if (!within(view_origin, LKS_FIXED(8388607))) {
        return world->fail(LKS_ERROR_INVALID_ARGUMENT,
                           out_of_range("view_origin", view_origin, "m", LKS_FIXED(8388607)));
    }
    const double share = world->keep_previous ? view_share(interpolation) : 1.0;
    write_rotation(blend(found->previous_rotation, found->rotation, share), matrix);
    const auto place = [&](std::int64_t before, std::int64_t now, std::int64_t origin) {
        return static_cast<float>(
            blend(relative_metres(before, origin), relative_metres(now, origin), share));
    };
    matrix[12] = place(found->previous_position.x, found->position.x, view_origin.x);
    matrix[13] = place(found->previous_position.y, found->position.y, view_origin.y);
    matrix[14] = place(found->previous_position.z, found->position.z, view_origin.z);
    matrix[15] = 1.0f;
    return LKS_OK;
}
