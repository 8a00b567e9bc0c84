#include "collide/wide_response.h"

namespace lks {
namespace {

Respond response_to(std::uint32_t shape_kind, const ResponseKernels& kernels) {
    switch (shape_kind) {
    case LKS_SHAPE_PLANE:
        return kernels.plane;
    case LKS_SHAPE_SPHERE:
        return kernels.sphere;
    case LKS_SHAPE_CAPSULE:
        return kernels.capsule;
    default:
        return kernels.box;
    }
}

bool centres_are_near(const ContactFrame& frame) {
    const auto near = [](const fixed::Vec3& v) {
        constexpr auto limit = static_cast<std::uint64_t>(response_centre_limit);
        return fixed::magnitude(v.x) <= limit && fixed::magnitude(v.y) <= limit &&
               fixed::magnitude(v.z) <= limit;
    };
    return near(frame.start_centre) && near(frame.end_centre);
}

ResponseTask make_task(const ContactFrame& frame, const ParticleArrays& particles,
                       std::int64_t greatest_new_depth) {
    constexpr fixed::Matrix3 none = fixed::to_matrix(fixed::identity_rotation());
    const Shape& shape = frame.shape;
    const fixed::Vec3& a = frame.start_centre;
    const fixed::Vec3& b = frame.end_centre;
    ResponseTask task{{particles.x, particles.y, particles.z},
                      {particles.start_x, particles.start_y, particles.start_z},
                      (shape.kind == LKS_SHAPE_PLANE ? 0 : shape.radius) + frame.margin,
                      shape.half_length,
                      {shape.half_extents.x, shape.half_extents.y, shape.half_extents.z},
                      !(frame.start_rotation == none) || !(frame.end_rotation == none),
                      {},
                      {},
                      {a.x, a.y, a.z},
                      {b.x, b.y, b.z},
                      frame.static_friction,
                      frame.dynamic_friction,
                      frame.greatest_recovery,
                      contact_tolerance,
                      greatest_new_depth};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            task.start_rotation[row][column] = frame.start_rotation.m[row][column];
            task.end_rotation[row][column] = frame.end_rotation.m[row][column];
        }
    }
    return task;
}

} // namespace

WideResponse::WideResponse(const ContactFrame& frame, const ParticleArrays& particles,
                           const ResponseKernels& kernels, const ContactReaction* reaction,
                           const FarPushes* far)
    : frame_(frame), particles_(particles), greatest_new_depth_(far == nullptr ? INT64_MAX : far->beyond),
      respond_(reaction == nullptr && centres_are_near(frame) ? response_to(frame.shape.kind, kernels)
                                                              : nullptr) {}

std::uint64_t WideResponse::operator()(std::uint32_t first, std::uint32_t count, std::uint64_t near) {
    if (respond_ == nullptr || near == 0) {
        return near;
    }
    if (!task_) {
        task_ = make_task(frame_, particles_, greatest_new_depth_);
    }
    return respond_(*task_, first, count, near);
}

} // namespace lks
