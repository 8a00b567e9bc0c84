#include "rigid/rigid_tick.h"

#include <algorithm>

#include "fixed/formats.h"
#include "rigid/articulation.h"
#include "rigid/body_motion.h"
#include "rigid/closures.h"
#include "rigid/contact_memory.h"
#include "rigid/contact_search.h"
#include "rigid/coupling.h"
#include "rigid/figure_overlaps.h"
#include "rigid/figures.h"
#include "rigid/light_feet.h"
#include "rigid/motor_aim.h"
#include "rigid/particle_touch.h"
#include "rigid/rigid_substep.h"
#include "rigid/rope_loads.h"
#include "rigid/sleep.h"
#include "rigid/tick_spin.h"
#include "rigid/wide_trees.h"
#include "solver/object_tick.h"
#include "solver/world.h"

namespace lks {
namespace {

class RigidTick {
public:
    RigidTick(lks_world& world, Team* team)
        : world_(world), scene_(world.rigid), rate_(world.rate), team_(team) {}

    void run() {
        begin();
        wake_islands(world_);
        const bool moves = anything_moves();
        if (!moves && scene_.coupled.empty()) {
            end_forgotten_contacts();
            return;
        }
        prepare();
        scene_.contacts.clear();
        join_figures(scene_);
        if (moves) {
            find_contacts(world_, team_);
        }
        if (world_.event_log.wants_contacts()) {
            scene_.contact_marks.clear();
            static_cast<void>(scene_.contact_marks.resize(scene_.contacts.size())); // within its room
        }
        find_articulations(scene_);
        const bool joined = find_light_feet(scene_, world_.gravity);
        find_closures(scene_);
        find_figures(scene_);
        find_bundles(scene_);
        // Those that it has woken, too.
        for (Body& body : scene_.bodies) {
            if (body.is_awake()) {
                body.world_inverse = rotated(body.inverse_inertia, body.rotation);
            }
        }
        for_each_joint([](Joint& joint) { find_motor_aim(joint); });
        run_substeps();
        if (joined) {
            join_figures(scene_);
        }
        part_figures(scene_, world_.rate);
        finish();
    }

private:
    bool used(std::size_t index) const { return scene_.body_slots[index].used; }

    bool is_at_work(std::size_t joint) const {
        const JointDescription& d = scene_.joints[joint].description;
        return scene_.joint_slots[joint].used &&
               (scene_.bodies[d.body_a].is_awake() || scene_.bodies[d.body_b].is_awake());
    }

