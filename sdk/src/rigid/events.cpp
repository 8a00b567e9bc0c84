#include "rigid/events.h"

#include <algorithm>

#include "fixed/world_times.h"
#include "rigid/contact_memory.h"
#include "rigid/contact_search.h"
#include "rigid/coupling.h"
#include "rigid/make_body.h"

namespace lks {
namespace {

using fixed::Scaled;

constexpr std::int64_t greatest_strength = LKS_FIXED(8388607);

void add(lks_world& world, const lks_event& event) {
    EventLog& log = world.event_log;
    if (!log.wants(static_cast<lks_event_kind>(event.kind))) {
        return;
    }
    if (log.events.size() < log.capacity) {
        log.events.push_reserved(event);
    } else {
        ++world.counters.lost_events;
    }
}

lks_event make_event(const lks_world& world, lks_event_kind kind) {
    lks_event event{};
    event.kind = kind;
    event.tick = world.tick;
    return event;
}

void set_place(lks_event& event, const fixed::Vec3& place, const fixed::Direction& normal) {
    event.point = {place.x, place.y, place.z};
    event.normal = {world_from_direction(normal.x), world_from_direction(normal.y),
                    world_from_direction(normal.z)};
}

lks_body_id body_id(const RigidScene& scene, std::uint32_t index) {
    return {index, scene.body_slots[index].generation};
}

std::int64_t to_strength(const Scaled& value) {
    return std::min(value.to_i64_fixed(world_fraction_bits), greatest_strength);
}

// Two bodies, or a body and a collider.
struct Pair {
    std::uint32_t body_a;
    std::uint32_t other;

    friend bool operator==(const Pair&, const Pair&) = default;
    friend bool operator<(const Pair& p, const Pair& q) {
        return p.body_a != q.body_a ? p.body_a < q.body_a : p.other < q.other;
    }
};

constexpr Pair no_pair{UINT32_MAX, UINT32_MAX};

Pair pair_of(const ContactKey& key) {
    return {key.body_a, key.other};
}

// What the contacts of a pair did in a tick, World m/s: added up, and what they have yet to give.
struct PairPushes {
    std::int64_t given = 0;
    std::int64_t to_come = 0;
    // Of the contact that gave most in one substep.
    std::int64_t most = -1;
    fixed::Vec3 place{};
    fixed::Direction normal{};
};
// What is remembered of a pair at the end of a tick.
struct PairMemory {
    bool touches = false;
    bool forgotten = false;
    std::int64_t last = 0; // World m/s: what it gave in the last substep
};

// The contacts of this tick, those that pushed at the end of the one before, and those that push now, pair by
// pair: all three in ascending order.
//
// What is told must follow from the state alone, and that holds no more of the tick before than what its last
// substep pushed. So a hit is a tick that reaches the threshold where the one before, had all its substeps
// been like the last, was below it. An impact takes a substep to come down on what is still open, and one to
// be stopped. Where a tick ends between the two it is told at once, with what is to come, if the next tick
// will count as one that was at the threshold already; else then, with what was given before.
class ContactChanges {
public:
    explicit ContactChanges(lks_world& world) : world_(world), scene_(world.rigid) {}

    void record() {
        for (Pair pair = next_pair(); !(pair == no_pair); pair = next_pair()) {
            const PairPushes pushes = take_contacts(pair);
            const PairMemory before = take(scene_.memories, old_, pair);
            const PairMemory now = take(scene_.next_memories, new_, pair);
            const bool begins = !before.touches && (pushes.given != 0 || now.touches);
            if (!begins && !before.touches) {
                continue; // they are only near
            }
            if (begins) {
                const std::int64_t whole = fixed::saturating_add(pushes.given, pushes.to_come);
                report(pair, pushes, LKS_EVENT_CONTACT_BEGIN, impulse_of(pair, whole));
            }
            const std::int64_t load = impulse_of(pair, of_tick(now));
            const bool was_loaded = before.touches && reaches_threshold(load_before(pair, before));
            if (!was_loaded) {
                tell_hit(pair, pushes, before.forgotten ? PairMemory{} : before, now, load);
            }
            if (was_loaded != (now.touches && reaches_threshold(load))) {
                report(pair, pushes, was_loaded ? LKS_EVENT_CONTACT_UNLOADED : LKS_EVENT_CONTACT_LOADED,
                       load);
            }
            if (!now.touches) {
                report(pair, pushes, LKS_EVENT_CONTACT_END, 0);
            }
        }
    }

private:
    Pair next_pair() const {
        Pair least = no_pair;
        if (contact_ < scene_.contacts.size()) {
            least = std::min(least, pair_of(scene_.contacts[contact_].key));
        }
        if (old_ < scene_.memories.size()) {
            least = std::min(least, pair_of(scene_.memories[old_].key));
        }
        if (new_ < scene_.next_memories.size()) {
            least = std::min(least, pair_of(scene_.next_memories[new_].key));
        }
        return least;
    }

