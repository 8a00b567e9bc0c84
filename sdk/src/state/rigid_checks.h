// What an image may say of bodies, joints and contacts. States are checked as they stand in it.
#pragma once

#include "solver/world.h"
#include "state/word_ranges.h"

namespace lks {

class RigidChecks {
public:
    explicit RigidChecks(const lks_world& world);

    // What a game could have given, in its plain form.
    bool definition(const BodyDefinition& definition) const;
    bool description(const JointDescription& description) const;
    // Two bodies that are there.
    static bool joined(std::uint32_t a, std::uint32_t b, const Array<Loaded>& bodies);

    // A BodyState of a body of this kind, a JointState.
    bool body(const unsigned char* at, std::uint32_t kind) const;
    bool joint(const unsigned char* at, const fixed::Rotation& known_target) const;
    // Between a body and a later one, both there, or one of so many places for colliders.
    static bool contact(const ContactMemory& memory, const Array<Loaded>& bodies, std::uint32_t colliders);
    // So many of a ContactPush.
    bool pushes(const unsigned char* at, std::uint32_t count) const;

private:
    static bool sleeps_soundly(const unsigned char* at, std::uint32_t kind);
    // As lks_body_move_to would have it.
    bool moves_within_reach(const unsigned char* at) const;

    static constexpr std::size_t push_words = sizeof(ContactPush) / 8;
    static constexpr std::size_t target_size = sizeof(fixed::Rotation);

    const lks_world& world_;
    WordRanges<sizeof(BodyState) / 8> body_ranges_;
    WordRanges<(sizeof(JointState) - target_size) / 8> joint_ranges_;
    WordRanges<greatest_point_count * push_words> push_ranges_;
};

} // namespace lks
