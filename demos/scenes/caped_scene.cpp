#include "scenes/caped_scene.h"

#include "scenes/time_curves.h"

namespace lks_demo {
namespace {

constexpr std::uint32_t columns = 22;
constexpr std::uint32_t rows = 34;
// Above the feet, mm.
constexpr std::int64_t top = 1475;
constexpr std::int64_t middle = top - 481;
constexpr std::int64_t chest_height = 1285;

} // namespace

bool CapedScene::add_cape(lks_body_id chest, const lks_vec3& feet, Rgb front, Rgb back) {
    lks_cloth_def def = lks_default_cloth_def();
    def.columns = columns;
    def.rows = rows;
    def.width = 0.525;
    def.height = 0.9625;
    def.area_density = 0.25;
    def.shear.compliance = 1e-6;
    def.bend.compliance = 1e-3;
    def.particle_radius = 0.012;
    const lks_asset* asset = nullptr;
    const lks_vec3 behind = millimetres(0, middle, -145);
    lks_object_def object = lks_default_object_def();
    object.transform.position = {feet.x + behind.x, feet.y + behind.y, feet.z + behind.z};
    object.linear_damping = LKS_FIXED_RATIO(1, 2);
    ClothLook look;
    look.front = {Pattern::plain, front, front, rgb(0xcf9a3e), 0.2f};
    look.back = {Pattern::plain, back, back, rgb(0xcf9a3e), 0.2f};
    look.thickness = 0.006f;
    if (!create_cloth(def, asset) || !add_object("cape", asset, object)) {
        return false;
    }
    look_as_grid(def, look);
    for (std::uint32_t column = 0; column < columns; ++column) {
        lks_attachment_def hold = lks_default_attachment_def();
        hold.object = last_object();
        hold.vertex = column;
        hold.body = chest;
        // Drawn together to the width of the shoulders.
        const std::int64_t across =
            (2 * static_cast<std::int64_t>(column) - (columns - 1)) * 205 / (columns - 1);
        hold.point = millimetres(across, top - chest_height, -125);
        lks_attachment_id id{};
        if (!accept(lks_world_add_attachment(world(), &hold, &id))) {
            return false;
        }
    }
    return true;
}

} // namespace lks_demo
