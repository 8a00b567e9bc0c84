// How the humanoid of lockstitch/ragdoll.h looks: a mannequin's limbs in wood, and a shirt and trousers.
#pragma once

#include "scenes/look.h"

namespace lks_demo {

struct Mannequin {
    lks_bone bones[LKS_HUMANOID_BONES];
    lks_body_shape shapes[LKS_HUMANOID_BONES];

    Mannequin() { lks_humanoid(bones, shapes); }
};

struct MannequinLook {
    BoneLook bones[LKS_HUMANOID_BONES];
};

inline MannequinLook mannequin_look(Rgb shirt, Rgb trousers) {
    const Rgb skin = rgb(0xd9a679);
    const Rgb shoe = rgb(0x3d3632);
    // Its limbs end where they turn, and its head stands free above its chest: balls close what is between.
    return {{{trousers, 0.0f},
             {shirt, 0.088f},
             {skin, 0.052f},
             {shirt, 0.055f},
             {skin, 0.043f},
             {skin, 0.037f},
             {shirt, 0.055f},
             {skin, 0.043f},
             {skin, 0.037f},
             {trousers, 0.075f},
             {trousers, 0.056f},
             {shoe, 0.042f},
             {trousers, 0.075f},
             {trousers, 0.056f},
             {shoe, 0.042f}}};
}

} // namespace lks_demo
