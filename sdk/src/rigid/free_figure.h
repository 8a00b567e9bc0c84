// A figure that nothing pushes from outside keeps its angular momentum, and gains no energy.
//
// What joints, limits, motors and its own bones push on one side they push back on the other. But they move
// bodies and turn the levers that they push at, and what a substep has pushed far has not the momentum any
// more that it began with. A humanoid that whirls lost half of it within a minute at 8 substeps, and a motor
// that strained against a soft limit set one spinning by 170 J within ten seconds. So at the end of a tick
// such a figure is turned as a whole, about its centre of mass, by what it has lost:
//
//     Δω = I⁻¹·Σ(L predicted − L),    v += Δω × r,    ω += Δω,
//
// of which neither joints nor the centre of mass notice anything. Where nothing does any work on it, neither
// motors nor springs, its energy then is at most what it was: what moves otherwise than a body of its inertia
// and momentum is brought nearer to that, and where that has more energy all of it turns less. Where masses
// are as 1 : 100, or light bodies hold heavy ones, that is done after each substep.
//
// What one ball joint holds at something that stands, a pendulum, a top or a chain, keeps its momentum about
// that pivot alike, where none of its joints has limits or friction: only gravity turns it there. A hinge
// turns it otherwise, too, but not about its axis, as long as it leans on no limit: what hangs on one keeps
// that part of its momentum. Its energy needs no such care.
#pragma once

#include "rigid/body_motion.h"
#include "rigid/rigid_scene.h"

namespace lks {

class FreeFigures {
public:
    FreeFigures(RigidScene& scene, const MotionRate& rate, std::uint32_t substeps)
        : scene_(scene), rate_(rate), substeps_(substeps) {}

    // Before the prediction of substep 1 .. substeps, and once its velocities are known.
    void begin_substep(FigureRange& figure, std::uint32_t substep) const;
    void finish_substep(FigureRange& figure, std::uint32_t substep) const;

private:
    RigidScene& scene_;
    const MotionRate& rate_;
    std::uint32_t substeps_;
};

} // namespace lks
