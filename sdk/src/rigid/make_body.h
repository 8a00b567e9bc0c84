// Bodies from their definitions.
#pragma once

#include "rigid/body.h"
#include "rigid/body_definition.h"
#include "rigid/pair.h"

namespace lks {

BodyDescription describe_body(const BodyDefinition& definition);
// Of settings with the same mass as before.
void take_settings(BodyDescription& description, const BodySettings& settings);
// At rest where the definition says, with its velocities.
Body make_body(const BodyDescription& description, const lks_body_def& def);
// What follows from the description alone; for new bodies and for those of images.
void apply_description(Body& body, const BodyDescription& description);

// Where the centre of mass is when the body's frame is at `position`, and the other way round.
void place_body(Body& body, const BodyDescription& description, const fixed::Vec3& position,
                const fixed::Rotation& rotation);
fixed::Vec3 frame_position(const Body& body, const BodyDescription& description);

// 1/kg.
InverseMass to_inverse_mass(const fixed::Scaled& value);
fixed::Scaled to_scaled(const InverseMass& inverse_mass);
fixed::Scaled inverse_mass(const Body& body);
// Also of one that is kinematic now.
fixed::Scaled dynamic_inverse_mass(const BodyDescription& description);
// What the shares of two bodies are shares of.
fixed::Scaled greater_inverse_mass(const PairShares& shares, const Body& a, const Body& b);
// N·s at a lever from the centre of mass, world axes.
void apply_impulse(Body& body, const fixed::Vec3& impulse, const fixed::Vec3& lever);
// N·m·s in world axes.
void apply_angular_impulse(Body& body, const fixed::Vec3& momentum);
fixed::Scaled kinetic_energy(const Body& body, const BodyDescription& description);

} // namespace lks
