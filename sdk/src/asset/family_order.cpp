#include "asset/family_order.h"

namespace lks {

FamilyOrder order_families(const Family (&families)[family_count]) {
    const auto damping_time = [&](std::uint32_t family) {
        return families[family].compliance * families[family].damping;
    };
    FamilyOrder order{};
    for (std::uint32_t family = 0; family < family_count; ++family) {
        for (std::uint32_t other = 0; other < family_count; ++other) {
            const int difference = fixed::compare(damping_time(other), damping_time(family));
            order.place[family] += difference > 0 || (difference == 0 && other < family) ? 1 : 0;
        }
    }
    return order;
}

} // namespace lks
