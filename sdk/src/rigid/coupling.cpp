#include "rigid/coupling.h"

#include <algorithm>

#include "collide/filter.h"
#include "collide/saturation.h"
#include "rigid/ways.h"

namespace lks {
namespace {

using fixed::Vec3;

class Coupling {
public:
    explicit Coupling(lks_world& world) : world_(world), scene_(world.rigid) {
        const Vec3& g = world.gravity;
        const std::int64_t ticks = world.rate.ticks_per_second;
        twice_fall_ = sum_of_magnitudes(g) / ticks / ticks;
    }

    void find() {
        scene_.coupled.clear();
        scene_.object_pairs.clear();
        scene_.object_pushes.clear();
        scene_.is_coupled.clear();
        scene_.held.clear();
        if (scene_.empty() || world_.objects.empty()) {
            return;
        }
        for (std::size_t i = 0; i < world_.objects.size(); ++i) {
            scene_.is_coupled.push_reserved(0);
        }
        for (std::size_t i = 0; i < scene_.attachments.size(); ++i) {
            if (scene_.attachment_slots[i].used) {
                const AttachmentDescription& d = scene_.attachments[i].description;
                scene_.is_coupled[d.object] = 1;
                if (d.kind == LKS_ATTACHMENT_TO_VERTEX) {
                    scene_.is_coupled[d.other] = 1;
                } else {
                    scene_.held.push_reserved({d.object, d.other, d.particle});
                }
            }
        }
        std::sort(scene_.held.begin(), scene_.held.end());
        if (!scene_.bodies.empty()) {
            find_pairs();
        }
        for (std::uint32_t i = 0; i < scene_.is_coupled.size(); ++i) {
            if (scene_.is_coupled[i] != 0) {
                scene_.coupled.push_reserved(i);
            }
        }
    }

private:
    static constexpr std::uint32_t object_flag = 0x80000000u;

    void find_pairs() {
        scene_.overlaps.clear();
        scene_.boxed.clear();
        for (std::uint32_t i = 0; i < scene_.bodies.size(); ++i) {
            if (scene_.body_slots[i].used && meets_particles(scene_.descriptions[i].filter)) {
                scene_.overlaps.add(box_of_body(scene_.bodies[i], scene_.descriptions[i]));
                scene_.boxed.push_reserved(i);
            }
        }
        for (std::uint32_t i = 0; i < world_.objects.size(); ++i) {
            if (world_.objects[i].object != nullptr) {
                scene_.overlaps.add(box_of_object(*world_.objects[i].object));
                scene_.boxed.push_reserved(i | object_flag);
            }
        }
        scene_.overlaps.for_each_pair(
            [this](std::uint32_t i, std::uint32_t j) { add_pair(scene_.boxed[i], scene_.boxed[j]); });
        std::sort(scene_.object_pairs.begin(), scene_.object_pairs.end());
        static_cast<void>(scene_.object_pushes.resize(scene_.object_pairs.size())); // within its room
    }

    // Bodies stand before objects.
    void add_pair(std::uint32_t body, std::uint32_t object) {
        if ((body & object_flag) != 0 || (object & object_flag) == 0) {
            return;
        }
        if (scene_.object_pairs.size() == object_pair_capacity(world_.objects.size(), scene_.bodies.size())) {
            ++world_.counters.lost_contacts;
            return;
        }
        const std::uint32_t index = object & ~object_flag;
        scene_.object_pairs.push_reserved(std::uint64_t{index} << 32 | body);
        scene_.is_coupled[index] = 1;
    }

    // Twice what gravity moves in a tick.
    std::int64_t twice_fall(std::int64_t gravity_factor) const {
        const std::int64_t factor = gravity_factor < 0 ? -gravity_factor : gravity_factor;
        return fixed::multiply_shift(twice_fall_, factor, world_fraction_bits);
    }

    // However it turns.
    Box box_of_body(const Body& body, const BodyDescription& description) const {
        const std::int64_t speed =
            body.is_awake() ? per_tick(sum_of_magnitudes(body.velocity), world_.rate) : 0;
        const std::int64_t reach =
            description.radius + near_distance + 2 * speed + twice_fall(description.gravity_factor);
        const auto low = [reach](std::int64_t p, std::int64_t q) {
            return saturating_subtract(std::min(p, q), reach);
        };
        const auto high = [reach](std::int64_t p, std::int64_t q) {
            return fixed::saturating_add(std::max(p, q), reach);
        };
        const Vec3& p = body.position;
        const Vec3& q = body.is_dynamic() ? body.position : body.target_position;
        return {{low(p.x, q.x), low(p.y, q.y), low(p.z, q.z)},
                {high(p.x, q.x), high(p.y, q.y), high(p.z, q.z)}};
    }

    // Where its particles are, and may be at twice their speed.
    Box box_of_object(const Object& object) const {
        Bounds bounds = object.bounds(*world_.kernels);
        for (const Pin& pin : object.pins()) {
            include(bounds, pin.target);
        }
        const std::int64_t motion = world_from_coordinate(object.greatest_motion(*world_.kernels)) *
                                    static_cast<std::int64_t>(world_.rate.substeps);
        const std::int64_t reach = near_distance + twice_fall(object.gravity_factor) + 2 * motion +
                                   world_from_coordinate(object.asset().particle_radius) + 1;
        const Vec3& o = object.origin;
        const Vec3 low{world_from_coordinate(bounds.low.x), world_from_coordinate(bounds.low.y),
                       world_from_coordinate(bounds.low.z)};
        const Vec3 high{world_from_coordinate(bounds.high.x), world_from_coordinate(bounds.high.y),
                        world_from_coordinate(bounds.high.z)};
        const Vec3 all{reach, reach, reach};
        return {saturating_subtract(saturating_add(o, low), all),
                saturating_add(saturating_add(o, high), all)};
    }

    lks_world& world_;
    RigidScene& scene_;
    std::int64_t twice_fall_; // at a gravity factor of one
};

} // namespace

void find_coupled(lks_world& world) {
    Coupling(world).find();
}

AttachmentSides sides_of(lks_world& world, const Attachment& attachment) {
    const AttachmentDescription& d = attachment.description;
    const bool to_body = d.kind == LKS_ATTACHMENT_TO_BODY;
    return {*world.objects[d.object].object, to_body ? &world.rigid.bodies[d.other] : nullptr,
            to_body ? nullptr : world.objects[d.other].object};
}

} // namespace lks
