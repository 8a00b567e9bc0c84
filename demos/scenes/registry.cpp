#include "scenes/nearest_name.h"
#include "scenes/scene.h"
#include "scenes/scene_list.h"

namespace lks_demo {
namespace {

struct Entry {
    SceneInfo info;
    std::unique_ptr<Scene> (*make)(const SceneInfo& info);
};

const std::vector<Entry>& entries() {
    static const std::vector<Entry> all = {
        {{"cloth_hang",
          "A cloth of 64 x 64 vertices swings down from two corners that come together",
          420,
          240,
          {60, 200}},
         make_cloth_hang},
        {{"cloth_drape", "A cloth falls on a sphere and a box and slides", 360, 240, {50, 180}},
         make_cloth_drape},
        {{"flag", "A pennant, an irregular triangle mesh, in a gusty wind", 480, 240, {90, 230}}, make_flag},
        {{"rope_bridge", "A roller runs over a bridge of ropes and back", 600, 300, {130, 290}},
         make_rope_bridge},
        {{"rope_wrap", "Ropes swing and fall around capsules", 420, 240, {70, 220}}, make_rope_wrap},
        {{"curtain_rings", "A pair of curtains on moving rings opens and closes", 600, 300, {60, 240}},
         make_curtain_rings},
        {{"crane",
          "A winch lifts a crate, a barrier opens, and a banner is sent from pad to pad",
          360,
          240,
          {120, 230}},
         make_crane},
        {{"box_stack", "A tower and a pyramid of boxes, and a ball that rolls into it", 300, 150, {60, 110}},
         make_box_stack},
        {{"dominoes", "A ball tips a row of dominoes, and the last one bowls", 420, 330, {130, 310}},
         make_dominoes},
        {{"newtons_cradle", "Five balls on rods hand on an impact", 600, 150, {50, 120}},
         make_newtons_cradle},
        {{"bouncing_balls",
          "Balls bounce as high as their plates let them, and one falls through",
          300,
          150,
          {57, 130}},
         make_bouncing_balls},
        {{"cart",
          "A cart on springs and wishbones rolls over bumps and into a pile of crates",
          160,
          150,
          {40, 118}},
         make_cart},
        {{"ragdoll_stairs", "A mannequin tumbles down a flight of stairs", 300, 240, {50, 230}},
         make_ragdoll_stairs},
        {{"ragdoll_pile", "Thirty mannequins fall into a pit and pile up", 420, 240, {60, 120}},
         make_ragdoll_pile},
        {{"ragdoll_hang",
          "A mannequin hangs by its hands on two ropes until one breaks",
          420,
          300,
          {60, 270}},
         make_ragdoll_hang},
        {{"ragdoll_cape", "A powered mannequin walks in a circle and wears a cape", 480, 180, {60, 170}},
         make_ragdoll_cape},
        {{"sentry",
          "A powered mannequin stands, salutes and bows, and its strength leaves it",
          420,
          330,
          {100, 300}},
         make_sentry},
        {{"spider", "A powered spider walks over rubble, and its strength leaves it", 480, 180, {60, 170}},
         make_spider},
    };
    return all;
}

const Entry* find_entry(const std::string& name) {
    for (const Entry& entry : entries()) {
        if (name == entry.info.name) {
            return &entry;
        }
    }
    return nullptr;
}

} // namespace

const std::vector<std::string>& scene_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const Entry& entry : entries()) {
            all.emplace_back(entry.info.name);
        }
        return all;
    }();
    return names;
}

const SceneInfo* find_scene_info(const std::string& name) {
    const Entry* entry = find_entry(name);
    return entry != nullptr ? &entry->info : nullptr;
}

std::unique_ptr<Scene> create_scene(const std::string& name, const SceneOptions& options,
                                    std::string& error) {
    const Entry* entry = find_entry(name);
    if (entry == nullptr) {
        error = "There is no scene '" + name + "'" + did_you_mean(name, scene_names());
        return nullptr;
    }
    std::unique_ptr<Scene> scene = entry->make(entry->info);
    return scene->create(options, error) ? std::move(scene) : nullptr;
}

} // namespace lks_demo
