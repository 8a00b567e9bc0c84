// How the humanoid of lockstitch/ragdoll.h looks: a mannequin's limbs in wood, and a shirt and trousers.
#pragma once

#include "scenes/look.h"

namespace lks_demo {

struct Mannequin {
    lks_bone bones[LKS_HUMANOID_BONES];
    lks_body_shape shapes[LKS_HUMANOID_BONES];

    Mannequin() { lks_humanoid(bones, shapes); }
};

struct MannequinColours {
    Rgb colour[LKS_HUMANOID_BONES];
};

inline MannequinColours mannequin_colours(Rgb shirt, Rgb trousers) {
    const Rgb skin = rgb(0xd9a679);
    const Rgb shoe = rgb(0x3d3632);
    MannequinColours out;
    for (Rgb& colour : out.colour) {
        colour = skin;
    }
    out.colour[LKS_HUMANOID_CHEST] = shirt;
    out.colour[LKS_HUMANOID_UPPER_ARM_LEFT] = out.colour[LKS_HUMANOID_UPPER_ARM_RIGHT] = shirt;
    out.colour[LKS_HUMANOID_PELVIS] = trousers;
    out.colour[LKS_HUMANOID_UPPER_LEG_LEFT] = out.colour[LKS_HUMANOID_UPPER_LEG_RIGHT] = trousers;
    out.colour[LKS_HUMANOID_LOWER_LEG_LEFT] = out.colour[LKS_HUMANOID_LOWER_LEG_RIGHT] = trousers;
    out.colour[LKS_HUMANOID_FOOT_LEFT] = out.colour[LKS_HUMANOID_FOOT_RIGHT] = shoe;
    return out;
}

} // namespace lks_demo
