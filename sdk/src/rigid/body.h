// A rigid body: what it is, and where and how fast it is.
#pragma once

#include <lockstitch/body.h>

#include <cstdint>

#include "rigid/inertia.h"
#include "rigid/quaternion.h"

namespace lks {

// The inverse of a mass: mantissa · 2^exponent 1/kg, the mantissa with its 31st bit set; zero for infinitely
// heavy ones.
struct InverseMass {
    std::uint32_t mantissa;
    std::int32_t exponent;

    friend constexpr bool operator==(const InverseMass&, const InverseMass&) = default;
};

struct Surface {
    std::int64_t static_friction; // World
    std::int64_t dynamic_friction;
    std::int64_t restitution;
};

// What a body is: what follows from its definition (rigid/body_definition.h).
struct BodyDescription {
    std::uint32_t kind; // lks_body_kind
    std::uint32_t shape_count;
    BodyShape shapes[LKS_MAX_BODY_SHAPES]; // around the centre of mass
    MassProperties properties;
    fixed::Vec3 centre;     // World: the centre of mass in the frame that the game gave
    std::int64_t radius;    // World: of a ball about the centre of mass with all shapes in it
    std::int64_t thickness; // World: half of that of its thinnest shape
    Surface surface;
    lks_filter filter;
    std::int64_t gravity_factor;
    std::int64_t linear_damping;
    std::int64_t angular_damping;
    std::uint32_t never_sleeps; // 0 or 1
};

// Body::turns: so often what trembles or rocks has turned round.
inline constexpr std::uint8_t enough_turns = 2;

// Where and how fast it is. Images and hashes have it in this order.
struct BodyState {
    fixed::Vec3 position; // World, of the centre of mass
    // Kinematic: at the end of the next tick.
    fixed::Vec3 target_position;
    // Sleep (rigid/sleep.h): where it has stayed, for how many ticks, whether it is asleep, and how its speed
    // changes.
    fixed::Vec3 rest_position;
    Quaternion orientation;
    Quaternion target_orientation;
    fixed::Vec3 velocity;         // World, m/s
    fixed::Vec3 angular_velocity; // World, rad/s, in world axes
    Quaternion rest_orientation;
    std::uint32_t rest;   // for how long, in fifths of a tick
    std::uint8_t asleep;  // 0 or 1
    std::uint8_t gathers; // 0 or 1: speed, when that changed last
    std::uint8_t turns;   // how often it has lost it after that, up to enough_turns
    std::uint8_t steady;  // for how many ticks it has accelerated as what rolls on a slope does
};

struct Speeds {
    fixed::Vec3 velocity;
    fixed::Vec3 spin;
};

// And what every constraint on it needs.
struct Body : BodyState {
    // Copied from the description.
    InverseMass inverse_mass; // zero: kinematic
    std::int32_t scale;
    std::int32_t inverse_shift;
    SymmetricMatrix inverse_inertia; // in its own axes

    // What every row reads stands beside that.
    fixed::Matrix3 rotation;       // of `orientation`
    SymmetricMatrix world_inverse; // inverse_inertia in world axes at the predicted pose
    bool jointed;                  // joints hold it

    // For views: at the tick before.
    fixed::Vec3 previous_position;
    fixed::Rotation previous_rotation;

    std::uint32_t impacts; // of a substep: how many contacts are about to strike it
    // For events: whether it was asleep when that was last looked at.
    bool known_asleep;

    // Of the tick and the substep at work.
    bool slept;          // at the beginning of the tick
    std::int64_t struck; // asleep: how fast particles would have made it, World m/s
    bool touched;        // by a contact that pushed at the end of the tick
    bool squeezed;       // deep in something else, at the beginning of the last substep
    bool sticks;         // deeper, by more than sticking_depth
    bool figure_touched; // the least body of a figure: any of its bodies is
    fixed::Vec3 tick_position;
    Quaternion tick_orientation;
    Speeds tick_speeds;
    fixed::Vec3 start_position;
    fixed::Vec3 predicted_position;
    Quaternion start_orientation;
    Quaternion predicted_orientation;
    fixed::Vec3 predicted_spin;     // in the middle of the substep
    fixed::Vec3 uncarried_position; // before anything that was pushed in the last substep was pushed again
    Quaternion uncarried_orientation;

    Speeds speeds() const { return {velocity, angular_velocity}; }
    bool is_dynamic() const { return inverse_mass.mantissa != 0; }
    bool is_awake() const { return is_dynamic() && asleep == 0; }
    bool is_moving() const {
        return !(velocity == fixed::Vec3{0, 0, 0}) || !(angular_velocity == fixed::Vec3{0, 0, 0});
    }
    // Awake, or kinematic and on its way.
    bool is_active() const { return is_dynamic() ? asleep == 0 : is_moving(); }
    // In this tick: what is about to move may yet have no speed.
    bool has_woken() const { return slept && is_awake(); }
    // What constraints may move it by: nothing while it sleeps.
    InverseMass effective_inverse_mass() const { return asleep != 0 ? InverseMass{0, 0} : inverse_mass; }
    // After `orientation` has changed.
    void follow_orientation() { rotation = fixed::to_matrix(narrow(orientation)); }
};

// A shape's own axes in the world, where its body is turned so.
inline fixed::Matrix3 shape_axes(const fixed::Matrix3& body_rotation, const BodyShape& shape) {
    return shape.rotation == fixed::identity_rotation()
               ? body_rotation
               : fixed::multiply(body_rotation, fixed::to_matrix(shape.rotation));
}

} // namespace lks