    bool reaches_threshold(std::int64_t impulse) const { return impulse >= world_.event_log.least_impulse; }

    // `load`: the impulse of a tick that pushes as its last substep.
    void tell_hit(const Pair& pair, const PairPushes& pushes, const PairMemory& before, const PairMemory& now,
                  std::int64_t load) {
        std::int64_t speed = pushes.given;
        if (before.last > now.last) {
            speed = fixed::saturating_add(speed, before.last - now.last);
        }
        if (reaches_threshold(load)) {
            speed = fixed::saturating_add(speed, pushes.to_come);
        }
        const std::int64_t impulse = impulse_of(pair, speed);
        if (reaches_threshold(impulse)) {
            report(pair, pushes, LKS_EVENT_CONTACT_HIT, impulse);
        }
    }

    // As if it had pushed all the time as in its last substep.
    std::int64_t of_tick(const PairMemory& memory) const {
        return fixed::multiply_shift(memory.last, world_.rate.substeps, 0);
    }

    PairPushes take_contacts(const Pair& pair) {
        PairPushes pushes;
        for (; contact_ < scene_.contacts.size() && pair_of(scene_.contacts[contact_].key) == pair;
             ++contact_) {
            const Contact& contact = scene_.contacts[contact_];
            const ContactBodies bodies{scene_.bodies[pair.body_a], other_body(scene_, pair.other)};
            const bool with_sleeper = is_with_sleeper(scene_, contact.key);
            const auto counted = [&](std::int64_t speed) {
                return with_sleeper ? times(speed, wall_ratio(scene_, contact.key)) : speed;
            };
            pushes.given = fixed::saturating_add(pushes.given, counted(contact.given_speed));
            pushes.to_come = std::max(pushes.to_come, counted(speed_to_come(contact, bodies)));
            keep_place(contact, scene_.contact_marks[contact_], bodies, pushes);
        }
        return pushes;
    }

    // What has given nothing yet is told of where it is now.
    static void keep_place(const Contact& contact, const ContactMark& mark, const ContactBodies& bodies,
                           PairPushes& pushes) {
        if (mark.most > pushes.most) {
            pushes.most = mark.most;
            pushes.place = mark.most != 0 ? mark.place : place_of(contact, bodies.a, bodies.b);
            pushes.normal = mark.most != 0 ? mark.normal : contact.normal();
        }
    }

    PairMemory take(const Array<ContactMemory>& memories, std::size_t& at, const Pair& pair) const {
        const auto substeps_per_second = static_cast<std::int64_t>(world_.rate.substeps_per_second);
        PairMemory of_pair;
        for (; at < memories.size() && pair_of(memories[at].key) == pair; ++at) {
            of_pair.touches = true;
            of_pair.forgotten = memories[at].forgotten != 0;
            for (std::uint32_t i = 0; i < memories[at].count; ++i) {
                const std::int64_t push = memories[at].pushes[i].normal;
                of_pair.last =
                    fixed::saturating_add(of_pair.last, fixed::multiply_shift(push, substeps_per_second, 0));
            }
        }
        return of_pair;
    }

    // World N·s. Speeds count in the greater inverse mass of the two.
    static std::int64_t impulse(std::int64_t speed, const Scaled& greater) {
        if (greater.is_zero()) {
            return 0;
        }
        return to_strength(Scaled::from_fixed(static_cast<std::uint64_t>(speed), world_fraction_bits) /
                           greater);
    }
    std::int64_t impulse_of(const Pair& pair, std::int64_t speed) const {
        return impulse(speed, greater_inverse_mass(scene_, pair.body_a, pair.other));
    }
    std::int64_t load_before(const Pair& pair, const PairMemory& before) const {
        return before.forgotten
                   ? impulse(of_tick(before), greater_dynamic_inverse_mass(scene_, pair.body_a, pair.other))
                   : impulse_of(pair, of_tick(before));
    }

    void report(const Pair& pair, const PairPushes& pushes, lks_event_kind kind, std::int64_t impulse) {
        lks_event event = make_event(world_, kind);
        const ContactSides sides = contact_sides(world_, pair.body_a, pair.other);
        event.body_a = sides.body_a;
        event.body_b = sides.body_b;
        event.collider = sides.collider;
        event.strength = impulse;
        set_place(event, pushes.place, pushes.normal);
        add(world_, event);
    }

