#include "api/attachment_checks.h"

#include "api/body_checks.h"

namespace lks {
namespace {

lks_result check_side(const lks_world& world, lks_object_id id, std::uint32_t vertex) {
    lks_result result = LKS_OK;
    const Object* object = require_object(&world, id, result);
    return object == nullptr ? result : check_vertex(world, *object, vertex);
}

lks_result check_other_side(const lks_world& world, const lks_attachment_def& def) {
    if (def.kind == LKS_ATTACHMENT_TO_BODY) {
        if (const lks_result result = require_body(&world, def.body); result != LKS_OK) {
            return result;
        }
        return within(def.point, LKS_FIXED(64))
                   ? LKS_OK
                   : world.fail(LKS_ERROR_INVALID_ARGUMENT,
                                out_of_range("attachment's point", def.point, "m", LKS_FIXED(64)));
    }
    if (const lks_result result = check_side(world, def.other_object, def.other_vertex); result != LKS_OK) {
        return result;
    }
    if (def.object.index == def.other_object.index && def.vertex == def.other_vertex) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                          Sentence() << "The attachment's two sides are the same: vertex " << def.vertex
                                     << " of the object with index " << def.object.index << ".");
    }
    return LKS_OK;
}

} // namespace

lks_result check_attachment_ranges(const lks_world& world, lks_fixed compliance, lks_fixed damping,
                                   lks_fixed break_force) {
    const Number numbers[] = {
        {"attachment's compliance", " m/N", compliance, 0, LKS_FIXED(1000)},
        {"attachment's damping", " N·s/m", damping, 0, LKS_FIXED(1000000)},
        {"attachment's break_force", " N", break_force, 0, LKS_FIXED(8000000)},
    };
    return check_numbers(world, numbers);
}

lks_result check_attachment_def(const lks_world& world, const lks_attachment_def& def) {
    if (def.kind > LKS_ATTACHMENT_TO_VERTEX) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence()
                                                          << "Attachment kind " << def.kind
                                                          << " does not exist: the kinds are 0 and 1.");
    }
    if (const lks_result result =
            check_attachment_ranges(world, def.compliance, def.damping, def.break_force);
        result != LKS_OK) {
        return result;
    }
    if (const lks_result result = check_side(world, def.object, def.vertex); result != LKS_OK) {
        return result;
    }
    return check_other_side(world, def);
}

lks_result require_attachment(const lks_world* world, lks_attachment_id id) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (world->has_attachment(id)) {
        return LKS_OK;
    }
    return world->fail(LKS_ERROR_STALE_ID, Sentence()
                                               << "There is no attachment with index " << id.index
                                               << " and generation " << id.generation << " in this world.");
}

} // namespace lks
