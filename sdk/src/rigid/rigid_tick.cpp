#include "rigid/rigid_tick.h"

#include <algorithm>

#include "rigid/articulation.h"
#include "rigid/carried_pushes.h"
#include "rigid/contact_search.h"
#include "rigid/coupling.h"
#include "rigid/particle_contact.h"
#include "rigid/sleep.h"
#include "solver/object_tick.h"
#include "solver/pins.h"
#include "solver/world.h"

namespace lks {
namespace {

class RigidTick {
public:
    explicit RigidTick(lks_world& world) : world_(world), scene_(world.rigid), rate_(world.rate) {
        // What a substep of gravity alone gives a body is no impact.
        const fixed::Vec3& g = world.gravity;
        const auto size = [](std::int64_t c) { return c < 0 ? -c : c; };
        least_approach_ = 4 * ((size(g.x) + size(g.y) + size(g.z)) / rate_.substeps_per_second) +
                          (std::int64_t{1} << world_fraction_bits) / 100;
    }

    void run() {
        begin();
        wake_islands(world_);
        const bool moves = anything_moves();
        if (!moves && scene_.coupled.empty()) {
            return;
        }
        prepare();
        scene_.contacts.clear();
        if (moves) {
            find_contacts(world_);
        }
        find_figures(scene_);
        find_articulations(scene_);
        // Those that it has woken, too.
        for (Body& body : scene_.bodies) {
            if (body.is_awake()) {
                body.world_inverse = rotated(body.inverse_inertia, body.rotation);
            }
        }
        any_restitution_ = false;
        for (const Contact& contact : scene_.contacts) {
            any_restitution_ = any_restitution_ || contact.restitution != 0;
        }
        for (std::uint32_t substep = 1; substep <= world_.rate.substeps; ++substep) {
            run_substep(substep);
        }
        finish();
    }

private:
    bool used(std::size_t index) const { return scene_.body_slots[index].used; }

    ContactBodies bodies_of(const Contact& contact) {
        return {scene_.bodies[contact.key.body_a], other_body(scene_, contact.key.other)};
    }

    Body& body_a(const Joint& joint) { return scene_.bodies[joint.description.body_a]; }
    Body& body_b(const Joint& joint) { return scene_.bodies[joint.description.body_b]; }

    template <typename Use>
    void for_each_attachment(const Use& use) {
        for (std::size_t i = 0; i < scene_.attachments.size(); ++i) {
            if (scene_.attachment_slots[i].used) {
                use(scene_.attachments[i], sides_of(world_, scene_.attachments[i]));
            }
        }
    }

    void project_attachments() {
        for_each_attachment(
            [](Attachment& attachment, const AttachmentSides& sides) { lks::project(attachment, sides); });
    }

    Object& coupled_object(std::uint32_t index) { return *world_.objects[index].object; }

    // Cloth and ropes against colliders and bodies, so that a substep ends with nothing inside either.
    void collide_objects(std::uint32_t substep) {
        std::size_t pair = 0;
        for (const std::uint32_t index : scene_.coupled) {
            Object& object = coupled_object(index);
            collide_object(world_, object, world_.scratch[0], substep);
            bool touched = false;
            for (; pair < scene_.object_pairs.size() && scene_.object_pairs[pair] >> 32 == index; ++pair) {
                const auto body = static_cast<std::uint32_t>(scene_.object_pairs[pair]);
                collide_with_body(object, scene_.bodies[body], scene_.descriptions[body],
                                  held_particles(scene_.held, index, body), rate_, *world_.kernels);
                touched = true;
            }
            if (touched) {
                place_pins(object, substep, world_.rate.substeps);
            }
        }
    }

    bool is_at_work(std::size_t joint) const {
        const JointDescription& d = scene_.joints[joint].description;
        return scene_.joint_slots[joint].used &&
               (scene_.bodies[d.body_a].is_awake() || scene_.bodies[d.body_b].is_awake());
    }

    template <typename Use>
    void for_each_joint(const Use& use) {
        for (std::size_t i = 0; i < scene_.joints.size(); ++i) {
            if (is_at_work(i)) {
                Joint& joint = scene_.joints[i];
                use(joint, body_a(joint), body_b(joint));
            }
        }
    }

    void project_joint(std::size_t index) {
        if (is_at_work(index)) {
            Joint& joint = scene_.joints[index];
            project(joint, body_a(joint), body_b(joint));
        }
    }

    // Nobody is awake, and nothing is on its way to wake anybody.
    bool anything_moves() const {
        for (const Body& body : scene_.bodies) {
            if (body.is_active()) {
                return true;
            }
        }
        for (const ColliderSlot& slot : world_.colliders) {
            if (slot.used && slot.collider.moves()) {
                return true;
            }
        }
        return false;
    }

