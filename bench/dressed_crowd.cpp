#include "dressed_crowd.h"

namespace lks_bench {
namespace {

// As in the scene ragdoll_cape.
constexpr std::uint32_t cape_columns = 22;
constexpr std::uint32_t cape_rows = 34;
constexpr double cape_width = 0.525;
constexpr double cape_height = 0.9625;
constexpr int cape_top = 1475; // mm
constexpr int chest_y = 1285;
constexpr int shoulders = 410; // of the held edge, which is drawn together to them
constexpr std::uint32_t rope_segments = 15;

lks_vec3 sum(const lks_vec3& a, const lks_vec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

} // namespace

DressedCrowd::DressedCrowd(Dress dress, std::uint32_t substeps, std::uint32_t workers) : dress_(dress) {
    if (dress != Dress::coupled) {
        for (lks_bone& bone : shape_.bones) {
            bone.body.filter.mask &= ~LKS_CATEGORY_PARTICLES;
        }
    }
    crowd_ = std::make_unique<OurCrowd>(shape_, substeps, 1, workers);
    if (dress == Dress::none) {
        return;
    }
    lks_cloth_def cape = lks_default_cloth_def();
    cape.columns = cape_columns;
    cape.rows = cape_rows;
    cape.width = cape_width;
    cape.height = cape_height;
    cape.area_density = 0.25;
    cape.shear.compliance = 1e-6;
    cape.bend.compliance = 1e-3;
    cape.particle_radius = 0.012;
    lks_asset_create_cloth(&cape, &cape_);
    lks_rope_def rope = lks_default_rope_def();
    rope.segments = rope_segments;
    rope.length = CrowdRows::rope_length / 1000.0;
    lks_asset_create_rope(&rope, &rope_);
    for (std::size_t i = 0; i < shape_.places.size(); ++i) {
        add_cape(i);
        if ((i + 1) % CrowdRows::columns != 0) {
            add_rope(i, i + 1);
        }
    }
}

DressedCrowd::~DressedCrowd() {
    crowd_.reset();
    lks_asset_release(cape_);
    lks_asset_release(rope_);
}

void DressedCrowd::add_cape(std::size_t humanoid) {
    const int half_height = static_cast<int>(cape_height * 500);
    const lks_object_id cape = add_object(
        cape_, sum(shape_.places[humanoid].position, millimetres(0, cape_top - half_height, -145)));
    for (std::uint32_t column = 0; column < cape_columns; ++column) {
        const int across = (2 * static_cast<int>(column) - static_cast<int>(cape_columns - 1)) * shoulders /
                           (2 * static_cast<int>(cape_columns - 1));
        hold(cape, column, humanoid, LKS_HUMANOID_CHEST, millimetres(across, cape_top - chest_y, -125));
    }
}

// From one's left hand, which is towards +x, to the next one's right hand.
void DressedCrowd::add_rope(std::size_t left, std::size_t right) {
    const lks_vec3 hand = shape_.bones[LKS_HUMANOID_HAND_LEFT].body.transform.position;
    const lks_object_id rope = add_object(rope_, sum(shape_.places[left].position, hand));
    hold(rope, 0, left, LKS_HUMANOID_HAND_LEFT, {});
    hold(rope, rope_segments, right, LKS_HUMANOID_HAND_RIGHT, {});
}

lks_object_id DressedCrowd::add_object(const lks_asset* asset, const lks_vec3& position) {
    lks_object_def def = lks_default_object_def();
    def.asset = asset;
    def.transform.position = position;
    def.linear_damping = LKS_FIXED_RATIO(1, 2);
    if (dress_ != Dress::beside) {
        def.velocity = shape_.velocity;
    }
    lks_object_id object{};
    lks_world_add_object(crowd_->world(), &def, &object);
    particles_ += lks_asset_vertex_count(asset);
    return object;
}

void DressedCrowd::hold(lks_object_id object, std::uint32_t vertex, std::size_t humanoid, std::uint32_t bone,
                        const lks_vec3& point) {
    if (dress_ == Dress::beside) {
        lks_object_pin(crowd_->world(), object, vertex);
        return;
    }
    lks_attachment_def def = lks_default_attachment_def();
    def.object = object;
    def.vertex = vertex;
    def.body = crowd_->bodies()[humanoid * LKS_HUMANOID_BONES + bone];
    def.point = point;
    lks_attachment_id attachment{};
    lks_world_add_attachment(crowd_->world(), &def, &attachment);
    attachments_.push_back(attachment);
}

std::vector<double> DressedCrowd::attachment_errors() const {
    std::vector<double> errors;
    for (const lks_attachment_id attachment : attachments_) {
        lks_fixed error = 0;
        lks_attachment_error(crowd_->world(), attachment, &error);
        errors.push_back(lks_fixed_to_double(error));
    }
    return errors;
}

} // namespace lks_bench
