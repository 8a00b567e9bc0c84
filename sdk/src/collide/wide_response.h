// What contact.cpp does with one particle, by a kernel for several at a time (kernels/response_task.h).
#pragma once

#include <cstdint>
#include <optional>

#include "collide/contact.h"

namespace lks {

class WideResponse {
public:
    // With a reaction each depends on the one before. Those that are pushed far are left.
    WideResponse(const ContactFrame& frame, const ParticleArrays& particles, const ResponseKernels& kernels,
                 const ContactReaction* reaction, const FarPushes* far);

    // Of particles first .. first + count - 1, those of which the bits of `near` are set; the bits of those
    // that are left.
    std::uint64_t operator()(std::uint32_t first, std::uint32_t count, std::uint64_t near);

private:
    const ContactFrame& frame_;
    const ParticleArrays& particles_;
    std::int64_t greatest_new_depth_;
    Respond respond_;                  // null: one by one
    std::optional<ResponseTask> task_; // once somebody is near
};

} // namespace lks
