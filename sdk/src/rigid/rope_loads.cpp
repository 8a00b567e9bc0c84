#include "rigid/rope_loads.h"

#include <algorithm>

#include "rigid/articulation.h"
#include "rigid/body_motion.h"
#include "rigid/coupling.h"
#include "rigid/make_body.h"
#include "solver/object_tick.h"

namespace lks {
namespace {

using fixed::Scaled;
using fixed::Vec3;

// Metres: a body that weighs on a particle would stretch its attachment by about what it falls in a substep
// times its mass over the particle's. By less than this it is left to the attachment.
constexpr std::uint64_t least_stretches_in_a_metre = 512;
constexpr std::uint64_t fall = 10; // m/s²

// Bones weigh what hangs on them.
bool is_heavy(const Attachment& attachment, const AttachmentSides& sides, const StepRate& rate) {
    const Body& body = *sides.body;
    if (!body.is_dynamic()) {
        return false;
    }
    const Scaled substeps = Scaled::from_u64(rate.substeps_per_second);
    const Scaled particle = to_scaled(particle_inverse_mass(sides.object, attachment.description.particle));
    return body.jointed || particle * Scaled::from_u64(fall * least_stretches_in_a_metre) >
                               to_scaled(body.inverse_mass) * substeps * substeps;
}

// From the greater inverse mass of an attachment's sides to that of its body's tree, what is pushed; or back,
// what moves by it.
std::int64_t in_tree_unit(std::int64_t value, const Attachment& attachment, const ArticulatedBody& part) {
    return fixed::multiply_divide(value, std::int64_t{attachment.side.share} << 2, part.share);
}

// Of the segment at a rope's end, from the particle on; zero: the particle is none.
fixed::Direction end_direction(const Object& object, std::uint32_t particle) {
    const ChainCoefficients& chain = object.coefficients().chain;
    const std::uint32_t last = chain.count();
    const std::uint32_t index = object.asset().particle_to_vertex[particle];
    if (index != 0 && index != last) {
        return {0, 0, 0};
    }
    const std::uint32_t next = chain.particles[index == 0 ? 1 : last - 1];
    fixed::NormalisedVector n{};
    return fixed::normalise(particle_position(object, next) - particle_position(object, particle), n)
               ? n.direction
               : fixed::Direction{0, 0, 0};
}

bool is_none(const fixed::Direction& n) {
    return n.x == 0 && n.y == 0 && n.z == 0;
}

// None: the body is not in one, or does not move.
const ArticulatedTree* tree_of(const RigidScene& scene, std::uint32_t body) {
    const std::uint32_t tree = scene.articulated[body].tree;
    return tree != no_tree && scene.bodies[body].is_awake() ? &scene.trees[tree] : nullptr;
}

// How far its point moves by a push of one along the rope: 30 fraction bits of the greater inverse mass. In
// the middle of a rope, which pulls in two directions, as far as in any.
std::int64_t motion_by_rope(RigidScene& scene, const Attachment& attachment, const fixed::Direction& n) {
    const std::int64_t* const k = attachment.body_motion;
    const AttachmentDescription& d = attachment.description;
    if (is_none(n)) {
        return k[0] + k[3] + k[5] - 2 * std::int64_t{attachment.side.share};
    }
    if (const ArticulatedTree* const tree = tree_of(scene, d.other); tree != nullptr) {
        const std::int64_t response =
            std::max<std::int64_t>(response_of(scene, *tree, d.other, d.point, n), 0);
        return in_tree_unit(response >> (world_fraction_bits - 30), attachment, scene.articulated[d.other]);
    }
    const auto times = [](std::int64_t entry, std::int32_t a, std::int32_t b) {
        return fixed::multiply_shift(entry, std::int64_t{a} * b, 60);
    };
    return times(k[0], n.x, n.x) + times(k[3], n.y, n.y) + times(k[5], n.z, n.z) +
           2 * (times(k[1], n.x, n.y) + times(k[2], n.x, n.z) + times(k[4], n.y, n.z));
}

// Without speed.
void follow(Object& object, std::uint32_t particle, const Vec3& shift) {
    const Coordinates before = object.position(particle);
    move_particle(object, particle, shift);
    const Coordinates after = object.position(particle);
    const std::int64_t moved[3] = {after.x - before.x, after.y - before.y, after.z - before.z};
    for (int axis = 0; axis < 3; ++axis) {
        std::int64_t& x = object.start_axis(axis)[particle];
        x = std::clamp(fixed::saturating_add(x, moved[axis]), -coordinate_limit, coordinate_limit);
    }
}

class LoadedRope {
public:
    LoadedRope(lks_world& world, std::uint32_t object)
        : world_(world), scene_(world.rigid), object_(*world.objects[object].object),
          loads_(scene_.rope_loads_of(object)) {}

