// Momentum, inertia and energy of a figure about its centre of mass, or where something holds it, at the end
// of a substep.
//
// Sums over masses, each as its share of the figure's greatest: momenta and inertia have 80 fraction bits.
#pragma once

#include "rigid/body_motion.h"
#include "rigid/rigid_scene.h"

namespace lks {

class FigureInertia {
public:
    // Of a point of this mass.
    void add_point(const fixed::Vec3& lever, std::int64_t share);
    // Of one kilogram in units of 2^scale m.
    void add_body(const SymmetricMatrix& inertia, std::int64_t share, int scale);

    // I⁻¹·momentum, World rad/s, to 2^-8 at the worst. Zero for what is as thin as 1 : 2^22 of inertia.
    fixed::Vec3 spin_of(const Sum3& momentum) const;
    // The same of what can only turn about an axis.
    fixed::Vec3 spin_about(const fixed::Direction& axis, const Sum3& momentum) const;

private:
    // As numbers of 30 bits, in units of 2^down; none: false.
    struct Entries {
        std::int64_t xx, xy, xz, yy, yz, zz;
        int down;
    };
    bool find_entries(Entries& entries) const;

    fixed::Int128 xx_{0, 0}, xy_{0, 0}, xz_{0, 0}, yy_{0, 0}, yz_{0, 0}, zz_{0, 0};
};

class FigureMomentum {
public:
    FigureMomentum(const RigidScene& scene, const FigureRange& figure);

    // Of the centre of mass, or of its pivot.
    const fixed::Vec3& position() const { return position_; }
    const fixed::Vec3& velocity() const { return velocity_; }

    Sum3 momentum() const;
    FigureInertia inertia() const;
    // Twice that of all motion about it, 64 fraction bits.
    fixed::Int128 energy() const;

private:
    const RigidScene& scene_;
    const FigureRange& figure_;
    fixed::Vec3 position_;
    fixed::Vec3 velocity_;
};

// The same of one body with this momentum and spin.
fixed::Int128 energy_of_turning(const Sum3& momentum, const fixed::Vec3& spin);

// What the figure's momentum would be now if nothing had moved its bodies from where they were predicted,
// less what it is.
Sum3 lost_momentum(const RigidScene& scene, const FigureRange& figure, const MotionRate& rate);

// Twice what gravity has done in the substep on all motion about the centre of mass, as energies have it.
fixed::Int128 work_of_gravity(const RigidScene& scene, const FigureRange& figure, const MotionRate& rate);

} // namespace lks
