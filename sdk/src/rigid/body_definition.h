// What the game gave of a body, in its plainest form: bodies of equal definitions are equal byte for byte.
#pragma once

#include <lockstitch/body.h>

#include <cstdint>

namespace lks {

// As lks_body_def has them.
struct BodySettings {
    std::int64_t mass; // World; 0: as the densities say
    std::int64_t gravity_factor;
    std::int64_t linear_damping;
    std::int64_t angular_damping;
    std::int64_t static_friction;
    std::int64_t dynamic_friction;
    std::int64_t restitution;
    lks_filter filter;
    std::uint32_t never_sleeps; // 0 or 1
};

// State: it can't be told from the description to the last bit. What a shape has not got is zero, its
// rotation is normalised, and shapes that the body has not got are zero.
struct BodyDefinition {
    std::uint32_t kind; // lks_body_kind
    std::uint32_t shape_count;
    BodySettings settings;
    lks_body_shape shapes[LKS_MAX_BODY_SHAPES];
};

// Of a checked definition.
BodySettings plain_settings(const lks_body_def& def);
BodyDefinition plain_definition(const lks_body_def& def);
// As the game would give it, at rest at the origin; its shapes are those of `definition`.
lks_body_def define_body(const BodyDefinition& definition);

} // namespace lks