    lks_world& world_;
    RigidScene& scene_;
    std::size_t contact_ = 0;
    std::size_t old_ = 0;
    std::size_t new_ = 0;
};

// The mean of a tick, of pushes that were added up.
std::int64_t mean_strength(const lks_world& world, const fixed::Vec3& sum,
                           const Scaled& greater_inverse_mass) {
    const Scaled length = Scaled::from_fixed(fixed::length(sum), world_fraction_bits);
    return to_strength(length * force_of_push(world.rate, greater_inverse_mass));
}

} // namespace

ContactSides contact_sides(const lks_world& world, std::uint32_t body_a, std::uint32_t other) {
    ContactSides sides{body_id(world.rigid, body_a), {}, {}};
    if (other < other_is_collider) {
        sides.body_b = body_id(world.rigid, other);
    } else {
        const std::uint32_t index = other & ~other_is_collider;
        sides.collider = {index, world.colliders[index].generation};
    }
    return sides;
}

void record_contacts(lks_world& world) {
    if (world.event_log.wants_contacts()) {
        ContactChanges(world).record();
    }
}

void record_particles(lks_world& world) {
    if (!world.event_log.wants_particles()) {
        return;
    }
    const RigidScene& scene = world.rigid;
    for (std::size_t i = 0; i < scene.object_pairs.size(); ++i) {
        const ParticlePushes& pushes = scene.object_pushes[i];
        const std::int64_t impulse = std::min(pushes.impulse, greatest_strength);
        if (impulse == 0 || impulse < world.event_log.least_impulse) {
            continue;
        }
        const auto object = static_cast<std::uint32_t>(scene.object_pairs[i] >> 32);
        lks_event event = make_event(world, LKS_EVENT_PARTICLES_PUSHED);
        event.body_a = body_id(scene, static_cast<std::uint32_t>(scene.object_pairs[i]));
        event.object = {object, world.objects[object].generation};
        event.strength = impulse;
        set_place(event, pushes.place, pushes.normal);
        add(world, event);
    }
}

void record_break(lks_world& world, const Joint& joint, std::uint32_t index) {
    if (!world.event_log.wants(LKS_EVENT_JOINT_BROKE)) {
        return;
    }
    const RigidScene& scene = world.rigid;
    const JointDescription& d = joint.description;
    const Scaled greater =
        greater_inverse_mass(joint.constants.shares, scene.bodies[d.body_a], scene.bodies[d.body_b]);
    const bool by_force = exceeds(joint.pushed, joint.constants.break_push);
    lks_event event = make_event(world, LKS_EVENT_JOINT_BROKE);
    event.joint = {index, scene.joint_slots[index].generation};
    event.body_a = body_id(scene, d.body_a);
    event.body_b = body_id(scene, d.body_b);
    event.strength =
        by_force ? mean_strength(world, joint.pushed, greater)
                 : mean_strength(world, joint.turned, greater.times_power_of_two(-2 * joint.constants.reach));
    const Body& b = scene.bodies[d.body_b];
    set_place(event, b.position + fixed::rotate(b.rotation, d.point_b), {0, 0, 0});
    add(world, event);
}

void record_break(lks_world& world, const Attachment& attachment, std::uint32_t index) {
    if (!world.event_log.wants(LKS_EVENT_ATTACHMENT_BROKE)) {
        return;
    }
    lks_event event = make_event(world, LKS_EVENT_ATTACHMENT_BROKE);
    event.attachment = {index, world.rigid.attachment_slots[index].generation};
    if (attachment.description.kind == LKS_ATTACHMENT_TO_BODY) {
        event.body_a = body_id(world.rigid, attachment.description.other);
    }
    const AttachmentSides sides = sides_of(world, attachment);
    event.strength = mean_strength(world, attachment.pushed, attachment.constants.greater_inverse_mass);
    set_place(event, particle_position(sides.object, attachment.description.particle), {0, 0, 0});
    add(world, event);
}

void record_sleep(lks_world& world) {
    for (std::uint32_t i = 0; i < world.rigid.bodies.size(); ++i) {
        Body& body = world.rigid.bodies[i];
        const bool asleep = body.asleep != 0;
        if (body.known_asleep == asleep) {
            continue;
        }
        body.known_asleep = asleep;
        lks_event event = make_event(world, asleep ? LKS_EVENT_FELL_ASLEEP : LKS_EVENT_WOKE);
        event.body_a = body_id(world.rigid, i);
        add(world, event);
    }
}

} // namespace lks
