#include "crowd.h"

namespace lks_bench {

Crowd::Crowd() {
    lks_bone all[LKS_HUMANOID_BONES];
    lks_body_shape all_shapes[LKS_HUMANOID_BONES];
    lks_humanoid(all, all_shapes);
    std::uint32_t renamed[LKS_HUMANOID_BONES] = {};
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < LKS_HUMANOID_BONES; ++i) {
        if (i == LKS_HUMANOID_HEAD || i == LKS_HUMANOID_HAND_LEFT || i == LKS_HUMANOID_HAND_RIGHT) {
            continue;
        }
        renamed[i] = count;
        shapes[count] = all_shapes[i];
        bones[count] = all[i];
        bones[count].body.shapes = &shapes[count];
        bones[count].body.never_sleeps = 1;
        bones[count].friction = 0;
        if (bones[count].parent != LKS_NO_PARENT) {
            bones[count].parent = renamed[bones[count].parent];
        }
        ++count;
    }
    for (int layer = 0; layer < 4; ++layer) {
        for (int row = 0; row < 5; ++row) {
            for (int column = 0; column < 5; ++column) {
                places.push_back({LKS_FIXED_RATIO(9 * column + layer, 10),
                                  LKS_FIXED_RATIO(5 + 19 * layer, 10), LKS_FIXED_RATIO(6 * row + layer, 10)});
            }
        }
    }
}

} // namespace lks_bench
