#include "rigid/particle_contact.h"

#include <algorithm>

#include "collide/contact.h"
#include "collide/saturation.h"
#include "fixed/formats.h"
#include "rigid/attachment.h"
#include "rigid/make_body.h"

namespace lks {
namespace {

using fixed::Scaled;
using fixed::Vec3;

// To the nearest.
std::int64_t to_world(std::int64_t coordinate) {
    return fixed::shift_right_rounded(coordinate, coordinate_from_world_shift);
}
Vec3 to_world(const Vec3& v) {
    return {to_world(v.x), to_world(v.y), to_world(v.z)};
}

// One shape of a body, in the coordinates of one object.
class BodyShapePlace {
public:
    BodyShapePlace(const Body& body, const BodyShape& shape) : body_(body), shape_(shape) {}

    ShapeWay way(const Surface& surface) const {
        ShapeWay way{};
        way.shape.kind = shape_.kind;
        way.shape.radius = coordinate_from_world(shape_.radius);
        way.shape.half_length = coordinate_from_world(shape_.half_length);
        const Vec3& e = shape_.half_extents;
        way.shape.half_extents = {coordinate_from_world(e.x), coordinate_from_world(e.y),
                                  coordinate_from_world(e.z)};
        const bool still = body_.asleep != 0;
        const Quaternion& start = still ? body_.orientation : body_.start_orientation;
        const fixed::Matrix3 start_rotation = fixed::to_matrix(narrow(start));
        way.start =
            (still ? body_.position : body_.start_position) + fixed::rotate(start_rotation, shape_.position);
        way.end = body_.position + fixed::rotate(body_.rotation, shape_.position);
        way.rotating = !(narrow(start) == narrow(body_.orientation));
        way.start_rotation = shape_axes(start_rotation, shape_);
        way.end_rotation = shape_axes(body_.rotation, shape_);
        way.static_friction = surface.static_friction;
        way.dynamic_friction = surface.dynamic_friction;
        return way;
    }

    // After the body has moved.
    void follow(ContactFrame& frame, const Vec3& origin) const {
        const Vec3 centre =
            saturating_subtract(body_.position + fixed::rotate(body_.rotation, shape_.position), origin);
        constexpr std::int64_t limit = std::int64_t{126} << world_fraction_bits;
        Vec3 bounded = centre;
        clamp_vector(bounded, limit);
        frame.end_centre = {coordinate_from_world(bounded.x), coordinate_from_world(bounded.y),
                            coordinate_from_world(bounded.z)};
        frame.end_rotation = shape_axes(body_.rotation, shape_);
    }

private:
    const Body& body_;
    const BodyShape& shape_;
};

// Of a body that does not give way: a kinematic one goes on as before.
class Reaction : public ContactReaction {
public:
    // pushes: null, or what they push is added to it.
    Reaction(const HeldParticles& held, const Object& object, const Body& body, const MotionRate& rate,
             SweptParticles& swept, ParticlePushes* pushes)
        : held_(held), swept_(swept), object_(object), inverse_mass_(body.effective_inverse_mass()),
          substeps_per_second_(static_cast<std::uint64_t>(rate.substeps_per_second)), pushes_(pushes) {}
    bool ignores(std::uint32_t particle) const override { return held_.contain(particle); }
    Vec3 give_way(std::uint32_t particle, const Vec3& correction) override {
        moved(particle);
        fixed::NormalisedVector way{};
        if (adds_up() && fixed::normalise(correction, way)) {
            add_push(particle, to_world(saturate(fixed::length(correction))), correction, way.direction);
        }
        return correction;
    }

protected:
    // A push of this substep along a way, World, in the greater inverse mass of the two.
    void add_push(std::uint32_t particle, std::int64_t push, const Vec3& correction,
                  const fixed::Direction& way) const {
        const InverseMass own = particle_inverse_mass(object_, particle);
        const InverseMass& greater = pair_shares(own, inverse_mass_).a == direction_one ? own : inverse_mass_;
        if (greater.mantissa == 0) {
            return;
        }
        const Scaled speed = Scaled::from_fixed(fixed::magnitude(push), world_fraction_bits) *
                             Scaled::from_u64(substeps_per_second_);
        const std::int64_t impulse = (speed / to_scaled(greater)).to_i64_fixed(world_fraction_bits);
        pushes_->impulse = fixed::saturating_add(pushes_->impulse, impulse);
        if (impulse > pushes_->most) {
            pushes_->most = impulse;
            pushes_->place = particle_position(object_, particle) + to_world(correction);
            pushes_->normal = way;
        }
    }
    void moved(std::uint32_t particle) const { swept_.moved(particle); }
    bool adds_up() const { return pushes_ != nullptr; }

private:
    HeldParticles held_;
    SweptParticles& swept_;
    const Object& object_;
    InverseMass inverse_mass_;
    std::uint64_t substeps_per_second_;
    ParticlePushes* pushes_;
};

// What hits it pushes it.
class Pushed final : public Reaction {
public:
    Pushed(const Reaction& reaction, Object& object, Body& body, const BodyShapePlace& place,
           ContactFrame& frame)
        : Reaction(reaction), object_(object), body_(body), place_(place), frame_(frame) {}

