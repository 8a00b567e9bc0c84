#include "api/ragdoll_checks.h"

#include "api/joint_checks.h"

namespace lks {

lks_result check_bone_tree(const lks_world& world, const lks_ragdoll_def& def) {
    if (def.struct_size != sizeof(lks_ragdoll_def)) {
        return world.fail(LKS_ERROR_STRUCT_SIZE,
                          wrong_struct_size("ragdoll_def", def.struct_size, sizeof(lks_ragdoll_def)));
    }
    if (def.bone_count < 1 || def.bone_count > LKS_MAX_BONES) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "The ragdoll has " << def.bone_count
                                                                 << " bones; it needs from 1 to "
                                                                 << LKS_MAX_BONES << ".");
    }
    if (def.bones == nullptr) {
        return world.fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_ragdoll_def", "bones"));
    }
    if (def.reserved != 0) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "The ragdoll's reserved field is "
                                                                 << def.reserved << "; it must be 0.");
    }
    if (def.scale < LKS_FIXED_RATIO(5, 100) || def.scale > LKS_FIXED(20)) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT, out_of_range("ragdoll's scale", def.scale, "",
                                                                   LKS_FIXED_RATIO(5, 100), LKS_FIXED(20)));
    }
    for (std::uint32_t i = 0; i < def.bone_count; ++i) {
        const lks_bone& bone = def.bones[i];
        if (i != 0 && bone.parent == LKS_NO_PARENT) {
            return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                              Sentence()
                                  << "Bone " << i << " is a second root; only the first bone has no parent.");
        }
        if (i == 0 ? bone.parent != LKS_NO_PARENT : bone.parent >= i) {
            return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                              Sentence() << "Bone " << i << " has the parent " << bone.parent
                                         << (i == 0 ? "; the first bone is the root and has none."
                                                    : "; a parent is an earlier bone."));
        }
        const Number strengths[] = {{"motor_torque", " N·m", bone.motor_torque, 0, LKS_FIXED(1000000)},
                                    {"break_force", " N", bone.break_force, 0, greatest_break_strength},
                                    {"break_torque", " N·m", bone.break_torque, 0, greatest_break_strength}};
        const WithinBone within_bone(world, i);
        if (const lks_result result = check_numbers(world, strengths); result != LKS_OK) {
            return result;
        }
    }
    return LKS_OK;
}

} // namespace lks
