// The rule of lockstitch/filter.h.
#pragma once

#include <lockstitch/filter.h>

#include <cstdint>

namespace lks {

inline constexpr lks_filter default_filter{1, 0xffffffffu, 0};

constexpr bool is_default_filter(const lks_filter& filter) {
    return filter.category == default_filter.category && filter.mask == default_filter.mask &&
           filter.group == default_filter.group;
}

constexpr bool filters_meet(const lks_filter& p, const lks_filter& q) {
    if (p.group == q.group && p.group != 0) {
        return p.group > 0;
    }
    return (p.category & q.mask) != 0 && (q.category & p.mask) != 0;
}

// Particles look at no categories.
constexpr bool meets_particles(const lks_filter& filter) {
    return (filter.mask & LKS_CATEGORY_PARTICLES) != 0;
}

// Whether a query for these categories wants it.
constexpr bool is_asked_for(const lks_filter& filter, std::uint32_t categories) {
    return (filter.category & categories) != 0;
}

} // namespace lks
