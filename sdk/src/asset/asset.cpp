#include "asset/asset.h"

namespace lks {

void retain_asset(const lks_asset* asset) {
    asset->holders.fetch_add(1, std::memory_order_relaxed);
}

void release_asset(const lks_asset* asset) {
    if (asset == nullptr || asset->holders.fetch_sub(1, std::memory_order_acq_rel) != 1) {
        return;
    }
    const lks_allocator allocator = asset->allocator;
    destroy(allocator, const_cast<lks_asset*>(asset));
}

} // namespace lks
