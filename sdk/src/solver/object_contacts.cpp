#include "solver/object_contacts.h"

#include <algorithm>

#include "collide/broad_phase.h"
#include "fixed/formats.h"
#include "solver/object_arrays.h"
#include "solver/pins.h"
#include "solver/world.h"

namespace lks {
namespace {

// What is pushed no further than a millimetre, or than an old overlap is undone, is not looked at again: one
// push after the other stops it, of an angle a between two plates some mm/sin²a behind their faces.
constexpr std::int64_t greatest_unlooked_push = coordinate_one >> 10;

fixed::Vec3 within_range(const fixed::Vec3& corner) {
    const auto within = [](std::int64_t value) {
        return std::clamp(value, -coordinate_limit, coordinate_limit);
    };
    return {within(corner.x), within(corner.y), within(corner.z)};
}

Bounds grown(const Bounds& bounds, std::int64_t reach) {
    const fixed::Vec3 all{reach, reach, reach};
    return {within_range(bounds.low) - all, within_range(bounds.high) + all};
}

} // namespace

void ObjectContacts::find_candidates(Bounds bounds, std::uint32_t substeps) {
    candidate_count_ = 0;
    if (world_.colliders.empty()) {
        return;
    }
    for (const Pin& pin : object_.pins()) {
        include(bounds, pin.target);
    }
    const std::int64_t reach = std::min(world_.rate.motion_limit, coordinate_limit / substeps) * substeps;
    candidate_count_ = collect_candidates(world_.colliders.data(),
                                          static_cast<std::uint32_t>(world_.colliders.size()), object_.origin,
                                          grown(bounds, reach), object_.asset().particle_radius, candidates_);
}

bool ObjectContacts::resolve(std::uint32_t substep) {
    const Bounds swept = swept_bounds();
    const FarPushes far{std::min(greatest_unlooked_push, world_.rate.greatest_recovery),
                        scratch_.far_pushed.data()};
    const bool looks_again = candidate_count_ > 1;
    if (looks_again) {
        std::fill_n(far.words, look_words(object_.count()), 0);
    }
    bool touched = false;
    for (std::uint32_t i = 0; i < candidate_count_; ++i) {
        ContactFrame frame{};
        if (find_frame(candidates_[i], substep, swept, frame)) {
            push_out(frame, looks_again ? &far : nullptr);
            touched = true;
        }
    }
    if (!touched) {
        return false;
    }
    if (looks_again) {
        look_again(far, substep);
    }
    place_pins(object_, substep, world_.rate.substeps);
    knows_bounds_ = false;
    knows_start_ = false;
    return true;
}

void ObjectContacts::push_out(ContactFrame& frame, const FarPushes* far) {
    if (frame.rotating && frame.reachable) {
        frame.greatest_growth = object_.greatest_growth(*world_.kernels);
    }
    blocks_.cut_particles(object_.count(), [&](std::uint32_t, std::uint32_t first, std::uint32_t count) {
        resolve_contacts(frame, particle_arrays(object_), first, count, *world_.kernels, nullptr, far);
    });
}

bool ObjectContacts::is_near(std::uint32_t index, const Bounds& bounds) const {
    return may_touch(world_.colliders[index].collider, object_.origin, bounds,
                     object_.asset().particle_radius);
}

// False: nothing within the bounds touches it in this substep.
bool ObjectContacts::find_frame(std::uint32_t index, std::uint32_t substep, const Bounds& bounds,
                                ContactFrame& frame) const {
    if (!is_near(index, bounds)) {
        return false;
    }
    const lks_asset& asset = object_.asset();
    frame = make_contact_frame(world_.colliders[index].collider, substep, world_.rate.substeps,
                               object_.origin, bounds, asset.particle_radius, asset.friction);
    frame.greatest_recovery = world_.rate.greatest_recovery;
    return true;
}

// At who was pushed far: perhaps through another collider, also one that was out of reach before.
void ObjectContacts::look_again(const FarPushes& far, std::uint32_t substep) {
    blocks_.cut_particles(object_.count(), [&](std::uint32_t, std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t i = first; i < first + count; i += particles_a_look) {
            if (const std::uint64_t who = far.words[i / particles_a_look]; who != 0) {
                SecondLook look(particle_arrays(object_), far.beyond, i, who);
                look_again(look, substep);
            }
        }
    });
}

void ObjectContacts::look_again(SecondLook& look, std::uint32_t substep) const {
    if (!is_among_several_that_move_alike(look.bounds())) {
        return;
    }
    while (!look.done()) {
        const Bounds bounds = look.bounds();
        for (std::uint32_t i = 0; i < candidate_count_; ++i) {
            ContactFrame frame{};
            if (find_frame(candidates_[i], substep, bounds, frame) && frame.reachable) {
                look.meet(frame);
            }
        }
        look.end_round();
    }
}

// What moves against each other may leave no room at all: then pushes that give way to one another would
// bring all particles to one point.
bool ObjectContacts::is_among_several_that_move_alike(const Bounds& bounds) const {
    std::uint32_t near = 0;
    bool alike = true;
    fixed::Vec3 first_way{};
    for (std::uint32_t i = 0; i < candidate_count_ && alike; ++i) {
        if (!is_near(candidates_[i], bounds)) {
            continue;
        }
        const ColliderState& collider = world_.colliders[candidates_[i]].collider;
        const fixed::Vec3 way = collider.target_position - collider.position;
        first_way = near == 0 ? way : first_way;
        alike = !collider.rotates() && way == first_way;
        ++near;
    }
    return alike && near > 1;
}

// The prediction has brought what was beyond the range back to its ends.
void ObjectContacts::begin_where_it_ended() {
    start_bounds_ = {within_range(bounds_.low), within_range(bounds_.high)};
}

// Where the particles have been in this substep, from start to now. What has touched nothing in the one
// before begins where that looked for it last.
Bounds ObjectContacts::swept_bounds() {
    if (!knows_start_) {
        start_bounds_ = bounds_of_blocks([this](std::uint32_t first, std::uint32_t count) {
            return object_.start_bounds(*world_.kernels, first, count);
        });
        knows_start_ = true;
    }
    bounds_ = bounds_of_blocks([this](std::uint32_t first, std::uint32_t count) {
        return object_.bounds(*world_.kernels, first, count);
    });
    knows_bounds_ = true;
    return joined(start_bounds_, bounds_);
}

template <typename BoundsOf>
Bounds ObjectContacts::bounds_of_blocks(const BoundsOf& bounds_of) const {
    Bounds parts[greatest_block_count];
    const std::uint32_t blocks = blocks_.cut_particles(
        object_.count(), [&](std::uint32_t block, std::uint32_t first, std::uint32_t count) {
            parts[block] = bounds_of(first, count);
        });
    Bounds bounds = parts[0];
    for (std::uint32_t block = 1; block < blocks; ++block) {
        bounds = joined(bounds, parts[block]);
    }
    return bounds;
}

} // namespace lks
