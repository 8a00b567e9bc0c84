// The hash over all of an asset that can influence a simulation or its views, its vertex numbering included.
#include "asset/build.h"
#include "state/hash.h"

namespace lks {
namespace {

void add_scaled(Hash& hash, const fixed::Scaled& value) {
    hash.add_u64(value.mantissa);
    hash.add_u32(static_cast<std::uint32_t>(value.exponent));
}

} // namespace

std::uint64_t compute_fingerprint(const lks_asset& asset) {
    Hash hash;
    hash.add_u32(LKS_SOLVER_VERSION);
    hash.add_u32(static_cast<std::uint32_t>(asset.kind));
    hash.add_u32(asset.vertex_count());
    hash.add_u32(asset.constraint_count());
    hash.add_i64(asset.particle_radius);
    hash.add_i64(asset.friction);
    for (const Family& family : asset.families) {
        hash.add_u32(family.enabled ? 1 : 0);
        add_scaled(hash, family.compliance);
        add_scaled(hash, family.damping);
    }
    hash.add_u32_array(asset.vertex_to_particle.data(), asset.vertex_to_particle.size());
    for (std::uint32_t i = 0; i < asset.vertex_count(); ++i) {
        hash.add_i64(asset.rest_positions[i].x);
        hash.add_i64(asset.rest_positions[i].y);
        hash.add_i64(asset.rest_positions[i].z);
        add_scaled(hash, asset.inverse_masses[i]);
    }
    for (const Batch& batch : asset.batches) {
        hash.add_u32(batch.family);
        hash.add_u32(batch.first);
        hash.add_u32(batch.count);
        hash.add_u32(static_cast<std::uint32_t>(batch.difference_shift));
        hash.add_u32(static_cast<std::uint32_t>(batch.rest_exponent));
    }
    for (std::uint32_t i = 0; i < asset.constraint_count(); ++i) {
        hash.add_u32(asset.constraints[i].a);
        hash.add_u32(asset.constraints[i].b);
        hash.add_i64(asset.rest_lengths[i]);
    }
    hash.add_u32(static_cast<std::uint32_t>(asset.solver));
    // What views draw: the same edges may be those of other triangles.
    hash.add_u32_array(asset.triangles.data(), asset.triangles.size());
    if (!asset.tethers.empty()) {
        const Tethers& tethers = asset.tethers;
        hash.add_u32_array(tethers.anchors.data(), tethers.anchors.size());
        hash.add_u32_array(tethers.lengths.data(), tethers.lengths.size());
        for (const TetherPart& part : tethers.parts) {
            hash.add_u64(part.members);
            hash.add_u32(part.anchor);
        }
    }
    return hash.finish();
}

} // namespace lks