    void begin() {
        for (Body& body : scene_.bodies) {
            body.previous_position = body.position;
            body.previous_rotation = narrow(body.orientation);
            body.tick_position = body.position;
            body.tick_orientation = body.orientation;
            if (body.asleep != 0) {
                continue;
            }
            body.follow_orientation();
            if (!body.is_dynamic()) {
                aim_kinematic(body, rate_, world_.rate.substeps);
            }
        }
    }

    // What somebody awake needs.
    void prepare() {
        place_collider_bodies(world_);
        scene_.ticks.clear();
        for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
            scene_.ticks.push_reserved(
                used(i) ? make_body_tick(scene_.descriptions[i], world_.rate, world_.gravity) : BodyTick{});
        }
        for_each_joint([](Joint& joint, Body&, Body&) {
            joint.pushed = {0, 0, 0};
            joint.turned = {0, 0, 0};
        });
        for (const std::uint32_t index : scene_.coupled) {
            begin_object_tick(world_, coupled_object(index), world_.scratch[0]);
        }
        for_each_attachment([this](Attachment& attachment, const AttachmentSides& sides) {
            begin_tick(attachment, sides, world_.rate);
        });
    }

    void run_substep(std::uint32_t substep) {
        for (Contact& contact : scene_.contacts) {
            if (contact.fast && substep > 1) {
                find_points_again(world_, contact);
            }
            const ContactBodies bodies = bodies_of(contact);
            begin_substep(contact, bodies.a, bodies.b);
        }
        for_each_joint([](Joint& joint, Body& a, Body& b) { lks::begin_substep(joint, a, b); });
        strike_all();
        predict(substep);
        for (const std::uint32_t index : scene_.coupled) {
            begin_object_substep(world_, coupled_object(index), world_.scratch[0], substep);
        }
        for_each_attachment([](Attachment& attachment, const AttachmentSides& sides) {
            lks::begin_substep(attachment, sides);
        });
        factor_articulations(scene_);
        carry_pushes_on();
        for (std::uint32_t iteration = 0; iteration < world_.rate.iterations; ++iteration) {
            for (const std::uint32_t index : scene_.coupled) {
                project_object(world_, coupled_object(index), world_.scratch[0]);
            }
            // Forward and back: a sweep in one direction only makes tall stacks sway.
            project_attachments();
            for_each_joint([](Joint& joint, Body& a, Body& b) { lks::project(joint, a, b); });
            solve_articulations(scene_);
            for (Contact& contact : scene_.contacts) {
                project(contact, bodies_of(contact));
            }
            for (std::size_t i = scene_.contacts.size(); i-- > 0;) {
                project(scene_.contacts[i], bodies_of(scene_.contacts[i]));
            }
            for (std::size_t i = scene_.joints.size(); i-- > 0;) {
                project_joint(i);
            }
            solve_articulations(scene_);
            project_attachments();
            collide_objects(substep);
        }
        for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
            if (used(i) && scene_.bodies[i].is_awake()) {
                finish_body(scene_.bodies[i], scene_.descriptions[i], rate_, world_.counters.speed_clamps);
            }
        }
        if (world_.event_log.wants_contacts()) {
            for (Contact& contact : scene_.contacts) {
                add_up_pushes(contact, rate_);
            }
        }
        for (const Contact& contact : scene_.contacts) {
            restore_speed(contact, bodies_of(contact), least_approach_);
        }
        for_each_joint([](Joint& joint, Body& a, Body& b) {
            add_up_pushes(joint, a, b);
            if (!joint.in_tree) {
                undo_error(joint, a, b);
            }
        });
        for (const Contact& contact : scene_.contacts) {
            undo_overlap(contact, bodies_of(contact), rate_);
        }
        undo_articulations(scene_);
        for_each_attachment(
            [](Attachment& attachment, const AttachmentSides&) { finish_substep(attachment); });
    }

    void carry_pushes_on() {
        for (Body& body : scene_.bodies) {
            body.uncarried_position = body.position;
            body.uncarried_orientation = body.orientation;
        }
        for_each_joint([](Joint& joint, Body& a, Body& b) { lks::warm_start(joint, a, b); });
        for (Contact& contact : scene_.contacts) {
            warm_start(contact, bodies_of(contact));
        }
        solve_articulations(scene_);
        if (scale_carried_pushes(scene_, rate_, 2 * least_approach_)) {
            solve_articulations(scene_);
        }
    }

