// lockstitch/body.h: what a body was added with and may be changed while it exists.
#include <lockstitch/body.h>

#include <cstring>

#include "api/body_checks.h"
#include "rigid/contact_search.h"
#include "rigid/make_body.h"
#include "rigid/sleep.h"

using namespace lks;

namespace {

// Whom a change concerns: how the body moves by itself, or whom it touches, too.
enum class Concerns { itself, who_touches };

// Calls change(def) on the definition with which it would be added as it is, and makes it so. Where nothing
// is another then, nobody is woken.
template <typename Change>
lks_result change_body(lks_world* world, lks_body_id id, Concerns concerns, const Change& change) {
    if (const lks_result result = require_body(world, id); result != LKS_OK) {
        return result;
    }
    RigidScene& scene = world->rigid;
    BodySettings& settings = scene.definitions[id.index].settings;
    lks_body_def def = define_body(scene.definitions[id.index]);
    change(def);
    if (const lks_result result = check_body_def(*world, def); result != LKS_OK) {
        return result;
    }
    const BodySettings wanted = plain_settings(def);
    if (std::memcmp(&wanted, &settings, sizeof(BodySettings)) == 0) {
        return LKS_OK;
    }
    settings = wanted;
    take_settings(scene.descriptions[id.index], settings);
    wake(scene.bodies[id.index]);
    if (concerns == Concerns::who_touches) {
        wake_neighbours(scene, id.index);
        wake_touched(*world, id.index);
    }
    return LKS_OK;
}

// What the body is defined as; null, with the result, where the id is stale.
const BodySettings* find_settings(const lks_world* world, lks_body_id id, lks_result& result) {
    result = require_body(world, id);
    return result == LKS_OK ? &world->rigid.definitions[id.index].settings : nullptr;
}

// Of a setting that has a call to itself, where there must be something to tell it to.
template <typename Value>
lks_result tell_only(const lks_world* world, lks_body_id id, Value BodySettings::*setting, Value* to,
                     const char* call, const char* argument) {
    lks_result result = LKS_OK;
    const BodySettings* found = find_settings(world, id, result);
    if (found == nullptr) {
        return result;
    }
    if (to == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument(call, argument));
    }
    *to = found->*setting;
    return LKS_OK;
}

void tell(std::int64_t value, lks_fixed* to) {
    if (to != nullptr) {
        *to = value;
    }
}

} // namespace

extern "C" {

lks_result lks_body_set_gravity_factor(lks_world* world, lks_body_id body, lks_fixed factor) {
    return change_body(world, body, Concerns::itself,
                       [factor](lks_body_def& def) { def.gravity_factor = factor; });
}

lks_result lks_body_gravity_factor(const lks_world* world, lks_body_id body, lks_fixed* factor) {
    return tell_only(world, body, &BodySettings::gravity_factor, factor, "lks_body_gravity_factor", "factor");
}

lks_result lks_body_set_damping(lks_world* world, lks_body_id body, lks_fixed linear, lks_fixed angular) {
    return change_body(world, body, Concerns::itself, [=](lks_body_def& def) {
        def.linear_damping = linear;
        def.angular_damping = angular;
    });
}

lks_result lks_body_damping(const lks_world* world, lks_body_id body, lks_fixed* linear, lks_fixed* angular) {
    lks_result result = LKS_OK;
    if (const BodySettings* found = find_settings(world, body, result)) {
        tell(found->linear_damping, linear);
        tell(found->angular_damping, angular);
    }
    return result;
}

lks_result lks_body_set_surface(lks_world* world, lks_body_id body, lks_fixed static_friction,
                                lks_fixed dynamic_friction, lks_fixed restitution) {
    return change_body(world, body, Concerns::who_touches, [=](lks_body_def& def) {
        def.static_friction = static_friction;
        def.dynamic_friction = dynamic_friction;
        def.restitution = restitution;
    });
}

lks_result lks_body_surface(const lks_world* world, lks_body_id body, lks_fixed* static_friction,
                            lks_fixed* dynamic_friction, lks_fixed* restitution) {
    lks_result result = LKS_OK;
    if (const BodySettings* found = find_settings(world, body, result)) {
        tell(found->static_friction, static_friction);
        tell(found->dynamic_friction, dynamic_friction);
        tell(found->restitution, restitution);
    }
    return result;
}

lks_result lks_body_set_filter(lks_world* world, lks_body_id body, lks_filter filter) {
    return change_body(world, body, Concerns::who_touches,
                       [&filter](lks_body_def& def) { def.filter = filter; });
}

lks_result lks_body_filter(const lks_world* world, lks_body_id body, lks_filter* filter) {
    return tell_only(world, body, &BodySettings::filter, filter, "lks_body_filter", "filter");
}

lks_result lks_body_set_never_sleeps(lks_world* world, lks_body_id body, uint32_t never_sleeps) {
    return change_body(world, body, Concerns::itself,
                       [never_sleeps](lks_body_def& def) { def.never_sleeps = never_sleeps; });
}

uint32_t lks_body_never_sleeps(const lks_world* world, lks_body_id body) {
    return world != nullptr && world->has_body(body)
               ? world->rigid.definitions[body.index].settings.never_sleeps
               : 0;
}

} // extern "C"
