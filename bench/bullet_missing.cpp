#include "bullet_crowd.h"
#include "bullet_peer.h"

namespace lks_bench {

bool has_bullet() {
    return false;
}

std::unique_ptr<Variant> make_bullet_peer(const Workload&) {
    return nullptr;
}

std::unique_ptr<Variant> make_bullet_body(const FloatCloth&, std::uint32_t, std::uint32_t, double,
                                          const std::vector<FloatSphere>&) {
    return nullptr;
}

std::unique_ptr<CrowdWorld> make_bullet_crowd(const Crowd&, int) {
    return nullptr;
}

} // namespace lks_bench
