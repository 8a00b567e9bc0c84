#include "collide/contact.h"

#include <algorithm>
#include <bit>

#include "collide/saturation.h"
#include "collide/trace.h"
#include "collide/wide_response.h"

namespace lks {
namespace {

// Positions relative to a shape's centre are followed within this ball; no shape reaches past 61 m.
// Differences of two such positions then fit into 64 bits, and so do their lengths.
constexpr std::int64_t followed_radius = coordinate_one * 63;

// The plane that a particle may not get behind, in the shape's frame at the end of the substep.
struct Contact {
    fixed::Direction normal;
    std::int64_t depth;     // of the particle's present position behind it, to be undone, > 0
    std::int64_t old_depth; // the part of depth that was there when the substep began
};

// The relative way of one particle through the substep, in the shape's frame.
struct Way {
    fixed::Vec3 start;
    fixed::Vec3 end;
};

bool is_followed(const fixed::Vec3& v) {
    const auto coarse = [](std::int64_t a) { return fixed::magnitude(a) >> 32; };
    const std::uint64_t x = coarse(v.x), y = coarse(v.y), z = coarse(v.z);
    constexpr std::uint64_t radius = static_cast<std::uint64_t>(followed_radius) >> 32;
    return x * x + y * y + z * z < radius * radius;
}

// px - c0 where it is too long: the point at which the way to `end`, which is followed, comes within the
// followed ball. What is left out is at least a metre from the shape. Halved, as the differences may have 65
// bits.
fixed::Vec3 cut_start(const fixed::Vec3& start_position, const fixed::Vec3& start_centre,
                      const fixed::Vec3& end) {
    fixed::Vec3 outer = {(start_position.x >> 1) - (start_centre.x >> 1),
                         (start_position.y >> 1) - (start_centre.y >> 1),
                         (start_position.z >> 1) - (start_centre.z >> 1)};
    fixed::Vec3 inner = {end.x >> 1, end.y >> 1, end.z >> 1};
    // The way is below 2^64 units long; 16 halvings leave millimetres.
    for (int halving = 0; halving < 16; ++halving) {
        const fixed::Vec3 middle = {(outer.x >> 1) + (inner.x >> 1), (outer.y >> 1) + (inner.y >> 1),
                                    (outer.z >> 1) + (inner.z >> 1)};
        const bool inside = is_followed(saturating_add(middle, middle));
        (inside ? inner : outer) = middle;
    }
    return inner + inner;
}

// Where the particle is, and was at the start, in the shape's frame. False: too far away to touch.
bool find_way(const ContactFrame& frame, const fixed::Vec3& position, const fixed::Vec3& start, Way& way) {
    const fixed::Vec3 relative_end = saturating_subtract(position, frame.end_centre);
    if (!is_followed(relative_end)) {
        return false;
    }
    fixed::Vec3 relative_start = saturating_subtract(start, frame.start_centre);
    if (!is_followed(relative_start)) {
        relative_start = cut_start(start, frame.start_centre, relative_end);
    }
    way.end = fixed::rotate_transposed(frame.end_rotation, relative_end);
    way.start = fixed::rotate_transposed(frame.start_rotation, relative_start);
    return true;
}

// For planes: an object may reach 128 m from the plane's centre, so that the differences are halved, too.
fixed::Vec3 plane_local(const fixed::Matrix3& rotation, const fixed::Vec3& position,
                        const fixed::Vec3& centre) {
    const auto half = [](std::int64_t a, std::int64_t b) {
        return std::clamp((a >> 1) - (b >> 1), -coordinate_limit, coordinate_limit);
    };
    const fixed::Vec3 relative = {half(position.x, centre.x), half(position.y, centre.y),
                                  half(position.z, centre.z)};
    const fixed::Vec3 local = fixed::rotate_transposed(rotation, relative);
    return {saturating_double(local.x), saturating_double(local.y), saturating_double(local.z)};
}

// What is new is undone at once; a collider that appears in a heap is not to shoot it away.
void take_depth(const ContactFrame& frame, std::int64_t depth, std::int64_t start_depth, Contact& contact) {
    const std::int64_t old_depth = std::min(depth, std::max<std::int64_t>(start_depth, 0));
    contact.old_depth = std::min(old_depth, frame.greatest_recovery);
    contact.depth = depth - (old_depth - contact.old_depth);
}

template <lks_shape_kind kind>
bool find_contact(const ContactFrame& frame, const Way& way, Contact& contact) {
    const auto nearest_to = [&frame](const fixed::Vec3& p) {
        return nearest_surface<kind>(frame.shape, p, frame.margin);
    };
    Trace found{};
    if (!trace(nearest_to, way.start, way.end, contact_tolerance, found)) {
        return false;
    }
    contact.normal = found.hit.normal;
    take_depth(frame, found.closing - found.hit.distance, -found.start.distance, contact);
    return true;
}

bool find_plane_contact(const ContactFrame& frame, const Way& way, Contact& contact) {
    const std::int64_t height = saturating_subtract(way.end.y, frame.margin);
    if (height >= 0) {
        return false;
    }
    const std::int64_t start_height = saturating_subtract(way.start.y, frame.margin);
    contact.normal = {0, direction_one, 0};
    take_depth(frame, saturating_subtract(0, height), saturating_subtract(0, start_height), contact);
    return true;
}

std::int64_t times_friction(std::uint32_t coefficient, std::int64_t depth) {
    const fixed::UInt128 product = fixed::multiply_unsigned(coefficient, static_cast<std::uint64_t>(depth));
    return saturate(fixed::saturate_to_uint64(fixed::shift_right_rounded(product, friction_fraction_bits)));
}

// Coulomb's law on positions. The normal impulse of the substep has moved the particle by the new depth, so
// that friction may move it by up to the static coefficient times that against the sliding of this substep:
// if that does for all of it the particle sticks, else the dynamic coefficient counts. Returns by how much it
// slides less.
fixed::Vec3 friction(const ContactFrame& frame, const Way& way, const Contact& contact) {
    const std::int64_t new_depth = contact.depth - contact.old_depth;
    if (frame.static_friction == 0 || new_depth == 0) {
        return {0, 0, 0};
    }
    // The new depth goes in first: what is left along the normal is then too small for the rounding of
    // |normal| to matter.
    const fixed::Vec3 motion =
        saturating_subtract(way.end, way.start) + fixed::scale(contact.normal, new_depth);
    const fixed::Vec3 sliding = motion - fixed::scale(contact.normal, fixed::dot(contact.normal, motion));
    fixed::NormalisedVector slide{};
    if (!fixed::normalise(sliding, slide)) {
        return {0, 0, 0};
    }
    if (slide.length <= times_friction(frame.static_friction, new_depth)) {
        return sliding;
    }
    const std::int64_t loss = std::min(times_friction(frame.dynamic_friction, new_depth), slide.length);
    return fixed::scale(slide.direction, loss);
}

std::int64_t moved(std::int64_t position, std::int64_t by) {
    return std::clamp(fixed::saturating_add(position, by), -coordinate_limit, coordinate_limit);
}

// Returns the new depth.
std::int64_t apply(const ContactFrame& frame, const Way& way, const Contact& contact,
                   const ParticleArrays& particles, std::uint32_t i, ContactReaction* reaction) {
    const fixed::Vec3 push = fixed::scale(contact.normal, contact.depth) - friction(frame, way, contact);
    fixed::Vec3 correction = fixed::rotate(frame.end_rotation, push);
    const fixed::Vec3 recovery =
        contact.old_depth > 0
            ? fixed::rotate(frame.end_rotation, fixed::scale(contact.normal, contact.old_depth))
            : fixed::Vec3{0, 0, 0};
    if (reaction != nullptr) {
        // Recovering from an old overlap gives no speed, to neither of them.
        correction = recovery + reaction->give_way(i, correction - recovery);
    }
    particles.x[i] = moved(particles.x[i], correction.x);
    particles.y[i] = moved(particles.y[i], correction.y);
    particles.z[i] = moved(particles.z[i], correction.z);
    if (contact.old_depth > 0) {
        particles.start_x[i] = fixed::saturating_add(particles.start_x[i], recovery.x);
        particles.start_y[i] = fixed::saturating_add(particles.start_y[i], recovery.y);
        particles.start_z[i] = fixed::saturating_add(particles.start_z[i], recovery.z);
    }
    return contact.depth - contact.old_depth;
}

// A particle's way grows by half of itself where the collider rotates: its bounding box against the box of
// the frame, in object space.
bool misses_box(const ContactFrame& frame, const fixed::Vec3& position, const fixed::Vec3& start) {
    fixed::Vec3 low = {std::min(position.x, start.x), std::min(position.y, start.y),
                       std::min(position.z, start.z)};
    fixed::Vec3 high = {std::max(position.x, start.x), std::max(position.y, start.y),
                        std::max(position.z, start.z)};
    const std::int64_t own = sum_of_magnitudes(saturating_subtract(high, low)) / 2 + 1;
    low = saturating_subtract(low, {own, own, own});
    high = saturating_add(high, {own, own, own});
    return (low.x > frame.box_high.x) | (low.y > frame.box_high.y) | (low.z > frame.box_high.z) |
           (high.x < frame.box_low.x) | (high.y < frame.box_low.y) | (high.z < frame.box_low.z);
}

fixed::Vec3 position_of(const ParticleArrays& particles, std::uint32_t i) {
    return {particles.x[i], particles.y[i], particles.z[i]};
}
fixed::Vec3 start_of(const ParticleArrays& particles, std::uint32_t i) {
    return {particles.start_x[i], particles.start_y[i], particles.start_z[i]};
}

// Bit i: particle first + i.
std::uint64_t without_misses(const ContactFrame& frame, const ParticleArrays& particles, std::uint32_t first,
                             std::uint64_t near) {
    for (std::uint64_t left = near; left != 0; left &= left - 1) {
        const auto i = first + static_cast<std::uint32_t>(std::countr_zero(left));
        if (misses_box(frame, position_of(particles, i), start_of(particles, i))) {
            near &= ~(left & -left);
        }
    }
    return near;
}

constexpr std::uint32_t particles_at_once = 64;

// Calls resolve(i), which returns the new depth, for those of the particles whose bit near(first, count)
// sets, and respond() leaves.
template <typename Near, typename Resolve>
void visit_near(std::uint32_t first, std::uint32_t count, const Near& near, WideResponse& respond,
                const FarPushes* far, const Resolve& resolve) {
    const std::uint32_t last = first + count;
    for (std::uint32_t i = first; i < last; i += particles_at_once) {
        const std::uint32_t at_once = std::min(last - i, particles_at_once);
        std::uint64_t left = respond(i, at_once, near(i, at_once));
        for (; left != 0; left &= left - 1) {
            const std::int64_t depth = resolve(i + static_cast<std::uint32_t>(std::countr_zero(left)));
            if (far != nullptr && depth > far->beyond) {
                far->words[i / particles_at_once] |= left & -left;
            }
        }
    }
}

template <lks_shape_kind kind>
bool meets_solid(const ContactFrame& frame, const fixed::Vec3& position, const fixed::Vec3& start, Way& way,
                 Contact& contact) {
    if (!find_way(frame, position, start, way)) {
        return false;
    }
    // The distance changes by no more than the way is long.
    const std::int64_t length_bound = sum_of_magnitudes(way.end - way.start);
    return !is_beyond<kind>(frame.shape, way.end, frame.margin, length_bound) &&
           find_contact<kind>(frame, way, contact);
}

bool meets_plane(const ContactFrame& frame, const fixed::Vec3& position, const fixed::Vec3& start, Way& way,
                 Contact& contact) {
    way.end = plane_local(frame.end_rotation, position, frame.end_centre);
    way.start = plane_local(frame.start_rotation, start, frame.start_centre);
    return find_plane_contact(frame, way, contact);
}

template <lks_shape_kind kind>
std::int64_t resolve_solid_contact(const ContactFrame& frame, const ParticleArrays& particles,
                                   std::uint32_t i, ContactReaction* reaction) {
    if (reaction != nullptr && reaction->ignores(i)) {
        return 0;
    }
    Way way{};
    Contact contact{};
    return meets_solid<kind>(frame, position_of(particles, i), start_of(particles, i), way, contact)
               ? apply(frame, way, contact, particles, i, reaction)
               : 0;
}

std::int32_t upper_half(std::int64_t coordinate) {
    return static_cast<std::int32_t>(coordinate >> 32);
}

// Most particles leave with the kernel's question.
template <lks_shape_kind kind>
void resolve_solid(const ContactFrame& frame, const ParticleArrays& particles, std::uint32_t first,
                   std::uint32_t count, const Kernels& kernels, ContactReaction* reaction,
                   const FarPushes* far) {
    const auto resolve = [&](std::uint32_t i) {
        return resolve_solid_contact<kind>(frame, particles, i, reaction);
    };
    WideResponse respond(frame, particles, kernels.respond, reaction, far);
    if (frame.rotating && (!frame.has_box || frame.greatest_growth == INT64_MAX)) {
        // Nothing can be said of all of them.
        const auto near = [&](std::uint32_t i, std::uint32_t n) {
            const std::uint64_t all = UINT64_MAX >> (particles_at_once - n);
            return frame.has_box ? without_misses(frame, particles, i, all) : all;
        };
        visit_near(first, count, near, respond, far, resolve);
        return;
    }
    // Particles' boxes grow by no more than the frame's does here; each is looked at by its own later.
    const std::int64_t growth = frame.rotating ? frame.greatest_growth : 0;
    const fixed::Vec3 low = saturating_subtract(frame.box_low, {growth, growth, growth});
    const fixed::Vec3 high = saturating_add(frame.box_high, {growth, growth, growth});
    const BoxTask task{{particles.x, particles.y, particles.z},
                       {particles.start_x, particles.start_y, particles.start_z},
                       {upper_half(low.x), upper_half(low.y), upper_half(low.z)},
                       {upper_half(high.x), upper_half(high.y), upper_half(high.z)}};
    const auto near = [&](std::uint32_t i, std::uint32_t n) {
        const std::uint64_t in_box = kernels.near_box(task, i, n);
        return frame.rotating ? without_misses(frame, particles, i, in_box) : in_box;
    };
    visit_near(first, count, near, respond, far, resolve);
}

// A plane is met only by what is below it in the end. Heights on 24 fraction bits decide for most.
void resolve_plane(const ContactFrame& frame, const ParticleArrays& particles, std::uint32_t first,
                   std::uint32_t count, const Kernels& kernels, ContactReaction* reaction,
                   const FarPushes* far) {
    const fixed::Matrix3& r = frame.end_rotation;
    const fixed::Vec3& c = frame.end_centre;
    const std::int32_t a = r.m[0][1], b = r.m[1][1], d = r.m[2][1];
    // Q54: each difference is right to one unit of 2^-24, times components that sum to less than 2.
    const std::int64_t certainly_above = (frame.margin >> 2) + (std::int64_t{2} << direction_fraction_bits);
    const PlaneTask task{{particles.x, particles.y, particles.z},
                         {a, b, d},
                         certainly_above + a * (c.x >> 32) + b * (c.y >> 32) + d * (c.z >> 32)};
    const auto near = [&](std::uint32_t i, std::uint32_t n) { return kernels.near_plane(task, i, n); };
    WideResponse respond(frame, particles, kernels.respond, reaction, far);
    visit_near(first, count, near, respond, far, [&](std::uint32_t i) {
        Way way{};
        Contact contact{};
        return meets_plane(frame, position_of(particles, i), start_of(particles, i), way, contact)
                   ? apply(frame, way, contact, particles, i, reaction)
                   : 0;
    });
}

// What find_new_depth() finds of one shape.
template <typename Meets>
bool find_new_depth_of(const ContactFrame& frame, const fixed::Vec3& position, const fixed::Vec3& start,
                       const Meets& meets, NewDepth& out) {
    Way way{};
    Contact contact{};
    if (!meets(frame, position, start, way, contact)) {
        return false;
    }
    out = {fixed::rotate(frame.end_rotation, contact.normal), contact.depth - contact.old_depth};
    return out.depth > 0;
}

} // namespace

void resolve_contacts(const ContactFrame& frame, const ParticleArrays& particles, std::uint32_t first,
                      std::uint32_t count, const Kernels& kernels, ContactReaction* reaction,
                      const FarPushes* far) {
    if (!frame.reachable) {
        return;
    }
    switch (frame.shape.kind) {
    case LKS_SHAPE_PLANE:
        return resolve_plane(frame, particles, first, count, kernels, reaction, far);
    case LKS_SHAPE_SPHERE:
        return resolve_solid<LKS_SHAPE_SPHERE>(frame, particles, first, count, kernels, reaction, far);
    case LKS_SHAPE_CAPSULE:
        return resolve_solid<LKS_SHAPE_CAPSULE>(frame, particles, first, count, kernels, reaction, far);
    default:
        return resolve_solid<LKS_SHAPE_BOX>(frame, particles, first, count, kernels, reaction, far);
    }
}

bool find_new_depth(const ContactFrame& frame, const fixed::Vec3& position, const fixed::Vec3& start,
                    NewDepth& out) {
    if (frame.has_box && misses_box(frame, position, start)) {
        return false;
    }
    switch (frame.shape.kind) {
    case LKS_SHAPE_PLANE:
        return find_new_depth_of(frame, position, start, meets_plane, out);
    case LKS_SHAPE_SPHERE:
        return find_new_depth_of(frame, position, start, meets_solid<LKS_SHAPE_SPHERE>, out);
    case LKS_SHAPE_CAPSULE:
        return find_new_depth_of(frame, position, start, meets_solid<LKS_SHAPE_CAPSULE>, out);
    default:
        return find_new_depth_of(frame, position, start, meets_solid<LKS_SHAPE_BOX>, out);
    }
}

} // namespace lks