    // An impact may cause the next one: forward and back, until nothing strikes any more.
    void strike_all() {
        if (!any_restitution_) {
            return;
        }
        constexpr int most_passes = 8;
        bool again = true;
        for (int pass = 0; pass < most_passes && again; ++pass) {
            again = false;
            for (std::size_t i = 0; i < scene_.contacts.size(); ++i) {
                Contact& contact = scene_.contacts[pass % 2 == 0 ? i : scene_.contacts.size() - 1 - i];
                again = strike(contact, bodies_of(contact), least_approach_, rate_) || again;
            }
        }
    }

    void predict(std::uint32_t substep) {
        for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
            if (!used(i) || scene_.bodies[i].asleep != 0) {
                continue;
            }
            Body& body = scene_.bodies[i];
            if (body.is_dynamic()) {
                predict_body(body, scene_.descriptions[i], scene_.ticks[i], rate_,
                             world_.counters.speed_clamps);
            } else {
                place_kinematic(body, substep, world_.rate.substeps, rate_);
            }
        }
        for (std::size_t i = 0; i < world_.colliders.size(); ++i) {
            if (world_.colliders[i].used && world_.colliders[i].collider.moves()) {
                place_kinematic(scene_.collider_bodies[i], substep, world_.rate.substeps, rate_);
            }
        }
    }

    void finish() {
        remember_contacts();
        break_what_bears_too_much();
        wake_for_particles();
        for (Body& body : scene_.bodies) {
            if (!body.is_dynamic()) {
                body.target_orientation = body.orientation;
            }
        }
        fall_asleep(world_);
    }

    void break_what_bears_too_much() {
        bool any = false;
        for (std::uint32_t i = 0; i < scene_.joints.size(); ++i) {
            if (is_at_work(i) && breaks(scene_.joints[i])) {
                record_break(world_, scene_.joints[i], i);
                scene_.free_joint(i);
                any = true;
            }
        }
        if (any) {
            scene_.follow_joints();
        }
        for (std::uint32_t i = 0; i < scene_.attachments.size(); ++i) {
            if (scene_.attachment_slots[i].used && lks::breaks(scene_.attachments[i])) {
                record_break(world_, scene_.attachments[i], i);
                scene_.free_attachment(i);
            }
        }
    }

    // What particles have struck, and what attachments hold, is awake.
    void wake_for_particles() {
        constexpr std::int64_t enough = (std::int64_t{1} << world_fraction_bits) / 50;
        for (Body& body : scene_.bodies) {
            if (body.struck > enough) {
                wake(body);
            }
            body.struck = 0;
        }
        for_each_attachment([](Attachment& attachment, const AttachmentSides& sides) {
            if (sides.body != nullptr && attachment.constants.movable != 0) {
                sides.body->rest_ticks = 0;
            }
        });
    }

    // What pushed in this tick, and what holds sleeping bodies, in the order of keys.
    void remember_contacts() {
        scene_.next_memories.clear();
        std::size_t old = 0;
        for (const Contact& contact : scene_.contacts) {
            old = keep_sleeping(old, &contact.key);
            remember(contact);
        }
        keep_sleeping(old, nullptr);
        record_contacts(world_);
        scene_.memories.swap(scene_.next_memories);
    }

    // Those before `end`, or all; the first one that was not looked at.
    std::size_t keep_sleeping(std::size_t old, const ContactKey* end) {
        for (; old < scene_.memories.size() && (end == nullptr || scene_.memories[old].key < *end); ++old) {
            const ContactKey& key = scene_.memories[old].key;
            const bool awake = scene_.bodies[key.body_a].is_awake() ||
                               (key.other < other_is_collider && scene_.bodies[key.other].is_awake());
            if (!awake) {
                add_memory(scene_.memories[old]);
            }
        }
        // The contact's own is replaced.
        return end != nullptr && old < scene_.memories.size() && scene_.memories[old].key == *end ? old + 1
                                                                                                  : old;
    }

    void add_memory(const ContactMemory& memory) {
        if (scene_.next_memories.size() < contact_capacity(scene_.bodies.size())) {
            scene_.next_memories.push_reserved(memory);
        } else {
            ++world_.counters.lost_contacts;
        }
    }

    void remember(const Contact& contact) {
        ContactMemory memory{};
        memory.key = contact.key;
        for (std::uint32_t i = 0; i < contact.count; ++i) {
            if (contact.points[i].push.normal != 0) {
                memory.pushes[memory.count++] = contact.points[i].push;
            }
        }
        if (memory.count != 0) {
            add_memory(memory);
        }
    }

    lks_world& world_;
    RigidScene& scene_;
    MotionRate rate_;
    std::int64_t least_approach_;
    bool any_restitution_ = false;
};

} // namespace

void run_rigid_tick(lks_world& world) {
    if (!world.rigid.empty()) {
        RigidTick(world).run();
        record_sleep(world);
    }
}

} // namespace lks