    void project() {
        for_each([this](RopeLoad& load, Attachment& attachment) {
            lks::project(attachment, sides_of(world_, attachment));
            load.before = particle_position(object_, load.particle);
            load.along = end_direction(object_, load.particle);
            load.motion = motion_by_rope(scene_, attachment, load.along);
        });
        weigh();
        object_.bear(world_.rate, particles(), particle_count_);
        project_object(world_, object_, world_.scratch[0]);
        for_each([this](const RopeLoad& load, Attachment& attachment) {
            if (load.motion > 0) {
                take_along(load, attachment);
            }
        });
    }

    void undo() {
        for_each([this](RopeLoad& load, Attachment& attachment) {
            const AttachmentSides sides = sides_of(world_, attachment);
            const fixed::Direction n = end_direction(object_, load.particle);
            if (load.motion > 0 && !is_none(n)) {
                // The rope holds back what has moved away from it, and follows what has moved otherwise.
                const std::int64_t away = -fixed::dot(n, attachment_error(attachment, sides));
                if (away > 0) {
                    shift_body(attachment, fixed::scale(n, divide(away, invert(load.motion))));
                }
            }
            follow(object_, load.particle, attachment_error(attachment, sides));
        });
    }

    void forget() {
        weigh();
        object_.bear_no_more(world_.rate, particles(), particle_count_);
    }

private:
    template <typename Use>
    void for_each(const Use& use) {
        for (RopeLoad& load : loads_) {
            use(load, scene_.attachments[load.attachment]);
        }
    }

    ParticleLoad* particles() {
        return scene_.particle_loads.begin() + (loads_.data() - scene_.rope_loads.data());
    }

    // Loads of one particle stand together.
    void weigh() {
        particle_count_ = 0;
        ParticleLoad* const to = particles();
        for (auto load = loads_.begin(); load != loads_.end();) {
            const std::uint32_t particle = load->particle;
            Scaled mass = object_.asset().masses[particle];
            bool moves = true;
            for (; load != loads_.end() && load->particle == particle; ++load) {
                const Attachment& attachment = scene_.attachments[load->attachment];
                moves = moves && load->motion > 0;
                mass = mass + mass_of(attachment, *load);
            }
            to[particle_count_++] = {particle, 0, moves ? Scaled::from_u64(1) / mass : Scaled{}};
        }
    }

    Scaled mass_of(const Attachment& attachment, const RopeLoad& load) {
        if (load.motion <= 0) {
            return {};
        }
        const Scaled motion = Scaled::from_fixed(static_cast<std::uint64_t>(load.motion), 30);
        return Scaled::from_u64(1) / (motion * attachment.constants.greater_inverse_mass);
    }

    void take_along(const RopeLoad& load, Attachment& attachment) {
        Vec3 moved = particle_position(object_, load.particle) - load.before;
        clamp_vector(moved, greatest_push);
        const Inverse inverse = invert(load.motion);
        const Vec3 push{divide(moved.x, inverse), divide(moved.y, inverse), divide(moved.z, inverse)};
        const Vec3 before = attachment.push;
        add_push(attachment, push);
        push_body(attachment, attachment.push - before);
    }

    // The body, with what is joined to it.
    void push_body(const Attachment& attachment, const Vec3& more) {
        const AttachmentDescription& d = attachment.description;
        if (const ArticulatedTree* const tree = tree_of(scene_, d.other); tree != nullptr) {
            push_from_outside(scene_, *tree, d.other, d.point, in_tree_unit(more, attachment));
        } else {
            lks::push(scene_.bodies[d.other], attachment.side, more, 1);
        }
    }