    template <typename Use>
    void for_each_joint(const Use& use) {
        for (std::size_t i = 0; i < scene_.joints.size(); ++i) {
            if (is_at_work(i)) {
                use(scene_.joints[i]);
            }
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
        scene_.follow_joints();
        for (Body& body : scene_.bodies) {
            body.previous_position = body.position;
            body.previous_rotation = narrow(body.orientation);
            body.tick_position = body.position;
            body.tick_orientation = body.orientation;
            body.tick_speeds = body.speeds();
            body.slept = body.asleep != 0;
            if (body.slept) {
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
        for_each_joint([](Joint& joint) {
            joint.pushed = {0, 0, 0};
            joint.turned = {0, 0, 0};
        });
        for (const std::uint32_t index : scene_.coupled) {
            begin_object_tick(world_, *world_.objects[index].object, world_.scratch[0]);
        }
        for_each_attachment(world_, [this](Attachment& attachment, const AttachmentSides& sides) {
            begin_tick(attachment, sides, world_.rate);
        });
        find_rope_loads(world_);
        note_particle_touches(world_);
    }

    void run_substeps() {
        scene_.contact_moves.clear();
        static_cast<void>(scene_.contact_moves.resize(scene_.bodies.size() + 1)); // within its room
        RigidSubstep rigid_substep(world_, team_);
        for (std::uint32_t substep = 1; substep <= world_.rate.substeps; ++substep) {
            rigid_substep.run(substep);
        }
        forget_rope_loads(world_);
    }

    void finish() {
        remember_contacts();
        break_what_bears_too_much();
        wake_for_particles();
        for (Body& body : scene_.bodies) {
            if (!body.is_dynamic()) {
                keep_mean_spin(body);
                body.target_orientation = body.orientation;
            } else if (body.is_awake()) {
                // What undid errors has left this behind.
                world_.counters.world_edge_hits += axes_at_edge(body);
                clamp_vector(body.position, world_position_limit);
                body.follow_orientation();
            }
        }
        fall_asleep(world_);
    }

    // What it keeps if it becomes dynamic: not that of its last substep (fixed::interpolate).
    void keep_mean_spin(Body& body) const {
        if (!(body.orientation == body.tick_orientation)) {
            body.angular_velocity = tick_spin(body.tick_orientation, body.orientation, world_.rate);
            clamp_vector(body.angular_velocity, rate_.spin_limit);
        }
    }

    // Axes on which it is beyond the edge of the world, or there and on its way out.
    static std::uint32_t axes_at_edge(const Body& body) {
        const auto is_at_edge = [](std::int64_t place, std::int64_t velocity) {
            constexpr std::int64_t edge = world_position_limit;
            const std::int64_t outwards = place < 0 ? -velocity : velocity;
            return (outwards > 0 ? place >= edge || place <= -edge : place > edge || place < -edge) ? 1u : 0u;
        };
        return is_at_edge(body.position.x, body.velocity.x) + is_at_edge(body.position.y, body.velocity.y) +
               is_at_edge(body.position.z, body.velocity.z);
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
            scene_.joints_changed();
        }
        for (std::uint32_t i = 0; i < scene_.attachments.size(); ++i) {
            if (scene_.attachment_slots[i].used && lks::breaks(scene_.attachments[i])) {
                record_break(world_, scene_.attachments[i], i);
                scene_.free_attachment(i);
            }
        }
    }

    // What particles have struck, or left, and what attachments hold, is awake.
    void wake_for_particles() {
        constexpr std::int64_t enough = world_one / 50;
        for (Body& body : scene_.bodies) {
            if (body.struck > enough) {
                wake(body);
            }
            body.struck = 0;
        }
        wake_who_was_left(world_);
        for_each_attachment(world_, [](Attachment& attachment, const AttachmentSides& sides) {
            if (sides.body != nullptr && attachment.constants.movable != 0) {
                sides.body->rest = 0;
            }
        });
    }

    // Where nobody moves.
    void end_forgotten_contacts() {
        const auto is_forgotten = [](const ContactMemory& memory) { return memory.forgotten != 0; };
        if (std::any_of(scene_.memories.begin(), scene_.memories.end(), is_forgotten)) {
            scene_.contacts.clear();
            remember_contacts();
        }
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
        record_particles(world_);
        scene_.memories.swap(scene_.next_memories);
    }

    // Those before `end`, or all; the first one that was not looked at.
    std::size_t keep_sleeping(std::size_t old, const ContactKey* end) {
        for (; old < scene_.memories.size() && (end == nullptr || scene_.memories[old].key < *end); ++old) {
            const ContactKey& key = scene_.memories[old].key;
            const bool awake = scene_.bodies[key.body_a].is_awake() ||
                               (key.other < other_is_collider && scene_.bodies[key.other].is_awake());
            if (!awake && scene_.memories[old].forgotten == 0) {
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
        memory.normal = contact.normal();
        const bool may_stick =
            keeps_side(scene_.bodies[contact.key.body_a], other_body(scene_, contact.key.other));
        for (std::uint32_t i = 0; i < contact.count; ++i) {
            const ContactPoint& point = contact.points[i];
            if (point.push.normal != 0 || (may_stick && point.separation < -sticking_depth)) {
                memory.pushes[memory.count++] = point.push;
            }
        }
        if (memory.count == 0) {
            return;
        }
        if (is_with_sleeper(scene_, memory.key)) {
            scale_pushes({memory.pushes, memory.count}, wall_ratio(scene_, memory.key));
        }
        add_memory(memory);
    }

    lks_world& world_;
    RigidScene& scene_;
    MotionRate rate_;
    Team* team_;
};

} // namespace

bool bodies_need_team(const lks_world& world) {
    // A substep of so many takes longer than its stages do by themselves.
    constexpr std::size_t worth_waking = 48;
    std::size_t awake = 0;
    for (const Body& body : world.rigid.bodies) {
        awake += body.is_awake() ? 1u : 0u;
    }
    return awake >= worth_waking;
}

void run_rigid_tick(lks_world& world, Team* team) {
    if (!world.rigid.empty()) {
        RigidTick(world, team).run();
        record_sleep(world);
    }
}

} // namespace lks
