// Cloth and ropes against bodies, both ways: a particle that hits a body is put in front of it as it is in
// front of a collider (collide/contact.h), and of that correction each side takes what its mass leaves it:
// Δx = D·w_p/W, and the body is pushed by D/W at the same place, with W of rigid/pair.h along D.
#pragma once

#include "kernels/kernels.h"
#include "rigid/attachment.h"
#include "rigid/body_motion.h"
#include "rigid/particle_pushes.h"
#include "rigid/swept_particles.h"
#include "solver/object.h"

namespace lks {

// Of one object and one body, ascending.
struct HeldParticles {
    const HeldParticle* first;
    const HeldParticle* last;

    bool contain(std::uint32_t particle) const;
};
HeldParticles held_particles(const Array<HeldParticle>& held, std::uint32_t object, std::uint32_t body);

// All particles of the object against all shapes of the body, in this substep. A sleeping body does not give
// way; how fast what struck it would have made it is added to its `struck`. What they push is added to
// `pushes`, if anybody wants to know.
void collide_with_body(Object& object, Body& body, const BodyDescription& description,
                       const HeldParticles& held, const MotionRate& rate, const Kernels& kernels,
                       SweptParticles& swept, ParticlePushes* pushes);

} // namespace lks