    // At the end of a substep.
    void shift_body(const Attachment& attachment, const Vec3& push) {
        const AttachmentDescription& d = attachment.description;
        if (const ArticulatedTree* const tree = tree_of(scene_, d.other); tree != nullptr) {
            shift_from_outside(scene_, *tree, d.other, d.point, in_tree_unit(push, attachment));
        } else {
            Body& body = scene_.bodies[d.other];
            lks::push(body, attachment.side, push, 1);
            body.orientation = normalise(body.orientation);
            body.follow_orientation();
        }
    }

    Vec3 in_tree_unit(const Vec3& push, const Attachment& attachment) const {
        const ArticulatedBody& part = scene_.articulated[attachment.description.other];
        return {lks::in_tree_unit(push.x, attachment, part), lks::in_tree_unit(push.y, attachment, part),
                lks::in_tree_unit(push.z, attachment, part)};
    }

    lks_world& world_;
    RigidScene& scene_;
    Object& object_;
    std::span<RopeLoad> loads_;
    std::size_t particle_count_ = 0;
};

// Of those that may weigh on it a rope bears nothing where none is heavy.
template <typename MayWeigh>
void keep_heavy(RigidScene& scene, const MayWeigh& may_weigh) {
    Array<RopeLoad>& loads = scene.rope_loads;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < loads.size();) {
        std::size_t end = i;
        bool heavy = false;
        for (; end < loads.size() && loads[end].object == loads[i].object; ++end) {
            heavy = heavy || (loads[end].heavy && may_weigh(loads[end]));
        }
        for (; i < end; ++i) {
            const bool stays = heavy && may_weigh(loads[i]);
            scene.attachments[loads[i].attachment].loads_rope = stays;
            if (stays) {
                loads[kept++] = loads[i];
            }
        }
    }
    static_cast<void>(loads.resize(kept));                // never grows
    static_cast<void>(scene.particle_loads.resize(kept)); // within its room
}

} // namespace

void find_rope_loads(lks_world& world) {
    RigidScene& scene = world.rigid;
    scene.rope_loads.clear();
    bool any = false;
    for (std::uint32_t i = 0; i < scene.attachments.size(); ++i) {
        Attachment& attachment = scene.attachments[i];
        attachment.loads_rope = false;
        if (!scene.attachment_slots[i].used) {
            continue;
        }
        const AttachmentSides sides = sides_of(world, attachment);
        const AttachmentDescription& d = attachment.description;
        if (may_load_rope(d, sides.object) && (attachment.constants.movable & 1) != 0) {
            RopeLoad made{};
            made.object = d.object;
            made.particle = d.particle;
            made.attachment = i;
            made.heavy = is_heavy(attachment, sides, world.rate);
            scene.rope_loads.push_reserved(made);
            any = any || made.heavy;
        }
    }
    if (!any) {
        scene.rope_loads.clear();
        return;
    }
    std::sort(scene.rope_loads.begin(), scene.rope_loads.end());
    keep_heavy(scene, [](const RopeLoad&) { return true; });
    for (RopeLoad& load : scene.rope_loads) {
        load.anchored = !world.objects[load.object].object->pins().empty() ||
                        any_rope_load(scene, load.object, [&scene](std::uint32_t body) {
                            return !scene.bodies[body].is_dynamic();
                        });
    }
}

void drop_loads(RigidScene& scene) {
    keep_heavy(scene, [&scene](const RopeLoad& load) {
        return scene.articulated[scene.attachments[load.attachment].description.other].loads_rope;
    });
}

void project_loaded_rope(lks_world& world, std::uint32_t object) {
    LoadedRope(world, object).project();
}

void forget_rope_loads(lks_world& world) {
    for_each_loaded_rope(world.rigid, [&world](std::uint32_t object) { LoadedRope(world, object).forget(); });
}

void undo_rope_loads(lks_world& world, std::uint32_t object) {
    LoadedRope(world, object).undo();
}

} // namespace lks