    Vec3 give_way(std::uint32_t particle, const Vec3& correction) override {
        moved(particle);
        fixed::NormalisedVector way{};
        if (!fixed::normalise(correction, way)) {
            return correction;
        }
        const PairShares shares = pair_shares(particle_inverse_mass(object_, particle), body_.inverse_mass);
        Vec3 lever = particle_position(object_, particle) - body_.position;
        clamp_vector(lever, std::int64_t{64} << world_fraction_bits);
        std::int64_t weight = shares.a;
        const RowSide side = push_side(body_, shares.b, way.direction, lever, weight);
        const std::int64_t p = divide(to_world(way.length), invert(weight));
        push(body_, side, fixed::scale(way.direction, p), p, -1);
        place_.follow(frame_, object_.origin);
        if (adds_up()) {
            add_push(particle, p, correction, way.direction);
        }
        return fixed::scale(way.direction, fixed::scale_component(shares.a, coordinate_from_world(p)));
    }

private:
    Object& object_;
    Body& body_;
    const BodyShapePlace& place_;
    ContactFrame& frame_;
};

// A sleeping one only takes down what has struck it: what lies on it does not, what falls on it does.
class Struck final : public Reaction {
public:
    Struck(const Reaction& reaction, const Object& object, Body& body, const MotionRate& rate)
        : Reaction(reaction), object_(object), body_(body), rate_(rate),
          least_(coordinate_from_world(LKS_FIXED_RATIO(1, 4) / rate.substeps_per_second)) {}

    Vec3 give_way(std::uint32_t particle, const Vec3& correction) override {
        const std::int64_t size = sum_of_magnitudes(correction);
        if (size > least_) {
            const PairShares shares =
                pair_shares(particle_inverse_mass(object_, particle), body_.inverse_mass);
            const std::int64_t moved = to_world(fixed::scale_component(shares.b, size));
            body_.struck = fixed::saturating_add(body_.struck,
                                                 fixed::multiply_shift(moved, rate_.substeps_per_second, 0));
        }
        return Reaction::give_way(particle, correction);
    }

private:
    const Object& object_;
    Body& body_;
    const MotionRate& rate_;
    std::int64_t least_;
};

} // namespace

bool HeldParticles::contain(std::uint32_t particle) const {
    return std::any_of(first, last, [particle](const HeldParticle& h) { return h.particle == particle; });
}

HeldParticles held_particles(const Array<HeldParticle>& held, std::uint32_t object, std::uint32_t body) {
    const HeldParticle* first = std::lower_bound(held.begin(), held.end(), HeldParticle{object, body, 0});
    return {first, std::lower_bound(first, held.end(), HeldParticle{object, body, UINT32_MAX})};
}

void collide_with_body(Object& object, Body& body, const BodyDescription& description,
                       const HeldParticles& held, const MotionRate& rate, const Kernels& kernels,
                       SweptParticles& swept, ParticlePushes* pushes) {
    const ParticleArrays particles{object.axis(0),       object.axis(1),       object.axis(2),
                                   object.start_axis(0), object.start_axis(1), object.start_axis(2)};
    const lks_asset& asset = object.asset();
    const Bounds bounds = swept.bounds();
    Reaction reaction(held, object, body, rate, swept, pushes);
    for (std::uint32_t i = 0; i < description.shape_count; ++i) {
        const BodyShapePlace place(body, description.shapes[i]);
        ContactFrame frame = make_contact_frame(place.way(description.surface), object.origin, bounds,
                                                asset.particle_radius, asset.friction);
        if (!frame.reachable) {
            continue;
        }
        frame.greatest_recovery = rate.greatest_recovery;
        if (frame.rotating) {
            frame.greatest_growth = swept.greatest_growth();
        }
        if (!body.is_dynamic()) {
            resolve_contacts(frame, particles, 0, object.count(), kernels, &reaction);
        } else if (body.asleep != 0) {
            Struck struck(reaction, object, body, rate);
            resolve_contacts(frame, particles, 0, object.count(), kernels, &struck);
        } else {
            Pushed pushed(reaction, object, body, place, frame);
            resolve_contacts(frame, particles, 0, object.count(), kernels, &pushed);
        }
    }
}

} // namespace lks
