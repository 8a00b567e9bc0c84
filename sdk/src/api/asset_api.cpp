// lockstitch/asset.h.
#include <lockstitch/asset.h>

#include <algorithm>

#include "asset/authoring_values.h"
#include "asset/create.h"

using namespace lks;

namespace {

// What both kinds of definitions have in common, from checking to handing out.
template <typename Def, typename Fill>
lks_result create_asset(const Def* def, lks_asset** asset, lks_asset::Kind kind, const Fill& fill) {
    if (def == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (def->struct_size != sizeof(Def)) {
        return LKS_ERROR_STRUCT_SIZE; // where its error field lies is unknown
    }
    if (asset == nullptr) {
        return report(def->error, LKS_ERROR_NULL_ARGUMENT,
                      Sentence() << "There is no place for the new asset: asset is null.");
    }
    if (!allocator_is_valid(def->allocator)) {
        return report(def->error, LKS_ERROR_INVALID_ARGUMENT,
                      Sentence() << "The asset's allocator has only one of its two functions.");
    }
    auto* made = create<lks_asset>(def->allocator, def->allocator);
    if (made == nullptr) {
        return report(def->error, LKS_ERROR_OUT_OF_MEMORY,
                      Sentence() << "The allocator has no memory for an asset.");
    }
    made->kind = kind;
    Build build(*made, def->error);
    const lks_result result = fill(build, *made);
    if (result != LKS_OK) {
        release_asset(made);
        return result;
    }
    made->fingerprint = compute_fingerprint(*made);
    *asset = made;
    return report(def->error, LKS_OK, Sentence());
}

} // namespace

extern "C" {

lks_cloth_def lks_default_cloth_def(void) {
    lks_cloth_def def{};
    def.struct_size = sizeof(lks_cloth_def);
    def.columns = 21;
    def.rows = 21;
    def.width = 2.0;
    def.height = 2.0;
    def.area_density = 0.3;
    def.stretch = {0.0, 0.0, 1, 0};
    def.shear = {1e-7, 0.0, 1, 0};
    def.bend = {1e-5, 0.0, 1, 0};
    def.tethers_per_vertex = 2;
    def.particle_radius = 0.01;
    def.friction = 1.0;
    return def;
}

lks_result lks_asset_create_cloth(const lks_cloth_def* def, lks_asset** asset) {
    return create_asset(def, asset, lks_asset::Kind::cloth, [def](Build& build, lks_asset& made) {
        if (def->reserved != 0) {
            return build.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "The definition's reserved field is "
                                                                     << def->reserved << "; it must be 0.");
        }
        const struct {
            const char* name;
            const lks_distance_material& material;
        } families[family_count] = {{"stretch", def->stretch}, {"shear", def->shear}, {"bend", def->bend}};
        for (std::uint32_t i = 0; i < family_count; ++i) {
            if (const lks_result result =
                    read_family(build.error, families[i].name, families[i].material, made.families[i]);
                result != LKS_OK) {
                return result;
            }
        }
        if (const lks_result result = read_surface(build.error, def->particle_radius, def->friction, made);
            result != LKS_OK) {
            return result;
        }
        const lks_result built =
            def->vertex_count > 0 ? build_cloth_mesh(build, *def) : build_cloth_grid(build, *def);
        return built != LKS_OK ? built : build_tethers(build, *def);
    });
}

lks_rope_def lks_default_rope_def(void) {
    lks_rope_def def{};
    def.struct_size = sizeof(lks_rope_def);
    def.segments = 50;
    def.length = 5.0;
    def.linear_density = 0.2;
    def.stretch = {0.0, 0.0, 1, 0};
    def.bend = {1e-4, 0.0, 1, 0};
    def.particle_radius = 0.01;
    def.friction = 1.0;
    return def;
}

lks_result lks_asset_create_rope(const lks_rope_def* def, lks_asset** asset) {
    return create_asset(def, asset, lks_asset::Kind::rope, [def](Build& build, lks_asset& made) {
        if (const lks_result result =
                read_family(build.error, "stretch", def->stretch, made.families[LKS_CONSTRAINT_STRETCH]);
            result != LKS_OK) {
            return result;
        }
        if (const lks_result result =
                read_family(build.error, "bend", def->bend, made.families[LKS_CONSTRAINT_BEND]);
            result != LKS_OK) {
            return result;
        }
        if (const lks_result result = read_surface(build.error, def->particle_radius, def->friction, made);
            result != LKS_OK) {
            return result;
        }
        return build_rope(build, *def);
    });
}

void lks_asset_release(lks_asset* asset) {
    release_asset(asset);
}

uint64_t lks_asset_fingerprint(const lks_asset* asset) {
    return asset == nullptr ? 0 : asset->fingerprint;
}

uint32_t lks_asset_vertex_count(const lks_asset* asset) {
    return asset == nullptr ? 0 : asset->vertex_count();
}

uint32_t lks_asset_constraint_count(const lks_asset* asset) {
    return asset == nullptr ? 0 : asset->constraint_count();
}

uint32_t lks_asset_colour_count(const lks_asset* asset) {
    return asset == nullptr ? 0 : asset->colour_count;
}

uint32_t lks_asset_triangle_count(const lks_asset* asset) {
    return asset == nullptr ? 0 : static_cast<uint32_t>(asset->triangles.size() / 3);
}

lks_result lks_asset_triangles(const lks_asset* asset, uint32_t* indices, size_t index_capacity) {
    if (asset == nullptr || (indices == nullptr && !asset->triangles.empty())) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (index_capacity < asset->triangles.size()) {
        return LKS_ERROR_BUFFER_TOO_SMALL;
    }
    std::copy(asset->triangles.begin(), asset->triangles.end(), indices);
    return LKS_OK;
}

lks_result lks_asset_constraint(const lks_asset* asset, uint32_t constraint, lks_constraint_info* info) {
    if (asset == nullptr || info == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (constraint >= asset->constraint_count()) {
        return LKS_ERROR_INVALID_ARGUMENT;
    }
    const Batch* batch = std::upper_bound(asset->batches.begin(), asset->batches.end(), constraint,
                                          [](uint32_t i, const Batch& b) { return i < b.first; }) -
                         1;
    constexpr std::int64_t half = std::int64_t{1} << (coordinate_from_world_shift - 1);
    const Constraint& ends = asset->constraints[constraint];
    info->vertex_a = asset->particle_to_vertex[ends.a];
    info->vertex_b = asset->particle_to_vertex[ends.b];
    info->family = batch->family;
    info->colour = batch->colour;
    info->rest_length = (asset->rest_lengths[constraint] + half) >> coordinate_from_world_shift;
    return LKS_OK;
}

uint32_t lks_asset_vertex_tethers(const lks_asset* asset, uint32_t vertex,
                                  lks_tether tethers[LKS_MAX_TETHERS_PER_VERTEX]) {
    if (asset == nullptr || tethers == nullptr || vertex >= asset->vertex_count()) {
        return 0;
    }
    const Tethers& all = asset->tethers;
    const std::uint32_t particle = asset->vertex_to_particle[vertex];
    const std::uint32_t group = particle / tether_group;
    std::uint32_t found = 0;
    const std::uint32_t end = all.empty() ? 0 : all.first_parts[group + 1];
    for (std::uint32_t i = all.empty() ? 0 : all.first_parts[group]; i < end; ++i) {
        const TetherPart& part = all.parts[i];
        if ((part.members >> particle % tether_group & 1) != 0) {
            const std::uint32_t length =
                all.lengths[std::size_t{part.row} * asset->vertex_count() + particle];
            tethers[found++] = {asset->particle_to_vertex[all.anchors[part.anchor]], 0,
                                lks_fixed{length} << (world_fraction_bits - tether_fraction_bits)};
        }
    }
    return found;
}

} // extern "C"
