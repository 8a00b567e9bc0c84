#include "api/attachment_checks.h"

#include "api/body_checks.h"
#include "rigid/coupling.h"

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

// Bits as of movable_sides: the sides of the attachment that are this particle.
std::uint32_t sides_that_are(const AttachmentDescription& d, std::uint32_t object, std::uint32_t particle) {
    const bool near = d.object == object && d.particle == particle;
    const bool far = d.kind == LKS_ATTACHMENT_TO_VERTEX && d.other == object && d.other_particle == particle;
    return (near ? 1u : 0u) | (far ? 2u : 0u);
}

Sentence& write_point(Sentence& sentence, const fixed::Vec3& point) {
    sentence << "(";
    sentence.world_value(point.x) << ", ";
    sentence.world_value(point.y) << ", ";
    return sentence.world_value(point.z) << ") m";
}

} // namespace

lks_result check_held_nowhere(const lks_world& world, lks_object_id object, std::uint32_t vertex,
                              const char* refused) {
    const RigidScene& scene = world.rigid;
    const std::uint32_t particle = world.objects[object.index].object->asset().vertex_to_particle[vertex];
    for (std::uint32_t i = 0; i < scene.attachments.size(); ++i) {
        const AttachmentDescription& d = scene.attachments[i].description;
        if (!scene.attachment_slots[i].used || !d.is_rigid()) {
            continue;
        }
        const std::uint32_t here = sides_that_are(d, object.index, particle);
        if (here != 0 && movable_sides(d, sides_of(world, scene.attachments[i])) == here) {
            return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                              Sentence()
                                  << "The attachment with index " << i << " holds vertex " << vertex
                                  << " of the object with index " << object.index
                                  << " at what can't move, without compliance or a break_force; " << refused);
        }
    }
    return LKS_OK;
}

lks_result check_held_at_one_point(const lks_world& world, const AttachmentDescription& made,
                                   std::uint32_t vertex) {
    const RigidScene& scene = world.rigid;
    for (std::uint32_t i = 0; i < scene.attachments.size(); ++i) {
        const AttachmentDescription& d = scene.attachments[i].description;
        if (scene.attachment_slots[i].used && d.contradicts(made)) {
            const fixed::Vec3& centre = scene.descriptions[d.other].centre;
            Sentence sentence;
            sentence << "The attachment with index " << i << " holds vertex " << vertex
                     << " of the object with index " << d.object << " at ";
            write_point(sentence, d.point + centre)
                << " of the body with index " << d.other << ", without compliance or a break_force; ";
            return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                              write_point(sentence << "it can't be held at ", made.point + centre)
                                  << " of it, too.");
        }
    }
    return LKS_OK;
}

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
