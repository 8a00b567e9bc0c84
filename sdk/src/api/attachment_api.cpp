// lockstitch/attachment.h.
#include <lockstitch/attachment.h>

#include <algorithm>

#include "api/attachment_checks.h"
#include "api/read_out.h"
#include "rigid/coupling.h"
#include "rigid/rope_loads.h"
#include "rigid/sleep.h"

using namespace lks;

namespace {

AttachmentDescription describe(const lks_attachment_def& def, const lks_world& world) {
    AttachmentDescription d{};
    d.kind = def.kind;
    d.object = def.object.index;
    d.particle = world.objects[d.object].object->asset().vertex_to_particle[def.vertex];
    if (def.kind == LKS_ATTACHMENT_TO_BODY) {
        d.other = def.body.index;
        d.point = to_vec3(def.point) - world.rigid.descriptions[d.other].centre;
    } else {
        d.other = def.other_object.index;
        d.other_particle = world.objects[d.other].object->asset().vertex_to_particle[def.other_vertex];
    }
    d.compliance = def.compliance;
    d.damping = def.damping;
    d.break_force = def.break_force;
    return d;
}

// What it holds at something that can't move is not held so already, nor at another point of its body.
lks_result check_contradictions(const lks_world& world, const lks_attachment_def& def,
                                const Attachment& made) {
    if (const lks_result result = check_held_at_one_point(world, made.description, def.vertex);
        result != LKS_OK) {
        return result;
    }
    if (made.constants.movable == 3 || !made.description.is_rigid()) {
        return LKS_OK;
    }
    const bool near = made.constants.movable == 1;
    if (!near && def.kind == LKS_ATTACHMENT_TO_BODY) {
        return LKS_OK; // a body can turn about one point and hang between two
    }
    return check_held_nowhere(world, near ? def.object : def.other_object,
                              near ? def.vertex : def.other_vertex,
                              "it can't be held at another place, too.");
}

void wake_side(const AttachmentSides& sides) {
    if (sides.body != nullptr) {
        wake(*sides.body);
    }
}

} // namespace

extern "C" {

lks_attachment_def lks_default_attachment_def(void) {
    lks_attachment_def def{};
    def.struct_size = sizeof(lks_attachment_def);
    return def;
}

lks_result lks_world_add_attachment(lks_world* world, const lks_attachment_def* def,
                                    lks_attachment_id* attachment) {
    if (const lks_result result = check_addition(world, "attachment", def, attachment); result != LKS_OK) {
        return result;
    }
    if (const lks_result result = check_attachment_def(*world, *def); result != LKS_OK) {
        return result;
    }
    Attachment made{};
    made.description = describe(*def, *world);
    const AttachmentSides sides = sides_of(*world, made);
    made.constants = make_attachment_constants(made.description, sides, world->rate);
    if (made.constants.movable == 0) {
        return world->fail(LKS_ERROR_INVALID_ARGUMENT,
                           Sentence() << "Neither side of the attachment can move: vertex " << def->vertex
                                      << " is pinned, and so is the other one, or its body is kinematic.");
    }
    if (const lks_result result = check_contradictions(*world, *def, made); result != LKS_OK) {
        return result;
    }
    if (may_load_rope(made.description, sides.object) && !sides.object.reserve_coefficients()) {
        return world->fail_out_of_memory("an attachment");
    }
    RigidScene& scene = world->rigid;
    const std::uint32_t index = first_free(scene.attachment_slots);
    if (index >= LKS_MAX_ATTACHMENTS) {
        return world->fail(LKS_ERROR_LIMIT,
                           Sentence() << "A world holds at most " << LKS_MAX_ATTACHMENTS << " attachments.");
    }
    if (index >= scene.attachment_room() &&
        !scene.reserve_attachments(grown_room(scene.attachments.size()))) {
        return world->fail_out_of_memory("an attachment");
    }
    if (index == scene.attachment_slots.size()) {
        scene.attachment_slots.push_reserved(Slot{1, false});
        scene.attachments.push_reserved(Attachment{});
    }
    scene.attachments[index] = made;
    scene.attachment_slots[index].used = true;
    wake_side(sides);
    *attachment = {index, scene.attachment_slots[index].generation};
    return LKS_OK;
}

lks_result lks_world_remove_attachment(lks_world* world, lks_attachment_id attachment) {
    if (const lks_result result = require_attachment(world, attachment); result != LKS_OK) {
        return result;
    }
    wake_side(sides_of(*world, world->rigid.attachments[attachment.index]));
    world->rigid.free_attachment(attachment.index);
    return LKS_OK;
}

uint32_t lks_world_has_attachment(const lks_world* world, lks_attachment_id attachment) {
    return world != nullptr && world->has_attachment(attachment) ? 1u : 0u;
}

uint32_t lks_world_attachment_count(const lks_world* world) {
    return world == nullptr ? 0 : count_used(world->rigid.attachment_slots);
}

lks_result lks_attachment_error(const lks_world* world, lks_attachment_id attachment, lks_fixed* error) {
    if (const lks_result result = require_attachment(world, attachment); result != LKS_OK) {
        return result;
    }
    if (error == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_attachment_error", "error"));
    }
    const Attachment& found = world->rigid.attachments[attachment.index];
    const std::uint64_t apart = fixed::length(attachment_offset(found, sides_of(*world, found)));
    *error = static_cast<lks_fixed>(std::min<std::uint64_t>(apart, INT64_MAX));
    return LKS_OK;
}

lks_result lks_attachment_force(const lks_world* world, lks_attachment_id attachment, lks_vec3* force) {
    if (const lks_result result = require_attachment(world, attachment); result != LKS_OK) {
        return result;
    }
    if (force == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_attachment_force", "force"));
    }
    const Attachment& found = world->rigid.attachments[attachment.index];
    const fixed::Scaled greater = found.constants.greater_inverse_mass;
    *force = greater.is_zero() ? lks_vec3{} : times(found.pushed, force_of_push(world->rate, greater));
    return LKS_OK;
}

} // extern "C"
