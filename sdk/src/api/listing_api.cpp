// What a world holds, by number: who loads an image finds with it what has come with the image.
#include <lockstitch/lockstitch.h>

#include "api/checks.h"
#include "api/report.h"
#include "solver/world.h"

namespace lks {
namespace {

// The n-th of those whose slots are used, in the order of their indices.
template <typename Slots, typename Id>
lks_result list(const lks_world* world, const Slots& slots, std::uint32_t n, const char* function,
                const char* what, Id* id) {
    if (id == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument(function, what));
    }
    std::uint32_t count = 0;
    const std::uint32_t index = find_nth(slots, n, count, [](const auto& slot) { return slot.used; });
    if (index < slots.size()) {
        *id = {index, slots[index].generation};
        return LKS_OK;
    }
    return world->fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "There is no " << what << " " << n
                                                              << ": the world has " << count << ".");
}

} // namespace
} // namespace lks

using namespace lks;

extern "C" {

uint32_t lks_world_collider_count(const lks_world* world) {
    return world == nullptr ? 0 : count_used(world->colliders);
}

lks_result lks_world_collider_at(const lks_world* world, uint32_t n, lks_collider_id* collider) {
    return world == nullptr ? LKS_ERROR_NULL_ARGUMENT
                            : list(world, world->colliders, n, "lks_world_collider_at", "collider", collider);
}

lks_result lks_world_body_at(const lks_world* world, uint32_t n, lks_body_id* body) {
    return world == nullptr ? LKS_ERROR_NULL_ARGUMENT
                            : list(world, world->rigid.body_slots, n, "lks_world_body_at", "body", body);
}

lks_result lks_world_joint_at(const lks_world* world, uint32_t n, lks_joint_id* joint) {
    return world == nullptr ? LKS_ERROR_NULL_ARGUMENT
                            : list(world, world->rigid.joint_slots, n, "lks_world_joint_at", "joint", joint);
}

lks_result lks_world_attachment_at(const lks_world* world, uint32_t n, lks_attachment_id* attachment) {
    return world == nullptr ? LKS_ERROR_NULL_ARGUMENT
                            : list(world, world->rigid.attachment_slots, n, "lks_world_attachment_at",
                                   "attachment", attachment);
}

} // extern "C"
