// lockstitch/view.h: colliders and bodies as matrices. Reads only; no tick calls it.
#include <lockstitch/view.h>

#include "api/body_checks.h"
#include "api/view_units.h"
#include "rigid/quaternion.h"

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

// Between two ticks.
struct PosePair {
    fixed::Vec3 position_before;
    fixed::Vec3 position;
    fixed::Rotation rotation_before;
    fixed::Rotation rotation;
};

void write_pose(const PosePair& pose, double share, const lks_vec3& view_origin, float matrix[16]) {
    write_rotation(blend(pose.rotation_before, pose.rotation, share), matrix);
    const auto place = [&](std::int64_t before, std::int64_t now, std::int64_t origin) {
        return static_cast<float>(
            blend(relative_metres(before, origin), relative_metres(now, origin), share));
    };
    matrix[12] = place(pose.position_before.x, pose.position.x, view_origin.x);
    matrix[13] = place(pose.position_before.y, pose.position.y, view_origin.y);
    matrix[14] = place(pose.position_before.z, pose.position.z, view_origin.z);
    matrix[15] = 1.0f;
}

lks_result check_view(const lks_world& world, const char* function, const lks_vec3& view_origin,
                      const float* matrix) {
    if (matrix == nullptr) {
        return world.fail(LKS_ERROR_NULL_ARGUMENT, null_argument(function, "matrix"));
    }
    if (!within(view_origin, LKS_FIXED(8388607))) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                          out_of_range("view_origin", view_origin, "m", LKS_FIXED(8388607)));
    }
    return LKS_OK;
}

double share_of(const lks_world& world, std::uint32_t interpolation) {
    return world.keep_previous ? view_share(interpolation) : 1.0;
}

} // namespace

extern "C" {

lks_result lks_collider_write_matrix(const lks_world* world, lks_collider_id collider, uint32_t interpolation,
                                     lks_vec3 view_origin, float matrix[16]) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    const ColliderState* found = world->find_collider(collider);
    if (found == nullptr) {
        return world->stale_collider(collider);
    }
    if (const lks_result result = check_view(*world, "lks_collider_write_matrix", view_origin, matrix);
        result != LKS_OK) {
        return result;
    }
    write_pose({found->previous_position, found->position, found->previous_rotation, found->rotation},
               share_of(*world, interpolation), view_origin, matrix);
    return LKS_OK;
}

lks_result lks_body_write_matrix(const lks_world* world, lks_body_id body, uint32_t interpolation,
                                 lks_vec3 view_origin, float matrix[16]) {
    if (const lks_result result = require_body(world, body); result != LKS_OK) {
        return result;
    }
    if (const lks_result result = check_view(*world, "lks_body_write_matrix", view_origin, matrix);
        result != LKS_OK) {
        return result;
    }
    const Body& found = world->rigid.bodies[body.index];
    write_pose({found.previous_position, found.position, found.previous_rotation, narrow(found.orientation)},
               share_of(*world, interpolation), view_origin, matrix);
    // What was placed is the centre of mass; the frame is where it turns about.
    const fixed::Vec3& c = world->rigid.descriptions[body.index].centre;
    const double centre[3] = {static_cast<double>(c.x) * world_unit, static_cast<double>(c.y) * world_unit,
                              static_cast<double>(c.z) * world_unit};
    for (int row = 0; row < 3; ++row) {
        double moved = 0.0;
        for (int column = 0; column < 3; ++column) {
            moved += static_cast<double>(matrix[4 * column + row]) * centre[column];
        }
        matrix[12 + row] = static_cast<float>(static_cast<double>(matrix[12 + row]) - moved);
    }
    return LKS_OK;
}

} // extern "C"
