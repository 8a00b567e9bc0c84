// What has to be right of a ragdoll's description before anything else can be looked at.
#pragma once

#include <lockstitch/ragdoll.h>

#include "api/checks.h"

namespace lks {

// Of a failure of its body's, its joint's or its pose's: which bone it is, and of which pose.
class WithinBone {
public:
    WithinBone(const lks_world& world, std::uint32_t index, const char* when = "") : world_(world) {
        name_ << "Bone " << index << when << ": ";
        world_.failing_within = &name_;
    }
    ~WithinBone() { world_.failing_within = nullptr; }
    WithinBone(const WithinBone&) = delete;
    WithinBone& operator=(const WithinBone&) = delete;

private:
    const lks_world& world_;
    Sentence name_;
};

// LKS_OK, or reported: its size, how many bones there are, its scale, each bone's parent, and what its joint
// bears and its motor turns with, which the scale is put on.
lks_result check_bone_tree(const lks_world& world, const lks_ragdoll_def& def);

} // namespace lks
