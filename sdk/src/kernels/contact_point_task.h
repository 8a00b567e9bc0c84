// Points of contacts between bodies, several at a time: where they begin a substep, what pushes at them do,
// and how far they have parted. What is done with one is said in rigid/contact.h.
#pragma once

#include <cstdint>

namespace lks {

struct Body;
struct Contact;
struct ContactPoint;

inline constexpr std::uint32_t point_lanes = 8;

// All lanes have addresses; several may have the same.
struct ContactPointTask {
    const Body* a[point_lanes];
    const Body* b[point_lanes];
    const Contact* contacts[point_lanes];
    ContactPoint* points[point_lanes];
    std::uint32_t count;
};

// What making rows finds beside them.
struct WideRows {
    std::uint32_t near; // bit i: the surfaces of lane i are near each other
    std::int64_t lever_a[3][point_lanes];
    std::int64_t lever_b[3][point_lanes];
};

// Each returns the lanes that are left to the caller, who does them as ever: what is far out, or very small
// or large.
struct ContactPointKernels {
    // All of begin_substep but what is allowed, of contacts without restitution.
    std::uint32_t (*begin)(const ContactPointTask& task);
    // The rows of all.
    std::uint32_t (*make_rows)(const ContactPointTask& task, WideRows& rows);
    // The gap and the slip.
    std::uint32_t (*measure)(const ContactPointTask& task);
};
// Where lanes would bring nothing.
inline constexpr ContactPointKernels no_contact_point_kernels{nullptr, nullptr, nullptr};

} // namespace lks
